"""Fits of curves with adhesion return the work of adhesion that the curves were made with."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.fit.adhesive_curve import adhesive_states

from .shapes import SHAPES, name

# Contact is lost at the end of the stable range of the elastic one, at the rim of the other one's imprint.
ELASTIC, YIELDING = mdr.Medium(1e9, work_of_adhesion=0.2), mdr.Medium(10e9, 127.3, work_of_adhesion=1.0)
OUT = np.append(np.linspace(-15e-9, 60e-9, 150), np.linspace(60e-9, -60e-9, 250))
# With an exponent of 1/2 adhesion spreads without limit; a flat face carries the same force for any w.
PROFILES = [each for each in SHAPES if name(each) not in ("PowerLaw0.5", "FlatPunch")]


def fitted(profile, medium, depth=OUT, noise=0.0, rows=1, **parameters):
    """A fit to made curves that begin at 3 nm, with noise as a share of the largest force."""
    force = mdr.indent(profile, medium, depth).force
    force = force + noise * force.max() * np.random.default_rng(1).normal(size=(rows, depth.size))
    depth = np.tile(depth + 3e-9, (rows, 1))
    parameters = {
        "work_of_adhesion": None,
        **({"q_c": np.inf} if medium.q_c == np.inf else {}),
        **parameters,
    }
    fit = mdr.fit_indentation(profile, depth, force, **parameters)
    return fit if rows > 1 else fit[0]


def pulls(fit, medium):
    """Deviations in units of the standard errors, by name."""
    values, true = fit.to_dict(), {"contact_point": 3e-9, "baseline": 0.0}
    for parameter, error in fit.standard_errors.items():
        yield parameter, (values[parameter] - true.get(parameter, getattr(medium, parameter, 0.0))) / error


@pytest.mark.parametrize("medium", [ELASTIC, YIELDING], ids=["elastic", "yielding"])
@pytest.mark.parametrize("profile", PROFILES, ids=name)
def test_is_the_inverse_of_indent(profile, medium):
    """To rounding, 10⁻¹³, times the condition number of a fit."""
    fit = fitted(profile, medium)
    found = fit.medium.E_star, fit.medium.q_c, fit.medium.work_of_adhesion, fit.contact_point
    expected = medium.E_star, medium.q_c, medium.work_of_adhesion, 3e-9
    np.testing.assert_allclose(found, expected, rtol=1e-8)
    assert not fit.remarks
    path = mdr.indent(profile, medium, OUT)
    for quantity in ("force", "contact_radius", "plastic_radius", "stiffness", "surface_energy"):
        expected = getattr(path, quantity)
        scale = np.abs(expected[np.isfinite(expected)]).max()
        np.testing.assert_allclose(getattr(fit.path, quantity), expected, rtol=1e-6, atol=1e-9 * scale)


@pytest.mark.parametrize(
    "profile", [mdr.Paraboloid(1e-6), mdr.Cone(0.3), mdr.PowerLaw(1e12, 2.7)], ids=name
)
@pytest.mark.parametrize("q_c", [1e6, 127.3])
def test_derivatives_are_those_of_the_force(profile, q_c):
    """Differences of a step h have errors of h² and of rounding over h.

    Some samples are below the rim of the imprint and the end of the stable range. One may be just within
    this end, where the derivatives are infinite.
    """
    depth, largest = np.linspace(60e-9, -60e-9, 61)[None], np.full((1, 61), 60e-9)
    start = np.log([10e9, q_c, 2.0])

    def states(logarithms=start, shift=0.0, growth=0.0):
        E, q, w = np.exp(logarithms)[:, None, None]
        values = {"E_star": E, "q_c": q, "work_of_adhesion": w}
        return adhesive_states(
            profile, values, depth + shift, largest + growth, np.zeros((1, 61), bool), True
        )

    _, _, force, slope, memory_slope, gradient = states()
    step = 1e-6
    for i, expected in enumerate(gradient):
        difference = states(start + step * np.eye(3)[i])[2] - states(start - step * np.eye(3)[i])[2]
        error = np.abs(difference / (2 * step) - expected)[0]
        assert np.sort(error)[-2] < 1e-6 * np.abs(force).max()
    for expected, change in ((slope, {"shift": 1e-14}), (memory_slope, {"growth": 1e-14})):
        difference = states(**change)[2] - states(**{key: -value for key, value in change.items()})[2]
        error = np.abs(difference / 2e-14 - expected)[0]
        assert np.sort(error)[-2] < 1e-5 * np.abs(slope).max()


@pytest.mark.parametrize("medium", [ELASTIC, YIELDING], ids=["elastic", "yielding"])
def test_errors_are_those_of_repeated_measurements(medium):
    """The standard deviation of the pulls of 50 curves is known to 10 %: four of these around 1."""
    fit = fitted(mdr.Paraboloid(1e-6), medium, OUT[::2], noise=0.01, rows=50, baseline=None)
    assert len(fit.standard_errors) == 4 + (medium.q_c < np.inf)
    for parameter, pull in pulls(fit, medium):
        assert 0.6 < pull.std() < 1.4, parameter
        assert abs(pull.mean()) < 0.57, parameter
        assert np.abs(pull).max() < 4, parameter


def test_what_is_held_stays_and_makes_the_others_better_known():
    profile = mdr.Paraboloid(1e-6)
    free, held = (fitted(profile, YIELDING, noise=0.01, rows=3, work_of_adhesion=w) for w in (None, 1.0))
    assert (held.medium.work_of_adhesion == 1.0).all()
    assert (held.standard_errors["contact_point"] < free.standard_errors["contact_point"]).all()
    assert all(np.abs(pull).max() < 4 for _, pull in pulls(held, YIELDING))
    everything = fitted(profile, YIELDING, work_of_adhesion=1.0, E_star=10e9, q_c=127.3, contact_point=3e-9)
    assert np.abs(everything.residuals).max() < 1e-12 * everything.force.max()
    assert "work of adhesion w" in str(everything)


def test_curves_of_different_lengths_and_cycles():
    """A second, deeper indentation begins on the imprint of the first one."""
    profile = mdr.Paraboloid(1e-6)
    deeper = np.concatenate([OUT, np.linspace(-60e-9, 90e-9, 200), np.linspace(90e-9, -60e-9, 250)])
    paths = OUT, deeper, OUT[50:300]
    forces = [mdr.indent(profile, YIELDING, path).force for path in paths]
    fit = mdr.fit_indentation(profile, list(paths), forces, work_of_adhesion=None)
    np.testing.assert_allclose(fit.medium.work_of_adhesion, 1.0, rtol=1e-8)
    np.testing.assert_allclose(fit.medium.E_star, 10e9, rtol=1e-8)


def test_a_pull_off_before_that_of_the_model_does_not_matter():
    """A soft cantilever loses contact where the tension is largest; the forces up to there are the same.

    Of a retract, which has no touch.
    """
    profile, force = mdr.Paraboloid(1e-6), mdr.indent(mdr.Paraboloid(1e-6), ELASTIC, OUT).force
    force = np.where(np.arange(force.size) > force.argmin(), 0.0, force)
    fit = mdr.fit_indentation(profile, OUT[150:], force[150:], q_c=np.inf, work_of_adhesion=None)
    assert fit.medium.work_of_adhesion == pytest.approx(0.2, rel=1e-8)


def test_nothing_is_determined_without_tension():
    medium = mdr.Medium(10e9, 127.3)
    fit = fitted(mdr.Cone(0.3), medium, noise=0.005)
    assert "no tension" in fit.remarks[0]
    assert fit.medium.work_of_adhesion < 1.0


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"work_of_adhesion": -1.0}, "work_of_adhesion = -1 J/m².*not negative"),
        ({"work_of_adhesion": "free"}, "must be a number"),
        ({"eta": None, "time": np.arange(OUT.size)}, "together with eta"),
        ({"depth_noise": 1e-9}, "together with depth_noise"),
    ],
)
def test_what_is_not_fitted_is_refused(parameters, words):
    if "time" in parameters:
        parameters = parameters | {"time": parameters["time"][None]}
    with pytest.raises(ValueError, match=words):
        fitted(mdr.Cone(0.3), YIELDING, **parameters)
