"""Whether E* is within its standard errors on curves that deviate from the model, and where a remark warns.

The table of 100 seeds of each family is in `assets/fits.md`. Nominally two standard errors cover 95 %.
"""

from dataclasses import replace

import numpy as np
import pytest

from ...approx import approx
from .families import KINDS, covered, fits, told, visible

SEEDS = range(20)
GEL, GLASS, METAL = KINDS


@pytest.mark.parametrize("name", KINDS)
def test_clean_curves_are_covered_and_have_no_remark(name):
    """Of 95 % in 40 less than 33 are found once in a thousand times, two remarks of 0.4 % once in 80."""
    fit = fits(KINDS[name], "clean", 0.0, range(40))
    assert np.count_nonzero(covered(KINDS[name], fit)) >= 33
    assert sum(map(bool, told(fit))) <= 2


@pytest.mark.parametrize(
    ("name", "family", "size", "remarks"),
    [
        (GEL, "retract", 0.005, {"unloading"}),
        (GLASS, "retract", 0.005, {"unloading"}),
        (METAL, "retract", 0.005, {"unloading"}),
        (GLASS, "tilt", 0.01, {"tilt", "drag", "unloading"}),
        (GLASS, "creep", 0.003, {"unloading", "drift"}),
        (METAL, "creep", 0.003, {"unloading"}),
        (METAL, "creep", 0.02, {"misfit"}),
        (GLASS, "outliers", 0.1, {"outliers"}),
        (METAL, "outliers", 0.1, {"outliers"}),
        (GLASS, "correlated noise", 40, {"errors"}),
        (METAL, "correlated noise", 40, {"errors"}),
        (GEL, "few samples", 8, {"few", "undetermined"}),
    ],
)
def test_where_errors_are_too_small_a_remark_says_so(name, family, size, remarks):
    """E* of many of these is not covered; of the 100 in the table 80 % or more have one of the remarks.

    Less than 13 of 20 are found once in 100 times then.
    """
    fit = fits(KINDS[name], family, size, SEEDS)
    assert sum(bool(each & remarks) for each in told(fit)) >= 13
    assert np.count_nonzero(covered(KINDS[name], fit)) < 19


@pytest.mark.parametrize(("name", "size"), [(METAL, 0.003), (GLASS, 0.02), (METAL, 0.02)])
def test_a_drift_of_a_yielding_medium_is_not_seen_without_a_hold(name, size):
    """It biases E* by several errors, but the curve by less than four standard deviations."""
    assert visible(KINDS[name], "drift", size) < 4
    fit = fits(KINDS[name], "drift", size, SEEDS)
    assert np.count_nonzero(covered(KINDS[name], fit)) < 15


def test_the_most_that_can_be_seen_is_the_significance_of_the_true_cause():
    """Of a tilt it is that of the test for a tilt, √gain, where this is the only deviation."""
    kind = KINDS[GEL]
    fit = fits(kind, "tilt", 0.002, SEEDS)
    free = fits(replace(kind, options=kind.options | {"tilt": None}), "tilt", 0.002, SEEDS)
    gain = np.sum(fit.residuals**2, axis=1) / np.sum(free.residuals**2, axis=1) - 1
    seen = np.sqrt(np.maximum(gain, 0) * fit.depth.shape[1])
    # The mean of 20 deviates of width 1 is known to 0.22: four of these.
    assert visible(kind, "tilt", 0.002) == approx(np.mean(seen), abs=0.9)
