"""Laws of hardness of one's own: against the paper's sum, a row of springs, and refusals."""

import itertools
import pickle
from dataclasses import dataclass, replace

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.medium.hardness import HardnessLaw

from ...approx import approx
from ...laws import FAULTS, Decaying, Kinked, Layered, NixGao, Written, Wrong

E, H, L = 70e9, 2e9, 1e-6
MIXTURES = {
    "H": (H, 0.0, 0.0),
    "q": (0.0, H * L, 0.0),
    "f": (0.0, 0.0, H * L * L),
    "H+q": (0.6 * H, 0.5 * H * L, 0.0),
    "q+f": (0.0, 0.7 * H * L, 0.4 * H * L * L),
    "H+q+f": (0.5 * H, 0.3 * H * L, 0.2 * H * L * L),
}
CONE, BALL = mdr.Cone(slope=0.3), mdr.Paraboloid(radius=1e-5)
BLUNT = mdr.TruncatedCone(flat_radius=5e-7, slope=0.3)
SHAPES = (CONE, BALL, mdr.Sphere(radius=1e-5), BLUNT, mdr.FlatPunch(radius=1e-6))
SIZE = NixGao(H0=0.5 * H, a_star=3 * L)


def both(mixture, **other):
    """The medium with the constants of a mixture, and with a law that writes their sum out."""
    constants = MIXTURES[mixture]
    hardness, q_c, f_c = constants
    return mdr.Medium(E, q_c=q_c, hardness=hardness, f_c=f_c, **other), mdr.Medium(
        E, hardness=Written(*constants), **other
    )


def assert_same(one, other, rel=1e-12, names=None):
    """All quantities of two results; a difference of depths or forces is relative to their largest."""
    for name in names or one.to_dict():
        first, last = (np.asarray(getattr(each, name), dtype=float) for each in (one, other))
        scale = np.max(np.abs(last[np.isfinite(last)]), initial=0.0)
        np.testing.assert_allclose(first, last, rtol=rel, atol=rel * scale * 1e-2, err_msg=name)


