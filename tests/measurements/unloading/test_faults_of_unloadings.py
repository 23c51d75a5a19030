"""What is said of records whose zero, air or unloading is not as the method assumes, and of good ones."""

import contextlib
import re
from pathlib import Path

import numpy as np
import pytest
import scipy

import mdr_core as mdr

from ...approx import approx
from ...said import kinds, remark_of
from ..fit.test_fit import silica
from .test_creep import record

DATA = Path(__file__).parents[2] / "data"
E, DEEP, TIP = 70e9, 300e-9, mdr.Cone.berkovich()
SAID = {"zero", "creep", "taken"}


def first_yield(tip, medium):
    """Depth (m) at which the medium begins to yield."""
    depth = np.geomspace(1e-13, 1e-5, 600)
    yields = mdr.indent(tip, medium, depth).plastic_depth > 1e-3 * depth
    return depth[np.argmax(yields)] if yields.any() else np.inf


def with_yield(tip, name, ratio):
    """A medium of class (b) or (c) that yields from a share 1/ratio of `DEEP` on, by bisection."""
    low, high = -25.0, 0.0
    for _ in range(30):
        middle = (low + high) / 2
        later = first_yield(tip, mdr.Medium(E, **{name: E * 10**middle})) > DEEP / ratio
        low, high = (low, middle) if later else (middle, high)
    return mdr.Medium(E, **{name: E * 10**high})


def pressed(tip, medium, start=0.0, back=0.4, samples=300):
    """Depths and forces from a share of `DEEP` on, and back by most of what recovers."""
    dead = float(mdr.indent(tip, medium, [0.0, DEEP]).plastic_depth[-1])
    loading = np.linspace(start * DEEP, DEEP, samples)
    depth = np.append(loading, np.linspace(DEEP, dead + back * (DEEP - dead), samples))
    return depth, mdr.indent(tip, medium, depth).force


@pytest.mark.parametrize("tip", [TIP, mdr.Paraboloid(2e-6)])
@pytest.mark.parametrize(
    ("name", "value"),
    [("elastic", 0), ("hardness", 0.02), ("hardness", 0.13), ("q_c", 20), ("q_c", 200), ("f_c", 200)],
)
def test_exact_records_are_silent(tip, name, value):
    """From 0, 0.1, 0.9 and 21 % of the depth on, to 200 times the depth of first yield."""
    medium = mdr.Medium(E)
    if name == "hardness":
        medium = mdr.Medium(E, hardness=value * E)
    elif name != "elastic":
        medium = with_yield(tip, name, value)
    for start in (0.0, 1e-3, 9e-3, 0.21):
        result = mdr.oliver_pharr(tip, *pressed(tip, medium, start))
        assert not SAID & kinds(result), start
        assert result.contact_point == 0


@pytest.mark.parametrize(
    "tip",
    [
        mdr.TruncatedCone(5e-8, 0.358),
        mdr.PowerLaw(1e-3, 0.5),
        mdr.RoundedCone(0.358, 60e-9),
        mdr.Sphere(3e-6),
    ],
)
def test_elastic_contacts_have_the_exponent_of_their_tip(tip):
    """Of a truncated cone it is that of a cone from another depth on, m = 3 of a tip ∝ r^(1/2)."""
    assert not SAID & kinds(mdr.oliver_pharr(tip, *pressed(tip, mdr.Medium(E))))


@pytest.mark.parametrize("noise", [0.0, 1e-3])
@pytest.mark.parametrize("share", [0.02, 0.1, 0.3])
def test_a_depth_that_is_0_at_a_force_is_said_with_both_numbers(share, noise):
    """E* and H of both readings stand in a remark, and as given in the result."""
    depth, force = pressed(TIP, mdr.Medium(E, hardness=8e9))
    expected = mdr.oliver_pharr(TIP, depth, force)
    force = force + noise * force.max() * np.random.default_rng(2).normal(size=force.size)
    start = int(np.argmax(force > share * force.max()))
    result = mdr.oliver_pharr(TIP, depth[start:] - depth[start], force[start:])
    assert result.contact_point == 0
    assert result.E_star > 1.05 * expected.E_star
    remark = remark_of(result, "zero")
    before, first_E, first_H = re.search(
        r"contact is ([\d.]+) nm before, .*: E\* ([\d.]+) GPa and H ([\d.]+) GPa, instead of", remark
    ).groups()
    # Of the noise: it is that of first contact, and twice its share in H.
    assert float(before) == approx(1e9 * depth[start], rel=1e-3 + 40 * noise)
    assert float(first_E) == approx(expected.E_star / 1e9, rel=1e-3 + 10 * noise)
    assert float(first_H) == approx(expected.hardness / 1e9, rel=1e-3 + 20 * noise)
    assert "give" not in remark.text
    assert ("zero" in kinds(mdr.oliver_pharr(TIP, depth, force))) is False


