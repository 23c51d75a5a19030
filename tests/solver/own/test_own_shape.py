"""A shape that is not in the library is solved throughout, from z, g, g′ and its kinks alone."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import quad

import mdr_core as mdr
from mdr_core.solver.profiles.radius_table import OneLength

from ...approx import approx
from ...shapes import name

MEDIUM = mdr.Medium(E_star=1e9, q_c=10.0)
D_C = MEDIUM.critical_depth
MASS, SPEED = 1e-9, 0.1


@dataclass(frozen=True)
class Told(mdr.Profile):
    """A shape of the library, of which no more is told than what a shape must tell."""

    known: mdr.Profile

    face_radius = property(lambda self: self.known.face_radius)
    kinks = property(lambda self: self.known.kinks)

    def height_at(self, r):
        return self.known.height_at(r)

    def reduced_at(self, x):
        return self.known.reduced_at(x)

    def reduced_slope_at(self, x):
        # Infinite at a sharp edge.
        with np.errstate(divide="ignore"):
            return self.known.reduced_slope_at(x)


@dataclass(frozen=True)
class Pencil(mdr.Profile):
    """A cone on top of a paraboloid, z = s r + r²/(2R)."""

    slope: float
    radius: float

    def height_at(self, r):
        return self.slope * r + r**2 / (2 * self.radius)

    def reduced_at(self, x):
        return np.pi / 2 * self.slope * x + x**2 / self.radius

    def reduced_slope_at(self, x):
        return np.pi / 2 * self.slope + 2 * x / self.radius


KNOWN = (
    mdr.Cone(slope=0.3),
    mdr.Paraboloid(radius=1e-5),
    mdr.PowerLaw(coefficient=1e11, exponent=3.0),
    mdr.PowerLaw(coefficient=2e-4, exponent=0.5),
    mdr.Hyperboloid(slope=0.3, tip_radius=1e-6),
    mdr.RoundedCone(tip_radius=1e-6, slope=0.3),
    mdr.TruncatedCone(flat_radius=1e-6, slope=0.3),
    mdr.RoundedPunch(flat_radius=1e-6, edge_radius=1e-5),
)


@pytest.mark.parametrize("known", KNOWN, ids=name)
class TestToldAgain:
    @pytest.mark.parametrize("path", [(0.3,), (3.0,), (3.0, 2.6), (1e3, 1e3 - 0.4)])
    def test_indentation(self, known, path):
        told, exact = (
            mdr.indent(shape, MEDIUM, np.array(path) * D_C)[-1] for shape in (Told(known), known)
        )
        # What is promised for every shape.
        for quantity in ("contact_radius", "plastic_radius", "force", "stored_energy", "plastic_work"):
            assert getattr(told, quantity) == approx(getattr(exact, quantity), rel=1e-12), quantity
        r = np.array([1e-3, 0.3, 0.9, 0.999]) * exact.contact_radius
        np.testing.assert_allclose(told.pressure(r), exact.pressure(r), rtol=1e-10)
        np.testing.assert_allclose(told.surface(r), exact.surface(r), rtol=1e-10)
        force = mdr.indent_to_force(Told(known), MEDIUM, mdr.indent(known, MEDIUM, 3 * D_C).force)
        assert force.depth == approx(3 * D_C, rel=1e-12)

    @pytest.mark.parametrize("share", [0.0, 0.3])
    def test_impact(self, known, share):
        dry = mdr.impact(known, MEDIUM, MASS, SPEED)
        medium = mdr.Medium(MEDIUM.E_star, q_c=MEDIUM.q_c, eta=share * dry.contact_time * MEDIUM.E_star / 4)
        told, exact = (mdr.impact(shape, medium, MASS, SPEED) for shape in (Told(known), known))
        for quantity in ("max_depth", "restitution", "contact_time", "max_force", "plastic_work"):
            # 1e-9 is promised of each.
            assert getattr(told, quantity) == approx(getattr(exact, quantity), rel=2e-9), quantity

    def test_chain(self, known):
        half_width = known.contact_radius(3 * D_C)
        told, exact = (
            mdr.Foundation(shape, MEDIUM, 200, half_width).advance(3 * D_C)
            for shape in (Told(known), known)
        )
        # The elements stand alike, but for the rounding of where kinks are.
        assert told.force == approx(exact.force, rel=1e-12)


class TestPencil:
    shape = Pencil(slope=0.1, radius=1e-6)

    def radius(self, depth):
        """The root of x²/R + (π/2) s x = d."""
        half = np.pi / 4 * self.shape.slope * self.shape.radius
        return depth * self.shape.radius / (half + np.sqrt(half**2 + depth * self.shape.radius))

    @pytest.mark.parametrize("times", [0.3, 1 + 1e-5, 3.0, 100.0])
    def test_force_and_pressure_by_quadrature(self, times):
        state = mdr.indent(self.shape, MEDIUM, times * D_C)
        a, c = (self.radius(d) for d in (state.depth, max(state.depth - D_C, 0.0)))
        assert state.contact_radius == approx(a, rel=1e-14)
        ends = max(state.depth - D_C, 0.0), state.depth
        # Quad's own accuracy.
        force = 2 * MEDIUM.E_star * quad(self.radius, *ends, epsabs=0, epsrel=1e-12)[0]
        assert state.force == approx(force, rel=1e-11)
        r = 0.7 * a

        def punches(t):
            # x = max(r, c) + t² takes out the root at its lower end.
            x = max(r, c) + t * t
            return 2 * t * self.shape.reduced_slope_at(x) / np.sqrt((x - r) * (x + r))

        pressure = (
            MEDIUM.E_star / np.pi * quad(punches, 0, np.sqrt(a - max(r, c)), epsabs=0, epsrel=1e-12)[0]
        )
        assert state.pressure(r) == approx(pressure, rel=1e-10)

    @pytest.mark.slow
    def test_impact_against_the_chain(self):
        medium = mdr.Medium(MEDIUM.E_star, q_c=MEDIUM.q_c, eta=20.0)
        hit = mdr.impact(self.shape, medium, MASS, SPEED)
        chain = mdr.chain_impact(self.shape, medium, MASS, SPEED)
        assert hit.restitution == approx(chain.restitution, abs=chain.error)
        assert hit.max_depth == approx(chain.max_depth, rel=chain.error)
        assert 0.1 < hit.restitution < 0.9


class Capped(Pencil):
    """A pencil whose kink is told: where both halves are as deep."""

    kinks = property(lambda self: (2 * self.radius * (np.pi / 2 * self.slope) ** 2,))


@pytest.mark.few(2)
@pytest.mark.parametrize("eta", [0.0, 3.0])
@pytest.mark.parametrize("kind", [Pencil, Capped], ids=["smooth", "with a kink"])
def test_many_at_once(kind, eta):
    """Arrays of parameters: the impacts of the entries, one by one."""
    slopes, radii, speeds = np.array([0.1, 0.2, 0.3]), np.array([1e-6, 2e-6, 1e-5]), [0.1, 0.2, 0.05]
    medium = mdr.Medium(1e9, q_c=10.0, eta=eta)
    hits = mdr.impact(kind(slopes, radii), medium, MASS, speeds)
    for i, (slope, radius) in enumerate(zip(slopes, radii, strict=True)):
        one = mdr.impact(kind(float(slope), float(radius)), medium, MASS, speeds[i])
        for quantity in ("max_depth", "max_force", "restitution", "contact_time", "plastic_work"):
            # What is promised of times and viscous impacts, which take steps of their own.
            assert getattr(hits, quantity)[i] == approx(getattr(one, quantity), rel=1e-9), quantity


def test_a_shape_that_may_change_is_refused():
    @dataclass
    class Loose(Pencil.__base__):
        slope: float
        height_at = reduced_at = reduced_slope_at = Pencil.height_at

    for use in (
        lambda: mdr.indent(Loose(0.1), MEDIUM, 1e-9),
        lambda: mdr.impact(Loose(0.1), MEDIUM, 1e-9, 0.1),
        lambda: mdr.chain_impact(Loose(0.1), MEDIUM, 1e-9, 0.1),
    ):
        with pytest.raises(TypeError, match=r"Loose .* @dataclass\(frozen=True\)"):
            use()


@dataclass(frozen=True)
class Polygon(mdr.Profile):
    """A generator of straight lines between vertices, g = x Σ Δs arccos(b/x) over the vertices b < x."""

    vertices: tuple[tuple[float, float], ...]

    @property
    def kinks(self):
        return tuple(self.reduced_at(self._radii[1:-1]))

    @property
    def _radii(self):
        return np.array(self.vertices)[:, 0]

    def _changes(self, x):
        """Changes of slope at the vertices, and for each of them arccos(b/x) and its tangent."""
        r, z = np.transpose(self.vertices)
        change = np.diff(np.diff(z) / np.diff(r), prepend=0.0, append=0.0)
        change[-1] = 0.0
        tangent = np.sqrt(np.maximum(np.subtract.outer(x, r), 0.0) * np.add.outer(x, r)) / np.maximum(
            r, 1e-300
        )
        return change, np.arctan(tangent), tangent

    def height_at(self, r):
        return np.interp(r, *np.transpose(self.vertices))

    def reduced_at(self, x):
        change, angle, _ = self._changes(x)
        return x * (angle @ change)

    def reduced_slope_at(self, x):
        change, angle, tangent = self._changes(x)
        # Infinite at a kink.
        with np.errstate(divide="ignore"):
            return (angle + np.where(angle > 0, 1 / tangent, 0.0)) @ change


@pytest.mark.slow
def test_a_polygon_has_a_contact_radius_at_any_depth():
    """The slope of g is infinite at each of 59 kinks, between which a root must not be lost."""
    r = np.linspace(0.0, 2e-3, 61)
    polygon = Polygon(tuple(zip(r.tolist(), (r**2 / 2e-3 + 0.05 * r).tolist(), strict=True)))
    depth = np.append(10 ** np.random.default_rng(1).uniform(-9, -3.2, 2_000), 3.5575617283436532e-06)
    radius = polygon.contact_radius(depth)
    # The rounding of the depth, and of the radius by the slope of g.
    close = 8 * np.finfo(float).eps * (depth + radius * polygon.reduced_slope_at(radius))
    assert np.all(np.abs(polygon.reduced_at(radius) - depth) <= close)
    alone = polygon.contact_radius(3.5575617283436532e-06)
    assert alone == approx(radius[-1], rel=1e-14)


@pytest.mark.parametrize(
    ("former", "name"),
    [
        ("_height", "height_at"),
        ("_reduced", "reduced_at"),
        ("_reduced_slope", "reduced_slope_at"),
        ("_radius", "radius_at"),
    ],
)
def test_a_shape_with_a_former_name_is_told_the_new_one(former, name):
    with pytest.raises(TypeError, match=f"Dull .* {former}, .*: call it {name}"):
        type("Dull", (Pencil,), {former: lambda self, x: x})


def test_an_error_in_a_shape_is_no_limit_of_the_fast_limit():
    """The fast limit presses deeper than the impact; an error of the shape there is nobody's limit."""

    @dataclass(frozen=True)
    class Fails(Pencil):
        end: float = np.inf

        def reduced_at(self, x):
            if np.any(x > self.end):
                raise ValueError("a mistake in the shape")
            return super().reduced_at(x)

    deep = mdr.impact(Pencil(0.3, 1e-5), MEDIUM, MASS, SPEED)
    hit = mdr.impact(Fails(0.3, 1e-5), MEDIUM, MASS, SPEED)
    object.__setattr__(hit.profile, "end", 1.0001 * float(deep.contact_radius))
    with pytest.raises(ValueError, match="a mistake in the shape"):
        _ = hit.limits


