"""Fits of curves in time: background, viscosity, holds; weights, samples left out, lists of curves."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.measurements.fit.measurement import rates

from ...approx import approx
from ...said import kinds, remark_of
from ...shapes import name
from .test_fit import DATA, REFERENCE

E, ETA, DEPTH = 5e3, 62.5, 5e-7  # τ = 50 ms
TIME = np.linspace(0.0, 1.0, 241)
#: Approach, hold and retract; a triangle; a faster retract, whose corner lies between two samples.
PATHS = {
    "hold": np.interp(TIME, [0, 0.35, 0.65, 1], DEPTH * np.array([-0.5, 1, 1, -0.5])),
    "triangle": np.interp(TIME, [0, 0.5, 1], DEPTH * np.array([-0.5, 1, -0.5])),
    "fast": np.interp(TIME, [0, 0.701, 1], DEPTH * np.array([-0.5, 1, -2])),
}
POINT, BASELINE, TILT, DRAG = 3e-8, 2e-10, 2e-4, 1e-4
BACKGROUND = {"baseline": BASELINE, "tilt": TILT, "drag": DRAG}
FREE = {"eta": None, **dict.fromkeys(BACKGROUND)}


def made(profile, medium, depth, time=TIME):
    """Measured depth and force of the chain with an offset and a background."""
    z = depth + POINT
    force = mdr.indent_in_time(profile, medium, depth, time, tolerance=1e-7).force
    return z, force + BASELINE + TILT * z + DRAG * np.gradient(z, time)


def in_time(name):
    """Depth, force and time of both segments: about 150 means, from half a depth before contact on."""
    data = np.genfromtxt(DATA / f"{name}.csv", delimiter=",", names=True)
    z = 1e-9 * data["depth_nm"]
    point = 1e-9 * REFERENCE[name]["approach"]["hertz_para"]["contact_point_nm"]
    rows = z > point - (z.max() - point) / 2
    step = np.count_nonzero(rows) // 150
    values = z[rows], 1e-9 * data["force_nN"][rows], data["time_s"][rows]
    return tuple(v[: v.size // step * step].reshape(-1, step).mean(axis=1) for v in values)


def fit_of(name, **free):
    depth, force, time = in_time(name)
    return mdr.fit_indentation(
        mdr.Paraboloid(1e-5), depth, force, time=time, q_c=np.inf, baseline=None, **free
    )


class TestInverse:
    @pytest.mark.parametrize("path", PATHS)
    @pytest.mark.parametrize(
        "profile", [mdr.Cone.from_half_angle(25.0), mdr.Paraboloid(1e-5), mdr.Sphere(2e-6)], ids=name
    )
    def test_elastic(self, profile, path):
        """To the tolerance of the chain, 10⁻⁷ of the force, times the condition number of a fit, 10³."""
        z, force = made(profile, mdr.Medium(E, eta=ETA), PATHS[path])
        fit = mdr.fit_indentation(profile, z, force, time=TIME, q_c=np.inf, **FREE)
        values = fit.medium.E_star, fit.medium.eta, fit.contact_point, fit.baseline, fit.tilt, fit.drag
        assert values == approx((E, ETA, POINT, *BACKGROUND.values()), rel=1e-4)
        background = fit.baseline + fit.tilt * z + fit.drag * np.gradient(z, TIME)
        model = approx(force - background - fit.residuals, abs=1e-6 * force.max())
        assert fit.path.force == model

    def test_yielding(self):
        profile, medium = mdr.Cone.from_half_angle(65.0), mdr.Medium.from_critical_depth(E, 2e-7)
        medium = mdr.Medium(E, q_c=medium.q_c, eta=ETA)
        z, force = made(profile, medium, PATHS["hold"])
        fit = mdr.fit_indentation(profile, z, force, time=TIME, **FREE)
        values = fit.medium.E_star, fit.medium.q_c, fit.medium.eta, fit.drag
        assert values == approx((E, medium.q_c, ETA, DRAG), rel=1e-4)

    def test_hold_cut_out(self):
        """A gap in time changes nothing: rates at its edges are those of the nearer samples."""
        profile = mdr.Paraboloid(1e-5)
        z, force = made(profile, mdr.Medium(E, eta=ETA), PATHS["hold"])
        keep = (TIME < 0.36) | (TIME > 0.64)
        fit = mdr.fit_indentation(profile, z[keep], force[keep], time=TIME[keep], q_c=np.inf, **FREE)
        assert (fit.medium.E_star, fit.medium.eta) == approx((E, ETA), rel=1e-4)

    @pytest.mark.slow
    @pytest.mark.few(1)
    @pytest.mark.parametrize("path", PATHS)
    def test_errors_are_those_of_repeated_measurements(self, path):
        """The standard deviation of the pulls of 60 curves is known to 9 %: four of these around 1."""
        profile = mdr.Paraboloid(1e-5)
        z, force = made(profile, mdr.Medium(E, eta=ETA), PATHS[path])
        noise = 0.004 * force.max() * np.random.default_rng(1).normal(size=(60, TIME.size))
        depth, time = np.broadcast_to(z, noise.shape), np.broadcast_to(TIME, noise.shape)
        fit = mdr.fit_indentation(profile, depth, force + noise, time=time, q_c=np.inf, **FREE)
        values, truth = fit.to_dict(), {"E_star": E, "eta": ETA, "contact_point": POINT, **BACKGROUND}
        for parameter, true in truth.items():
            pull = (values[parameter] - true) / fit.standard_errors[parameter]
            assert 0.64 < pull.std() < 1.36, parameter
            assert np.abs(pull).max() < 4, parameter

    def test_nothing_to_be_seen_of_viscosity(self):
        z, force = made(mdr.Cone(0.3), mdr.Medium(E), PATHS["hold"])
        random = np.random.default_rng(7)
        remarks, values = set(), []
        for _ in range(4):
            noisy = force + 0.01 * force.max() * random.normal(size=force.size)
            fit = mdr.fit_indentation(mdr.Cone(0.3), z, noisy, time=TIME, q_c=np.inf, **FREE)
            values.append(fit.medium.eta / (fit.standard_errors["eta"] + 1e-300))
            remarks.update(fit.remarks)
        assert 0 <= min(values) <= max(values) < 3
        assert any("the viscosity is 0 within the noise" in remark for remark in remarks)


class TestRealCurves:
    @pytest.mark.parametrize("name", ["spot3-0", "map2x2-2"])
    @pytest.mark.parametrize(
        ("free", "key"), [((), "rms_elastic_no_drag"), (("drag",), "rms_elastic"), (("drag", "eta"), "rms")]
    )
    def test_residuals_of_both_segments(self, name, free, key):
        """Root mean square over the range of force, at most 1.02 times that of a search by brute force."""
        fit = fit_of(name, **dict.fromkeys(free))
        rms = np.sqrt(np.mean(fit.residuals**2)) / np.ptp(fit.force)
        assert rms <= 1.02 * REFERENCE[name]["in_time"][key]

    def test_errors_under_a_misfit(self):
        """Within a factor of two of the scatter of 100 fits to resampled blocks of residuals."""
        fit, count, block = fit_of("map2x2-2", drag=None), 100, 15
        start = np.random.default_rng(3).integers(0, fit.depth.size, (count, fit.depth.size // block + 1))
        rows = (start[..., None] + np.arange(block)).reshape(count, -1)[:, : fit.depth.size]
        force = fit.force - fit.residuals + fit.residuals[rows % fit.depth.size]
        depth, time = (np.broadcast_to(v, force.shape) for v in (fit.depth, fit.time))
        again = mdr.fit_indentation(
            fit.profile, depth, force, time=time, q_c=np.inf, baseline=None, drag=None
        )
        for parameter, error in fit.standard_errors.items():
            assert 0.5 < np.std(again.to_dict()[parameter]) / error < 2, parameter
        assert fit.block_length > 5
        assert "block-wise (Newey–West)" in repr(fit)

    def test_misfit(self):
        """A curve without its drag is not fitted, and a remark says what to try; with it none is left."""
        assert "give drag=None" in fit_of("spot3-0").remarks[0]
        assert not fit_of("spot3-0", drag=None).remarks


class TestSamples:
    PROFILE = mdr.Cone(0.3)
    DEPTH = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 35e-9, 80))
    MEDIUM = mdr.Medium(10e9, q_c=127.3)

    def noisy(self, rows=1, seed=0):
        force = mdr.indent(self.PROFILE, self.MEDIUM, self.DEPTH).force
        noise = np.random.default_rng(seed).normal(size=(rows, force.size))
        return self.DEPTH + 3e-9, force + 0.004 * force.max() * noise, 0.004 * force.max()

    def test_without_numbers(self):
        """The fit is that of the other samples, and says how many were left out."""
        z, (force,), _ = self.noisy()
        depth, broken = z.copy(), force.copy()
        depth[5], broken[[50, 150]] = np.nan, np.nan
        keep = np.isfinite(depth + broken)
        fit = mdr.fit_indentation(self.PROFILE, depth, broken)
        other = mdr.fit_indentation(self.PROFILE, z[keep], force[keep])
        assert fit.to_dict() == approx(other.to_dict(), rel=1e-9)
        assert fit.residuals[keep] == approx(other.residuals, rel=1e-6)
        assert np.isnan(fit.residuals[~keep]).all()
        assert "3 of 180 samples" in remark_of(fit, "left out")

    def test_weights(self):
        """A sample of half the variance counts as one that was measured twice, in errors too."""
        z, (force,), sigma = self.noisy()
        twice = np.repeat(np.arange(z.size), np.where(np.arange(z.size) < 60, 2, 1))
        noise = np.where(np.arange(z.size) < 60, sigma / np.sqrt(2), sigma)
        fit = mdr.fit_indentation(self.PROFILE, z, force, force_noise=noise)
        other = mdr.fit_indentation(self.PROFILE, z[twice], force[twice], force_noise=sigma)
        assert fit.to_dict() == approx(other.to_dict(), rel=1e-6)
        assert fit.force_noise == approx(noise)

    def test_curves_of_different_lengths(self):
        z, force, _ = self.noisy(3)
        counts = 180, 120, 150
        curves = [z[:n] for n in counts], [row[:n] for row, n in zip(force, counts, strict=True)]
        fits = mdr.fit_indentation(self.PROFILE, *curves)
        assert fits.shape == (3,)
        assert fits.residuals.shape == fits.path.shape == (3, 180)
        for i, (depth, row) in enumerate(zip(*curves, strict=True)):
            single = mdr.fit_indentation(self.PROFILE, depth, row)
            assert fits[i].to_dict() == approx(single.to_dict(), rel=1e-9)
            assert fits[i].depth.shape == fits[i].path.shape == depth.shape
            assert fits[i].residuals == approx(single.residuals, rel=1e-6)
            assert fits[i].remarks == single.remarks
        assert np.isnan(fits.residuals[1, 120:]).all()
        for chosen in ([False, True, True], [1, 2], np.array([1, 2]), slice(1, None)):
            assert fits[chosen].medium == fits[1:].medium
            assert fits[chosen].depth.shape == fits[chosen].path.shape == (2, 150)
            assert fits[chosen][1].remarks == fits[2].remarks
        with pytest.raises(IndexError, match="one axis, the curves"):
            fits[np.zeros((2, 2), int)]

    def test_remarks_are_in_the_order_of_their_importance(self):
        """Wrong units come before all else, samples left out last; so do they of many curves."""
        z, force, _ = self.noisy(2)
        force[0, 5] = np.nan
        fits = mdr.fit_indentation(self.PROFILE, [z, 1e9 * z], [force[0], 1e6 * force[1]])
        assert [each.what for each in fits.remarks[0].remedy] == ["depth", "force"]
        assert "1 of 180 samples" in fits.remarks[-1]

    def test_white_residuals_have_no_blocks(self):
        z, force, _ = self.noisy(50)
        fit = mdr.fit_indentation(self.PROFILE, np.broadcast_to(z, force.shape), force)
        assert np.all(fit.block_length == 1)

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"drag": None}, "ζ need the times"),
            ({"eta": 1.0, "time": None}, "η need the times"),
            ({"eta": None, "time": np.zeros(180)}, "does not increase"),
            ({"eta": -1.0, "time": np.arange(180.0)}, "eta"),
            ({"time": np.arange(179.0)}, "have the same shape"),
            ({"force_noise": np.zeros(180)}, "force_noise"),
            ({"depth": [DEPTH, DEPTH[:9]], "force": [DEPTH, DEPTH[:8]]}, "curve 1: depth"),
            ({"force": np.full(180, np.inf)}, "finite"),
        ],
    )
    def test_refusals(self, change, message):
        given = {"depth": self.DEPTH, "force": mdr.indent(self.PROFILE, self.MEDIUM, self.DEPTH).force}
        with pytest.raises(ValueError, match=message):
            mdr.fit_indentation(self.PROFILE, **(given | change))

    def test_dataset_has_everything(self):
        pytest.importorskip("xarray")
        z, force, _ = self.noisy(2)
        fits = mdr.fit_indentation(self.PROFILE, [z, z[:-9]], [force[0], force[1, :-9]], q_c=np.inf)
        data = fits.to_xarray()
        assert dict(data.sizes) == {"curve": 2, "sample": 180, "parameter": 2, "other_parameter": 2}
        assert (data.model + data.residuals).values == approx(data.force.values, nan_ok=True)
        assert data.depth.values[0] == approx(z)
        assert data.E_star_error.attrs["units"] == "Pa"
        assert data.attrs["remarks"].splitlines() == list(fits.remarks)


class TestYieldAndViscosity:
    """A cone pressed to five critical depths in 6.7 s; the record begins at −d/2 and ends there."""

    CONE, MEDIUM = mdr.Cone(0.3), mdr.Medium.from_critical_depth(1e9, 40e-9)
    TIME = np.linspace(0.0, 20.0, 301)
    DEPTH = np.interp(TIME, [0, 10, 20], 200e-9 * np.array([-0.5, 1, -0.5]))

    def force(self, tau):
        medium = mdr.Medium(1e9, q_c=self.MEDIUM.q_c, eta=tau * 1e9 / 4)
        return mdr.indent_in_time(self.CONE, medium, self.DEPTH, self.TIME, tolerance=1e-6).force

    @pytest.mark.few(2)
    @pytest.mark.parametrize("tau", [0.8, 1.2, 2.0, 4.0])
    def test_dashpots_do_not_stand_for_springs(self, tau):
        """0.1 % of noise; an E* within 20 %, of which the statistical error is at most 6 %."""
        random, force = np.random.default_rng(0), self.force(tau)
        noisy = force + 1e-3 * force.max() * random.normal(size=(6, force.size))
        depth, time = (np.broadcast_to(each, noisy.shape) for each in (self.DEPTH, self.TIME))
        fit = mdr.fit_indentation(self.CONE, depth, noisy, time=time, eta=None)
        np.testing.assert_allclose(fit.medium.E_star, 1e9, rtol=0.2)
        np.testing.assert_allclose(fit.medium.q_c, self.MEDIUM.q_c, rtol=0.1)

    def test_the_sample_at_the_corner_is_left_out_of_all_that_is_said(self):
        """Its rate is not known; without it E* has the tolerance of the chain. `residuals` has it."""
        fit = mdr.fit_indentation(self.CONE, self.DEPTH, self.force(1.2), time=self.TIME, eta=None)
        assert fit.medium.E_star == approx(1e9, rel=1e-6)
        corner = np.argmax(np.abs(fit.residuals))
        assert self.TIME[corner] == 10.0
        assert np.abs(fit.residuals[corner]) > 0.01 * fit.force.max()
        assert fit.force_noise < 1e-6 * fit.force.max()
        assert not fit.remarks

    def test_without_a_minimum_nothing_is_said_of_its_causes(self):
        """The elastic part of a force of dashpots alone is nowhere seen."""
        force = 1e-6 * np.maximum(self.DEPTH / 200e-9, 0.0) * (self.TIME <= 10)
        random = np.random.default_rng(0)
        force = force + 1e-9 * random.normal(size=force.size)
        fit = mdr.fit_indentation(self.CONE, self.DEPTH, force, time=self.TIME, eta=None)
        assert np.isinf(fit.standard_errors["E_star"])
        said = " ".join(fit.remarks)
        assert "undetermined" in kinds(fit)
        assert not any(word in said for word in ("class", "tip", "unloading", "inf %"))


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["reloading", "reversed"])
def test_the_rate_jumps_where_the_depth_turns_up_or_down(sign):
    """It is not known at these samples alone; a smooth path has none."""
    time = np.linspace(0.0, 3.0, 301)
    depth = sign * 1e-7 * np.interp(time, [0, 1, 2, 3], [0, 1, 0.4, 1.4])
    rate, corner = rates(depth[None], time[None])
    assert np.flatnonzero(corner[0]).tolist() == [100, 200]
    assert rate[0, [50, 150, 250]] == approx(sign * 1e-7 * np.array([1, -0.6, 1]), rel=1e-9)
    assert not rates(1e-7 * np.sin(time)[None], time[None])[1].any()
