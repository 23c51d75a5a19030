"""Every class of hardness: states against 45 digits, closed limits, impacts."""

import numpy as np
import pytest

pytest.importorskip("mpmath")

import mpmath
from mpmath import mp, mpf
from scipy.integrate import quad, solve_ivp

import mdr_core as mdr
from mdr_core.solver.contact.yielding import RadiusCap

from ...approx import approx
from ...reference import Reference
from ...shapes import SHAPES, name
from ...slow_reference import Impact as SpringImpact
from ...slow_reference import Springs, WithRadii
from ...slow_reference import State as SpringState

E = 70e9
#: Scale of the hardness (Pa), and of lengths (m).
H, L = 2e9, 1e-6
#: H, q_c and f_c of five mixtures, with one radius L at which their parts are about as hard.
MIXTURES = {
    "H": (H, 0.0, 0.0),
    "f": (0.0, 0.0, H * L * L),
    "H+q": (0.6 * H, 0.5 * H * L, 0.0),
    "q+f": (0.0, 0.7 * H * L, 0.4 * H * L * L),
    "H+q+f": (0.5 * H, 0.3 * H * L, 0.2 * H * L * L),
}
PROFILES = (
    mdr.Cone(slope=0.3),
    mdr.Paraboloid(radius=1e-5),
    mdr.PowerLaw(coefficient=1e11, exponent=3.0),
    mdr.Sphere(radius=1e-5),
    mdr.RoundedCone(tip_radius=3e-6, slope=0.3),
    mdr.TruncatedCone(flat_radius=5e-7, slope=0.3),
)


def medium_of(mixture, **other):
    hardness, q_c, f_c = MIXTURES[mixture]
    return mdr.Medium(E, q_c=q_c, hardness=hardness, f_c=f_c, **other)


class State(Reference):
    """A state in 45 digits, with the cap u_c = π a σ_c(a)/(2E*) at the largest contact radius."""

    def __init__(self, profile, medium, depth, largest):
        super().__init__(profile, mdr.Medium(E, q_c=1.0), depth, largest)
        a, modulus = self.radius(mpf(largest)), mpf(medium.E_star)
        hardness = mpf(medium.hardness) + mpf(medium.q_c) / a + mpf(medium.f_c) / a**2
        self.plastic_depth = max(mpf(0), mpf(largest) - mp.pi * a * hardness / (2 * modulus))
        self.live_interval = self.depth - self.plastic_depth
        self.c = self.radius(self.plastic_depth) if self.plastic_depth else mpf(0)


@pytest.mark.parametrize("mixture", MIXTURES)
@pytest.mark.parametrize("shape", PROFILES, ids=name)
def test_states_against_elements_in_45_digits(shape, mixture):
    """Random depths, an unloading each; forces 10⁻¹², energies 10⁻¹¹ and 10⁻⁹ of their sum."""
    medium = medium_of(mixture)
    rng = np.random.default_rng([PROFILES.index(shape), list(MIXTURES).index(mixture)])
    for largest in np.exp(rng.uniform(np.log(1e-8), np.log(6e-6), 2)):
        springs, a = (
            Springs(shape, medium, 1.5 * shape.contact_radius(largest)),
            shape.contact_radius(largest),
        )
        live = min(largest, float(springs.cap(a)))
        path = [largest, largest - rng.uniform(0, 0.9) * live]
        states = mdr.indent(shape, medium, path)
        total = states.stored_energy[0] + states.plastic_work[0]
        for state, depth in zip(states, path, strict=True):
            exact = State(shape, medium, depth, largest)
            assert abs(state.plastic_depth - float(exact.plastic_depth)) <= 1e-13 * largest
            if exact.live_interval > 0:
                assert state.force == approx(float(exact.force), rel=1e-12)
                assert abs(state.stored_energy - float(exact.stored_energy)) <= 1e-11 * total
        # The work of the elements is stored or plastic.
        work = SpringImpact(springs, a, 1.0).work
        assert states.plastic_work[0] + states.stored_energy[0] == approx(work, rel=1e-9)


