"""All shapes, all classes and sums of hardness, all quantities, against springs over x.

Cases are random by their seed; `python -m tests.benchmarks.combinations` tries thousands.
"""

import pytest

from .random_cases import BOUNDS, SUMS, TIPS, Case, deviations


@pytest.mark.parametrize("seed", range(len(TIPS) * len(SUMS)))
def test_a_random_case(seed):
    """Within the errors of the reference, `BOUNDS`."""
    case = Case.random(seed)
    beyond = {name: miss for name, miss in deviations(case).items() if not miss <= BOUNDS[name]}
    assert not beyond, case
