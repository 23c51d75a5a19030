"""The method of Oliver and Pharr on unloadings with closed forms, and on fused silica."""

import re
from dataclasses import replace

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...said import kinds
from ..fit.test_fit import silica

E = 10e9
CONE = 2 - 4 / np.pi
#: Loading, hold, unloading to the depth 10 nm, hold, and a second loading.
DEPTH = np.concatenate(
    [
        np.linspace(0, 60e-9, 50), np.full(10, 60e-9), np.linspace(60e-9, 10e-9, 80), np.full(9, 10e-9),
        np.linspace(10e-9, 40e-9, 20),
    ]
)  # fmt: skip


@pytest.mark.parametrize(
    ("profile", "epsilon", "exponent"),
    [
        (mdr.Cone(0.3), CONE, 2.0),
        (mdr.Paraboloid(1e-6), 0.75, 1.5),
        (mdr.FlatPunch(1e-7), 1.0, 1.0),
        # ε = m (1 − z(a)/d), where g/z = 8/3 for z ∝ r⁴.
        (mdr.PowerLaw(1e20, 4.0), 1.25 * (1 - 3 / 8), 1.25),
    ],
)
def test_elastic_unloadings_are_power_laws(profile, epsilon, exponent):
    """F = k d^m with S = 2E* a: E* and the mean pressure are exact if ε is the constant of the shape.

    Some hundred roundings, as F, S and m are extrapolated from the samples.
    """
    state = mdr.indent(profile, mdr.Medium(E), DEPTH)
    result = mdr.oliver_pharr(profile, DEPTH, state.force, epsilon=epsilon)
    loaded = state[50]
    expected = loaded.stiffness, E, loaded.mean_pressure, exponent
    values = result.stiffness, result.E_star, result.hardness, result.exponent
    assert values == approx(expected, rel=1e-11)
    assert not kinds(result) & {"creep", "taken"}
    height = profile.height(loaded.contact_radius)
    assert result.contact_depth == approx(height, rel=1e-11, abs=1e-18)


def test_beta_and_scale():
    """E* goes as 1/β, and everything as the units do, from nm to km."""
    profile, F = mdr.Cone(0.3), mdr.indent(mdr.Cone(0.3), mdr.Medium(E), DEPTH).force
    result = mdr.oliver_pharr(profile, 1e12 * DEPTH, 1e24 * F, epsilon=CONE, beta=1.25)
    assert result.E_star == approx(E / 1.25, rel=1e-11)
    assert result.to_dict().keys() >= {"E_star", "E_star_error", "hardness", "contact_depth_error"}
    assert "effective modulus E*     8" in repr(result)


def test_a_yielded_cone_has_the_stiffness_of_the_model_at_another_radius():
    """For d ≫ d_c ε F/S vanishes, and h_c → d, where the model has z(a) = 2d/π: E* is 2/π of the medium's.

    The unloading is that of a flat punch to the order d_c/d = 10⁻³.
    """
    profile, medium = mdr.Cone(0.3), mdr.Medium.from_critical_depth(E, 60e-12)
    depth = np.append(np.linspace(0, 60e-9, 50), np.linspace(60e-9, 59.95e-9, 50))
    state = mdr.indent(profile, medium, depth)
    result = mdr.oliver_pharr(profile, depth, state.force, epsilon=CONE)
    assert result.stiffness == approx(2 * E * state[50].contact_radius, rel=1e-3)
    assert result.E_star == approx(2 / np.pi * E, rel=2e-3)
    assert result.hardness == approx(4 / np.pi**2 * state[50].mean_pressure, rel=4e-3)


@pytest.mark.slow
def test_errors_are_those_of_repeated_measurements():
    """The standard deviation of 30 pulls is known to 13 %: four of these around 1."""
    profile, random = mdr.Cone(0.3), np.random.default_rng(1)
    F = mdr.indent(profile, mdr.Medium(E), DEPTH).force
    exact = mdr.oliver_pharr(profile, DEPTH, F)
    noisy = [
        mdr.oliver_pharr(profile, DEPTH, F + 0.004 * F.max() * random.standard_normal(F.size))
        for _ in range(30)
    ]
    for name, error in exact.standard_errors.items():
        pulls = [
            (getattr(each, name) - getattr(exact, name)) / each.standard_errors[name] for each in noisy
        ]
        assert error < 1e-10 * abs(getattr(exact, name))
        assert 0.48 < np.std(pulls) < 1.52, name
        assert abs(np.mean(pulls)) < 4 / np.sqrt(30), name


