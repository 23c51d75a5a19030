"""Where the model ends, as data; and results that cannot be pieced together from others."""

from dataclasses import dataclass

import numpy as np
import pytest

import mdr_core as mdr

from ..approx import approx
from ..said import limit_of

SOFT = mdr.Medium(1e9, q_c=10.0)


@dataclass(frozen=True)
class PowerLawOfHardness(mdr.HardnessLaw):
    """H (a₀/a)^m, as lists: NumPy takes them for numbers."""

    H: float
    a_0: float
    m: float

    def at(self, a):
        return (self.H * (self.a_0 / a) ** self.m).tolist()

    def rate(self, a):
        return (-self.m * self.H * (self.a_0 / a) ** self.m / a).tolist()


VISCOUS = mdr.Medium(4e6, q_c=200.0, eta=30.0)
CHAIN = mdr.chain_impact(mdr.Paraboloid(2e-3), VISCOUS, 1e-4, 0.5, tolerance=1e-3)


def exceeded(result):
    return {limit.what for limit in result.limits if limit.exceeded}


@pytest.mark.parametrize(
    "result",
    [
        mdr.indent(mdr.Cone(0.2), mdr.Medium(1e9), 1e-9),
        mdr.indent(mdr.Sphere(200e-9), mdr.Medium(1e9), [0.0, 5e-9, 2e-9]),
        mdr.indent(mdr.FlatPunch(1e-6), mdr.Medium(1e9), 1e-9),
        mdr.indent(mdr.TruncatedCone(1e-6, 0.2), SOFT, [0.0, 2e-9]),
        mdr.indent(mdr.ParabolicPunch(1e-5, 1e-6), SOFT, 1e-6),
        mdr.indent(mdr.Smooth(lambda r: r / 1e-5), SOFT, 1e-9),
        mdr.indent(mdr.Sampled([0.0, 1e-6, 2e-6], [0.0, 1e-7, 3e-7]), SOFT, 1e-8),
        mdr.indent(mdr.Cone(0.3), SOFT, []),
        mdr.impact(mdr.Paraboloid(1e-3), mdr.Medium(1e9), 1e-6, 0.1),
        mdr.impact(mdr.Paraboloid(2e-3), mdr.Medium(4e6, eta=30.0), 1e-4, [0.05, 0.5]),
        mdr.indent_in_time(mdr.Cone(0.3), VISCOUS, [0.0, 1e-4], [0.0, 1e-4], tolerance=1e-2),
        CHAIN,
        CHAIN.motion(9),
    ],
    ids=lambda result: f"{type(result).__name__} {result.shape}",
)
def test_a_small_contact_exceeds_nothing(result):
    assert exceeded(result) == set()


def test_numbers_in_other_units_are_noticed():
    """A modulus in GPa, half-angles in radians and depths in µm are taken for what they say, and told."""
    state = mdr.indent(mdr.Cone(0.2), mdr.Medium(95.0, q_c=1e-6), 1e-9)
    assert "E* is 95 Pa: check" in limit_of(state, "modulus").sentence
    assert "modulus" in exceeded(mdr.indent(mdr.Cone(0.2), mdr.Medium(2e13), 1e-9))
    for wrong in (1.0, 3e12):
        state = mdr.indent(mdr.Cone(0.2), mdr.Medium(1e9, hardness=wrong), 1e-9)
        assert "H and E* are given in Pa" in limit_of(state, "hardness").sentence
        assert limit_of(state, "hardness").value == approx(wrong / 1e9)
    # Fused silica; and what is a part of σ_c, or no hardness, has any value.
    for right in (
        mdr.Medium(70e9, hardness=11e9),
        mdr.Medium(1e9, q_c=1e-3, hardness=1.0),
        mdr.Medium(1e9, f_c=1.0),
    ):
        assert not [
            each for each in mdr.indent(mdr.Cone(0.2), right, 1e-9).limits if each.what == "hardness"
        ]
    state = mdr.indent(mdr.Cone.from_half_angle(1.2), SOFT, 1e-9)
    # cot 1.2°.
    assert limit_of(state, "slope").value == approx(47.74, rel=1e-4)
    assert "in degrees, not in radians" in limit_of(state, "slope").sentence
    state = mdr.indent(mdr.Paraboloid(1e-6), SOFT, 5e-6)
    assert "2.24 R" in limit_of(state, "contact radius").sentence
    assert "beyond" in repr(state)


def test_a_printed_fit_says_where_its_model_ends():
    """The tip of an AFM with a half-angle of 25° has a slope of 2.14."""
    tip, depth = mdr.Cone.from_half_angle(25.0), np.linspace(0.0, 60e-9, 100)
    fit = mdr.fit_indentation(tip, depth, mdr.indent(tip, mdr.Medium(1e4), depth).force, q_c=np.inf)
    assert limit_of(fit.path, "slope").value == approx(2.1445, rel=1e-4)
    assert "Slopes reach 2.14 within the contact" in repr(fit)


