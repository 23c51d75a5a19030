"""Creep at the start of an unloading, and its correction by the rate in the hold before."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...said import kinds

TIP, E, H, PEAK = mdr.Cone.berkovich(), 70e9, 9e9, 0.1


def record(share, kind, unloading=10.0, hold=10.0):
    """Times, depths and forces of a loading, a hold and an unloading of power 1.3 under a creep.

    `share` is ḣ/|Ṗ| at the end of the hold over 1/S. Creep is logarithmic in the time of the hold, or a
    viscous flow in proportion to the force.
    """
    a = np.sqrt(PEAK / (np.pi * H))
    stiffness = 2 * E * a
    largest = TIP.height(a) + 0.75 * PEAK / stiffness
    start = np.linspace(0, 10, 200, endpoint=False)
    held = 10 + np.linspace(0, hold, 100, endpoint=False)
    back = 10 + hold + np.linspace(0, unloading, 200)
    time = np.concatenate([start, held, back])
    force = PEAK * np.interp(time, [0, 10, 10 + hold, 10 + hold + unloading], [0, 1, 1, 0.1])
    force[:200] = PEAK * (start / 10) ** 2
    elastic = largest - 1.3 * PEAK / stiffness * (1 - (force / PEAK) ** (1 / 1.3))
    elastic[:200] = largest * start / 10
    rate = share * 0.9 * PEAK / unloading / stiffness
    if kind == "logarithmic":
        creep = rate * (0.5 + hold) * np.log1p(np.maximum(time - 10, 0) / 0.5)
    else:
        rates = np.where(time < 10, 0, rate * force / PEAK)
        creep = np.append(0, np.cumsum((rates[1:] + rates[:-1]) / 2 * np.diff(time)))
    return time, elastic + creep - creep[300], force


@pytest.mark.parametrize("kind", ["logarithmic", "viscous"])
@pytest.mark.parametrize("share", [0.1, 0.2, 0.5])
def test_the_correction_restores_the_modulus(kind, share):
    """To a twentieth of what creep changes: its rate is not constant, as it is taken to be."""
    time, depth, force = record(share, kind)
    result = mdr.oliver_pharr(TIP, depth, force, time=time)
    wrong = result.uncorrected.E_star - E
    assert wrong > 0.5 * share * E
    assert mdr.oliver_pharr(TIP, depth, force).E_star == result.uncorrected.E_star
    assert abs(result.E_star - E) < 0.05 * wrong
    assert result.remarks[0].kind == "creep"
    assert "uncorrected for creep" in repr(result)


@pytest.mark.parametrize("kind", ["logarithmic", "viscous"])
def test_where_the_depth_grows_while_the_force_falls(kind):
    """With times to 5 %; without them it is refused as creep."""
    time, depth, force = record(1.5, kind)
    result = mdr.oliver_pharr(TIP, depth, force, time=time)
    assert result.E_star == approx(E, rel=0.05)
    assert np.isnan(result.uncorrected.E_star)
    with pytest.raises(ValueError, match=r"creeps: it grows by .* while the force falls"):
        mdr.oliver_pharr(TIP, depth, force)


def test_less_than_a_twentieth_has_no_remark():
    time, depth, force = record(0.03, "viscous")
    result = mdr.oliver_pharr(TIP, depth, force, time=time)
    assert "creep" not in kinds(result)
    assert result.E_star == approx(E, rel=1e-3)


def test_without_a_hold_nothing_is_corrected():
    time, depth, force = record(0.1, "viscous")
    moving = (time < 10) | (time >= 20)
    result = mdr.oliver_pharr(TIP, depth[moving], force[moving], time=time[moving])
    assert any("no hold" in remark for remark in result.remarks)
    assert result.E_star == result.uncorrected.E_star


def triangle(count, noise, seed):
    """Times, depths and forces of a triangle of the depth, with noise of the force, without a hold."""
    depth = 200e-9 * np.minimum(np.linspace(0, 2, count), np.linspace(2, 0, count))
    force = mdr.indent(TIP, mdr.Medium(4.7e9, hardness=0.3e9), depth).force
    noisy = force + noise * force.max() * np.random.default_rng(seed).normal(size=count)
    return np.linspace(0, 10, count), depth, noisy


@pytest.mark.few(2)
@pytest.mark.parametrize("count", [400, 2000])
@pytest.mark.parametrize("noise", [1e-3, 4e-3, 1e-2])
def test_the_tip_of_a_triangle_is_no_hold(count, noise):
    """However many samples lie within the noise of the largest force."""
    for seed in range(3):
        time, depth, force = triangle(count, noise, seed)
        result = mdr.oliver_pharr(TIP, depth, force, time=time)
        assert result.E_star == result.uncorrected.E_star
        assert any("no hold" in remark for remark in result.remarks)


@pytest.mark.parametrize("noise", [0.0, 4e-3])
def test_the_hold_that_is_taken_is_said(noise):
    """A hold of 10 s, sampled each 0.1 s, of which a share of the noise on both sides is left out."""
    time, depth, force = record(0.2, "viscous")
    force = force + noise * PEAK * np.random.default_rng(1).normal(size=force.size)
    result = mdr.oliver_pharr(TIP, depth, force, time=time)
    (said,) = (remark for remark in result.remarks if "is held for" in remark)
    assert float(said.split()[5]) == approx(10.0, abs=0.3)
    assert result.E_star == approx(E, rel=0.02 + 3 * noise)


def test_the_noise_of_the_rate_is_in_the_error():
    """Root mean square of 20 pulls with 0.5 nm of noise of the depth, known to 16 %: at most 1.6."""
    time, depth, force = record(0.1, "viscous")
    pulls = []
    for seed in range(20):
        noisy = depth + 0.5e-9 * np.random.default_rng(seed).normal(size=depth.size)
        result = mdr.oliver_pharr(TIP, noisy, force, time=time)
        pulls.append((result.E_star - E) / result.standard_errors["E_star"])
    assert np.sqrt(np.mean(np.square(pulls))) < 1.6


@pytest.mark.parametrize(
    ("profile", "epsilon"),
    [(mdr.FlatPunch(1e-6), 1.0), (mdr.Cone(0.3), 2 - 4 / np.pi), (mdr.Sphere(2e-6), 0.75)],
)
def test_exponents_are_no_sign_of_creep(profile, epsilon):
    depth = np.concatenate([np.linspace(0, 60e-9, 90), np.full(20, 60e-9), np.linspace(60e-9, 5e-9, 90)])
    force = mdr.indent(profile, mdr.Medium(E), depth).force
    for time in (None, np.arange(200.0)):
        result = mdr.oliver_pharr(profile, depth, force, time=time, epsilon=epsilon)
        assert not any("creep" in remark for remark in result.remarks)
        assert result.E_star == approx(E, rel=0.03)


def test_times_that_go_back_are_refused():
    time, depth, force = record(0.1, "viscous")
    time[50] = 0.0
    with pytest.raises(ValueError, match=r"time\[50\] = 0 s does not increase"):
        mdr.oliver_pharr(TIP, depth, force, time=time)


@pytest.mark.few(2)
@pytest.mark.parametrize("medium", [mdr.Medium(E, hardness=7e9), mdr.Medium(E, q_c=2e3), mdr.Medium(5e9)])
@pytest.mark.parametrize("share", [0.95, 0.8])
def test_a_saturated_force_is_no_hold(medium, share):
    """Its depth comes back while the force is held: E* was up to five times too large by that rate."""
    depth = 1e-9 * np.append(np.linspace(0, 400, 300), np.linspace(400, 160, 200)[1:])
    force = mdr.indent(TIP, medium, depth).force
    force = force + 5e-4 * force.max() * np.random.default_rng(1).normal(size=force.size)
    saturated, time = np.minimum(force, share * force.max()), 0.1 * np.arange(depth.size)
    result = mdr.oliver_pharr(TIP, depth, saturated, time=time)
    assert [remark.kind for remark in result.remarks if remark.kind != "left out"] == ["taken"]
    assert "a sensor at the end of its range" in result.remarks[0].text
    assert result.E_star == mdr.oliver_pharr(TIP, depth, saturated).E_star
    # The power law of the part that is left is that of the whole unloading, to some scatter.
    assert result.E_star == approx(mdr.oliver_pharr(TIP, depth, force).E_star, rel=0.03)
