"""Remarks on what a fit leaves out: tilt, drag, drift; and on data that are not what they are taken for."""

import re

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...said import kinds, remark_of
from .test_fit import AFM, measured
from .test_fit_in_time import fit_of

BALL, GEL = mdr.Paraboloid(1e-5), mdr.Medium(1e4)
TIME = np.linspace(0.0, 2.0, 600)
#: Approach and retract with a baseline of twice the depth.
DEPTH = np.interp(TIME, [0, 1, 2], [-2e-6, 1e-6, -2e-6])
CONE, METAL = mdr.Cone(0.358), mdr.Medium(70e9, q_c=8e3)


def elastic(depth=DEPTH, extra=0.0, drift=0.0, time=TIME, **parameters):
    """A fit to a curve on the gel with a force (N) added, 0.2 % noise and a drift of the depth (m/s)."""
    force = mdr.indent(BALL, GEL, depth).force
    force = force + extra + 2e-3 * force.max() * np.random.default_rng(4).normal(size=force.size)
    return mdr.fit_indentation(
        BALL, depth + drift * TIME, force, time=time, **{"q_c": np.inf, "baseline": None, **parameters}
    )


def told(fit, kind):
    """Factor of the misfit, and the change of E* in its errors, of a remark; None if there is none."""
    found = [text for text in fit.remarks if text.startswith(f"a {kind}")]
    numbers = re.search(
        r"misfit in contact by a factor of (\S+) and change E\* by (\S+) standard errors", "".join(found)
    )
    return numbers and tuple(map(float, numbers.groups()))


def change(fit, other):
    """Change of E* to another fit in the errors of the first one."""
    return (other.medium.E_star - fit.medium.E_star) / fit.standard_errors["E_star"]


class TestElastic:
    def test_nothing_is_said_of_noise(self):
        assert not elastic().remarks
        assert not elastic(time=None).remarks

    @pytest.mark.parametrize("parameter", ["tilt", "drag"])
    def test_what_is_left_out_is_told_with_its_change_of_the_modulus(self, parameter):
        """The change is that of one linear step: of the tilt here, two thirds of the whole one."""
        size = 0.05 * mdr.indent(BALL, GEL, DEPTH).force.max()
        extra = {"tilt": size * DEPTH / 1e-6, "drag": size * np.sign(1 - TIME)}[parameter]
        fit, free = elastic(extra=extra), elastic(extra=extra, **{parameter: None})
        factor, step = told(fit, parameter)
        assert factor > 1.5
        assert step == approx(change(fit, free), rel=0.5, abs=0.1)
        assert f"give {parameter}=None" in fit.remarks[0]
        assert not free.remarks

    def test_a_drift_is_told_and_named_as_what_else_it_may_be(self):
        """2 % of the speed, with a hold. The change of E*, by one linear step, is that to the true one."""
        fit = elastic(np.interp(TIME, [0, 0.5, 1, 1.5, 2], [-2e-6, 0, 1e-6, 1e-6, -2e-6]), drift=6e-8)
        factor, step = told(fit, "drift")
        whole = (GEL.E_star - fit.medium.E_star) / fit.standard_errors["E_star"]
        assert factor > 1.6
        assert whole > 1
        assert step == approx(whole, rel=0.2)
        speed = re.search(r"a drift of (\S+) nm/s", fit.remarks[0])[1]
        assert float(speed) == approx(60, rel=0.1)
        assert "relaxation of the medium" in fit.remarks[0]

    def test_a_solid_that_relaxes_is_told_from_a_viscous_one(self):
        """Of three parameters, by the integral of Lee and Radok: the force falls by a third in the hold."""
        depth = np.interp(TIME, [0, 0.5, 1, 2], [-1e-6, 0, 1e-6, 1e-6])
        increments, force = np.diff(np.maximum(depth, 0.0) ** 1.5, prepend=0.0), np.zeros_like(TIME)
        for k, step in enumerate(increments):
            force[k:] += 4 / 3 * np.sqrt(1e-5) * step * (5e3 + 5e3 * np.exp(-(TIME[k:] - TIME[k]) / 0.3))
        assert force[-1] / force.max() == approx(2 / 3, abs=0.05)
        force = force + 2e-3 * force.max() * np.random.default_rng(4).normal(size=force.size)
        fit = mdr.fit_indentation(BALL, depth, force, time=TIME, q_c=np.inf, baseline=None, eta=None)
        assert told(fit, "drift")[0] > 1.6

    @pytest.mark.parametrize("segment", ["approach", "retract"])
    @pytest.mark.parametrize("name", AFM)
    def test_of_measured_curves_no_tilt_is_told(self, name, segment):
        fit = mdr.fit_indentation(BALL, *measured(name, segment), q_c=np.inf, baseline=None)
        assert told(fit, "tilt") is None

    @pytest.mark.parametrize("name", ["spot3-0", "map2x2-2"])
    def test_the_drag_of_gels_in_a_liquid_is_told(self, name):
        """Where it is free the residuals of both segments are smaller by 1.5 and 2.1 times."""
        fit = fit_of(name)
        factor, _ = told(fit, "drag")
        assert factor > 1.3
        assert told(fit_of(name, drag=None), "drag") is None

    def test_times_that_do_not_increase_say_nothing(self):
        assert not elastic(drift=6e-8, time=np.zeros(600)).remarks