@pytest.mark.parametrize("share", [5e-4, 1e-3, 4e-3])
def test_a_depth_that_is_0_at_a_small_force_is_said_with_the_depth_that_it_hides(share):
    """At 0.1 % of the force H is a tenth too large: a cone has 3 % of its depth there."""
    depth, force = pressed(TIP, mdr.Medium(E, hardness=8e9))
    expected = mdr.oliver_pharr(TIP, depth, force)
    hidden = np.sqrt(share) * depth.max()
    later = depth[: np.argmax(depth)] > hidden
    start = int(np.argmax(later))
    result = mdr.oliver_pharr(TIP, depth[start:] - depth[start], force[start:])
    remark = remark_of(result, "zero")
    told = float(re.search(r"a cone has ([\d.]+) % of its depth", remark)[1])
    assert told == approx(100 * depth[start] / depth.max(), rel=0.2)
    assert result.hardness > (1 + 1.5 * np.sqrt(share)) * expected.hardness


def test_an_offset_of_the_force_is_the_other_reading():
    """5 % of the largest force: the number of the remark is that of the record without it."""
    depth, force = pressed(TIP, mdr.Medium(E, hardness=8e9))
    expected = mdr.oliver_pharr(TIP, depth, force)
    result = mdr.oliver_pharr(TIP, depth, force + 0.05 * force.max())
    remark = remark_of(result, "zero")
    without = re.search(r"an offset: E\* ([\d.]+) GPa and H ([\d.]+) GPa", remark).groups()
    # The stiffness is fitted to the force with the offset.
    assert float(without[0]) == approx(expected.E_star / 1e9, rel=0.03)
    assert float(without[1]) == approx(expected.hardness / 1e9, rel=0.02)


@pytest.mark.parametrize("samples", [6, 13, 18])
def test_short_air_is_found(samples):
    """55 nm of air; without first contact E* would be 16 % too small, H 29 %."""
    depth, force = pressed(TIP, mdr.Medium(E, hardness=8e9))
    expected = mdr.oliver_pharr(TIP, depth, force)
    away = np.linspace(0, 55e-9, samples, endpoint=False)
    depth, force = np.append(away, depth + 55e-9), np.append(0 * away, force)
    for seed in range(5):
        noisy = force + 1e-3 * force.max() * np.random.default_rng(seed).normal(size=force.size)
        result = mdr.oliver_pharr(TIP, depth, noisy)
        assert result.contact_point == approx(55e-9, abs=4 * result.standard_errors["contact_point"])
        assert abs(result.E_star - expected.E_star) < 4 * result.standard_errors["E_star"]
        assert result.standard_errors["E_star"] < 0.05 * E


@pytest.mark.parametrize("share", [0.003, 0.03, 0.15])
def test_air_after_a_preload_is_used(share):
    """A preload where the depth is 0, 60 nm back, and the loading: as without the preload."""
    depth, force = pressed(TIP, mdr.Medium(E, hardness=8e9))
    expected = mdr.oliver_pharr(TIP, depth, force)
    start = int(np.argmax(force > share * force.max()))
    air = np.linspace(0, -60e-9, 40)
    d = np.concatenate([depth[start::-1], air, air[::-1], depth]) - depth[start]
    F = np.concatenate([force[start::-1], 0 * air, 0 * air, force])
    F = F + 5e-4 * F.max() * np.random.default_rng(1).normal(size=F.size)
    result = mdr.oliver_pharr(TIP, d, F)
    assert result.E_star == approx(expected.E_star, rel=0.02)
    assert result.hardness == approx(expected.hardness, rel=0.03)
    assert "is in the air after its first" in str(result.remarks)
    # The preload is no unloading.
    assert mdr.oliver_pharr(TIP, d, F, cycles=True).unloading.tolist() == [1]