@pytest.mark.parametrize("mixture", MIXTURES)
class TestALawThatWritesTheSumOut:
    """Gives what the constants give, in each function, to 10⁻¹²: only the rounding is another."""

    @pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
    def test_at_rest(self, shape, mixture):
        constants, law = both(mixture)
        path = np.array([0.0, 2e-9, 3e-7, 2.9e-7, 1e-6, 0.999e-6, 0.9e-6])
        states, others = (mdr.indent(shape, medium, path) for medium in (law, constants))
        # The stiffness is a difference of widths.
        assert_same(states, others, names=[n for n in states.to_dict() if n != "stiffness"])
        np.testing.assert_allclose(states.stiffness, others.stiffness, rtol=1e-9)
        r = np.linspace(0.0, 3e-6, 7)
        for i in (2, 4):
            for field in ("pressure", "surface", "imprint", "line_load"):
                one, other = (getattr(each[i], field)(r) for each in (states, others))
                # Infinite at the rim of a flat face.
                scale = np.max(np.abs(other[np.isfinite(other)]))
                np.testing.assert_allclose(one, other, rtol=1e-11, atol=1e-12 * scale)
            one, other = (each[i].stress(r[1:3], 2e-7).zz for each in (states, others))
            np.testing.assert_allclose(one, other, rtol=1e-10)
        for quantity in (mdr.yield_depth, mdr.yield_force, lambda *pair: mdr.yield_speed(*pair, 1e-9)):
            assert quantity(shape, law) == approx(quantity(shape, constants), rel=1e-12, abs=0)

    @pytest.mark.parametrize("shape", [CONE, mdr.Sphere(radius=1e-5), BLUNT], ids=["cone", "ball", "blunt"])
    def test_to_a_force(self, shape, mixture):
        constants, law = both(mixture)
        top = float(mdr.indent(shape, constants, 1e-6).force)
        forces = np.array([0.3, 0.99, 0.6]) * top
        one, other = (mdr.indent_to_force(shape, medium, forces) for medium in (law, constants))
        # A force that hardly grows with depth tells the depth with fewer digits.
        condition = top / (1e-6 * float(mdr.indent(shape, constants, 1e-6).stiffness))
        np.testing.assert_allclose(one.depth, other.depth, rtol=1e-12 * max(1.0, abs(condition)))

    @pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
    def test_impacts(self, shape, mixture):
        constants, law = both(mixture)
        speed = np.array([0.3, 3.0, 30.0])
        one, other = (mdr.impact(shape, medium, 1e-12, speed) for medium in (law, constants))
        # Contact times of a table of class (b) have twelve digits.
        assert_same(one, other, rel=4e-12)
        imprint = other.plastic_depth
        again = (
            mdr.impact(shape, each, 1e-12, 1.5 * speed, plastic_depth=imprint) for each in (law, constants)
        )
        assert_same(*again, rel=4e-12)
        moves = [each[1].motion(7) for each in (one, other)]
        np.testing.assert_allclose(moves[0].depth, moves[1].depth, rtol=1e-9, atol=1e-11 * one.max_depth[1])

    @pytest.mark.slow
    @pytest.mark.few(2)
    def test_in_time(self, mixture):
        constants, law = (replace(medium, eta=5.0) for medium in both(mixture))
        one, other = (mdr.impact(BALL, medium, 1e-12, [3.0, 20.0]) for medium in (law, constants))
        assert_same(one, other, rel=1e-11)
        one, other = (
            mdr.indent_in_time(
                CONE, medium, [0.0, 3e-7, 2e-7, 4e-7], [0.0, 1e-9, 2e-9, 3e-9], tolerance=1e-4
            )
            for medium in (law, constants)
        )
        assert_same(one, other, rel=1e-11)
        one, other = (mdr.chain_impact(CONE, medium, 1e-12, 20.0, n=150) for medium in (law, constants))
        # Velocities of the chain are found to twelve digits in each of its steps. For the constant cap of
        # q/a it has longer ramps, with other errors.
        for name in ("restitution", "max_depth", "max_force", "plastic_work"):
            rel = 1e-5 if mixture == "q" else 1e-10
            assert getattr(one, name) == approx(getattr(other, name), rel=rel)


@pytest.mark.few(2)
@pytest.mark.parametrize("eta", [0.0, 20.0])
@pytest.mark.parametrize("mixture", ["H", "q", "H+q+f"])
def test_oblique_impacts_over_a_law_of_ones_own(mixture, eta):
    """As over the constants: the same elements in the same steps. Without viscosity to rounding, with it to
    what the depths of its motion are solved to."""
    arguments = 1e-9, 5.0, 2.0, 0.3
    known, own = (
        mdr.oblique_impact(BALL, medium, *arguments, tangential_mass=2e-9 / 7)
        for medium in both(mixture, eta=eta)
    )
    assert known.plastic_work > 0
    for name in ("tangential_velocity", "max_tangential_force", "friction_work", "restitution"):
        assert getattr(own, name) == approx(getattr(known, name), rel=1e-7 if eta else 1e-10), name


def test_sweeps_take_one_law_for_all():
    xr = pytest.importorskip("xarray")
    hardness, q_c, f_c = MIXTURES["H+q+f"]
    radius, speed = xr.DataArray([1e-6, 1e-5], dims="ball"), xr.DataArray([1.0, 10.0], dims="speed")
    given = {"E_star": E, "mass": 1e-12, "speed": speed, "radius": radius}
    table = mdr.sweep.impacts(mdr.Sphere, hardness=Written(hardness, q_c, f_c), **given)
    other = mdr.sweep.impacts(mdr.Sphere, hardness=hardness, q_c=q_c, f_c=f_c, **given)
    np.testing.assert_allclose(table.restitution, other.restitution, rtol=1e-12)
    assert "Written" in table.attrs["hardness"]
    pressed = {"E_star": E, "depth": xr.DataArray([1e-8, 1e-7], dims="depth"), "radius": radius}
    one = mdr.sweep.indentations(mdr.Sphere, hardness=Written(hardness, q_c, f_c), **pressed)
    two = mdr.sweep.indentations(mdr.Sphere, hardness=hardness, q_c=q_c, f_c=f_c, **pressed)
    np.testing.assert_allclose(one.force, two.force, rtol=1e-12)
    with pytest.raises(ValueError, match="a sweep has one law for all entries"):
        mdr.sweep.impacts(mdr.Sphere, hardness=NixGao(np.array([1e9, 2e9]), 1e-6), **given)
    with pytest.raises(ValueError, match=r"Wrong.*grows"):
        mdr.sweep.impacts(mdr.Sphere, hardness=Wrong("grows"), invalid="nan", **given)


