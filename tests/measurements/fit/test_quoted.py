"""The number of a fit that is to be quoted."""

import re

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...said import remark_of
from ..unloading.test_creep import record
from .test_fit import silica

E, CONE = 10e9, mdr.Cone(0.3)
DEPTH = np.append(np.linspace(0, 60e-9, 100), np.linspace(60e-9, 10e-9, 100))


def force(medium, depth=DEPTH):
    return mdr.indent(CONE, medium, depth).force


def test_of_an_elastic_medium_it_is_the_modulus_of_the_fit():
    fit = mdr.fit_indentation(CONE, DEPTH, force(mdr.Medium(E)), q_c=np.inf)
    quoted = fit.quoted
    assert (quoted.quantity, quoted.source) == ("E_star", "fit")
    assert quoted.value == fit.medium.E_star == approx(E)
    assert quoted.standard_error == fit.standard_errors["E_star"]
    assert "elastic" in quoted.reason
    assert repr(quoted).startswith("E* 10 GPa by the fit")


@pytest.mark.parametrize("noise", [0.0, 1e-3])
@pytest.mark.parametrize("given", [{"hardness": 1.5e9}, {"q_c": 50.0}])
def test_of_a_model_that_describes_the_curve_it_is_that_of_the_model(given, noise):
    """A curve that `indent` made with E* has E*, and not what its unloading would have for a metal."""
    F = force(mdr.Medium(E, **given))
    F = F + noise * F.max() * np.random.default_rng(0).normal(size=F.size)
    fit = mdr.fit_indentation(CONE, DEPTH, F, **dict.fromkeys(given))
    assert fit.quoted.source == "fit"
    assert abs(fit.quoted.value - E) <= max(3 * fit.quoted.standard_error, 1e-6 * E)
    assert mdr.oliver_pharr(CONE, DEPTH, F).E_star < 0.95 * E


def wavy(medium):
    """A force that no model describes to its noise: neighbours are on one side of it."""
    return force(medium) * (1 + 2e-3 * np.sin(DEPTH / 4e-9))


def test_of_a_model_that_does_not_describe_the_curve_it_is_that_of_the_unloading():
    """From first contact of the fit: 5 nm here, which the depths do not have subtracted."""
    F = wavy(mdr.Medium(E, hardness=1.5e9))
    fit = mdr.fit_indentation(CONE, DEPTH + 5e-9, F, hardness=None)
    expected = mdr.oliver_pharr(CONE, DEPTH, F).E_star
    assert fit.quoted.source == "unloading"
    # First contact of the fit is within its error of 5 nm.
    assert fit.quoted.value == approx(expected, abs=3 * fit.quoted.standard_error)
    assert fit.quoted.value < 0.95 * fit.medium.E_star
    assert "E* of the model" in repr(fit)


def test_without_an_unloading_of_a_medium_that_yields_there_is_none():
    F = force(mdr.Medium(E, hardness=1.5e9))
    quoted = mdr.fit_indentation(CONE, DEPTH[:100], F[:100], hardness=None).quoted
    assert (quoted.value, quoted.standard_error, quoted.source) == (None, None, None)
    assert "of an unloading" in quoted.reason
    assert "\n" not in repr(quoted)


def test_it_is_that_of_one_curve():
    F = force(mdr.Medium(E))
    fit = mdr.fit_indentation(CONE, [DEPTH, DEPTH], [F, F], q_c=np.inf)
    with pytest.raises(ValueError, match="select one"):
        _ = fit.quoted
    assert fit[1].quoted.source == "fit"


def test_silica_in_any_class_has_one_number():
    """That of the unloading from its own zero: first contacts of the fits, 106 and −27 nm, are not used."""
    depth, F, _ = silica()
    expected = mdr.oliver_pharr(mdr.Cone.berkovich(), depth, F)
    for given in ({}, {"hardness": None}, {"hardness": None, "contact_point": 0.0}):
        quoted = mdr.fit_indentation(mdr.Cone.berkovich(), depth, F, **given).quoted
        assert quoted.source == "unloading"
        # Less than the error, 0.2 %.
        assert quoted.value == approx(expected.E_star, rel=1.5e-3)
        assert quoted.standard_error == approx(expected.standard_errors["E_star"], rel=0.2)


def test_a_yielded_curve_that_is_held_elastic_has_none():
    """Of 16 % more force on loading than on unloading: the fit of an elastic medium has 60.6 GPa."""
    depth, F, _ = silica()
    quoted = mdr.fit_indentation(mdr.Cone.berkovich(), depth, F, q_c=np.inf).quoted
    assert quoted.value is None
    assert "does not fit" in quoted.reason


def test_creep_is_corrected_where_it_is_not_small():
    time, depth, F = record(0.2, "viscous")
    fits = [
        mdr.fit_indentation(mdr.Cone.berkovich(), depth, F, time=t, hardness=None, contact_point=0.0)
        for t in (None, time)
    ]
    assert fits[0].quoted.value > 1.1 * 70e9
    assert fits[1].quoted.value == approx(70e9, rel=0.01)


X = np.linspace(-1e-6, 1e-6, 800)
BALL, GEL = mdr.Paraboloid(5e-6), mdr.Medium(12e3)


def gel(change=lambda F: F):
    """A curve of a gel with 3 pN of noise, and a change of its force."""
    F = mdr.indent(BALL, GEL, X).force
    return change(F) + 3e-12 * np.random.default_rng(0).normal(size=X.size)


def layer(F):
    """A layer of 4 µm on a hard substrate (Dimitriadis et al. 2002), to the second order."""
    chi = np.sqrt(BALL.radius * np.maximum(X, 0)) / 4e-6
    return F * (1 + 1.133 * chi + 1.283 * chi**2)


@pytest.mark.parametrize(
    ("change", "ratio"),
    [
        (layer, 1.24),
        *((lambda F, c=c: np.minimum(F, c * F.max()), r) for c, r in ((0.9, 0.96), (0.7, 0.75))),
    ],
)
def test_an_elastic_fit_with_systematic_residuals_has_none(change, ratio):
    """Of less than 5 % of the force, which is 100 times the noise; E* of the lower half tells the cause."""
    fit = mdr.fit_indentation(BALL, X, gel(change), q_c=np.inf)
    assert (fit.quoted.source, fit.quoted.kind) == (None, "misfit")
    remark = remark_of(fit, "misfit")
    told = float(re.search(r"(\S+) times E\* of the lower half", remark.text)[1])
    assert told == approx(ratio, abs=0.02)


@pytest.mark.parametrize("change", [lambda F: F, lambda F: F + 1.2e-11 * np.sin(X / 2e-7)])
def test_noise_and_weak_interference_are_no_misfit(change):
    fit = mdr.fit_indentation(BALL, X, gel(change), q_c=np.inf)
    assert fit.quoted.value == approx(GEL.E_star, rel=5e-3)