@pytest.mark.parametrize("mixture", MIXTURES)
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_the_plastic_depth_grows_with_depth(shape, mixture):
    """So that the largest depth stands for the largest plastic depth of the whole loading."""
    if isinstance(shape, mdr.PowerLaw) and shape.exponent < 1 and medium_of(mixture).hardness:
        with pytest.raises(ValueError, match="set hardness = 0, or take a convex shape"):
            mdr.indent(shape, medium_of(mixture), 1e-9)
        return
    depth = np.geomspace(1e-10, 1e-5, 2000)
    plastic = mdr.indent(shape, medium_of(mixture), depth[:, None]).plastic_depth[:, 0]
    # The rounding of a difference of depths.
    assert np.all(np.diff(plastic) >= -1e-15 * depth[1:])


class TestClosedLimits:
    """Constant hardness under a cone and a paraboloid."""

    @pytest.mark.parametrize("kappa", [1e-3, 0.3, 0.9])
    def test_a_cone(self, kappa):
        cone, medium = mdr.Cone(slope=0.3), mdr.Medium(E, hardness=kappa * E * 0.3)
        state = mdr.indent(cone, medium, [1e-9, 1e-6])
        np.testing.assert_allclose(state.plastic_radius, (1 - kappa) * state.contact_radius, rtol=1e-14)
        np.testing.assert_allclose(state.mean_pressure, medium.hardness * (1 - kappa / 2), rtol=1e-14)
        hit = mdr.impact(cone, medium, 1e-9, [1e-3, 1.0, 1e3])
        e = np.sqrt(kappa * (3 - 2 * kappa) / (2 - kappa))
        np.testing.assert_allclose(hit.restitution, e, rtol=1e-11)

        # Loading is that of a force ∝ d². In units of d_max and of 2E*/(π slope) the energy at the turning
        # point is κ(2 − κ)/3, and at s = 1 − u² on unloading u² ((1 + s + s²)/3 − (1 − κ)²) of it is back.
        def slowness(u):
            s = 1 - u * u
            return 2 / np.sqrt(((1 + s + s * s) / 3 - (1 - kappa) ** 2) * 3 / (kappa * (2 - kappa)))

        unloading, _ = quad(slowness, 0, np.sqrt(kappa), epsabs=0, epsrel=1e-11)
        expected = 2.80436421065 / 2 + unloading
        np.testing.assert_allclose(hit.contact_time * hit.speed / hit.max_depth, expected, rtol=1e-9)

    @pytest.mark.parametrize("kappa", [1.0, 2.0])
    def test_a_flat_cone_never_yields(self, kappa):
        cone, medium = mdr.Cone(slope=0.5), mdr.Medium(1.0, hardness=0.5 * kappa)
        assert mdr.yield_depth(cone, medium) == mdr.yield_speed(cone, medium, 1.0) == np.inf
        assert mdr.yield_force(cone, medium) == np.inf
        assert (
            mdr.indent(cone, medium, 1.0).plastic_depth
            == mdr.impact(cone, medium, 1.0, 1.0).plastic_work
            == 0
        )

    def test_a_paraboloid(self):
        ball, medium = mdr.Paraboloid(radius=1e-5), mdr.Medium(E, hardness=9e9)
        onset = mdr.yield_depth(ball, medium)
        assert onset == approx((np.pi * 9e9 / (2 * E)) ** 2 * 1e-5, rel=1e-14)
        ratio = np.array([0.5, 1 + 1e-6, 3.0, 1e4])
        state = mdr.indent(ball, medium, onset * ratio)
        expected = np.maximum(ratio - np.sqrt(ratio), 0.0)
        np.testing.assert_allclose(state.plastic_depth / onset, expected, rtol=0, atol=1e-15 * ratio.max())
        # The mean pressure at the onset is 2H/3, as of every elastic paraboloid under its own line load.
        assert mdr.indent(ball, medium, onset).mean_pressure == approx(6e9, rel=1e-14)

    def test_johnsons_exponent(self):
        """e ∝ v^(−1/4) under a ball of constant hardness, within 2 % from 30 times the yield speed on."""
        ball, medium = mdr.Paraboloid(radius=1e-5), mdr.Medium(E, hardness=9e9)
        speed = mdr.yield_speed(ball, medium, 1e-12) * np.array([29.9, 30.1, 1e3, 1.01e3, 1e5, 1.01e5])
        e = mdr.impact(ball, medium, 1e-12, speed).restitution
        slope = (np.diff(np.log(e)) / np.diff(np.log(speed)))[::2]
        np.testing.assert_allclose(slope, -0.25, rtol=0.02)
        assert abs(slope[2] + 0.25) < 1e-4

    def test_line_processes_alone_carry_no_more_than_their_force(self):
        """F = π f_c − E* α u_c² under a cone, α = 2/(π slope)."""
        cone, medium = mdr.Cone(slope=0.3), mdr.Medium(E, f_c=1e-3)
        state = mdr.indent(cone, medium, 1e-6)
        u = np.pi * 1e-3 / (2 * E * state.contact_radius)
        assert state.force == approx(np.pi * 1e-3 - E * 2 / (np.pi * 0.3) * u**2, rel=1e-12)
        assert mdr.indent_to_force(cone, medium, state.force).depth == approx(1e-6, rel=1e-9)
        with pytest.raises(ValueError, match="all of the contact yields, π f_c"):
            mdr.indent_to_force(cone, medium, np.pi * 1e-3)

    @pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Paraboloid(1e-5)], ids=name)
    def test_closed_forms_are_the_quadrature(self, shape):
        """The rule of the two shapes against that of any shape."""
        closed = mdr.impact(shape, mdr.Medium(E, hardness=9e9), 1e-12, np.geomspace(0.1, 1e4, 40))
        depth, zero = np.asarray(closed.plastic_depth), np.zeros(40)
        general = RadiusCap.of(shape, closed.medium).plastic_integral(zero, depth)
        np.testing.assert_allclose(closed.plastic_work, 2 * E * general, rtol=1e-9, atol=1e-30)
        np.testing.assert_allclose(
            closed.stored_energy + closed.plastic_work, 0.5e-12 * closed.speed**2, rtol=1e-13
        )