class TestYielding:
    TIME = np.linspace(0.0, 140.0, 700)
    RAMP = np.interp(TIME, [0, 5, 80, 140], 1e-9 * np.array([-20, 0, 600, 500]))
    HOLD = np.interp(TIME, [0, 5, 60, 90, 130, 140], 1e-9 * np.array([-20, 0, 600, 545, 545, 500]))

    def fit(self, depth, drift, noise=2e-4, metal=METAL):
        force = mdr.indent(CONE, metal, depth).force
        force = force + noise * force.max() * np.random.default_rng(6).normal(size=force.size)
        # Instruments write the same time twice where one part of the record ends and the next one begins.
        time = np.delete(np.insert(self.TIME, 400, self.TIME[400]), -1)
        return mdr.fit_indentation(CONE, depth + drift * self.TIME, force, time=time)

    def test_without_a_hold_a_common_drift_changes_the_modulus_by_some_per_cent(self):
        """As the docstring of the fit says. In so little noise it is seen, and its rate told."""
        fit = self.fit(self.RAMP, 1e-10)
        assert 0.01 < fit.medium.E_star / METAL.E_star - 1 < 0.06
        remark = remark_of(fit, "drift")
        rate = float(re.search(r"a drift of (\S+) pm/s", remark)[1])
        assert rate == approx(100, rel=0.05)

    def test_a_hold_tells_it(self):
        fit = self.fit(self.HOLD, 1e-10)
        remark = remark_of(fit, "creep")
        rate, said = re.search(
            r"depth changes by (\S+) pm/s: this is creep, or a drift.* by (\S+) %", remark
        ).groups()
        # Less what of the hold is not the hold: the force is the same to half a per cent.
        assert float(rate) == approx(100, rel=0.05)
        assert float(said) == approx(-100 * (fit.medium.E_star / METAL.E_star - 1), rel=0.15)
        # Where nothing drifts nothing is said.
        assert not self.fit(self.HOLD, 0.0).remarks

    @pytest.mark.parametrize("noise", [0.004, 0.01, 0.02])
    def test_a_hold_is_seen_in_noise(self, noise):
        """In 20 s at the largest load, with the noise of the force and none of the depth."""
        depth = 1e-9 * np.interp(self.TIME, [0, 5, 85, 105, 140], [-20, 0, 300, 300, 250])
        fit = self.fit(depth, 1e-10, noise, mdr.Medium(70e9, q_c=2e3))
        remark = remark_of(fit, "creep")
        rate = float(re.search(r"depth changes by (\S+) pm/s", remark)[1])
        assert rate == approx(100, rel=0.05)
        # A ramp is none, whatever the noise.
        ramp = self.fit(self.RAMP, 1e-10, noise, mdr.Medium(70e9, q_c=2e3))
        assert "creep" not in kinds(ramp)

    def test_a_hold_of_a_thirtieth_of_the_contact_does_not_show_a_drift(self):
        """4 s at 0.1 nm/s are 0.4 nm. A hold counts from a twentieth of the time in contact on."""
        top = 1e-9 * np.interp(self.TIME, [0, 5, 85, 89, 140], [-20, 0, 600, 600, 500])
        assert "creep" not in kinds(self.fit(top, 1e-10))