class TestNixAndGao:
    """A law that is none of the paper's sums, against springs one by one and the chain in time."""

    medium = mdr.Medium(E, hardness=SIZE)

    @pytest.mark.parametrize("exponent", [1, 2])
    def test_a_row_of_springs(self, exponent):
        """4000 springs, pressed in 4000 steps, with the cap of the largest radius so far."""
        shape = CONE if exponent == 1 else BALL
        scale = np.pi / 2 * 0.3 if exponent == 1 else 1e5
        path, count = np.array([4e-7, 8e-7, 7.9e-7, 1.2e-6, 1.19e-6]), 4000
        width = (path.max() / scale) ** (1 / exponent) / count
        x = (np.arange(count) + 0.5) * width
        g, plastic = scale * x**exponent, np.zeros(count)
        depth, largest, forces, works, work = 0.0, 0.0, [], [], 0.0
        before = 0.0
        for end in path:
            steps = np.linspace(depth, end, 4001)[1:] if end > largest else [end]
            for depth in steps:
                if depth > largest:
                    a = (depth / scale) ** (1 / exponent)
                    cap = np.pi * a * SIZE.H0 * np.sqrt(1 + SIZE.a_star / a) / (2 * E)
                    yielded = np.maximum(depth - g - cap - plastic, 0.0)
                    work += 2 * E * np.sum((before + cap) / 2 * yielded) * width
                    plastic, largest, before = plastic + yielded, depth, cap
            forces.append(2 * E * np.sum(np.maximum(depth - g - plastic, 0.0)) * width)
            works.append(work)
        states = mdr.indent(shape, self.medium, path)
        # Sums over midpoints have the error (width/a)², about, of kinks inside of an element.
        np.testing.assert_allclose(states.force, forces, rtol=1e-5, atol=1e-6 * max(forces))
        np.testing.assert_allclose(states.plastic_work, works, rtol=1e-4)

    @pytest.mark.parametrize("eta", [0.0, 5.0])
    def test_the_chain(self, eta):
        medium = replace(self.medium, eta=eta)
        hit, chain = mdr.impact(CONE, medium, 1e-12, 20.0), mdr.chain_impact(CONE, medium, 1e-12, 20.0)
        assert hit.restitution == approx(chain.restitution, abs=2e-6)
        assert hit.max_depth == approx(chain.max_depth, rel=2e-6)
        assert hit.plastic_work == approx(chain.plastic_work, rel=1e-5)
        for name in ("contact_time", "max_force"):
            bound = max(getattr(chain.errors, name), 2e-6)
            assert getattr(hit, name) == approx(getattr(chain, name), rel=bound)

    def test_dry_impacts_and_motions(self):
        """Also over an imprint: energy balance and quadrature against the equation of motion."""
        for imprint in (0.0, 3e-8):
            hit = mdr.impact(BALL, self.medium, 1e-12, [0.3, 3.0, 20.0], plastic_depth=imprint)
            for i in range(3):
                motion = hit[i].motion(3)
                assert -motion.velocity[-1] / hit.speed[i] == approx(hit.restitution[i], abs=1e-9)
                assert motion.time[-1] == approx(hit.contact_time[i], rel=1e-9)

    def test_it_is_found_from_a_curve(self):
        scipy = pytest.importorskip("scipy.optimize")
        tip, depth = (
            mdr.Cone.berkovich(),
            np.append(np.linspace(1e-8, 5e-7, 40), np.linspace(5e-7, 4.8e-7, 15)),
        )

        def force(depth, modulus, *law):
            return mdr.indent(
                tip, mdr.Medium(1e9 * modulus, hardness=NixGao(law[0] * 1e9, law[1] * 1e-6)), depth
            ).force

        exact = force(depth, 130.0, 0.6, 4.0)
        found, _ = scipy.curve_fit(
            force, depth, exact, p0=(100.0, 1.0, 1.0), bounds=(1e-3, 1e3), x_scale=(100, 1, 1)
        )
        np.testing.assert_allclose(found, [130.0, 0.6, 4.0], rtol=1e-4)


