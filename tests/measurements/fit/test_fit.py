"""Fits return the medium that the measurements were made with."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.show.report import with_error

from ...approx import approx
from ...said import kinds
from ...shapes import SHAPES, name

E, Q = 10e9, 127.3
MEDIUM = mdr.Medium(E, q_c=Q)  # d_c = 20 nm
OUT = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 35e-9, 100))
SAMPLES = np.linspace(0.0, 2e-6, 40)
PROFILES = (*SHAPES, mdr.Sampled(SAMPLES, SAMPLES**2 / 2e-6))


DATA = Path(__file__).parents[2] / "data"
REFERENCE = json.loads((DATA / "reference.json").read_text())
AFM = ("spot3-0", "map2x2-2", "qi-noisy-2")
HERTZ = {"hertz_para": mdr.Paraboloid(1e-5), "hertz_cone": mdr.Cone.from_half_angle(25.0)}


def measured(name, segment):
    """Depth (m) and force (N) of the approach or retract of an AFM curve."""
    data = np.genfromtxt(DATA / f"{name}.csv", delimiter=",", names=True)
    rows = data["retract"] == (segment == "retract")
    return 1e-9 * data["depth_nm"][rows], 1e-9 * data["force_nN"][rows]


def silica():
    """Depth (m) and force (N) of loading, hold and unloading, and the index of the largest depth."""
    data = np.genfromtxt(mdr.example("silica.csv"), delimiter=",", names=True)[:1154]
    return 1e-9 * data["depth_nm"], 1e-3 * data["force_mN"], int(np.argmax(data["depth_nm"]))


def curve(profile, medium=MEDIUM, depth=OUT):
    return mdr.indent(profile, medium, depth).force


def noisy(profile, rows, *, seed, depth_noise=0.0, depth=OUT):
    """Curves with 0.4 % noise of the force, and some of the depth (m)."""
    random, force = np.random.default_rng(seed), curve(profile, depth=depth)
    size = rows, depth.size
    return (
        depth + 3e-9 + depth_noise * random.normal(size=size),
        force + 0.004 * force.max() * random.normal(size=size),
    )


def pulls(fit, **truth):
    """Deviations in units of the standard errors, by name."""
    values = fit.to_dict()
    return {name: (values[name] - true) / fit.standard_errors[name] for name, true in truth.items()}


class TestIndentation:
    @pytest.mark.parametrize("profile", PROFILES, ids=name)
    def test_is_the_inverse_of_indent(self, profile):
        """To the precision of the table of radii, 10⁻¹³, times the condition number of a fit."""
        fit = mdr.fit_indentation(profile, OUT + 7e-9, curve(profile))
        assert fit.medium.E_star == approx(E, rel=1e-9)
        assert fit.medium.q_c == approx(Q, rel=1e-9)
        assert fit.contact_point == approx(7e-9, rel=1e-9)
        assert not fit.remarks
        assert fit.path.force == approx(curve(profile), rel=1e-8, abs=1e-12 * curve(profile).max())

    def test_baseline_and_a_frame_that_is_subtracted(self):
        profile, C, F0 = mdr.Paraboloid(1e-6), 2e-4, 1e-6
        F = curve(profile)
        depth, force = OUT + C * F, F + F0
        fit = mdr.fit_indentation(profile, depth - C * force, force, baseline=None)
        values = fit.medium.E_star, fit.medium.q_c, fit.contact_point, fit.baseline
        assert values == approx((E, Q, -C * F0, F0), rel=1e-8)
        assert len(fit.standard_errors) == len(fit.covariance) == 4

    @pytest.mark.parametrize("depth_noise", [0.0, 0.4e-9])
    def test_errors_are_those_of_repeated_measurements(self, depth_noise):
        """The standard deviation of the pulls of 100 curves is known to 7 %: four of these around 1."""
        profile = mdr.Cone(0.3)
        depth, force = noisy(profile, 100, seed=1, depth_noise=depth_noise)
        fit = mdr.fit_indentation(profile, depth, force, depth_noise=depth_noise)
        for parameter, pull in pulls(fit, E_star=E, q_c=Q, contact_point=3e-9).items():
            assert 0.72 < pull.std() < 1.28, parameter
            assert abs(pull.mean()) < 0.45, parameter
        # Where the noise is estimated from the residuals χ² is 1 by construction, which says nothing.
        chi = approx(1.0, abs=0.06) if depth_noise else approx(np.nan, nan_ok=True)
        assert np.mean(fit.reduced_chi_square) == chi
        # By the noise of force and depth the residuals have the size 1, but for the three values fitted.
        assert np.mean((fit.residuals / fit.residual_noise) ** 2) == approx(1.0, abs=0.1)
        assert np.median(fit.force_noise) == approx(0.004 * curve(profile).max(), rel=0.1)

    def test_depth_noise_does_not_count_as_largest_depth(self):
        """A running maximum of the samples makes E* several times too small; a remark says so."""
        profile = mdr.Cone(0.3)
        depth, force = noisy(profile, 1, seed=2, depth_noise=4e-9)
        naive = mdr.fit_indentation(profile, depth[0], force[0])
        assert naive.medium.E_star < 0.7 * E
        turns = np.count_nonzero(np.diff(np.sign(np.diff(depth[0]))))
        said = f"goes back and forth at {turns} of {depth[0].size - 1} samples"
        assert any(said in remark and "give depth_noise" in remark for remark in naive.remarks)
        fit = mdr.fit_indentation(profile, depth[0], force[0], depth_noise=4e-9)
        assert abs(pulls(fit, E_star=E)["E_star"]) < 3
        assert fit.standard_errors["E_star"] < 0.2 * E

    def test_noise_of_silica_hardly_counts(self):
        """A ten-thousandth of the recovered 0.88 µm; as much again hardly changes E*."""
        depth, force, _ = silica()
        assert np.count_nonzero(np.diff(np.sign(np.diff(depth)))) > 0.05 * depth.size
        normal, fits = np.random.default_rng(2).normal(size=depth.size), []
        for size in (0.0, 0.12e-9):
            held = {"q_c": 0.0, "contact_point": 0.0, "hardness": None}
            fits.append(mdr.fit_indentation(mdr.Cone.berkovich(), depth + size * normal, force, **held))
            assert "noise" not in kinds(fits[-1])
        change = fits[1].medium.E_star - fits[0].medium.E_star
        assert abs(change) < 0.1 * fits[0].standard_errors["E_star"]

    def test_noise_is_no_new_largest_depth_on_unloading_alone(self):
        profile, back = mdr.Cone(0.3), slice(int(np.argmax(OUT)), None)
        depth, force = noisy(profile, 1, seed=2, depth_noise=1e-9)
        assert np.count_nonzero(np.diff(depth[0][back]) > 0) > 0.1 * OUT[back].size
        fit = mdr.fit_indentation(profile, depth[0][back], force[0][back])
        assert "noise" not in kinds(fit)

    def test_rows_are_the_curves_one_by_one(self):
        profile = mdr.Sphere(1e-6)
        depth, force = noisy(profile, 3, seed=3)
        fit = mdr.fit_indentation(profile, depth, force)
        assert fit.shape == fit.medium.E_star.shape == (3,)
        assert fit.path.shape == fit.residuals.shape == depth.shape
        for i in range(3):
            single = mdr.fit_indentation(profile, depth[i], force[i])
            # The minimum is known to the square root of rounding, and to a last step of 10⁻¹¹.
            assert single.medium.E_star == approx(fit[i].medium.E_star, rel=1e-7)
            assert single.standard_errors["q_c"] == approx(fit.standard_errors["q_c"][i], rel=1e-5)

    def test_held_parameters(self):
        profile = mdr.Cone(0.3)
        fit = mdr.fit_indentation(profile, OUT, 1.01 * curve(profile), E_star=E, q_c=Q, contact_point=0.0)
        assert (fit.medium.E_star, fit.medium.q_c, fit.contact_point) == (E, Q, 0.0)
        assert fit.residuals == approx(0.01 * curve(profile), abs=1e-12 * curve(profile).max())
        assert not fit.standard_errors

    def test_elastic_medium(self):
        """Hertz: q_c is undetermined if the critical depth is larger than the largest depth."""
        profile = mdr.Paraboloid(1e-6)
        force = 4 / 3 * E * np.sqrt(1e-6) * np.maximum(OUT, 0.0) ** 1.5
        fit = mdr.fit_indentation(profile, OUT + 3e-9, force)
        assert fit.medium.E_star == approx(E, rel=1e-9)
        assert fit.medium.q_c == fit.standard_errors["q_c"] == np.inf
        assert fit.remarks[0].kind == "constant"
        held = mdr.fit_indentation(profile, OUT + 3e-9, force, q_c=np.inf)
        assert held.medium.E_star == approx(E, rel=1e-9)
        # A second, deeper indentation: the class of hardness is not tested where all of the depth recovers.
        twice = np.append(OUT, 1.3 * OUT)
        held = mdr.fit_indentation(profile, twice, curve(profile, mdr.Medium(E), twice), q_c=np.inf)
        assert held.medium.E_star == approx(E, rel=1e-9)
        assert not held.remarks

    @pytest.mark.parametrize("profile", [mdr.Cone(0.3), mdr.Paraboloid(1e-6)], ids=name)
    def test_hardly_yielding_curves_fit_as_well_as_the_truth(self, profile):
        """Least squares have no larger sum than the true medium, for d_c from 0.7 to 1 of the depth."""
        E_star, d_c = np.full(40, E), 60e-9 * np.linspace(0.7, 1.0, 40)
        medium = mdr.Medium.from_critical_depth(E_star[:, None], d_c[:, None])
        depth, random = np.tile(OUT, (40, 1)), np.random.default_rng(6)
        force = curve(profile, medium, depth)
        force = force + 0.004 * force.max() * random.normal(size=force.shape)
        free = mdr.fit_indentation(profile, depth, force)
        true = mdr.fit_indentation(profile, depth, force, E_star=E_star, q_c=medium.q_c[:, 0])
        squares, least = (np.sum(fit.residuals**2, axis=1) for fit in (free, true))
        # An elastic medium is taken where yield gains less than twice the variance.
        assert np.all(squares <= least + 2.1 * least / OUT.size)

    def test_loading_alone_hardly_determines_the_modulus(self):
        profile = mdr.Cone(0.3)
        depth, force = noisy(profile, 1, seed=4, depth=OUT[:100])
        fit = mdr.fit_indentation(profile, depth[0], force[0])
        assert "vague" in kinds(fit)
        assert fit.standard_errors["E_star"] > 0.02 * fit.medium.E_star

    @pytest.mark.parametrize("depth_noise", [0.0, 0.2e-9])
    def test_recovered_depth_that_grows_is_not_class_b(self, depth_noise):
        """Three cycles on one spot, with the same pressure at the largest contact: q_c/a or constant."""
        profile, random = mdr.Cone(0.3), np.random.default_rng(5)
        path = np.concatenate([OUT * largest for largest in (0.5, 1.0, 1.5)])
        constant = mdr.Medium(E, hardness=Q / profile.contact_radius(path.max()))
        for medium, told in ((MEDIUM, False), (constant, True)):
            force = mdr.indent(profile, medium, path).force
            measured = path + depth_noise * random.normal(size=force.size)
            force = force + 0.002 * force.max() * random.normal(size=force.size)
            fit = mdr.fit_indentation(profile, measured, force, depth_noise=depth_noise)
            assert any("not of class (b)" in remark for remark in fit.remarks) == told, fit.remarks

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"force": -curve(mdr.Cone(0.3))}, "no contact"),
            ({"force": OUT[:-1]}, "have the same shape"),
            ({"depth": np.full(OUT.size, np.nan)}, "finite"),
            ({"depth_noise": -1e-9}, "depth_noise"),
            ({"E_star": -1.0}, "E_star"),
            ({"E_star": "free"}, "None, which makes it free"),
            ({"depth": [], "force": []}, "are empty"),
            ({"force": np.ma.masked_less(OUT, 0.0)}, "force has masked samples"),
            ({"depth": OUT[:3], "force": OUT[:3]}, "hold some"),
            ({"depth": [OUT, OUT], "force": [OUT, OUT[:-1]]}, r"curve 1: depth\[1\] \d+, force\[1\] \d+"),
            ({"depth": [OUT, OUT[:0]], "force": [OUT, OUT[:0]]}, "curve 1: 0 samples do not determine"),
            ({"depth": [OUT, OUT], "force": [OUT, OUT * np.nan]}, "curve 1: 0 samples do not determine"),
            ({"force": 1e-200 * curve(mdr.Cone(0.3))}, "range of force.* N must be at least 1e-25"),
        ],
    )
    def test_refusals(self, change, message):
        given = {"depth": OUT, "force": curve(mdr.Cone(0.3))} | change
        with pytest.raises(ValueError, match=message):
            mdr.fit_indentation(mdr.Cone(0.3), **given)


class TestRealCurves:
    @pytest.mark.few(6)
    @pytest.mark.parametrize("order", ["time", "reversed", "random"])
    @pytest.mark.parametrize("segment", ["approach", "retract"])
    @pytest.mark.parametrize("name", AFM)
    def test_reference_fits(self, name, segment, order):
        """E* within 10⁻⁴ and sums of squares within 10⁻³ of established fits, in any order of samples."""
        depth, force = measured(name, segment)
        rows = {"time": slice(None), "reversed": slice(None, None, -1)}.get(
            order, np.random.default_rng(9).permutation(depth.size)
        )
        for model, reference in REFERENCE[name][segment].items():
            fit = mdr.fit_indentation(HERTZ[model], depth[rows], force[rows], q_c=np.inf, baseline=None)
            # Loading, unloading and the largest depth so far mean nothing to an elastic medium.
            assert not kinds(fit) & {"noise"}
            assert fit.medium.E_star == approx(reference["E_star"], rel=1e-4)
            squares = np.sum((1e9 * fit.residuals) ** 2)
            assert squares == approx(reference["sum_of_squares"], rel=1e-3)

    def test_unloading_alone(self):
        """The sum of squares is not larger than with any held first contact; E* is that of the best."""
        depth, force, top = silica()
        depth, force, profile = depth[top:], force[top:], mdr.Cone.berkovich()
        fit = mdr.fit_indentation(profile, depth, force)
        points = np.linspace(-2e-6, 1e-6, 61)
        scan = mdr.fit_indentation(
            profile, np.tile(depth, (61, 1)), np.tile(force, (61, 1)), contact_point=points
        )
        squares = np.sum(scan.residuals**2, axis=1)
        assert np.sum(fit.residuals**2) <= squares.min()
        assert fit.medium.E_star == approx(scan.medium.E_star[squares.argmin()], rel=0.02)
        assert abs(fit.contact_point - points[squares.argmin()]) < 5e-8

    def test_two_minima(self):
        """In 10 % of noise two first contacts 30 nm apart fit alike, with moduli of 16 and 1.9 kPa."""
        depth, force = measured("qi-noisy-2", "retract")
        fit = mdr.fit_indentation(HERTZ["hertz_para"], depth, force, q_c=np.inf, baseline=None)
        assert any("1.878 kPa" in remark and "fits about as well" in remark for remark in fit.remarks)
        fit = mdr.fit_indentation(HERTZ["hertz_para"], *measured("spot3-0", "retract"), q_c=np.inf)
        assert "undetermined" not in kinds(fit)

    def test_misfit_of_silica(self):
        """In terms of the force 1.3 % is the least that is possible; weights by a depth noise have more."""
        depth, force, _ = silica()
        fit = mdr.fit_indentation(mdr.Cone.berkovich(), depth, force)
        assert "residuals (1.3 % of the force)" in " ".join(fit.remarks)
        fit = mdr.fit_indentation(mdr.Cone.berkovich(), depth, force, depth_noise=1e-9)
        assert 1.3 <= float(re.search(r"residuals \((\S+) % of the force", fit.remarks[-1])[1]) < 2

    @pytest.mark.parametrize("q_c", [Q, np.inf])
    def test_made_unloading_alone(self, q_c):
        medium, depth = mdr.Medium(E, q_c=q_c), np.linspace(60e-9, 45e-9, 50)
        fit = mdr.fit_indentation(mdr.Cone(0.3), depth, curve(mdr.Cone(0.3), medium, depth))
        assert (fit.medium.E_star, fit.medium.q_c) == approx((E, q_c), rel=1e-9)


class TestHardness:
    DEPTH = MEDIUM.critical_depth * np.geomspace(1.2, 50, 10)

    @pytest.mark.parametrize("profile", [mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.Sphere(1e-5)], ids=name)
    def test_is_the_inverse_of_the_mean_pressure(self, profile):
        state = mdr.indent(profile, MEDIUM, self.DEPTH)
        fit = mdr.fit_hardness(profile, state.mean_pressure, state.contact_radius, E_star=E)
        assert fit.medium.q_c == approx(Q, rel=1e-11)
        assert fit.class_of_hardness.letter == "b"
        assert fit.class_of_hardness.slope == approx(-1.0, rel=1e-10)

    @pytest.mark.parametrize(("power", "name"), [(0.0, "a"), (-1.0, "b"), (-2.0, "c"), (-0.6, None)])
    def test_class(self, power, name):
        """Far above yield (H ≪ E* s/2) the mean pressure is the hardness to a thousandth."""
        a = np.geomspace(1e-7, 1e-6, 9)
        noise = np.exp(0.01 * np.random.default_rng(8).normal(size=9))
        fit = mdr.fit_hardness(mdr.Cone(0.3), 1e6 * (a / 1e-7) ** power * noise, a, E_star=E)
        found = fit.class_of_hardness
        assert found.letter == name
        assert abs(found.slope - power) < 4 * found.slope_error
        assert (name is None) == any("not of class (b) alone" in remark for remark in fit.remarks)
        # Without a class it is the nearest one.
        (constant,) = fit.standard_errors
        assert constant == {"a": "hardness", "c": "f_c"}.get(name, "q_c")
        truth = 1e6 * 1e-7 ** {"a": 0, "c": 2}.get(name, 1)
        if name:
            deviation = getattr(fit.medium, constant) - truth
            assert abs(deviation) < 4 * fit.standard_errors[constant] + 1e-3 * truth

    @pytest.mark.parametrize(
        "constants",
        [{"hardness": 0.4e9}, {"f_c": 2e-6}, {"hardness": 0.4e9, "q_c": 20.0}, {"q_c": 40.0, "f_c": 1e-6}],
        ids=" and ".join,
    )
    def test_constants_that_are_asked_for(self, constants):
        medium = mdr.Medium(E, **constants)
        state = mdr.indent(mdr.Cone(0.3), medium, self.DEPTH)
        data = mdr.Cone(0.3), state.mean_pressure, state.contact_radius
        fit = mdr.fit_hardness(*data, E_star=E, **dict.fromkeys(constants))
        for constant in ("hardness", "q_c", "f_c"):
            true = constants.get(constant, 0.0)
            assert getattr(fit.medium, constant) == approx(true, rel=1e-9)
        assert not fit.remarks
        if len(constants) > 1:
            first, second = constants
            held = mdr.fit_hardness(*data, E_star=E, **{first: constants[first], second: None})
            assert getattr(held.medium, second) == approx(constants[second], rel=1e-9)

    def test_errors_of_two_constants(self):
        """Pulls of 200 fits have the width of Student's t, √(10/8) for 10 degrees of freedom."""
        medium, depth = mdr.Medium(E, hardness=0.2e9, q_c=20.0), np.geomspace(20e-9, 2e-6, 12)
        state, random = mdr.indent(mdr.Cone(0.3), medium, depth), np.random.default_rng(3)
        deviations = []
        for _ in range(200):
            p_m = state.mean_pressure * np.exp(0.01 * random.normal(size=12))
            given = {"E_star": E, "hardness": None, "q_c": None}
            fit = mdr.fit_hardness(mdr.Cone(0.3), p_m, state.contact_radius, **given)
            deviations.append(list(pulls(fit, hardness=0.2e9, q_c=20.0).values()))
        # Four times the 5 % to which the width is known.
        assert np.std(deviations, axis=0) == approx(np.sqrt(1.25), rel=0.2)
        assert np.abs(np.mean(deviations, axis=0)).max() < 4 * np.sqrt(1.25 / 200)

    def test_constants_that_radii_do_not_tell_apart(self):
        medium, random = mdr.Medium(E, hardness=0.2e9), np.random.default_rng(5)
        state = mdr.indent(mdr.Cone(0.3), medium, np.geomspace(20e-9, 60e-9, 8))
        p_m, a = state.mean_pressure * np.exp(0.02 * random.normal(size=8)), state.contact_radius
        given = {"E_star": E, "hardness": None, "q_c": None}
        fit = mdr.fit_hardness(mdr.Cone(0.3), p_m, a, **given)
        assert "constant" in kinds(fit)
        with pytest.raises(ValueError, match="do not determine hardness and q_c"):
            mdr.fit_hardness(mdr.Cone(0.3), p_m[:2], a[:2], **given)
        with pytest.raises(ValueError, match="all held"):
            mdr.fit_hardness(mdr.Cone(0.3), p_m, a, E_star=E, hardness=1e9)

    def test_elastic_contacts_are_refused(self):
        state = mdr.indent(mdr.Cone(0.3), mdr.Medium(E), self.DEPTH)
        with pytest.raises(ValueError, match="nothing has yielded"):
            mdr.fit_hardness(mdr.Cone(0.3), 1.01 * state.mean_pressure, state.contact_radius, E_star=E)

    @pytest.mark.parametrize("radius", [0.9e-6, 2.1e-6])
    def test_radii_outside_of_a_profile_are_refused(self, radius):
        tip = mdr.Sampled([0.0, 1e-6, 2e-6], [0.0, 0.0, 1e-6])
        with pytest.raises(ValueError, match="is not between the flat face"):
            mdr.fit_hardness(tip, [1e9, 1e9], [1.5e-6, radius], E_star=1e10)