def test_fused_silica():
    """70.9 GPa and 9.4 GPa by `micromechanics` from the dynamic stiffness, which is another measurement.

    It is read before the hold, where the depth is 1 % less, and the area 3 %.
    """
    depth, force, _ = silica()
    result = mdr.oliver_pharr(mdr.Cone.from_half_angle(70.3), depth, force)
    assert result.E_star == approx(70.9e9, rel=0.02)
    assert result.hardness == approx(9.42e9, rel=0.04)
    # Parts of the unloading from 90 to 99 % down to 30 to 50 % of the force give 69.37 to 69.63 GPa.
    assert 0.13e9 <= result.standard_errors["E_star"] < 0.01 * result.E_star


def test_the_report_of_a_fit_has_it_where_there_is_an_unloading():
    """Of the contact: without first contact and background, which the fit knows."""
    profile, F0 = mdr.Cone(0.3), 1e-6
    F = mdr.indent(profile, mdr.Medium(E), DEPTH).force
    depth, force = DEPTH + 7e-9, F + F0
    held = {"q_c": np.inf, "baseline": F0}
    modulus = mdr.oliver_pharr(profile, DEPTH, F).E_star
    report = repr(mdr.fit_indentation(profile, depth, force, **held))
    # Six digits, without an error: without noise it is that of the arithmetic.
    assert f"Oliver and Pharr         E* {modulus / 1e9:.6g} GPa, H" in report
    assert "Oliver" not in repr(mdr.fit_indentation(profile, depth[:60], force[:60], **held))


@pytest.mark.parametrize(
    "parameters", [{"eta": None}, {"eta": 1e6}, {"work_of_adhesion": None}, {"work_of_adhesion": 0.01}]
)
def test_a_report_leaves_it_out_of_media_whose_unloading_is_no_power_law(parameters):
    """A viscous medium has another stiffness, one with adhesion another contact radius."""
    profile, time = mdr.Cone(0.3), np.linspace(0.0, 1.0, DEPTH.size)
    force = mdr.indent(profile, mdr.Medium(E), DEPTH).force
    assert "Oliver" in repr(mdr.fit_indentation(profile, DEPTH, force, time=time, q_c=np.inf))
    fit = mdr.fit_indentation(profile, DEPTH, force, time=time, q_c=np.inf, **parameters)
    assert "Oliver" not in repr(fit)


@pytest.mark.slow
def test_its_error_in_a_report_is_also_that_of_the_contact_point():
    """Of 30 unloadings, the standard deviation of whose pulls is known to 13 %: four of these around 1.

    That of the scatter about the power law alone would be 1.7.
    """
    profile, depth = mdr.Cone(0.3), np.linspace(60e-9, 20e-9, 200)
    force, random = mdr.indent(profile, mdr.Medium(E), depth).force, np.random.default_rng(2)
    exact, sigma, pulls = mdr.oliver_pharr(profile, depth, force).E_star, 0.002 * force.max(), []
    for _ in range(30):
        noisy = force + sigma * random.normal(size=force.size)
        fit = mdr.fit_indentation(
            profile, depth + 7e-9, noisy, q_c=np.inf, baseline=None, force_noise=sigma
        )
        value, error = re.search(r"Pharr +E\* ([\d.]+) ± ([\d.]+) GPa", repr(fit)).groups()
        pulls.append((float(value) - exact / 1e9) / float(error))
    assert 0.48 < np.std(pulls) < 1.52


def test_a_report_leaves_it_out_where_the_model_does_not_fit():
    """On silica the fitted first contact, 106 ± 29 nm below that of the record, makes 75.6 GPa of 69.6."""
    depth, force, _ = silica()
    fit = mdr.fit_indentation(mdr.Cone(0.358), depth, force)
    assert any("not of class (b)" in remark for remark in fit.remarks)
    assert "Oliver" not in repr(fit)


F_CONE = mdr.indent(mdr.Cone(0.3), mdr.Medium(E), DEPTH).force


@pytest.mark.parametrize(
    ("depth", "force", "options", "says"),
    [
        (DEPTH[:60], F_CONE[:60], {}, r"after the largest depth, 60 nm \(sample 60 of 60\)"),
        (DEPTH[:64], F_CONE[:64], {}, "upper half of an unloading has 4 samples, 5 or more"),
        (DEPTH - 50e-9, F_CONE, {}, r"contact depth .* must be positive and within the profile"),
        (DEPTH, -F_CONE, {}, "depth and force must decrease"),
        (DEPTH, F_CONE[:-1], {}, "must have the same shape"),
        (DEPTH[None], F_CONE[None], {}, "must have the same shape"),
        (DEPTH, np.where(DEPTH > 5e-8, np.inf, F_CONE), {}, "must be finite"),
        (DEPTH, np.full(DEPTH.size, np.nan), {}, "have no samples"),
        (DEPTH, F_CONE, {"epsilon": -1.0}, "epsilon"),
        (DEPTH, F_CONE, {"beta": 0.0}, "beta"),
        ([], [], {}, "have no samples"),
        (DEPTH[:60], F_CONE[:60], {"cycles": True}, "5 or more are needed"),
    ],
)
def test_curves_without_an_unloading_are_refused(depth, force, options, says):
    with pytest.raises(ValueError, match=says):
        mdr.oliver_pharr(mdr.Cone(0.3), depth, force, **options)