def rebound(profile, medium, mass, speed):
    """Restitution and contact time by Newton's equation with the force of the elements."""
    tau = medium.relaxation_time
    springs = WithRadii(profile, medium, float(profile.contact_radius(3e-6)))

    def loading(_, y):
        depth = np.maximum(y[0], 0.0)
        drag = 8 * medium.eta * float(springs.radius(depth)) * y[1]
        return y[1], -(float(springs.first_force(depth)) + drag) / mass

    def turned(_, y):
        return y[1]

    turned.terminal = True
    scale = 100 * np.sqrt(mass / (2 * E * float(springs.radius(1e-8))))
    exact = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-20}
    first = solve_ivp(loading, (0, scale), (0.0, speed), events=turned, **exact)
    largest = first.y[0, -1]

    def unloading(_, y):
        # On unloading elements are released at g = d + τḋ.
        return y[1], -SpringState(springs, y[0] + tau * min(y[1], 0.0), largest).force / mass

    def released(_, y):
        return y[0] + tau * y[1] - float(springs.plastic_depth(largest))

    released.terminal, released.direction = True, -1
    last = solve_ivp(unloading, (0, scale), (largest, 0.0), events=released, **exact)
    return largest, -last.y[1, -1] / speed, first.t[-1] + last.t[-1]


@pytest.mark.few(3)
@pytest.mark.parametrize("eta", [0.0, 5.0])
@pytest.mark.parametrize(("index", "mixture"), [(1, "H"), (3, "H+q+f"), (4, "H+q"), (5, "q+f")])
def test_impacts_against_newtons_equation_over_elements(index, mixture, eta):
    """DOP853 with steps of 10⁻¹¹; where yield starts its force has a kink."""
    shape, medium = PROFILES[index], medium_of(mixture, eta=eta)
    hit = mdr.impact(shape, medium, 1e-12, 20.0)
    assert hit.plastic_work > 0.05 * 0.5e-12 * 20.0**2
    depth, e, time = rebound(shape, medium, 1e-12, 20.0)
    assert hit.max_depth == approx(depth, rel=1e-8)
    assert hit.restitution == approx(e, abs=1e-8)
    assert hit.contact_time == approx(time, rel=1e-7)