STEEP = [Layered(H, 0.5, 1e-6, 0.1), Layered(H, 0.4, 1e-6, 0.01), Kinked(H, 1e-6), Decaying(H, 0.05, 5e-7)]


@pytest.mark.parametrize("law", STEEP, ids=["step of a tenth", "step of a hundredth", "kink", "decay"])
@pytest.mark.parametrize("shape", [mdr.Cone(slope=0.1), BALL, BLUNT], ids=["cone", "ball", "blunt"])
def test_steep_laws_keep_the_balance_of_energy(law, shape):
    """∫ F ds up to the depth of an impact is its energy, by Gauss from step to step of a fine division."""
    medium = mdr.Medium(E, hardness=law)
    hit = mdr.impact(shape, medium, 1e-12, [2.0, 60.0])
    node, weight = np.polynomial.legendre.leggauss(12)
    for i in range(2):
        depth, onset = hit.max_depth[i], min(float(mdr.yield_depth(shape, medium)), hit.max_depth[i])
        edges = [[0.0, depth, float(shape.reduced(1e-6))], np.geomspace(1e-8, 1, 3000) * depth]
        edges = np.unique(np.concatenate([*edges, onset + (depth - onset) * np.geomspace(1e-10, 1, 3000)]))
        edges = edges[edges <= depth]
        step = np.diff(edges)[:, None]
        s = edges[:-1, None] + step * (1 + node) / 2
        force = mdr.indent(shape, medium, s.reshape(-1, 1)).force.reshape(s.shape)
        assert np.sum(force * step * weight / 2) == approx(0.5e-12 * hit.speed[i] ** 2, rel=1e-12)
        motion = hit[i].motion(3)
        assert motion.time[-1] == approx(hit.contact_time[i], rel=1e-8)


class TestAForceThatFalls:
    """Solvers find by themselves that the force falls after the onset, for a law that does not say so."""

    @pytest.mark.parametrize(
        "law", [Written(0.0, 0.0, 0.2 / np.pi), Decaying(0.3, 0.02, 1.05)], ids=["f_c", "decay"]
    )
    def test_a_path_by_force_jumps(self, law):
        shape, medium = mdr.TruncatedCone(flat_radius=1.0, slope=0.3), mdr.Medium(1.0, hardness=law)
        depth = np.linspace(0.001, 3.0, 30001)
        force = mdr.indent(shape, medium, depth[:, None]).force[:, 0]
        first_top = force[np.argmax(np.diff(force) < 0)]
        assert np.any(np.diff(force) < -1e-7)
        for share in (0.5, 0.9999, 1.0001, 1.01):
            state = mdr.indent_to_force(shape, medium, share * first_top)
            first = depth[np.argmax(force >= share * first_top)]
            assert 0 <= first - state.depth <= depth[1] - depth[0]
            assert state.force == approx(share * first_top, rel=1e-12)
            assert ("jump" in [limit.what for limit in state.limits]) == (share > 1)

    def test_the_largest_force_of_an_impact_may_be_an_earlier_one(self):
        shape, law = mdr.TruncatedCone(flat_radius=1.0, slope=0.3), Written(0.0, 0.0, 0.2 / np.pi)
        medium = mdr.Medium(1.0, hardness=law)
        speed = 1.5 * mdr.yield_speed(shape, medium, 1.0)
        hit = mdr.impact(shape, medium, 1.0, [speed, 9 * speed])
        assert hit.max_force[0] == approx(mdr.yield_force(shape, medium), rel=1e-12)
        assert hit.turning_point.force[0] < 0.99 * hit.max_force[0]
        assert hit.max_force[1] == hit.turning_point.force[1]

    def test_a_sharp_tip_that_yields_from_first_touch_on(self):
        cone, medium = mdr.Cone(slope=0.1), mdr.Medium(E, hardness=Decaying(H, 1e-3, 1e-6))
        depth = np.geomspace(1e-9, 3e-5, 20001)
        force = mdr.indent(cone, medium, depth[:, None]).force[:, 0]
        top = int(np.argmax(np.diff(force) < 0))
        assert mdr.yield_depth(cone, medium) == 0.0 < force[top + 100] < force[top]
        state = mdr.indent_to_force(cone, medium, 1.001 * force[top])
        assert state.depth == approx(depth[np.argmax(force >= 1.001 * force[top])], rel=1e-3)
        hit = mdr.impact(cone, medium, 1e-12, 30.0)
        reached = max(force[depth <= hit.max_depth].max(), hit.turning_point.force)
        assert reached <= hit.max_force * (1 + 1e-12) <= reached * (1 + 1e-6)

    def test_more_than_it_carries_is_refused(self):
        medium = mdr.Medium(E, hardness=Written(0.0, 0.0, 1e-3))
        with pytest.raises(ValueError, match=r"more than the 0.00314159 N that the contact carries on"):
            mdr.indent_to_force(CONE, medium, 1.001 * np.pi * 1e-3)


