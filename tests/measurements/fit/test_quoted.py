"""The number of a fit that is to be quoted."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.measurements.fit import result

from ...approx import approx
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
    assert repr(quoted) == "E* 10 GPa by the fit: the medium is elastic"


def test_of_a_medium_that_yields_it_is_that_of_the_unloading():
    """From first contact of the fit: 5 nm here, which the depths do not have subtracted."""
    F = force(mdr.Medium(E, hardness=1.5e9))
    fit = mdr.fit_indentation(CONE, DEPTH + 5e-9, F, hardness=None)
    expected = mdr.oliver_pharr(CONE, DEPTH, F).E_star
    assert fit.quoted.source == "unloading"
    assert fit.quoted.value == approx(expected, rel=1e-6)
    assert fit.quoted.value < 0.95 * fit.medium.E_star


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


def test_it_is_computed_only_when_it_is_read():
    fit = mdr.fit_indentation(CONE, DEPTH, force(mdr.Medium(E, hardness=1.5e9)), hardness=None)
    assert not {"quoted", "unloading"} & set(vars(fit))
    assert fit.quoted is fit.quoted


def test_the_unloading_is_evaluated_once(monkeypatch):
    """For the number to quote, and for the row of the report."""
    calls, evaluate = [], result.unloading
    monkeypatch.setattr(result, "unloading", lambda fit: calls.append(fit) or evaluate(fit))
    fit = mdr.fit_indentation(CONE, DEPTH, force(mdr.Medium(E, hardness=1.5e9)), hardness=None)
    assert fit.quoted.value == fit.unloading[0].E_star
    assert "Oliver and Pharr" in str(fit)
    assert calls == [fit]


def test_silica_with_the_contact_of_its_file():
    depth, F, _ = silica()
    fit = mdr.fit_indentation(mdr.Cone.berkovich(), depth, F, hardness=None, contact_point=0.0)
    assert fit.quoted.source == "unloading"
    assert fit.quoted.value == approx(69.62e9, abs=0.1e9)
    assert 0.1e9 < fit.quoted.standard_error < 0.3e9


def test_silica_in_any_class_has_one_number():
    """Its own zero is first contact: those of the fits, 106 and −27 nm, are not."""
    depth, F, _ = silica()
    for hardness in ({}, {"hardness": None}):
        quoted = mdr.fit_indentation(mdr.Cone.berkovich(), depth, F, **hardness).quoted
        assert quoted.value == approx(69.62e9, abs=0.1e9)
        assert quoted.standard_error == approx(0.14e9, abs=0.03e9)


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