@pytest.mark.parametrize(
    ("value", "error", "unit", "text"),
    [
        (95.234e9, 0.31e9, "Pa", "95.23 ± 0.31 GPa"),
        # An error of the arithmetic is not one of the measurement.
        (2.5e-9, 0.0, "m", "2.5 nm"),
        (69.8481732e9, 1.5e-5, "Pa", "69.8482 GPa"),
        (69.8481732e9, 1.5e5, "Pa", "69.84817 ± 0.00015 GPa"),
        (1.0, np.inf, "N", "1 ± ∞ N"),
        (np.inf, np.inf, "N/m", "∞"),
    ],
)
def test_values_with_errors(value, error, unit, text):
    assert with_error(value, error, unit) == text


def test_the_error_of_a_modulus_alone_is_that_of_a_regression():
    """F = E* k(d) with a known noise σ: the standard error is σ/√Σk²."""
    depth = np.linspace(0.0, 50e-9, 40)
    force = mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9), depth).force
    noise = 0.01 * force[-1]
    measured = force + np.random.default_rng(4).normal(0.0, noise, depth.size)
    held = {"q_c": np.inf, "contact_point": 0.0, "force_noise": noise}
    fit = mdr.fit_indentation(mdr.Cone(0.3), depth, measured, **held)
    assert fit.block_length == 1
    expected = noise / np.sqrt(np.sum((force / 1e9) ** 2))
    assert fit.standard_errors["E_star"] == approx(expected, rel=1e-9)
