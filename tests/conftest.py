"""What all tests share: comparisons are relative."""

import pytest

_with_absolute_tolerance = pytest.approx


def relative_approx(expected, rel=None, abs=None, nan_ok=False):
    """`pytest.approx` without its default absolute tolerance of 1e-12.

    Many lengths, forces and energies in SI units are smaller, so that any two of them would be equal.
    """
    if abs is None:
        return _with_absolute_tolerance(expected, rel=1e-6 if rel is None else rel, abs=0.0, nan_ok=nan_ok)
    return _with_absolute_tolerance(expected, rel=rel, abs=abs, nan_ok=nan_ok)


pytest.approx = relative_approx
