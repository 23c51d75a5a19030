"""Random cases of every shape and every sum of hardness against springs over x, thousands of them.

    python -m tests.benchmarks.combinations [count] [first seed]

prints the cases beyond their bounds with their seeds, and the largest deviation of each quantity with its
seed. The suite has the first ones (`tests/test_every_combination.py`).
"""

import sys

from ..random_cases import BOUNDS, Case, deviations


def main(count=3000, first=0):
    worst = dict.fromkeys(BOUNDS, (0.0, first))
    for seed in range(first, first + count):
        case = Case.random(seed)
        found = deviations(case)
        beyond = {name: f"{miss:.1e}" for name, miss in found.items() if miss > BOUNDS[name]}
        if beyond:
            print(case, beyond, flush=True)
        for name, miss in found.items():
            worst[name] = max(worst[name], (miss, seed))
    for name, (miss, seed) in worst.items():
        print(f"{name:16} {miss:.1e} of {BOUNDS[name]:.0e} (seed {seed})")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