@pytest.mark.few(3)
@pytest.mark.parametrize("preload", [30e-9, 100e-9])
@pytest.mark.parametrize("noise", [0.0, 1e-4])
@pytest.mark.parametrize("shift", [0.0, 60e-9])
def test_a_small_loading_before_a_new_approach_is_left_out(preload, noise, shift):
    """It rises from 0 and is lifted off; the loading that leads to the largest depth counts."""
    medium, last = mdr.Medium(E, hardness=8e9), [-50e-9, 300e-9, 150e-9]
    legs = [np.linspace(*ends, 80) for ends in ((-60e-9, preload), (preload, -50e-9))]
    first, second = np.concatenate(legs), np.append(*(np.linspace(*e, 250) for e in (last[:2], last[1:])))
    depth = np.append(first, second)
    force = np.append(*(mdr.indent(TIP, medium, part).force for part in (first, second)))
    force = force + noise * force.max() * np.random.default_rng(3).normal(size=force.size)
    expected = mdr.oliver_pharr(TIP, second, mdr.indent(TIP, medium, second).force)
    result = mdr.oliver_pharr(TIP, depth + shift, force)
    assert abs(result.E_star - expected.E_star) <= 4 * result.standard_errors["E_star"] + 1e-3 * E
    assert result.contact_point == approx(shift, abs=3e-9)


def test_real_steel_is_lifted_off_before_its_loading():
    """The force begins to rise between the depths −2.2 nm and 0; as given E* is 1.5 % larger."""
    curve = mdr.read_curve(DATA / "steel.csv")
    result = mdr.oliver_pharr(TIP, curve.depth, curve.force)
    assert -4e-9 < result.contact_point < 0
    assert "creep" in kinds(result)


def test_an_unloading_at_the_beginning_is_no_lift_off():
    """A record from a peak on, with a second, larger one, has both unloadings."""
    path = [(200, 100), (100, 400), (400, 250)]
    depth = 1e-9 * np.concatenate([[0.0], *(np.linspace(*pair, 150) for pair in path)])
    force = mdr.indent(TIP, mdr.Medium(E, hardness=8e9), depth).force
    assert mdr.oliver_pharr(TIP, depth[1:], force[1:], cycles=True).shape == (2,)


@pytest.mark.parametrize("kind", ["logarithmic", "viscous"])
def test_creep_is_said_without_times(kind):
    """E* is 15 % too large and more; without creep nothing is said, also in noise."""
    for share in (0.3, 0.5):
        _, depth, force = record(share, kind)
        result = mdr.oliver_pharr(TIP, depth, force)
        assert result.E_star > 1.1 * E
        remark = remark_of(result, "creep")
        assert "creeps" in remark.text
        assert [each.what for each in remark.remedy] == ["time"]
        assert "give time=" in remark
        assert "give time=" not in remark.text
    _, depth, force = record(0.0, kind)
    for seed in range(4):
        noisy = force + 2e-3 * force.max() * np.random.default_rng(seed).normal(size=force.size)
        assert "creep" not in kinds(mdr.oliver_pharr(TIP, depth, noisy))


def test_a_laminate_is_no_half_space():
    """F ∝ d^2.5, where an elastic cone has 2: it is said, with the number."""
    depth = np.append(np.linspace(0, DEEP, 200), np.linspace(DEEP, 0, 200))
    force = 1e-3 * (depth / DEEP) ** 2.5
    (remark,) = (each for each in mdr.oliver_pharr(TIP, depth, force).remarks if each.kind == "creep")
    assert re.match(r"m = 2\.5 exceeds .*, 2\b", remark)


def test_the_error_covers_other_parts_of_an_unloading_that_bends():
    """By SciPy from 95 to 20 % of the force, as instruments have it; silica keeps its error."""
    _, depth, force = record(0.15, "logarithmic")
    result = mdr.oliver_pharr(TIP, depth, force)
    top = int(np.argmax(depth))
    part = slice(
        top + int(np.argmax(force[top:] < 0.95 * force[top])),
        top + int(np.argmax(force[top:] < 0.2 * force[top])),
    )

    def law(h, F, S, m):
        return F * np.maximum(1 + S * h / (m * F), 1e-9) ** m

    h, F = depth[part] - depth[top], force[part] / force[top]
    length = -h.min()
    (_, S, _), _ = scipy.optimize.curve_fit(law, h / length, F, p0=(1.0, 1.0, 1.4))
    other = S * force[top] / length
    assert result.exponent > 1.5
    assert abs(other - result.stiffness) > 0.01 * result.stiffness
    # To the samples with which both parts end.
    assert abs(other - result.stiffness) < 1.05 * result.standard_errors["stiffness"]
    glass = mdr.oliver_pharr(mdr.Cone.from_half_angle(70.3), *silica()[:2])
    assert glass.standard_errors["E_star"] == approx(0.14e9, rel=0.05)