def test_samples_with_nan_are_left_out():
    """As by `fit_indentation`; every seventh sample has one here, in depth or force."""
    depth, force = DEPTH.copy(), F_CONE.copy()
    depth[::14], force[7::14] = np.nan, np.nan
    used = np.arange(DEPTH.size) % 7 > 0
    left_out = mdr.oliver_pharr(mdr.Cone(0.3), DEPTH[used], F_CONE[used])
    assert mdr.oliver_pharr(mdr.Cone(0.3), depth, force).to_dict() == left_out.to_dict()


def test_an_ensemble_of_profiles_is_refused():
    with pytest.raises(ValueError, match="an unloading"):
        mdr.oliver_pharr(mdr.Cone([0.3, 0.4]), DEPTH, F_CONE)


def test_a_profile_known_to_a_smaller_depth_is_refused():
    with pytest.raises(ValueError, match="must be positive and within the profile"):
        mdr.oliver_pharr(mdr.Sampled([0, 1e-8], [0, 3e-9]), DEPTH, F_CONE)


BERKOVICH, PEAKS = mdr.Cone.berkovich(), (0.01, 0.03, 0.1)


def cycles(modulus, hardness=9.2e9):
    """Depths (m) and forces (N) of three loadings to larger `PEAKS` (N) and unloadings to 15 % of each.

    Made from the method's own definitions: at a peak F = H π a², h = z(a) + ε F/S with S = 2E* a, and an
    unloading of power 1.3.
    """
    depths, forces, start = [], [], (0.0, 0.0)
    for peak in PEAKS:
        a = np.sqrt(peak / (np.pi * hardness))
        stiffness = 2 * modulus * a
        largest = BERKOVICH.height(a) + 0.75 * peak / stiffness
        depths.append(np.linspace(start[0], largest, 200)[1:])
        forces.append(np.linspace(start[1], peak, 200)[1:])
        back = largest - np.linspace(0, 1.3 * peak / stiffness * (1 - 0.15 ** (1 / 1.3)), 150)
        depths.append(back)
        forces.append(peak * (1 + stiffness * (back - largest) / (1.3 * peak)) ** 1.3)
        start = back[-1], forces[-1][-1]
    return np.concatenate(depths), np.concatenate(forces)