@pytest.mark.parametrize(
    ("shape", "depth", "slope"),
    [
        (mdr.Cone(0.9), 1e-9, 0.9),
        # a = √(R d), and the slope at the edge is a/R.
        (mdr.Paraboloid(1e-6), 0.25e-6, 0.5),
        (mdr.PowerLaw(2e-4, 0.5), 1e-6, None),
        # Within the flat face there is none, at its edge that of the cone.
        (mdr.FlatPunch(1e-6), 1e-9, 0.0),
        (mdr.TruncatedCone(1e-6, 0.6), 1e-6, 0.6),
        (mdr.Sampled([0.0, 1e-6, 2e-6], [0.0, 1e-7, 9e-7]), 5e-7, 0.8),
        # The wall itself is no slope.
        (mdr.ParabolicPunch(1e-5, 1e-6), 1e-6, 0.1),
    ],
    ids=lambda value: type(value).__name__,
)
def test_slope_within_the_contact(shape, depth, slope):
    state = mdr.indent(shape, mdr.Medium(1e9), depth)
    if slope is None:
        # A cusp is steeper on its way than at the edge: z/a = c/√a.
        slope = 2e-4 / np.sqrt(state.contact_radius)
    # A difference over a millionth of the radius.
    assert limit_of(state, "slope").value == approx(slope, rel=1e-5, abs=1e-12)
    assert limit_of(state, "slope").exceeded == (slope > 0.3)


def test_a_path_goes_as_far_as_its_largest_contact():
    path = mdr.indent(mdr.Paraboloid(1e-6), mdr.Medium(1e9), [0.0, 0.25e-6, 0.01e-6])
    assert limit_of(path, "slope").value == approx(0.5, rel=1e-5)
    assert limit_of(path[2], "slope").value == approx(0.1, rel=1e-5)


def test_degrees_taken_for_a_slope_are_told():
    state = mdr.indent(mdr.Cone(70.3), SOFT, 1e-9)
    assert "tangent" in limit_of(state, "slope").sentence
    assert "in degrees, not in radians" in repr(state)
    assert "from_half_angle" not in repr(mdr.indent(mdr.Cone.from_half_angle(70.3), SOFT, 1e-9))


def test_a_sphere_next_to_its_equator():
    near = mdr.indent(mdr.Sphere(1e-6), mdr.Medium(1e9), 1.5e-6)
    assert limit_of(near, "contact radius").value == approx(near.contact_radius / 1e-6, rel=1e-12)
    assert "half-space approximation is good up to" in limit_of(near, "contact radius").sentence
    # It is steep there, but nobody has taken degrees for a slope.
    deeper = limit_of(mdr.indent(mdr.Sphere(1e-6), mdr.Medium(1e9), 5e-6), "slope")
    assert deeper.value > 3
    assert "from_half_angle" not in deeper.sentence
    assert exceeded(near) == {"slope", "contact radius"}


def test_a_slow_path_says_that_the_dashpots_carry_nothing():
    state = mdr.indent(mdr.Cone(0.3), VISCOUS, 1e-6)
    assert exceeded(state) == {"viscosity"}
    assert "prescribe the path in time" in repr(state)
    assert "τ = 30 µs" in repr(state)
    hit = mdr.impact(mdr.Cone(0.3), VISCOUS, 1e-6, 0.1)
    # States of a motion have their dashpots.
    assert (
        exceeded(hit.turning_point)
        == exceeded(hit.motion(5).states)
        == exceeded(hit.motion(5).states[2])
        == set()
    )


@pytest.mark.parametrize("eta", [0.0, 30.0])
def test_dashpots_are_exact_for_an_incompressible_medium_only(eta):
    medium = mdr.Medium(4e6, eta=eta, poisson=0.4)
    results = (
        mdr.impact(mdr.Paraboloid(2e-3), medium, 1e-4, 0.5),
        mdr.indent_in_time(mdr.Cone(0.3), medium, [0.0, 1e-4], [0.0, 1e-4], tolerance=1e-2),
    )
    for result in results:
        assert exceeded(result) == ({"Poisson ratio"} if eta else set())