class TestNearTheAxis:
    """Of a sharp tip the pressure grows as a logarithm for r → 0, from radii where g is tiny."""

    shape = Pencil(slope=0.1, radius=1e-6)

    @pytest.mark.parametrize("r", [1e-300, 1e-200, 1e-20])
    def test_elastic_stress(self, r):
        state = mdr.indent(self.shape, mdr.Medium(1e9), 2e-8)
        a = state.contact_radius
        # p = (E*/π) ∫ g′(x) dx/√(x² − r²) from r to a; ln(2a/r) is arccosh(a/r) for r ≪ a.
        cone = np.pi / 2 * 0.1 * (np.log(2 * a) - np.log(r))
        expected = 1e9 / np.pi * (cone + 2 / 1e-6 * np.sqrt(a**2 - r**2))
        assert state.pressure(r) == approx(expected, rel=1e-12)
        assert state.stress(r, 0.0).zz == approx(-expected, rel=1e-12)


@dataclass(frozen=True)
class Sharp(OneLength):
    """`Pencil` with one length, as a shape of the library has it: L = s R, H = s² R."""

    __module__ = "mdr_core.solver.profiles.sharp"

    slope: float
    radius: float

    _length = property(lambda self: self.slope * self.radius)
    _depth = property(lambda self: self.slope**2 * self.radius)

    @staticmethod
    def _Z(u):
        return u + u**2 / 2

    @staticmethod
    def _G(u):
        return np.pi / 2 * u + u**2

    @staticmethod
    def _G_slope(u):
        return np.pi / 2 + 2 * u


@pytest.mark.parametrize("share", [1e-280, 1e-12, 1e-3, 1.0, 1e6])
def test_a_sharp_shape_of_one_length(share):
    """Its table begins at the tip, where g is a line: against the same shape without a table."""
    sharp, pencil = Sharp(0.1, 1e-6), Pencil(0.1, 1e-6)
    depth = share * 1e-8
    # 1/(π/4) of the depth at the tip, and the root of the parabola.
    b = np.pi / 2 * 0.1
    expected = 2 * depth / (b + np.sqrt(b**2 + 4 * depth / 1e-6))
    assert sharp.radius_at(np.asarray(depth)) == approx(expected, rel=1e-14)
    if share >= 1e-12:
        force = mdr.indent(sharp, mdr.Medium(1e9), depth).force
        assert force == approx(mdr.indent(pencil, mdr.Medium(1e9), depth).force, rel=1e-12)