CALLS = {
    "indent": lambda medium: mdr.indent(BALL, medium, [1e-9, 1e-6]),
    "indent_to_force": lambda medium: mdr.indent_to_force(BALL, medium, 1e-2),
    "impact": lambda medium: mdr.impact(BALL, medium, 1e-12, [1.0, 50.0]),
    "viscous impact": lambda medium: mdr.impact(BALL, replace(medium, eta=1.0), 1e-12, 50.0),
    "chain_impact": lambda medium: mdr.chain_impact(BALL, medium, 1e-12, 50.0, n=60),
    "indent_in_time": lambda medium: mdr.indent_in_time(BALL, medium, [0.0, 1e-6], [0.0, 1.0]),
    "Foundation": lambda medium: mdr.Foundation(BALL, medium, 20, 1e-5).advance(1e-6),
}


class TestWhatIsNoLaw:
    @pytest.mark.few(14)
    @pytest.mark.parametrize(
        ("call", "fault"),
        [
            # Three seconds: the solver looks long for an end of the motion.
            pytest.param(*pair, marks=[pytest.mark.full] if pair == ("viscous impact", "negative") else [])
            for pair in itertools.product(CALLS, FAULTS)
        ],
    )
    def test_is_refused_in_each_function(self, call, fault):
        with pytest.raises(ValueError, match=FAULTS[fault]) as error:
            CALLS[call](mdr.Medium(E, hardness=Wrong(fault)))
        assert f"hardness Wrong(fault='{fault}')" in str(error.value)
        assert error.value.advice

    @pytest.mark.parametrize("fault", [fault for fault in FAULTS if fault not in ("grows", "other rate")])
    def test_counts_where_the_contact_is(self, fault):
        """Smaller contacts than those with the fault are computed."""
        flat = mdr.Medium(E, hardness=1e9)
        medium = mdr.Medium(E, hardness=Wrong(fault))
        if fault != "negative":
            small = mdr.indent(BALL, medium, 0.9e-9)
            assert small.force == approx(mdr.indent(BALL, flat, 0.9e-9).force, rel=1e-13)
            hit, other = (mdr.impact(BALL, each, 1e-16, 1.0) for each in (medium, flat))
            assert other.contact_radius < 1e-7
            assert hit.restitution == approx(other.restitution, rel=1e-12)
            assert hit.contact_time == approx(other.contact_time, rel=1e-11)
        assert mdr.indent(BALL, medium, 0.5e-9).force > 0

    def test_an_ensemble_is_looked_at_one_by_one(self):
        medium = mdr.Medium(E, hardness=NixGao(np.array([1e9, -1e9]), 1e-6))
        with pytest.raises(ValueError, match=r"NixGao\(H0=[^\[]*-1.*must be a number, not negative"):
            mdr.impact(BALL, medium, 1e-12, 1.0)
        # Under the slender one of two cones the law grows too much.
        rising = mdr.Medium(E, hardness=Power(1e9, 1e-6, 0.5))
        assert mdr.impact(mdr.Paraboloid([1e-5, 2e-5]), rising, 1e-12, 1.0).max_depth.shape == (2,)
        with pytest.raises(ValueError, match="grows with the contact radius"):
            mdr.impact(mdr.PowerLaw(coefficient=[0.3, 0.3], exponent=[2.0, 1.2]), rising, 1e-12, 1.0)

    def test_a_gap_between_the_radii_of_the_check_is_found_by_a_contact_in_it(self):
        """It is 3 nm wide at 1 µm, where the check looks at every 70th nanometre."""
        radius = np.linspace(0.5e-6, 2e-6, 2000)
        with pytest.raises(ValueError, match=r"line_load\(a\) = nan at a = 1\.00[3-6]\d*e-06 m"):
            mdr.indent(BALL, mdr.Medium(E, hardness=Gap(1e9)), radius**2 / BALL.radius)

    def test_each_of_several_punches_is_looked_at(self):
        """A law that is negative below a radius is one for the wider punch alone."""
        law = mdr.Medium(E, hardness=NixGao(1e9, -1.5e-6))
        assert mdr.impact(mdr.FlatPunch(2e-6), law, 1e-12, 1.0).max_depth > 0
        with pytest.raises(ValueError, match=r"σ_c = nan Pa at a = 1\S*e-06 m"):
            mdr.impact(mdr.FlatPunch([1e-6, 2e-6]), law, 1e-12, 1.0)

    def test_its_functions_are_looked_at(self):
        with pytest.raises(ValueError, match="write it for arrays"):
            mdr.indent(BALL, mdr.Medium(E, hardness=Scalar(1e9)), 1e-8)
        with pytest.raises(ValueError, match=r"line_load\(a\) = .* but by at\(a\) and rate\(a\)"):
            mdr.indent(BALL, mdr.Medium(E, hardness=Overridden(1e9)), 1e-8)
        with pytest.raises(ValueError, match=r"wall_load\(a\) = .* but by at\(a\) and rate\(a\)"):
            mdr.indent(BALL, mdr.Medium(E, hardness=Force(1e9)), 1e-8)
        with pytest.raises(ValueError, match=r"hardness = -1e.09 Pa must be above 0"):
            mdr.Medium(E, hardness=Overridden(-1e9)).hardness_at(1e-6)

    def test_a_constant_may_be_a_number(self):
        """The value needs no shape."""
        state = mdr.indent(BALL, mdr.Medium(E, hardness=Constant(1e9)), [1e-8, 1e-7])
        other = mdr.indent(BALL, mdr.Medium(E, hardness=1e9), [1e-8, 1e-7])
        assert_same(state, other)