@pytest.mark.parametrize("mixture", MIXTURES)
@pytest.mark.parametrize("shape", PROFILES, ids=name)
def test_energy_balance_and_equation_of_motion_agree(shape, mixture):
    """Also over an imprint; the second ends where a path to its depth ends."""
    medium, speed = medium_of(mixture), np.array([0.3, 3.0, 20.0])
    first = mdr.impact(shape, medium, 1e-12, speed)
    second = mdr.impact(shape, medium, 1e-12, 1.5 * speed, plastic_depth=first.plastic_depth)
    for hit in (first, second):
        work = hit.stored_energy + hit.plastic_work
        np.testing.assert_allclose(work, 1e-12 * hit.speed**2 / 2, rtol=1e-12)
        for i in range(3):
            motion = hit[i].motion(3)
            assert -motion.velocity[-1] / hit.speed[i] == approx(hit.restitution[i], abs=1e-10)
            assert motion.time[-1] == approx(hit.contact_time[i], rel=1e-9)
            energy = motion.kinetic_energy + motion.stored_energy + motion.plastic_work
            np.testing.assert_allclose(energy, 1e-12 * hit.speed[i] ** 2 / 2, rtol=1e-9)
        # One by one, and in an ensemble of media.
        again = mdr.impact(shape, medium, 1e-12, hit.speed[2], plastic_depth=hit.plastic_depth[2] * 0)
        media = mdr.Medium(
            E, q_c=[medium.q_c, 100.0], hardness=[medium.hardness, 0.0], f_c=[medium.f_c, 0.0]
        )
        many = mdr.impact(shape, media, 1e-12, hit.speed[2])
        assert many.restitution[0] == approx(again.restitution, rel=1e-13)
        assert many.contact_time[0] == approx(again.contact_time, rel=1e-11)
    path = mdr.indent(shape, medium, [first.max_depth[2], 0.0, second.max_depth[2]])
    assert second.max_depth[2] == path.depth[2]
    assert second.plastic_depth[2] == approx(path.plastic_depth[2], rel=1e-12)
    assert second.turning_point.force[2] == approx(path.force[2], rel=1e-11)


class TestFallingForce:
    """Line processes under a truncated cone: the force falls by 2 % after the onset."""

    cone, medium = mdr.TruncatedCone(flat_radius=1.0, slope=0.3), mdr.Medium(1.0, f_c=0.2 / np.pi)

    def test_a_path_by_force_jumps(self):
        depth = np.linspace(0.01, 1.5, 6000)
        force = mdr.indent(self.cone, self.medium, depth[:, None]).force[:, 0]
        onset = mdr.yield_force(self.cone, self.medium)
        later = depth > mdr.yield_depth(self.cone, self.medium)
        assert 0.97 < force[later].min() / onset < 0.99
        for share in (0.5, 0.999, 1.001, 1.02):
            state = mdr.indent_to_force(self.cone, self.medium, share * onset)
            first = depth[np.argmax(force >= share * onset)]
            assert 0 <= first - state.depth <= depth[1] - depth[0]
            assert state.force == approx(share * onset, rel=1e-12)
            jumps = [limit.sentence for limit in state.limits if limit.what == "jump"]
            assert len(jumps) == (share > 1)
            jump_depth = 1e3 * float(mdr.yield_depth(self.cone, self.medium))
            assert all(f"{jump_depth:.4g} mm" in sentence for sentence in jumps)

    def test_a_part_of_a_path_says_that_the_path_jumps(self):
        onset = mdr.yield_force(self.cone, self.medium)
        path = mdr.indent_to_force(self.cone, self.medium, np.array([0.5, 1.02]) * onset)
        for part in (path, path[1:], path[1]):
            assert "jump" in [limit.what for limit in part.limits]

    def test_the_largest_force_of_an_impact_may_be_that_at_the_onset(self):
        speed = 1.5 * mdr.yield_speed(self.cone, self.medium, 1.0)
        hit = mdr.impact(self.cone, self.medium, 1.0, [speed, 9 * speed])
        assert hit.max_force[0] == approx(mdr.yield_force(self.cone, self.medium), rel=1e-12)
        assert hit.turning_point.force[0] < 0.99 * hit.max_force[0]
        assert hit.max_force[1] == hit.turning_point.force[1]