def test_the_fast_limit_is_off_by_its_own_estimate():
    """A viscous impact as deep as (24) asks for may be far from it for its viscosity."""
    hit = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0, eta=1e5), 1e-6, 30.0)
    found, fast = limit_of(hit, "fast limit"), hit.fast_limit
    assert found.value == max(abs(fast.max_depth_error), abs(fast.contact_area_error)) > 0.1
    assert found.exceeded
    assert found.concerns == "Eqs. (23), (24)"
    # It is no limit of the result itself.
    assert "(23)" not in repr(hit)
    dry = limit_of(mdr.impact(mdr.Cone(0.3), SOFT, 1e-6, 30.0), "fast limit")
    assert dry.holds
    assert dry.value < 1e-3


def test_a_viscous_impact_of_the_right_depth_is_not_in_the_fast_limit():
    """Depth and area cross those of the limit at some viscosity, which takes much of the energy."""
    medium = mdr.Medium(2.7e6, q_c=4.0, eta=0.518)
    hit = mdr.impact(mdr.Paraboloid(50e-6), medium, 5.5e-10, 1.5)
    found, fast = limit_of(hit, "fast limit"), hit.fast_limit
    assert max(abs(fast.max_depth_error), abs(fast.contact_area_error)) < 0.01
    assert found.exceeded
    assert "viscous work is" in found.sentence


def test_where_nothing_yields_there_is_no_fast_limit():
    hit = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=5.0), 1e-14, 0.003)
    assert hit.max_depth < hit.medium.critical_depth
    assert "fast limit" not in {found.what for found in hit.limits}


def test_the_fast_limit_is_for_the_first_impact():
    hit = mdr.impact(mdr.Cone(0.3), SOFT, 1e-6, 30.0, plastic_depth=1e-9)
    assert "first impact on a virgin surface" in limit_of(hit, "fast limit").sentence
    assert limit_of(hit, "fast limit").exceeded


def test_where_the_fast_limit_is_not_known_it_does_not_hold():
    medium = mdr.Medium(1e9, q_c=10.0, eta=1e5)
    known = mdr.impact(mdr.Cone(0.3), medium, 1e-6, 30.0)
    # The tip ends between the depth that is reached and that of the limit without viscosity.
    r = 0.5 * (known.max_depth + known.fast_limit.max_depth) / (0.15 * np.pi)
    hit = mdr.impact(mdr.Sampled([0.0, r], [0.0, 0.3 * r]), medium, 1e-6, 30.0)
    assert limit_of(hit, "fast limit").value == np.inf
    assert "exceeds the known depth" in limit_of(hit, "fast limit").sentence


@pytest.mark.parametrize("hit", [mdr.impact(mdr.Cone(0.3), SOFT, 1e-6, [1.0, 200.0]), CHAIN])
def test_speed_against_wave_speed(hit):
    found = hit.speed_limit(density=1000.0)
    wave = np.sqrt(hit.medium.E_star / 1000.0)
    assert found.value == approx(np.max(hit.speed) / wave, rel=1e-15)
    assert found.exceeded == (np.max(hit.speed) / wave > 0.1)
    with pytest.raises(ValueError, match="density = -1 kg/m³"):
        hit.speed_limit(-1.0)


@pytest.mark.parametrize(("slope", "level"), [(0.29, "good"), (0.49, "note"), (0.51, "beyond")])
def test_slopes_are_small_to_three_tenths_and_estimates_above_a_half(slope, level):
    assert limit_of(mdr.indent(mdr.Cone(slope), SOFT, 1e-6), "slope").level == level


@pytest.mark.parametrize(("radius", "over"), [(0.49, False), (0.51, True)])
def test_contacts_are_small_to_half_of_the_radius_of_the_body(radius, over):
    """Under a paraboloid a² = R d."""
    state = mdr.indent(mdr.Paraboloid(1e-3), SOFT, 1e-3 * radius**2)
    assert limit_of(state, "contact radius").exceeded == over


class TestCriticalDepthBelowAtoms:
    """π q_c/(2E*) against 0.1 nm; a q_c of 0.3 N/m of steel, as one given in N/mm, has 2.2 pm."""

    def test_a_q_c_in_other_units(self):
        mistaken = mdr.Medium(210e9, q_c=0.3)
        for result in (
            mdr.indent(mdr.Paraboloid(1e-3), mistaken, 1e-6),
            mdr.impact(mdr.Paraboloid(1e-3), mistaken, 1e-6, 0.1),
        ):
            found = limit_of(result, "critical depth")
            assert found.exceeded
            assert found.level == "beyond"
            assert found.value == approx(np.pi * 0.3 / 420e9, rel=1e-12)
            assert "q_c = 0.3 " in found.sentence
            assert found.sentence[:40] in repr(result)

    def test_the_smallest_of_an_ensemble_is_named(self):
        state = mdr.indent(
            mdr.Paraboloid(1e-3), mdr.Medium(210e9, q_c=np.array([[5.0], [1e3]])), [0.0, 1e-6]
        )
        assert "q_c = 5 " in limit_of(state, "critical depth").sentence

    @pytest.mark.parametrize(
        "medium", [mdr.Medium(210e9, q_c=13.4), mdr.Medium(210e9), mdr.Medium(210e9, hardness=2e9)]
    )
    def test_others_have_none(self, medium):
        """13.4 N/m is a hair above the bound, 13.369 N/m."""
        state = mdr.indent(mdr.Paraboloid(1e-3), medium, 1e-6)
        assert "critical depth" not in {found.what for found in state.limits}


