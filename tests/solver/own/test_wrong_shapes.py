"""A shape of one's own that is none is refused by all calculations that reach so far, and by no other."""

import re
from dataclasses import dataclass

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx

SLOPE = 0.3
MEDIUM = mdr.Medium(E_star=1e9, q_c=10.0)
VISCOUS = mdr.Medium(E_star=1e9, q_c=10.0, eta=20.0)
MASS, SPEED, DEPTH = 1e-9, 0.1, 1e-7


@dataclass(frozen=True)
class Wrong(mdr.Profile):
    """A cone that is none from about x = 10 nm on, or 50 nm; `fault` says why."""

    fault: str
    slope: float = SLOPE

    def height_at(self, r):
        height = self.slope * r
        return np.where(r > 5e-8, np.nan, height) if self.fault == "z is NaN" else height

    def reduced_at(self, x):
        g = np.pi / 2 * self.slope * x
        return {
            "NaN in a part": np.where((x > 1e-8) & (x < 5e-8), np.nan, g),
            "infinite": np.where(x > 5e-8, np.inf, g),
            "falls for good": np.where(x > 5e-8, 2e-8 * np.exp(-x / 1e-6), g),
            "falls in a part": np.where((x > 1e-8) & (x < 3e-8), 0.3 * g, g),
            "negative at 0": g - 1e-9,
            "positive at 0": g + 1e-9,
        }.get(self.fault, g)

    def reduced_slope_at(self, x):
        slope = np.pi / 2 * self.slope + 0 * x
        return np.where(x > 5e-8, np.nan, slope) if self.fault == "slope is NaN" else slope


@dataclass(frozen=True)
class WrongRadius(Wrong):
    """The cone with a contact radius of its own that is not that of its g."""

    fault: str = "radius"

    def radius_at(self, depth):
        return depth / self.slope


WORDS = {
    "NaN in a part": r"g\(x\) is nan m at x = 1(e-08|\.\d+e-08) m",
    "infinite": r"g\(x\) is inf m at x = 5(e-08|\.\d+e-08) m|m just inside and inf m outside",
    "falls for good": r"g\(x\) does not rise beyond 2\.\d+e-08 m at x = 4\.\d+e-08 m|g\(x\) has fallen to",
    "falls in a part": r"g\(x\) has fallen to .* m at x = 1\.\d+e-08 m",
    "negative at 0": r"g\(x\) is -1e-09 m at x = 0 m",
    "positive at 0": r"g\(x\) is 1e-09 m at x = 0 m",
    "slope is NaN": r"g′\(x\) is nan at x = 5(e-08|\.\d+e-08)",
    "z is NaN": r"z\(r\) is nan m at r = 5(e-08|\.\d+e-08) m",
    "radius": r"the contact radius is .* m at depth = .* m, but g\(x\) is .* m just inside and .* m",
}
CALLS = {
    "indent": lambda shape: mdr.indent(shape, MEDIUM, [0.5 * DEPTH, DEPTH]).force,
    "force": lambda shape: mdr.indent_to_force(shape, MEDIUM, 6e-6).depth,
    "dry impact": lambda shape: mdr.impact(shape, MEDIUM, MASS, SPEED).restitution,
    "viscous impact": lambda shape: mdr.impact(shape, VISCOUS, MASS, SPEED).restitution,
    "chain": lambda shape: mdr.chain_impact(shape, VISCOUS, MASS, SPEED).restitution,
    "path in time": lambda shape: mdr.indent_in_time(shape, VISCOUS, [0.0, DEPTH], [0.0, 1e-6]).force,
    "creep": lambda shape: mdr.creep(shape, VISCOUS, [0.0, 6e-6], [0.0, 1e-6]).depth,
    "adhesion": lambda shape: mdr.indent(shape, mdr.Medium(1e9, work_of_adhesion=1e-3), DEPTH).force,
    "yield": lambda shape: mdr.yield_force(shape, mdr.Medium(1e8, q_c=10.0)),
}


def wrong(fault, **slope):
    return WrongRadius(**slope) if fault == "radius" else Wrong(fault, **slope)


@pytest.mark.few(18)
@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("fault", WORDS)
def test_a_wrong_shape_is_refused_in_words(fault, call):
    with pytest.raises(ValueError, match=WORDS[fault]) as refused:
        CALLS[call](wrong(fault))
    assert "correct" in str(refused.value)


# The long search for a g that is never reached is that of "falls in a part", too.
OF_MANY = [
    pytest.param(
        fault, medium, id=f"{fault}-{name}", marks=[pytest.mark.full] if long and name == "viscous" else []
    )
    for fault in WORDS
    for long in [fault in ("infinite", "falls for good")]
    for name, medium in (("dry", MEDIUM), ("viscous", VISCOUS))
]