def test_onset_deeper_than_the_known_shape_is_refused():
    tip = mdr.Sampled([0.0, 1e-6, 2e-6], [0.0, 1e-8, 4e-8])
    with pytest.raises(ValueError, match="yield depth = inf m is deeper than"):
        mdr.yield_depth(tip, mdr.Medium(1e9, hardness=1e9))


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda cone, glass: glass.critical_depth, r"class \(b\); take yield_depth"),
        (lambda cone, glass: glass.yield_line_load, r"class \(b\); it is π a σ_c\(a\)/2"),
        (
            lambda cone, glass: mdr.impact(cone, glass, 1e-9, 1.0).fast_limit,
            "the fast limit supports only the hardness",
        ),
        (
            lambda cone, glass: mdr.Medium(E, hardness=1e9, work_of_adhesion=0.1),
            "hardness = 1e\\+09 Pa .* work_of_adhesion to 0",
        ),
    ],
)
def test_what_is_of_class_b_alone_is_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call(mdr.Cone(0.3), mdr.Medium(E, hardness=9e9))


def test_other_classes_have_no_limit_of_the_fast_impact():
    hit = mdr.impact(mdr.Paraboloid(1e-5), mdr.Medium(E, hardness=1e9), 1e-9, 1.0)
    assert hit.restitution < 1
    limits = {limit.what: limit for limit in hit.limits}
    assert "fast limit" not in limits
    assert "0.7 times the value of Johnson's law" in limits["flow"].sentence
    assert limits["flow"].level == "note"


def test_smooth_shapes_are_checked_to_be_convex():
    glass = mdr.Medium(E, hardness=1e9)
    with pytest.raises(ValueError, match="set hardness = 0, or take a convex shape"):
        mdr.indent(mdr.Smooth(lambda r: 1 / (1 + r / 1e-6)), glass, 1e-9)
    smooth = mdr.indent(mdr.Smooth(lambda r: r / 1e-5), glass, 1e-8)
    assert smooth.force == approx(mdr.indent(mdr.Paraboloid(1e-5), glass, 1e-8).force, rel=1e-10)


@pytest.mark.parametrize("past", [1e-5, 4e-5, 9e-5])
def test_plastic_work_of_a_paraboloid_just_past_the_onset(past):
    """2E* √R d_y^(5/2) ∫ ρ √(ρ² − ρ) (2ρ − 1) dρ from 1 to r = √(d/d_y), by mpmath for the depth as it is.

    The increase of the plastic depth has 16 digits less those of 1/(r − 1), which is 5 at most.
    """
    R, E, H = 1e-3, 7e10, 9e9
    depth = R * (np.pi * H / (2 * E)) ** 2 * (1 + past) ** 2
    work = mdr.indent(mdr.Paraboloid(R), mdr.Medium(E, hardness=H), depth).plastic_work
    with mpmath.workdps(40):
        onset = mpmath.mpf(R) * (mpmath.pi * mpmath.mpf(H) / (2 * mpmath.mpf(E))) ** 2
        end = mpmath.sqrt(mpmath.mpf(float(depth)) / onset)
        integral = mpmath.quad(lambda r: r * mpmath.sqrt(r * r - r) * (2 * r - 1), [1, end])
        expected = 2 * E * mpmath.sqrt(mpmath.mpf(R)) * onset ** mpmath.mpf("2.5") * integral
    assert work == approx(float(expected), rel=1e-10)