@dataclass(frozen=True)
class Floor(HardnessLaw):
    """H (1 + L/a), constant below a radius, which it writes into its argument."""

    H: float

    def at(self, a):
        a[a < 5e-8] = 5e-8
        return self.H * (1 + 1e-7 / a)

    def rate(self, a):
        return np.where(a < 5e-8, 0.0, -self.H * 1e-7 / np.maximum(a, 5e-8) ** 2)


def test_a_law_cannot_change_its_argument():
    """The solver goes on with the radii that it has asked for."""
    medium = mdr.Medium(1e9, hardness=Floor(1e7))
    with pytest.raises(ValueError, match=r"Floor\.at changes its argument in place .*: return new values"):
        mdr.impact(mdr.Cone(0.3), medium, 1e-12, [0.5, 1.0])


@dataclass(frozen=True)
class Power(HardnessLaw):
    H: float
    L: float
    n: float

    def at(self, a):
        return self.H * (a / self.L) ** self.n

    def rate(self, a):
        return self.n * self.at(a) / a


@dataclass(frozen=True)
class Constant(HardnessLaw):
    H: float

    def at(self, a):
        return self.H

    def rate(self, a):
        return 0.0


class Gap(Constant):
    def at(self, a):
        return np.where((a > 1.003e-6) & (a < 1.006e-6), np.nan, self.H)