@pytest.mark.parametrize(("fault", "medium"), OF_MANY)
def test_one_of_many_is_refused_in_words(fault, medium):
    shapes = wrong(fault, slope=np.array([0.3, 0.4]))
    # The impacts of an ensemble find other radii than those of one profile.
    words = re.sub(r"1\(e-08[^)]*\)|5\(e-08[^)]*\)|[14]\\\.\\d\+e-08", ".*", WORDS[fault])
    with pytest.raises(ValueError, match=words) as refused:
        mdr.impact(shapes, medium, MASS, SPEED)
    assert "correct" in str(refused.value)


def test_an_ensemble_of_ones_own_has_a_constant_hardness():
    """A dataclass whose parameters are arrays has no hash of its own."""
    slopes = np.array([0.3, 0.4])
    own, cones = (mdr.impact(shapes, mdr.Medium(1e9, hardness=1e7), MASS, SPEED)
                  for shapes in (Wrong("none", slopes), mdr.Cone(slopes)))  # fmt: skip
    np.testing.assert_allclose(own.restitution, cones.restitution, rtol=1e-10)  # as promised of each


@pytest.mark.parametrize(
    "fault", ["NaN in a part", "infinite", "slope is NaN", "z is NaN", "falls for good"]
)
def test_a_contact_that_does_not_reach_so_far_is_solved(fault):
    """Below x = 10 nm each of them is the cone of the library."""
    shape, cone = wrong(fault), mdr.Cone(SLOPE)
    depth = cone.reduced(9e-9)
    assert mdr.indent(shape, MEDIUM, depth).force == approx(
        mdr.indent(cone, MEDIUM, depth).force, rel=1e-12
    )
    for medium in (MEDIUM, VISCOUS):
        hits = [mdr.impact(each, medium, 1e-13, 1e-3) for each in (shape, cone)]
        # What is promised of viscous impacts.
        assert hits[0].restitution == approx(hits[1].restitution, rel=1e-9)


def test_a_tip_to_a_radius_is_known_to_the_depth_there():
    @dataclass(frozen=True)
    class Short(Wrong):
        fault: str = "none"
        known_radius = 1e-7

    depth = mdr.Cone(SLOPE).reduced(1e-7)
    assert Short().known_depth == approx(depth, rel=1e-15)
    assert mdr.indent(Short(), MEDIUM, 0.999 * depth).contact_radius == approx(0.999e-7, rel=1e-12)
    with pytest.raises(ValueError, match="deeper than the shape is known"):
        mdr.indent(Short(), MEDIUM, 1.001 * depth)


def test_a_formula_that_is_rounded_at_the_tip_is_a_shape():
    """√(x² + R²) − R is 0, or a multiple of 10⁻¹⁶ R that goes up and down, for x < 10⁻⁸ R."""

    @dataclass(frozen=True)
    class Rounded(Wrong):
        fault: str = "none"
        R: float = 1e-6

        def reduced_at(self, x):
            return np.sqrt(x**2 + self.R**2) - self.R

        def reduced_slope_at(self, x):
            return x / np.sqrt(x**2 + self.R**2)

    radius = mdr.indent(Rounded(), MEDIUM, 1e-7).contact_radius
    # The rounding of 10⁻¹⁶ R in a depth of 0.1 R.
    assert radius == approx(1e-6 * np.sqrt(1.1**2 - 1), rel=1e-14)


@pytest.mark.parametrize("call", ["indent", "dry impact", "viscous impact"])
def test_warnings_of_a_shape_are_seen(call):
    """Those of a solver's own search are not."""

    @dataclass(frozen=True)
    class Careless(Wrong):
        fault: str = "none"

        def reduced_slope_at(self, x):
            return np.where(x < 0, 1 / (0 * x), super().reduced_slope_at(x))

    with pytest.warns(RuntimeWarning, match="divide by zero"):
        seen = CALLS[call](Careless())
    np.testing.assert_allclose(seen, CALLS[call](mdr.Cone(SLOPE)), rtol=1e-9)


@dataclass(frozen=True)
class InPlace(mdr.Profile):
    """A paraboloid that squares its argument in place, or returns a view of it, a cone."""

    radius: float
    squared: bool

    def height_at(self, r):
        return r**2 / (2 * self.radius)

    def reduced_at(self, x):
        if not self.squared:
            return x[...]
        x **= 2
        return x / self.radius

    def reduced_slope_at(self, x):
        return 2 * x / self.radius if self.squared else np.ones_like(x)


def test_a_shape_cannot_change_its_argument():
    with pytest.raises(ValueError, match=r"InPlace\.reduced_at changes its argument in place"):
        mdr.indent(InPlace(1e-6, True), mdr.Medium(1e9), 1e-8)
    with pytest.raises(ValueError, match="slope dz/dr changes its argument in place"):
        mdr.indent(mdr.Smooth(lambda r: np.multiply(r, 2e6, out=r)), mdr.Medium(1e9), 1e-8)
    assert mdr.indent(InPlace(1e-6, False), mdr.Medium(1e9), 1e-8).force == approx(1e9 * 1e-16, rel=1e-12)


