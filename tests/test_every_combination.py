"""All shapes, all classes and sums of hardness, all quantities, against springs over x.

Cases are random by their seed. By default each shape has two of the sums, with --full all of them;
`python -m tests.benchmarks.combinations` tries thousands.
"""

import pytest

from .random_cases import BOUNDS, SUMS, TIPS, Case, deviations

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