class Scalar(Constant):
    def at(self, a):
        return self.H if a > 0 else 0.0


class Overridden(Constant):
    def line_load(self, a):
        return 2 * a * self.H


class Force(Constant):
    """With the force of a contact in the place of 1/π of it."""

    def wall_load(self, a):
        return np.pi * a**2 * self.H


class TestTheMedium:
    law = SIZE

    def test_holds_the_law(self):
        medium = mdr.Medium(E, hardness=self.law)
        assert medium.q_c == medium.f_c == 0.0
        assert medium.hardness_at(3 * L) == approx(0.5 * H * np.sqrt(2), rel=1e-15)
        assert medium.hardness_at([L, 3 * L]).shape == (2,)
        assert replace(mdr.Medium(E), hardness=self.law) == medium
        assert mdr.Medium(E, q_c=np.inf, hardness=self.law) == medium
        assert replace(medium, hardness=0.0, q_c=2.0) == mdr.Medium(E, q_c=2.0)

    @pytest.mark.parametrize("name", ["q_c", "f_c"])
    def test_constants_beside_a_law_are_refused(self, name):
        for call in (
            lambda: mdr.Medium(E, hardness=self.law, **{name: 5.0}),
            lambda: replace(mdr.Medium(E, hardness=self.law), **{name: 5.0}),
            lambda: replace(mdr.Medium(E, **{name: 5.0}), hardness=self.law),
            lambda: mdr.Medium(E, hardness=self.law, **{name: [0.0, 5.0]}),
        ):
            with pytest.raises(
                ValueError, match=rf"{name}.* = 5 N.* NixGao\(.*take hardness = 0 with {name}"
            ):
                call()

    def test_laws_of_arrays(self):
        given = np.array([1e9, 2e9])
        medium = mdr.Medium(E, hardness=NixGao(given, [1e-6, 2e-6]))
        given[0] = 5e9
        assert medium.shape == (2,)
        np.testing.assert_array_equal(medium.hardness.H0, [1e9, 2e9])
        with pytest.raises(ValueError, match="read-only"):
            medium.hardness.H0[0] = 1.0
        assert given.flags.writeable
        assert medium == mdr.Medium(E, hardness=NixGao([1e9, 2e9], np.array([1e-6, 2e-6])))
        assert hash(medium) == hash(mdr.Medium(E, hardness=NixGao([1e9, 2e9], np.array([1e-6, 2e-6]))))
        assert medium != mdr.Medium(E, hardness=NixGao([1e9, 2e9], np.array([1e-6, 3e-6])))
        assert medium.entries(1).hardness == NixGao(2e9, 2e-6)
        assert mdr.Medium([E, E], hardness=self.law).shape == (2,)
        for law in (NixGao([1e9, 2e9], [1.0, 2.0, 3.0]), NixGao([1e9, 2e9], 1e-6)):
            with pytest.raises(ValueError, match="do not broadcast"):
                mdr.Medium([E, E, E], hardness=law)

    def test_what_is_no_law_is_refused(self):
        for bad in (NixGao, lambda a: 1e9 * a):
            with pytest.raises(ValueError, match=r"must be a number .* or a HardnessLaw"):
                mdr.Medium(E, hardness=bad)
        with pytest.raises(TypeError, match="abstract"):
            type("Half", (HardnessLaw,), {"at": lambda self, a: a})()
        open_law = type("Open", (Constant,), {})
        assert mdr.Medium(E, hardness=open_law(1e9)).hardness.H == 1e9

        class Plain(HardnessLaw):
            at, rate = Constant.at, Constant.rate

            def __init__(self):
                self.H = 1e9

        with pytest.raises(TypeError, match=r"Plain .* @dataclass\(frozen=True\)"):
            mdr.Medium(E, hardness=Plain())

    def test_is_pickled_and_printed(self):
        medium = mdr.Medium(E, hardness=self.law)
        assert pickle.loads(pickle.dumps(medium)) == medium
        state = pickle.loads(pickle.dumps(mdr.indent(CONE, medium, [1e-8, 1e-7])))
        assert "σ_c by NixGao(H0 1e+09, a_star 3e-06)" in repr(state)
        assert "NixGao" in repr(mdr.impact(CONE, medium, 1e-12, 1.0))
        assert [limit.what for limit in state.limits if limit.exceeded] == ["flow"]

    def test_its_results_are_plotted(self):
        pytest.importorskip("holoviews")
        medium = mdr.Medium(E, hardness=self.law)
        path = mdr.indent(CONE, medium, np.append(np.linspace(0, 1e-7, 20), 0.99e-7))
        assert path.plot() is not None
        assert mdr.impact(CONE, medium, 1e-12, 1.0).motion().plot() is not None

    def test_a_scene_is_solved(self):
        scene = mdr.Scene(CONE, mdr.Medium(E, hardness=self.law), mdr.scene.FreeImpact(1e-12, 10.0))
        assert {str(model) for model in scene.models} == {"closed form", "scalar ODE", "chain"}
        assert scene.solve("scalar ODE").restitution == approx(scene.solve().restitution, abs=1e-9)


