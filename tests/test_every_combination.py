"""All shapes, all classes and sums of hardness, all quantities, against springs over x.

Cases are random by their seed. By default each shape has two of the sums, with --full all of them. Calls
with arrays of shapes, laws, structures and solvers are compared with a loop of single calls: 37 by default,
200 with --full. `python -m tests.benchmarks.combinations` tries thousands of both.
"""

import pytest

from .random_cases import BOUNDS, SUMS, TIPS, Case, deviations
from .random_ensembles import SOLVERS, compared, random_ensemble

#: Seeds of one case of each shape with each sum; shapes take turns first.
ALL = range(len(TIPS) * len(SUMS))
#: Of each shape two sums, others for the next shape, so that each sum has three or four shapes.
FEW = {
    shape + len(TIPS) * ((shape + turn) % len(SUMS))
    for shape in range(len(TIPS))
    for turn in (0, len(SUMS) // 2)
}
SEEDS = [pytest.param(seed, marks=[] if seed in FEW else pytest.mark.full) for seed in ALL]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_random_case(seed):
    """Within the errors of the reference, `BOUNDS`."""
    case = Case.random(seed)
    beyond = {name: miss for name, miss in deviations(case).items() if not miss <= BOUNDS[name]}
    assert not beyond, case


def is_default(seed):
    """Whether a seed is run without --full: 40 of them, but three alone of the chain, which is slow."""
    chain = list(SOLVERS)[seed % len(SOLVERS)] == "chain_impact"
    return seed < (20 if chain else 40)


@pytest.mark.parametrize(
    "seed", [pytest.param(i, marks=[] if is_default(i) else pytest.mark.full) for i in range(200)]
)
def test_a_random_ensemble_is_a_loop_of_single_calls(seed):
    """To twice the error that each call may have; an error of one is raised for all, and names an entry."""
    ensemble = random_ensemble(seed)
    if ensemble.solver.startswith("sweep"):
        pytest.importorskip("xarray")
    beyond = {name: miss for name, miss in compared(ensemble).items() if not miss <= 1}
    assert not beyond, ensemble