class TestCycles:
    MODULUS = 69.6e9

    def test_each_unloading_has_its_stiffness_modulus_and_hardness(self):
        """To some hundred roundings, as for one unloading; S and h_c grow as the root of the force."""
        result = mdr.oliver_pharr(BERKOVICH, *cycles(self.MODULUS), cycles=True)
        assert result.shape == (3,)
        assert result.E_star == approx(self.MODULUS, rel=1e-11)
        assert result.hardness == approx(9.2e9, rel=1e-11)
        a = np.sqrt(np.array(PEAKS) / (np.pi * 9.2e9))
        assert result.stiffness == approx(2 * self.MODULUS * a, rel=1e-11)
        assert result.contact_depth == approx(BERKOVICH.height(a), rel=1e-11)
        assert kinds(result) == {"left out"}

    @pytest.mark.slow
    def test_errors_in_noise_are_those_of_repeated_measurements(self):
        """Of 20 seeds the standard deviation of the pulls is known to 16 %: four of these above 1.

        The errors are not less than the range of results for parts of the unloading, and may be larger.
        """
        depth, force = cycles(self.MODULUS)
        pulls = []
        for seed in range(20):
            noise = 5e-5 * np.random.default_rng(seed).normal(size=force.size)
            result = mdr.oliver_pharr(BERKOVICH, depth, force + noise, cycles=True)
            assert result.shape == (3,)
            pulls.append((result.E_star - self.MODULUS) / result.standard_errors["E_star"])
        assert np.all(np.std(pulls, axis=0) < 1.64)

    def test_without_cycles_a_remark_says_which_unloading_was_taken(self):
        depth, force = cycles(self.MODULUS)
        result = mdr.oliver_pharr(BERKOVICH, depth, force)
        assert result.remarks[0].startswith("unloading 3 of 3")
        assert result.remarks[0] in repr(result)
        # The second of two where the last peak is less deep.
        twice = np.append(depth[:698], depth[:349]), np.append(force[:698], force[:349])
        assert mdr.oliver_pharr(BERKOVICH, *twice).remarks[0].startswith("unloading 2 of 3")
        single = mdr.oliver_pharr(BERKOVICH, depth[:349], force[:349])
        assert "taken" not in kinds(single)

    def test_unloadings_have_one_number_in_remarks_print_and_tables(self):
        """The second of three is left out, as its force relaxes at one depth: the others are 1 and 3."""
        pytest.importorskip("pandas")
        xarray = pytest.importorskip("xarray")
        depth, force = cycles(self.MODULUS)
        relaxed = depth.copy()
        relaxed[548:698] = depth[547]
        relaxed[698:897] = np.linspace(depth[547], depth[896], 199)
        result = mdr.oliver_pharr(BERKOVICH, relaxed, force, cycles=True)
        assert result.unloading.tolist() == [1, 3]
        assert result.E_star == approx([self.MODULUS] * 2, rel=1e-11)
        (remark,) = (each for each in result.remarks if each.startswith("unloading 2 of 3"))
        assert "depth and force must decrease" in remark
        assert re.findall(r"^  unloading (\d)", repr(result), re.MULTILINE) == ["1", "3"]
        table = result.to_pandas()
        assert table.index.tolist() == [1, 3]
        assert table["E_star"][3] == result[1].E_star
        assert result[1].unloading == 3
        dataset = result.to_xarray()
        assert isinstance(dataset, xarray.Dataset)
        assert dataset["E_star"].sel(unloading=3).item() == result.E_star[1]
        # Of one unloading as well.
        single = mdr.oliver_pharr(BERKOVICH, depth, force)
        assert single.unloading == 3
        assert single.to_xarray()["unloading"].item() == 3

    def test_a_jump_to_contact_is_no_unloading(self):
        """An approach in air with noise, attracted by 2 % of the largest force before contact."""
        depth, force = cycles(self.MODULUS)
        away, random = np.linspace(-5e-8, 0, 60, endpoint=False), np.random.default_rng(2)
        pull = np.where(away > -1e-8, -0.002, 0.0) + 1e-5 * random.normal(size=60)
        result = mdr.oliver_pharr(BERKOVICH, np.append(away, depth), np.append(pull, force), cycles=True)
        assert np.all(np.abs(result.E_star - self.MODULUS) < 2 * result.standard_errors["E_star"])
        assert np.all(result.standard_errors["E_star"] < 0.02 * self.MODULUS)

    def test_fused_silica_has_one(self):
        depth, force, _ = silica()
        tip = mdr.Cone.from_half_angle(70.3)
        result = mdr.oliver_pharr(tip, depth, force, cycles=True)
        assert result.E_star.tolist() == [mdr.oliver_pharr(tip, depth, force).E_star]


@pytest.mark.parametrize(("of_depth", "of_force"), [(1e-3, 1.0), (1.0, 1e3)])
def test_numbers_of_no_material_are_said(of_depth, of_force):
    """Depths or forces in a wrong unit: 10³ or 10⁶ times 80 GPa, where diamond has 1.15 TPa."""
    tip = mdr.Cone(slope=0.3)
    depth = np.append(np.linspace(0, 100e-9, 200), np.linspace(100e-9, 0, 200))
    force = mdr.indent(tip, mdr.Medium(E_star=80e9, hardness=8e9), depth).force
    right = mdr.oliver_pharr(tip, depth, force)
    wrong = mdr.oliver_pharr(tip, of_depth * depth, of_force * force)
    assert not any("no material has" in remark for remark in right.remarks)
    said = [re.match(r"no material has (E\*|H) = ", remark) for remark in wrong.remarks]
    assert [match[1] for match in said if match] == ["E*", "H"]


def test_youngs_modulus_of_the_sample():
    """Back through `Medium.from_bodies`, which has E* of two bodies; the error is that of a step of E*."""
    tip, medium = mdr.Cone.berkovich(), mdr.Medium.from_bodies(72e9, 0.17, 1141e9, 0.07, hardness=9e9)
    depth = np.append(np.linspace(0, 1e-6, 300), np.linspace(1e-6, 0.2e-6, 300))
    force = mdr.indent(tip, medium, depth).force
    result = mdr.oliver_pharr(tip, depth, force)
    known = replace(result, E_star=medium.E_star).sample_modulus(0.17, tip=(1141e9, 0.07))
    # Rounding of five operations.
    assert known.value == approx(72e9, rel=1e-14)
    step = replace(result, E_star=medium.E_star * (1 + 1e-6)).sample_modulus(0.17, (1141e9, 0.07)).value
    slope = (step - known.value) / (1e-6 * medium.E_star)
    # The difference quotient has an error of the step.
    assert known.standard_error == approx(slope * result.standard_errors["E_star"], rel=1e-4)
    quoted = mdr.fit_indentation(tip, depth, force, hardness=None).quoted
    # Under a rigid tip.
    assert quoted.sample_modulus(0.5).value == approx(0.75 * quoted.value, rel=1e-14)
    with pytest.raises(ValueError, match="must be stiffer than the contact"):
        result.sample_modulus(0.2, tip=(50e9, 0.2))
