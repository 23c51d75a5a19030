"""Thousands of random cases against springs over x, and of random ensembles against a loop of single calls.

    python -m tests.benchmarks.combinations [cases] [ensembles] [first seed]

prints those beyond their bounds with their seeds, and the largest deviation of each quantity with its seed:
of cases as it is, of ensembles over the bound. The suite has the first ones
(`tests/test_every_combination.py`).
"""

import sys

from ..random_cases import BOUNDS, Case, deviations
from ..random_ensembles import compared, random_ensemble


def main(cases=3000, ensembles=3000, first=0):
    report(cases, first, Case.random, deviations, BOUNDS)
    report(ensembles, first, random_ensemble, compared, {})


def report(count, first, make, deviations, bounds):
    """Print deviations of so many random things by their seeds; a quantity without a bound has 1."""
    worst = {}
    for seed in range(first, first + count):
        thing = make(seed)
        try:
            found = deviations(thing)
        except AssertionError as error:
            print(error, flush=True)
            continue
        beyond = {name: f"{miss:.1e}" for name, miss in found.items() if not miss <= bounds.get(name, 1)}
        if beyond:
            print(thing, beyond, flush=True)
        for name, miss in found.items():
            worst[name] = max(worst.get(name, (0.0, seed)), (miss, seed))
    for name, (miss, seed) in worst.items():
        print(f"{name:20} {miss:.1e} of {bounds.get(name, 1):.0e} (seed {seed})")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
