"""The medium: Popov (2015), Eqs. (1), (2), (12), (19)."""

import dataclasses
import math

import pytest

import mdr_core as mdr

from ..approx import approx


def test_eq_1_relaxation_time_is_dashpot_over_spring():
    medium = mdr.Medium(E_star=3e6, eta=12.0)
    spring, dashpot = medium.E_star, 4 * medium.eta
    assert medium.relaxation_time == dashpot / spring


def test_eq_2_compliances_of_two_bodies_add():
    steel, rubber = mdr.Medium.from_bodies(210e9, 0.3), mdr.Medium.from_bodies(2e6, 0.5)
    both = mdr.Medium.from_bodies(210e9, 0.3, 2e6, 0.5)
    # One rounding in each of a few operations.
    assert 1 / both.E_star == approx(1 / steel.E_star + 1 / rubber.E_star, rel=1e-15)


def test_eq_2_incompressible_body_under_a_rigid_indenter():
    assert mdr.Medium.from_bodies(3.0, 0.5).E_star == 4.0


def test_eq_12_and_19_yield_line_load_is_reached_at_the_critical_depth():
    medium = mdr.Medium(E_star=100e9, q_c=7.0)
    assert medium.yield_line_load == math.pi * 7.0 / 2
    assert medium.critical_depth * medium.E_star == approx(medium.yield_line_load, rel=1e-15)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"E_star": 0.0}, "E_star = 0 Pa must be finite and positive"),
        ({"E_star": math.inf}, "E_star = inf"),
        ({"E_star": True}, "E_star must be one real number"),
        ({"E_star": [1e9, -2e9, 0.0]}, r"E_star\[1\] = -2e\+09 Pa must be .* \(and 1 more"),
        ({"E_star": [1e9, 2e9], "q_c": [1.0, 2.0, 3.0]}, r"E_star \(2,\), q_c \(3,\) do not broadcast"),
        ({"E_star": 1e9, "q_c": 0.0}, "q_c = 0 N/m must be positive"),
        ({"E_star": 1e9, "eta": -1.0}, "eta = -1 Pa·s must be finite and not negative"),
        ({"E_star": 1e300, "q_c": 1e-300}, r"E_star = 1e\+300 Pa must lie between 1e-25 and 1e\+25"),
    ],
)
def test_bad_medium_is_refused(arguments, says):
    with pytest.raises(ValueError, match=says):
        mdr.Medium(**arguments)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((1e9, 0.6), "nu1 = 0.6"),
        ((1e9, -1.0), "nu1 = -1"),
        ((-1e9, 0.3), "E1 = -1e"),
        ((1e9, 0.3, 0.0), "E2 = 0"),
        ((math.inf, 0.3), "both infinite"),
    ],
)
def test_bad_bodies_are_refused(arguments, says):
    with pytest.raises(ValueError, match=says):
        mdr.Medium.from_bodies(*arguments)


@pytest.mark.parametrize(
    "make",
    [
        lambda: mdr.Medium(210e9, 0.3),
        lambda: mdr.Medium.from_bodies(210e9, 0.3, 70e9, 0.3, 100.0),
        lambda: mdr.Structure(1e3, math.inf, 2e-3),
    ],
)
def test_what_could_be_taken_for_something_else_is_given_by_name(make):
    """0.3 after E* was q_c in N/m, and no Poisson ratio."""
    with pytest.raises(TypeError, match=r"positional|by name: q_c, eta, poisson|by name: modes"):
        make()


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"eta": [0.0, 1.0]}, r"viscosity eta\[1\] = 1 Pa·s .*; solve these separately"),
        (
            {"hardness": [0.0, 1e8], "q_c": [10.0, 0.0]},
            r"hardness\[1\] = 1e\+08 Pa .*; solve these separately",
        ),
        ({"f_c": 1e-6}, r"yield constant f_c\[0\] = 1e-06 N .* set it or work_of_adhesion to 0"),
    ],
)
def test_what_adhesion_excludes_it_excludes_in_all_entries(given, says):
    """The viscosity of other entries was left out, without a word."""
    with pytest.raises(ValueError, match=says):
        mdr.Medium(1e9, work_of_adhesion=[0.1, 0.0], **given)


