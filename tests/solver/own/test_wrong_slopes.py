"""A shape of one's own whose g′ is not the derivative of its g is refused; tables and kinks are not."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, PchipInterpolator

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, name
from .test_own_shape import Pencil, Polygon, Told
from .test_wrong_shapes import CALLS, MASS, MEDIUM, SPEED

SLOPE, RADIUS = 0.3, 1e-6


#: Mistakes in g′ of a pencil at radii x.
MISTAKES = {
    "z′ instead of g′": lambda shape, x: shape.slope + x / shape.radius,
    "twice": lambda shape, x: 2 * Pencil.reduced_slope_at(shape, x),
    "half": lambda shape, x: Pencil.reduced_slope_at(shape, x) / 2,
    "negative": lambda shape, x: -Pencil.reduced_slope_at(shape, x),
    "zero": lambda shape, x: 0 * x,
    "g instead of g′": lambda shape, x: shape.reduced_at(x),
    "as if x were in micrometres": lambda shape, x: 1e-6 * Pencil.reduced_slope_at(shape, x),
    "without the paraboloid": lambda shape, x: np.pi / 2 * shape.slope + 0 * x,
}


@dataclass(frozen=True)
class WrongPencil(Pencil):
    """A pencil with a mistake in g′."""

    mistake: str

    def reduced_slope_at(self, x):
        return MISTAKES[self.mistake](self, x)


def wrong(mistake, share=1.0):
    """A wrong pencil; that without its paraboloid is nearly one."""
    slope = 1e-3 if mistake == "without the paraboloid" else SLOPE
    return WrongPencil(share * slope, RADIUS, mistake)


WORDS = r"g′\(x\) is .* at x = .* m, but g\(x\) rises with the slope .*correct"


@pytest.mark.few(16)
@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_wrong_slope_is_refused_in_words(mistake, call):
    with pytest.raises(ValueError, match=WORDS):
        CALLS[call](wrong(mistake))


@pytest.mark.parametrize("eta", [0.0, 20.0])
@pytest.mark.parametrize("mistake", MISTAKES)
def test_one_of_many_is_refused(mistake, eta):
    with pytest.raises(ValueError, match=WORDS):
        mdr.impact(wrong(mistake, np.array([1.0, 1.1])), mdr.Medium(1e9, q_c=10.0, eta=eta), MASS, SPEED)


def test_what_is_said_is_the_slope_there():
    with pytest.raises(ValueError, match="g′") as refused:
        mdr.indent(wrong("twice"), MEDIUM, 1e-7)
    given, x, slope = (float(part) for part in _numbers(str(refused.value)))
    exact = Pencil(SLOPE, RADIUS).reduced_slope_at(x)
    # Six digits are shown; the slope of g is that in the middle of a step of 1 %.
    assert given == approx(2 * exact, rel=1e-5)
    assert slope == approx(exact, rel=1e-2)


def _numbers(text):
    text = text.partition("g′(x) is ")[2].partition(" there")[0]
    return [part for part in text.split() if part[0].isdigit()]


@dataclass(frozen=True)
class Table(mdr.Profile):
    """A shape from samples of g; `kind` says how g and g′ are interpolated."""

    kind: str
    power: float
    count: int
    cell: float = 1e-7
    height: float = 1e-8

    @property
    def known_radius(self):
        return self.count * self.cell

    def exact(self, x):
        return self.height * (x / self.cell) ** self.power

    def exact_slope(self, x):
        return self.power * self.exact(x) / np.where(x > 0, x, np.inf)

    @property
    def nodes(self):
        return self.cell * np.arange(self.count + 1)

    def height_at(self, r):
        return self.reduced_at(r) / 2

    def reduced_at(self, x):
        nodes = self.nodes
        g = self.exact(nodes)
        if self.kind == "single precision":
            g = g.astype(np.float32)
        if self.kind == "two digits":
            g = np.array([float(f"{each:.1e}") for each in g])
        if self.kind in ("cubic", "monotone"):
            return (CubicSpline if self.kind == "cubic" else PchipInterpolator)(nodes, g)(x)
        return self.exact(x) if self.kind in ("nearest", "steps") else np.interp(x, nodes, g)

    def reduced_slope_at(self, x):
        nodes = self.nodes
        g = self.exact(nodes)
        if self.kind in ("cubic", "monotone"):
            return (CubicSpline if self.kind == "cubic" else PchipInterpolator)(nodes, g)(x, 1)
        if self.kind == "exact slope":
            return self.exact_slope(x)
        if self.kind == "nearest":
            return self.exact_slope(nodes[np.rint(x / self.cell).astype(int).clip(0, self.count)])
        if self.kind == "steps":
            return np.diff(g)[np.minimum(x // self.cell, self.count - 1).astype(int)] / self.cell
        return np.interp(x, nodes, np.gradient(g, nodes))


KINDS = (
    "differences", "single precision", "two digits", "exact slope", "nearest", "steps", "cubic", "monotone",
)  # fmt: skip


@pytest.mark.few(16)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("power", [1.0, 1.5, 2.0, 3.0])
@pytest.mark.parametrize("count", [4, 12, 200])
def test_a_table_is_a_shape(kind, power, count):
    """However coarse it is, and in whichever way its slope is found."""
    table = Table(kind, power, count)
    for cells in (1.0, 1.5, 2.5, 0.999 * count):
        depth = float(table.reduced_at(np.array([cells * table.cell]))[0])
        assert mdr.indent(table, mdr.Medium(1e9), depth).force > 0


class Named(Told):
    """A shape of the library, with all names that a shape may give but its contact radius."""

    wall = property(lambda self: self.known.wall)
    known_depth = property(lambda self: self.known.known_depth)
    known_radius = property(lambda self: self.known.known_radius)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
@pytest.mark.parametrize("share", [1e-3, 0.03, 1.0, 30.0])
def test_each_shape_of_the_library_has_its_slope(shape, share):
    """On a flat face, at an edge and a kink, before a wall."""
    told, exact = (mdr.indent(each, MEDIUM, share * 1e-7).force for each in (Named(shape), shape))
    assert told == approx(exact, rel=1e-12)  # is promised of every shape


@dataclass(frozen=True)
class Terraces(mdr.Profile):
    """A cone with steps: g jumps by `jump` (m) at each multiple of a radius (m)."""

    jump: float
    width: float

    def height_at(self, r):
        return self.reduced_at(r)

    def reduced_at(self, x):
        return 0.1 * x + self.jump * np.floor(x / self.width)

    def reduced_slope_at(self, x):
        return 0.1 + 0 * x


@pytest.mark.parametrize("width", [1e-8, 3e-8, 2e-7])
@pytest.mark.parametrize("steep", [0.1, 1.0])
def test_kinks_and_jumps_are_no_mistake(width, steep):
    radii = width * np.arange(40)
    polygon = Polygon(tuple(zip(radii.tolist(), (radii**2 / (2 * width)).tolist(), strict=True)))
    for shape in (polygon, Terraces(steep * width, width)):
        for radius in (0.7 * width, 5.3 * width, 20.2 * width):
            depth = float(shape.reduced_at(np.array([radius]))[0])
            assert mdr.indent(shape, mdr.Medium(1e9), depth).contact_radius == approx(radius, rel=1e-9)


def test_a_contact_that_does_not_reach_so_far_is_solved():
    """g′ is wrong beyond 100 nm alone."""

    class Beyond(Pencil):
        def reduced_slope_at(self, x):
            return np.where(x > 1e-7, 5.0, 1.0) * super().reduced_slope_at(x)

    shape, right = Beyond(SLOPE, RADIUS), Pencil(SLOPE, RADIUS)
    depth = float(right.reduced(0.9e-7))
    # 1e-12 is promised of every shape.
    assert mdr.indent(shape, MEDIUM, depth).force == approx(
        mdr.indent(right, MEDIUM, depth).force, rel=1e-12
    )
    with pytest.raises(ValueError, match=WORDS):
        mdr.indent(shape, MEDIUM, float(right.reduced(1e-6)))