@dataclass(frozen=True)
class Dipped(mdr.Profile):
    """A paraboloid whose g has a narrow dip at a share of R."""

    radius: float
    place: float

    def height_at(self, r):
        return r**2 / (2 * self.radius)

    def reduced_at(self, x):
        u = (x / self.radius / self.place - 1) / 0.06
        return x**2 / self.radius * (1 - 0.5 * np.exp(-(u**2)))

    def reduced_slope_at(self, x):
        u = (x / self.radius / self.place - 1) / 0.06
        dip = 0.5 * np.exp(-(u**2))
        x_over_R = x / self.radius
        return 2 * x_over_R * (1 - dip) + x_over_R**2 * dip * 2 * u / (0.06 * self.place)


@pytest.mark.parametrize("place", [0.02, 0.03, 0.05])
def test_each_indenter_is_looked_at_as_closely_as_one(place):
    medium = mdr.Medium(1e9)
    for radius in (1e-6, np.array([1e-6, 1.01e-6])):
        with pytest.raises(ValueError, match="has fallen"):
            mdr.impact(Dipped(radius, place), medium, 1e-12, 0.05)


@dataclass(frozen=True)
class Sampled(Wrong):
    """The cone from a table up to 100 nm; `fault` says what there is beyond."""

    def reduced_at(self, x):
        beyond = {"NaN": np.nan, "the last value": None}[self.fault]
        share = np.interp(x, np.linspace(0.0, 1e-7, 5), np.linspace(0.0, 1e-7, 5), right=beyond)
        return np.pi / 2 * self.slope * share


@pytest.mark.slow
@pytest.mark.few(1)
@pytest.mark.parametrize("fault", ["NaN", "the last value"])
def test_a_table_ends(fault):
    """Up to there it is the cone of the library, and beyond it is refused; so is each of an ensemble."""
    tip, cone, end = Sampled(fault), mdr.Cone(SLOPE), float(mdr.Cone(SLOPE).reduced(1e-7))
    assert tip.known_depth == approx(end, rel=1e-12)
    for solved in (
        lambda shape: mdr.indent(shape, MEDIUM, 0.99 * end).force,
        lambda shape: mdr.indent_to_force(shape, MEDIUM, 2e-6).depth,
        lambda shape: mdr.impact(shape, VISCOUS, 1e-12, 0.02).restitution,
        lambda shape: mdr.chain_impact(shape, VISCOUS, 1e-12, 0.02).restitution,
        lambda shape: mdr.indent(shape, mdr.Medium(1e9, work_of_adhesion=1e-3), 0.9 * end).force,
    ):
        assert solved(tip) == approx(solved(cone), rel=1e-9)
    for call in CALLS.values():
        with pytest.raises(ValueError, match=r"deeper than Sampled is valid, 4\.71.*(nan|does not rise)"):
            call(tip)
    many = Sampled(fault, np.array([SLOPE, 1.1 * SLOPE]))
    with pytest.raises(
        ValueError, match=r"the contact radius is (1e-07|inf) m .* (nan|4\.71\S+) m outside"
    ):
        mdr.impact(many, MEDIUM, MASS, SPEED)
    if fault == "NaN":
        hits, one = (mdr.impact(each, VISCOUS, 1e-12, 0.02) for each in (many, cone))
        assert hits.restitution[0] == approx(one.restitution, rel=1e-9)


def test_a_radius_that_is_wrong_in_a_smaller_contact_alone():
    class Branch(Wrong):
        def radius_at(self, depth):
            radius = depth / (np.pi / 2 * self.slope)
            return np.where(radius < 1e-8, 1.02 * radius, radius)

    for shape in (Branch("none"), Branch("none", np.array([SLOPE, 0.4]))):
        with pytest.raises(ValueError, match=r"the contact radius is .* m at depth = .* radius_at"):
            mdr.impact(shape, MEDIUM, MASS, SPEED)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            lambda g: g[..., None] * np.ones(3),
            r"reduced_at\(\) has the shape \(2, 3\) for radii of shape \(2,\)",
        ),
        (np.sum, "does not rise beyond .* at x = 0 m"),
        (np.negative, "does not rise beyond -?0 m at x = 0 m"),
    ],
    ids=["a matrix", "one value", "downward"],
)
def test_a_function_that_is_no_height_at_each_radius(change, words):
    class Other(Wrong):
        def reduced_at(self, x):
            return change(super().reduced_at(x))

    for call in CALLS.values():
        with pytest.raises(ValueError, match=words):
            call(Other("none"))


def test_behind_a_wall_one_shape_goes_on_as_each_of_many():
    """A post with a conical end, whose wall alone is given."""

    class Post(Wrong):
        wall = 1e-8

    hit, hits = (
        mdr.impact(Post("none", slope), MEDIUM, MASS, SPEED) for slope in (SLOPE, np.array([SLOPE, 0.4]))
    )
    assert hit.contact_radius == 1e-8
    assert hit.max_depth == approx(hits.max_depth[0], rel=1e-9)