def test_poisson_ratio_is_that_of_the_first_body():
    assert mdr.Medium(1e9).poisson == 0.5
    assert mdr.Medium.from_bodies(1e9, 0.3, 2e9, 0.2).poisson == 0.3
    assert mdr.Medium([1e9, 2e9], poisson=[0.1, 0.2]).entries(1).poisson == 0.2
    for bad in (-1.0, 0.51):
        with pytest.raises(ValueError, match=f"Poisson ratio poisson = {bad:g} must lie in −1 < ν ≤ 0.5"):
            mdr.Medium(1e9, poisson=bad)


def test_media_of_arrays_are_compared_and_hashed():
    one, other = mdr.Medium([1e9, 2e9], q_c=1.0), mdr.Medium([1e9, 2e9], q_c=1.0)
    assert one == other
    assert len({one, other, mdr.Medium([1e9, 3e9], q_c=1.0), mdr.Medium(1e9)}) == 3
    assert mdr.Cone([0.1, 0.2]) == mdr.Cone([0.1, 0.2]) != mdr.Cone([0.1, 0.3])
    assert hash(mdr.Cone([0.1, 0.2])) == hash(mdr.Cone([0.1, 0.2])) != hash(mdr.Cone([[0.1, 0.2]]))
    assert mdr.Cone(0.1) != mdr.Paraboloid(0.1)
    assert mdr.Medium(1.0) != 1.0


def test_medium_from_a_hardness():
    medium = mdr.Medium.from_hardness(95e9, 1e9, 100e-9, eta=2.0, poisson=0.4)
    assert medium == mdr.Medium(95e9, q_c=1e9 * 100e-9, eta=2.0, poisson=0.4)
    # Deep below the critical depth the mean pressure at a radius is q_c/a: Popov (2015), Eq. (11).
    state = mdr.indent(mdr.Cone(0.01), medium, 1e4 * medium.critical_depth)
    assert state.mean_pressure * state.contact_radius == approx(medium.q_c, rel=1e-4)
    with pytest.raises(ValueError, match="q_c or f_c and hardness both"):
        mdr.Medium.from_hardness(95e9, 1e9, 100e-9, q_c=3.0)
    with pytest.raises(ValueError, match="hardness = -1 Pa"):
        mdr.Medium.from_hardness(95e9, -1.0, 100e-9)


class TestHardness:
    """σ_c = hardness + q_c/a + f_c/a², of which what is not given is 0."""

    def test_the_sum_at_a_radius(self):
        medium = mdr.Medium(E_star=1e9, q_c=2.0, hardness=3e6, f_c=4e-6)
        assert medium.hardness_at(2e-6) == approx(3e6 + 1e6 + 1e6, rel=1e-15)
        assert mdr.Medium(1e9).hardness_at([1.0, 2.0]).tolist() == [math.inf] * 2
        with pytest.raises(ValueError, match="radius = 0 m must be finite and positive"):
            medium.hardness_at(0.0)

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [
            ({"hardness": -1.0}, "hardness = -1 Pa must be finite and not negative"),
            ({"f_c": math.inf}, "f_c = inf N must be finite"),
            ({"hardness": 0.0}, "q_c = 0 N/m leaves no hardness, because the other constants are 0; give"),
            (
                {"q_c": math.inf, "hardness": 1e9},
                "q_c = inf N/m means that nothing yields, which contradicts a hardness",
            ),
            ({"q_c": [1.0, 0.0], "f_c": [0.0, 0.0]}, r"q_c\[1\] = 0 N/m leaves no hardness"),
        ],
    )
    def test_refusals(self, arguments, says):
        with pytest.raises(ValueError, match=says):
            mdr.Medium(E_star=1e9, **arguments)

    def test_what_determines_class_b_goes_with_no_other_class(self):
        for given in ({"hardness": 1e9}, {"f_c": 1.0}):
            with pytest.raises(ValueError, match=r"and critical_depth .*; give one"):
                mdr.Medium.from_critical_depth(1e9, 1e-9, **given)
        with pytest.raises(ValueError, match=r"q_c or f_c and hardness .*; give one"):
            mdr.Medium.from_hardness(1e9, 1e6, 1e-6, f_c=1.0)

    def test_a_hardness_for_an_elastic_medium_is_refused(self):
        with pytest.raises(ValueError, match="means that nothing yields"):
            dataclasses.replace(mdr.Medium(1e9), hardness=1e6)