def test_a_soft_medium_that_keeps_an_imprint_is_asked_about():
    """Silica with nanometres taken for micrometres is 69.6 kPa; an elastic gel of that modulus is not."""
    depth, force, _ = silica()
    assert "units" in kinds(mdr.oliver_pharr(TIP, 1e3 * depth, force))
    assert "units" not in kinds(mdr.oliver_pharr(TIP, depth, force))
    assert "units" not in kinds(mdr.oliver_pharr(TIP, *pressed(TIP, mdr.Medium(70e3))))


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("count", [1, 4, 6, 9])
def test_records_of_few_samples_are_refused_in_words(count, sign):
    """Noise about a force, which may be negative, and no loading: with times and without."""
    random = np.random.default_rng(count)
    depth, force = 1e-8 * random.normal(size=count), sign * (1e-3 + 1e-5 * random.normal(size=count))
    for time in (None, np.arange(count)):
        with pytest.raises(ValueError, match="unloading"):
            mdr.oliver_pharr(TIP, depth, force, time=time)


@pytest.mark.few(3)
@pytest.mark.parametrize("share", [0.6, 0.9, 0.97])
@pytest.mark.parametrize("noise", [0.0, 2e-4])
def test_a_depth_at_the_limit_of_its_sensor_has_no_number(share, noise):
    """The force goes on rising, while the depth stays at a share of the largest one."""
    depth, force = pressed(TIP, mdr.Medium(E, hardness=8e9))
    depth = np.minimum(depth, share * depth.max())
    depth = depth + noise * depth.max() * np.random.default_rng(4).normal(size=depth.size)
    with contextlib.suppress(mdr.MDRError):
        assert "misfit" in kinds(mdr.oliver_pharr(TIP, depth, force))
    fit = mdr.fit_indentation(TIP, depth, force, hardness=None, depth_noise=noise * depth.max())
    assert fit.quoted.source is None


@pytest.mark.parametrize("tip", [TIP, mdr.Paraboloid(1e-6), mdr.RoundedCone(0.358, 60e-9)])
def test_more_hardness_than_of_an_elastic_contact_is_impossible(tip):
    """Of a tip that is blunter than the one that is given; an elastic contact itself is none."""
    blunt = mdr.Sphere(3e-6)
    for real, wrong in ((tip, False), (blunt, True)):
        depth, force = pressed(real, mdr.Medium(E))
        sharp = mdr.Cone(0.05) if wrong else tip
        assert ("misfit" in kinds(mdr.oliver_pharr(sharp, depth, force))) == wrong


def test_an_exponent_that_no_unloading_has_is_said():
    """F ∝ (h − h_f)^m with m = 0.8, and with m = 12, as of a tip that is withdrawn from a liquid."""
    u = np.linspace(1.0, 0.02, 200)
    for m, bad in ((0.8, True), (1.4, False), (12.0, True)):
        h, F = 200e-9 + 100e-9 * u, 1e-3 * u**m
        depth = np.append(np.linspace(0, h[0], 200), h)
        force = np.append(F[0] * np.linspace(0, 1, 200) ** 2, F)
        assert ("misfit" in kinds(mdr.oliver_pharr(TIP, depth, force))) == bad


@pytest.mark.parametrize("rate", [0.0, 0.1e-9, 0.3e-9, -0.3e-9])
def test_a_drift_in_a_hold_at_the_end_is_said_and_can_be_subtracted(rate):
    """0.3 nm/s over 60 s, of which H is 10 % too small; minus_drift makes it right."""
    medium = mdr.Medium(E, hardness=8e9)
    loading = np.linspace(0, 300e-9, 300)
    down = np.linspace(300e-9, 205e-9, 400)
    force = mdr.indent(TIP, medium, np.append(loading, down)).force
    low = down[int(np.argmax(force[300:] < 0.1 * force.max()))]
    depth = np.concatenate(
        [loading, np.full(100, loading[-1]), np.linspace(300e-9, low, 200), np.full(300, low)]
    )
    time = np.append(np.linspace(0, 40, 400), np.linspace(40, 120, 501)[1:])
    force = mdr.indent(TIP, medium, depth).force
    expected = mdr.oliver_pharr(TIP, depth, force, time=time)
    drifted = depth + rate * time
    result = mdr.oliver_pharr(TIP, drifted, force, time=time)
    found = [each for each in result.remarks if each.kind == "drift"]
    assert bool(found) == bool(rate)
    if rate:
        (remedy,) = found[0].remedy
        assert remedy == mdr.Remedy("subtract", "drift", approx(rate, rel=1e-3))
        again = mdr.oliver_pharr(TIP, drifted - remedy.value * time, force, time=time)
        assert again.hardness == approx(float(expected.hardness), rel=1e-3)