COPPER = mdr.Medium(E, hardness=SIZE)
SCENE = mdr.Scene(CONE, COPPER, mdr.scene.DepthPath(1e-7))


@pytest.mark.parametrize(
    ("call", "instead"),
    [
        (lambda: mdr.fit_indentation(CONE, [0.0, 1e-7], [0.0, 1.0], hardness=SIZE), "curve_fit"),
        (SCENE.to_json, "keep the script"),
        (SCENE.to_python, "keep the script"),
        (lambda: mdr.creep(CONE, COPPER, [0.0, 1.0], [0.0, 1.0]), "use indent_in_time"),
        (lambda: mdr.impact(CONE, COPPER, 1e-12, 1.0).fast_limit, "ScalingLaw has the powers"),
        (lambda: COPPER.critical_depth, r"take yield_depth\(profile, medium\)"),
        (lambda: COPPER.yield_line_load, "hardness_at"),
        (lambda: mdr.Medium(E, hardness=SIZE, work_of_adhesion=0.1), "or give q_c"),
        (lambda: replace(COPPER, work_of_adhesion=0.1), "or give q_c"),
    ],
    ids=["fit", "JSON", "Python", "creep", "fast limit", "d_c", "line load", "adhesion", "replace"],
)  # fmt: skip
def test_what_has_no_law_says_so(call, instead):
    with pytest.raises(ValueError, match=instead) as error:
        call()
    assert "NixGao(H0=1000000000.0, a_star=3e-06)" in str(error.value)


class Asked(NixGao):
    """Nix and Gao's law, with a forward difference for its rate, which has a noise of 10⁻⁸."""

    radii = 0

    def at(self, a):
        type(self).radii += np.size(a)
        return super().at(a)

    def rate(self, a):
        step = 1e-8 * a
        return (self.at(a + step) - self.at(a)) / step


class TestARateByDifferences:
    """Its noise is not taken for a kink, at which the work is halved down to 10⁻⁹ of its length."""

    speed = np.geomspace(0.5, 5.0, 8)

    @pytest.mark.parametrize("tip", [BALL, CONE], ids=["ball", "cone"])
    def test_impacts(self, tip):
        exact = mdr.impact(tip, mdr.Medium(E, hardness=NixGao(0.5e9, 4e-6)), 1e-12, self.speed)
        Asked.radii = 0
        hit = mdr.impact(tip, mdr.Medium(E, hardness=Asked(0.5e9, 4e-6)), 1e-12, self.speed)
        # The noise of the rate, over the square root of the number of nodes.
        assert hit.restitution == approx(exact.restitution, rel=1e-8)
        assert hit.contact_time == approx(exact.contact_time, rel=1e-8)
        # It is 10⁵; halved to the end, one impact asks for 10⁸.
        assert Asked.radii < 1e6