class TestData:
    """A gel from approach and retract, and a metal pressed and unloaded."""

    @staticmethod
    def curves():
        for tip, medium, depth, free in (
            (BALL, GEL, DEPTH, {"q_c": np.inf, "baseline": None}),
            (CONE, METAL, 1e-9 * np.interp(TIME, [0, 1, 2], [-20, 600, 400]), {}),
        ):
            force = mdr.indent(tip, medium, depth).force
            noise = 3e-3 * force.max() * np.random.default_rng(5).normal(size=force.size)
            yield tip, depth + 1e-7, force + noise, noise, free

    @pytest.mark.parametrize(
        ("change", "words"),
        [
            (lambda z, F, noise: (F, z), "depth and force are swapped"),
            (lambda z, F, noise: (-z, F), "the depth has the wrong sign"),
            (lambda z, F, noise: (z, -F), "the force has the wrong sign"),
            (lambda z, F, noise: (-z, -F), "depth and force have the wrong sign"),
            (lambda z, F, noise: (z, noise), "this record shows no contact"),
            (lambda z, F, noise: (1e9 * z, F), "force in N"),
        ],
        ids=["swapped", "depth", "force", "both", "noise", "units"],
    )
    def test_is_named_as_what_it_is(self, change, words):
        for tip, depth, force, noise, free in self.curves():
            fit = mdr.fit_indentation(tip, *change(depth, force, noise), **free)
            assert words in fit.remarks[0]
            assert not mdr.fit_indentation(tip, depth, force, **free).remarks

    @pytest.mark.few(2)
    @pytest.mark.parametrize("baseline", [0.0, None])
    @pytest.mark.parametrize("noise", [0.0, 0.003, 0.01])
    def test_columns_of_a_yielding_cone_pressed_only(self, baseline, noise):
        """Its force is nearly linear in the depth: by the loading alone E* is not determined."""
        depth = np.linspace(-20e-9, 600e-9, 400)
        force = mdr.indent(CONE, mdr.Medium(70e9, q_c=2e3), depth).force
        force = force + noise * force.max() * np.random.default_rng(3).normal(size=force.size)
        swapped = mdr.fit_indentation(CONE, force, depth, baseline=baseline)
        assert "depth and force are swapped" in swapped.remarks[0]
        # Held at 0 N, the baseline refuses forces that are all negative.
        reversed_ = mdr.fit_indentation(CONE, -depth, -force, baseline=None)
        assert "depth and force have the wrong sign" in reversed_.remarks[0]
        fit = mdr.fit_indentation(CONE, depth, force, baseline=baseline)
        assert not [remark for remark in fit.remarks if "straight line" in remark]


NO_CONTACT = "shows no contact"


class TestContactIsSeen:
    @pytest.mark.parametrize("shift", [-2.0, -1.0, 1.0, 2.0])
    def test_in_a_curve_whose_retract_is_shifted(self, shift):
        """By a share of the largest force, which takes up most of the variance: a drag is named first."""
        largest = mdr.indent(BALL, GEL, DEPTH).force.max()
        fit = elastic(extra=np.where(TIME > 1, shift * largest, 0.0))
        assert fit.remarks[0].startswith("a drag of")
        assert NO_CONTACT not in str(fit.remarks)

    @pytest.mark.parametrize("rows", ["approach", "retract", "whole"])
    def test_in_a_measured_curve_with_drag_and_pull_off(self, rows):
        """The force in the last fifth of the depth varies by more than twice that of the others."""
        segments = ["approach", "retract"] if rows == "whole" else [rows]
        depth, force = np.hstack([measured("qi-noisy-2", segment) for segment in segments])
        time = 1e-4 * np.arange(depth.size)
        fit = mdr.fit_indentation(BALL, depth, force, time=time, q_c=np.inf, baseline=None)
        assert NO_CONTACT not in str(fit.remarks)

    @pytest.mark.few(2)
    @pytest.mark.parametrize("start", [-1e-7, 0.0, 2e-7, 5e-7])
    def test_in_a_noisy_record_that_begins_at_contact_or_in_it(self, start):
        """With noise of 20 % of the force: the contact explains half of the variance or more."""
        depth = np.interp(TIME, [0, 1, 2], [start, 1e-6, start])
        force = mdr.indent(BALL, GEL, depth).force
        for seed in range(3):
            noise = 0.2 * force.max() * np.random.default_rng(seed).normal(size=force.size)
            fit = mdr.fit_indentation(BALL, depth, force + noise, q_c=np.inf, baseline=None)
            assert NO_CONTACT not in str(fit.remarks)
            alone = mdr.fit_indentation(BALL, depth, noise, q_c=np.inf, baseline=None)
            assert NO_CONTACT in alone.remarks[0]
