"""Fits of curves with adhesion return the work of adhesion that the curves were made with."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.measurements.fit.adhesion import adhesive_states

from ...approx import approx
from ...said import kinds, remark_of
from ...shapes import SHAPES, name

MEDIUM = mdr.Medium(1e9, work_of_adhesion=0.2)
OUT = np.append(np.linspace(-15e-9, 60e-9, 150), np.linspace(60e-9, -60e-9, 250))
# With an exponent of 1/2 adhesion spreads without limit; a flat face carries the same force for any w.
PROFILES = [each for each in SHAPES if name(each) not in ("PowerLaw0.5", "FlatPunch")]


def fitted(profile, medium=MEDIUM, depth=OUT, noise=0.0, rows=1, **parameters):
    """A fit to made curves that begin at 3 nm, with noise as a share of the largest force."""
    force = mdr.indent(profile, medium, depth).force
    force = force + noise * force.max() * np.random.default_rng(1).normal(size=(rows, depth.size))
    depth = np.tile(depth + 3e-9, (rows, 1))
    fit = mdr.fit_indentation(
        profile, depth, force, **{"q_c": np.inf, "work_of_adhesion": None, **parameters}
    )
    return fit if rows > 1 else fit[0]


def pulls(fit):
    """Deviations in units of the standard errors, by name."""
    values, true = fit.to_dict(), {"contact_point": 3e-9, "baseline": 0.0}
    for parameter, error in fit.standard_errors.items():
        yield parameter, (values[parameter] - true.get(parameter, getattr(MEDIUM, parameter, 0.0))) / error


@pytest.mark.parametrize("profile", PROFILES, ids=name)
def test_is_the_inverse_of_indent(profile):
    """To rounding, 10⁻¹³, times the condition number of a fit."""
    fit = fitted(profile)
    found = fit.medium.E_star, fit.medium.work_of_adhesion, fit.contact_point
    np.testing.assert_allclose(found, (1e9, 0.2, 3e-9), rtol=1e-8)
    assert not fit.remarks
    path = mdr.indent(profile, MEDIUM, OUT)
    for quantity in ("force", "contact_radius", "stiffness", "surface_energy"):
        expected = getattr(path, quantity)
        scale = np.abs(expected[np.isfinite(expected)]).max()
        np.testing.assert_allclose(getattr(fit.path, quantity), expected, rtol=1e-6, atol=1e-9 * scale)


@pytest.mark.parametrize(
    "profile", [mdr.Paraboloid(1e-6), mdr.Cone(0.3), mdr.PowerLaw(1e12, 2.7)], ids=name
)
def test_derivatives_are_those_of_the_force(profile):
    """Differences of a step h have errors of h² and of rounding over h.

    Some samples are below the end of the stable range. One may be just within this end, where the
    derivatives are infinite.
    """
    depth, start = np.linspace(60e-9, -60e-9, 61)[None], np.log([10e9, 2.0])

    def states(logarithms=start, shift=0.0):
        E, w = np.exp(logarithms)[:, None, None]
        return adhesive_states(profile, {"E_star": E, "work_of_adhesion": w}, depth + shift, True)

    state, step = states(), 1e-6
    for i, parameter in enumerate(("E_star", "work_of_adhesion")):
        change = step * np.eye(2)[i]
        difference = states(start + change).force - states(start - change).force
        error = np.abs(difference / (2 * step) - np.exp(start[i]) * state.gradient[parameter])[0]
        assert np.sort(error)[-2] < 1e-6 * np.abs(state.force).max()
    difference = states(shift=1e-14).force - states(shift=-1e-14).force
    error = np.abs(difference / 2e-14 - state.slope)[0]
    assert np.sort(error)[-2] < 1e-5 * np.abs(state.slope).max()


@pytest.mark.slow
def test_errors_are_those_of_repeated_measurements():
    """The standard deviation of the pulls of 50 curves is known to 10 %: four of these around 1."""
    fit = fitted(mdr.Paraboloid(1e-6), depth=OUT[::2], noise=0.01, rows=50, baseline=None)
    assert len(fit.standard_errors) == 4
    for parameter, pull in pulls(fit):
        assert 0.6 < pull.std() < 1.4, parameter
        assert abs(pull.mean()) < 0.57, parameter
        assert np.abs(pull).max() < 4, parameter


def test_what_is_held_stays_and_makes_the_others_better_known():
    profile = mdr.Paraboloid(1e-6)
    free, held = (fitted(profile, noise=0.01, rows=3, work_of_adhesion=w) for w in (None, 0.2))
    assert (held.medium.work_of_adhesion == 0.2).all()
    assert (held.standard_errors["contact_point"] < free.standard_errors["contact_point"]).all()
    assert all(np.abs(pull).max() < 4 for _, pull in pulls(held))
    everything = fitted(profile, work_of_adhesion=0.2, E_star=1e9, contact_point=3e-9)
    assert np.abs(everything.residuals).max() < 1e-12 * everything.force.max()
    assert "work of adhesion w" in str(everything)


def test_curves_of_different_lengths_and_cycles():
    """A second, deeper indentation is that of a virgin medium: nothing has yielded."""
    profile = mdr.Paraboloid(1e-6)
    deeper = np.concatenate([OUT, np.linspace(-60e-9, 90e-9, 200), np.linspace(90e-9, -60e-9, 250)])
    paths = OUT, deeper, OUT[50:300]
    forces = [mdr.indent(profile, MEDIUM, path).force for path in paths]
    fit = mdr.fit_indentation(profile, list(paths), forces, q_c=np.inf, work_of_adhesion=None)
    np.testing.assert_allclose(fit.medium.work_of_adhesion, 0.2, rtol=1e-8)
    np.testing.assert_allclose(fit.medium.E_star, 1e9, rtol=1e-8)


def test_a_pull_off_before_that_of_the_model_is_said_and_changes_nothing():
    """A soft cantilever loses contact where the tension is largest; the forces up to there are the same.

    With δ = (π² w² R/E*²)^(1/3) that is at d = −3^(1/3) δ/4, and at prescribed depth at −3 δ/4 (Johnson,
    Kendall and Roberts). Of a retract, which has no touch, to the distance of its samples.
    """
    profile, retract = mdr.Paraboloid(1e-6), np.linspace(60e-9, -20e-9, 1000)
    force = mdr.indent(profile, MEDIUM, np.append(0.0, retract)).force[1:]
    force = np.where(np.arange(force.size) > force.argmin(), 0.0, force)
    fit = mdr.fit_indentation(profile, retract, force, q_c=np.inf, work_of_adhesion=None)
    assert fit.medium.work_of_adhesion == approx(0.2, rel=1e-8)
    (remark,) = fit.remarks
    difference = float(re.search(r"difference (\S+) nm", remark)[1])
    delta = (np.pi**2 * 0.2**2 * 1e-6 / 1e9**2) ** (1 / 3)
    assert 1e-9 * difference == approx((3 ** (1 / 3) - 3) / 4 * delta, abs=1.1 * 80e-9 / 999)


def test_nothing_is_determined_without_tension():
    fit = fitted(mdr.Cone(0.3), mdr.Medium(10e9), noise=0.005)
    assert "no tension" in fit.remarks[0]
    assert abs(fit.medium.E_star - 10e9) < 4 * fit.standard_errors["E_star"]


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"work_of_adhesion": -1.0}, "work_of_adhesion = -1 J/m².*not negative"),
        ({"work_of_adhesion": "free"}, "must be a number"),
        ({"eta": None, "time": np.arange(OUT.size)}, "viscosity; .*eta = 0"),
        ({"depth_noise": 1e-9}, "depth_noise=0.0"),
        ({"q_c": None}, "elastic medium.* q_c is free; give q_c=np.inf"),
        ({"q_c": 8.0, "work_of_adhesion": 0.05}, "elastic medium.* q_c is 8 N/m"),
        ({"q_c": [np.inf, 8.0], "rows": 2}, "elastic medium.* q_c is 8 … inf N/m"),
    ],
)
def test_what_is_not_fitted_is_refused(parameters, words):
    if "time" in parameters:
        parameters = parameters | {"time": parameters["time"][None]}
    with pytest.raises(ValueError, match=words):
        fitted(mdr.Cone(0.3), **parameters)


BOTH, APPROACH, RETRACT = slice(None), slice(0, 300), slice(300, None)


@pytest.mark.parametrize(
    ("w", "part"), [(1e-4, BOTH), (1e-4, APPROACH), (1e-4, RETRACT), (3e-4, BOTH), (3e-4, APPROACH)]
)
def test_an_adhesion_that_is_left_out_is_said(w, part):
    """By 8 and 29 % of the load E* was 9 and 29 % too large; with what the remedy frees it is right."""
    tip, depth = mdr.Paraboloid(5e-6), 1e-6 * np.append(np.linspace(-2, 1, 300), np.linspace(1, -2, 300))
    force = mdr.indent(tip, mdr.Medium(1e4, work_of_adhesion=w), depth).force
    force = force + 4e-3 * force.max() * np.random.default_rng(0).normal(size=force.size)
    fit = mdr.fit_indentation(tip, depth[part], force[part], q_c=np.inf)
    assert fit.medium.E_star > 1.05e4
    remark = remark_of(fit, "adhesion")
    freed = {remedy.what: None for remedy in remark.remedy if remedy.action == "free"}
    fit = mdr.fit_indentation(tip, depth[part], force[part], q_c=np.inf, **freed)
    assert abs(fit.medium.E_star - 1e4) < 4 * fit.standard_errors["E_star"] < 400
    assert "adhesion" not in kinds(fit)


@pytest.mark.few(3)
@pytest.mark.parametrize("eta", [0.0, 100.0])
@pytest.mark.parametrize("drag", [0.0, 2e-3])
@pytest.mark.parametrize("noise", [4e-3, 2e-2])
def test_no_drag_or_viscosity_is_taken_for_adhesion(eta, drag, noise):
    """The retract lies below the approach by both, but not below its own air."""
    tip, depth = mdr.Paraboloid(5e-6), 1e-6 * np.append(np.linspace(-2, 1, 300), np.linspace(1, -2, 300))
    time = np.linspace(0, 2, depth.size)
    force = np.zeros_like(depth)
    inside = slice(np.flatnonzero(depth > 0)[0], None)
    path = mdr.indent_in_time(tip, mdr.Medium(1e4, eta=eta), depth[inside], time[inside])
    force[inside] = path.force
    force += drag * np.gradient(depth, time)
    force += noise * force.max() * np.random.default_rng(1).normal(size=force.size)
    fit = mdr.fit_indentation(tip, depth, force, q_c=np.inf, baseline=None)
    assert "adhesion" not in kinds(fit)
