"""Comparison of numbers in SI units, of which many are smaller than pytest's absolute tolerance."""

import pytest


def approx(expected, rel=None, abs=None, nan_ok=False):
    """Return `pytest.approx` without its default absolute tolerance of 1e-12.

    Lengths, forces and energies of a contact may be smaller, and any two of them would be equal.
    The relative tolerance is 1e-6 unless `rel` or `abs` is given.
    """
    if abs is None:
        return pytest.approx(expected, rel=1e-6 if rel is None else rel, abs=0.0, nan_ok=nan_ok)
    return pytest.approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)