def test_a_contact_flows_by_its_hardness_there():
    """a σ_c = H a grows with the contact, and a σ_c = q_c does not, however these are given."""
    constant, sized = PowerLawOfHardness(1e8, 1e-9, 0.0), PowerLawOfHardness(1e8, 1e-9, 1.0)
    ball, cone = mdr.Paraboloid(1e-5), mdr.Cone(0.2)
    for tip in (ball, cone):
        said = [
            "flow" in exceeded(mdr.indent(tip, mdr.Medium(1e9, **given), 1e-8))
            for given in (
                {"hardness": 1e8},
                {"hardness": constant},
                {"hardness": 1e3, "q_c": 10.0},
                {"q_c": 10.0},
                {"hardness": sized},
            )
        ]
        assert said == [True, True, False, False, False]
    assert "2H/3" in limit_of(mdr.indent(ball, mdr.Medium(1e9, hardness=1e8), 1e-8), "flow").sentence
    assert (
        "2H/3" not in limit_of(mdr.indent(ball, mdr.Medium(1e9, hardness=constant), 1e-8), "flow").sentence
    )
    under_cone = limit_of(mdr.indent(cone, mdr.Medium(1e9, hardness=1e8), 1e-8), "flow")
    assert "ball" not in under_cone.sentence
    # d = π s a/2 of an elastic contact, d = s a of one that flows.
    assert under_cone.value == approx((np.pi / 2) ** 2)


def test_limits_of_an_ensemble_are_those_of_its_worst_row():
    """ν = 0.3 is farther from ½, and couples (1 − 2ν)/(2 − 2ν); ν = 0.5 has the larger slip, ν/(4 − 2ν)."""
    medium = mdr.Medium(1e9, eta=[30.0, 60.0], poisson=[0.3, 0.5])
    slow = mdr.Medium(1e9, eta=[[30.0], [60.0]])
    hit = mdr.impact(mdr.Paraboloid(1e-3), medium, 1e-6, 0.1)
    assert limit_of(hit, "Poisson ratio").value == 0.3
    assert "here ν = 0.3" in limit_of(hit, "Poisson ratio").sentence
    assert limit_of(mdr.indent(mdr.Cone(0.3), slow, [1e-9]), "viscosity").value == 4 * 60.0 / 1e9
    assert hit.speed_limit([1000.0, 4000.0]).value == approx(0.1 / np.sqrt(1e9 / 4000.0))
    slid = mdr.oblique_impact(
        mdr.Paraboloid(1e-3), mdr.Medium(1e9, poisson=[0.3, 0.5]), 1e-6, 0.1, 0.05, friction=0.5,
        tangential_mass=1e-6,
    )  # fmt: skip
    assert limit_of(slid, "coupling").value == approx(0.4 / 1.4)
    assert "here ν = 0.3" in limit_of(slid, "coupling").sentence
    assert limit_of(slid, "slip direction").value == approx(0.5 / 3)


def test_motion_begins_exactly_at_first_contact():
    for medium in (SOFT, VISCOUS):
        motion = mdr.impact(mdr.Sphere(1e-3), medium, 1e-6, 0.1).motion(50)
        assert (
            motion.depth[0] == motion.force[0] == motion.contact_radius[0] == motion.viscous_work[0] == 0.0
        )
        assert motion.velocity[0] == 0.1


@pytest.mark.parametrize(
    ("energy", "radius", "says"),
    [
        ([1.0, 2.0], [1.0, 1.4], "insufficient: two energies"),
        ([1.0, 2.0, 2.0], [1.0, 1.4, 1.5], "insufficient"),
        (np.array([1.0, 2.0, 4.0, 8.0]), np.array([1.0, 2.0, 4.0, 8.0]) ** 5.4, "none fits the slope 5.4"),
        ([1.0, 2.0, 4.0], [4.0, 2.1, 1.0], "none fits the slope -"),
        ([1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 1.0, 2.0], "more than one class fits"),
    ],
)
def test_imprints_that_tell_no_class(energy, radius, says):
    found = mdr.hardness_class(energy, radius, exponent=1.0)
    assert found.letter is None
    assert says in found.reason
