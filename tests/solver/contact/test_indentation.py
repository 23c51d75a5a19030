"""Indentation: Popov (2015), Eqs. (10)-(22), balance laws, memory, limits."""

import math
import pickle

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, integrate, name

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0)
D_C = MEDIUM.critical_depth
# Sixteen units of rounding: over arrays of other lengths the same sums and functions go through other code,
# each step of which is right to one or a few of them.
ULPS = 16 * np.finfo(float).eps
# Elastic, just yielding, and deep in the plastic range; then partly unloaded.
HISTORIES = ((0.4 * D_C,), (3.0 * D_C,), (40.0 * D_C,), (3.0 * D_C, 2.6 * D_C), (40.0 * D_C, 39.1 * D_C))


def state(shape, history):
    return mdr.indent(shape, MEDIUM, history)[-1]


def breaks(s):
    """Radii of one state at which a field has a kink or a singularity."""
    return sorted({0.0, s.plastic_radius, *(k for k in (0.3e-6, 1e-6) if k < s.contact_radius)})


def test_eq_11_fully_yielded_contact_carries_pi_q_c_a():
    punch = mdr.FlatPunch(radius=2e-6)
    force = mdr.indent(punch, MEDIUM, [D_C, 10 * D_C]).force
    assert force == approx(math.pi * MEDIUM.q_c * 2e-6, rel=1e-15)


class TestCone:
    """The paper's example, Eqs. (13)-(22), in the paper's own form."""

    slope = 0.3
    cone = mdr.Cone(slope)

    def test_eq_16_contact_radius(self):
        assert mdr.indent(self.cone, MEDIUM, D_C).contact_radius == approx(2 * D_C / math.pi / 0.3)

    def test_eq_17_18_line_load(self):
        deep = mdr.indent(self.cone, MEDIUM, 3 * D_C)
        x = np.linspace(0, 1.2 * deep.contact_radius, 41)
        elastic = MEDIUM.E_star * (3 * D_C - math.pi / 2 * self.slope * x)
        expected = np.clip(elastic, 0, math.pi / 2 * MEDIUM.q_c)
        np.testing.assert_allclose(deep.line_load(x), expected, rtol=1e-13, atol=1e-13)

    def test_eq_19_yield_starts_at_the_critical_depth(self):
        just = mdr.indent(self.cone, MEDIUM, [D_C * (1 - 1e-12), D_C * (1 + 1e-12)])
        assert just.plastic_radius[0] == 0.0
        assert 0 < just.plastic_radius[1] < 1e-11 * just.contact_radius[1]

    def test_eq_20_yield_force(self):
        expected = math.pi * MEDIUM.q_c**2 / (2 * MEDIUM.E_star * self.slope)
        assert mdr.indent(self.cone, MEDIUM, D_C).force == approx(expected, rel=1e-15)

    def test_eq_21_plastic_radius(self):
        deep = mdr.indent(self.cone, MEDIUM, 5 * D_C)
        assert deep.plastic_radius == approx(2 * (5 * D_C - D_C) / (math.pi * self.slope), rel=1e-15)
        width = deep.contact_radius - deep.plastic_radius
        assert width == approx(MEDIUM.q_c / (MEDIUM.E_star * self.slope), rel=1e-14)

    def test_eq_22_force_grows_linearly_after_yield(self):
        depth = np.linspace(1, 10, 10) * D_C
        critical = math.pi * MEDIUM.q_c**2 / (2 * MEDIUM.E_star * self.slope)
        expected = critical + 2 * MEDIUM.q_c / self.slope * (depth - D_C)
        np.testing.assert_allclose(mdr.indent(self.cone, MEDIUM, depth).force, expected, rtol=2e-15)

    def test_pressure_closed_form(self):
        """p = (E* s/2)[arccosh(a/r) − arccosh(c/r)]; at the axis (E* s/2) ln(a/c)."""
        deep = mdr.indent(self.cone, MEDIUM, 5 * D_C)
        a, c, factor = deep.contact_radius, deep.plastic_radius, MEDIUM.E_star * self.slope / 2
        r = np.linspace(0.01, 0.99, 30) * a
        expected = factor * (np.arccosh(a / r) - np.arccosh(np.maximum(c / r, 1)))
        np.testing.assert_allclose(deep.pressure(r), expected, rtol=1e-13)
        assert deep.pressure(0.0) == approx(factor * math.log(a / c), rel=1e-14)


@pytest.mark.parametrize("history", HISTORIES)
@pytest.mark.parametrize("shape", SHAPES, ids=name)
class TestBalance:
    """Laws that tie the fields of a state together, for every shape and history."""

    def test_eq_10_pressure_integrates_to_the_force(self, shape, history):
        s = state(shape, history)
        # The adaptive quadrature resolves the logarithms at kinks to about 1e-9.
        force = integrate(
            lambda r: 2 * math.pi * r * s.pressure(r), [*breaks(s), s.contact_radius * (1 - 1e-13)]
        )
        # The cut at the rim leaves out √(2e-13) of a singular one.
        assert force == approx(s.force, rel=2e-6 if s.contact_radius >= shape.wall else 1e-8)

    def test_eq_9_line_load_integrates_to_the_force(self, shape, history):
        s = state(shape, history)
        force = 2 * integrate(s.line_load, [*breaks(s), s.contact_radius * (1 - 1e-15)])
        # d − g(x) keeps 13 digits at 40 d_c, and quad reaches 1e-10.
        assert force == approx(s.force, rel=1e-9)

    def test_stored_energy_is_that_of_the_springs(self, shape, history):
        s = state(shape, history)
        energy = integrate(lambda x: s.line_load(x) ** 2, [*breaks(s), s.contact_radius]) / MEDIUM.E_star
        assert energy == approx(s.stored_energy, rel=1e-9)

    def test_surface_follows_the_indenter_in_contact(self, shape, history):
        s = state(shape, history)
        r = np.linspace(0, 0.999, 23) * s.contact_radius
        expected = s.depth - shape.height(r)
        np.testing.assert_allclose(s.surface(r) + s.imprint(r), expected, rtol=0, atol=1e-12 * s.depth)

    def test_surface_far_away_is_that_of_a_point_load(self, shape, history):
        s = state(shape, history)
        r = 1e4 * s.contact_radius
        # arcsin(a/r) = a/r + O(a³/r³).
        assert s.surface(r) == approx(s.force / (math.pi * MEDIUM.E_star * r), rel=1e-8)

    def test_surface_is_continuous_at_the_contact_edge(self, shape, history):
        s = state(shape, history)
        below, above = s.surface(np.array([1 - 1e-12, 1 + 1e-12]) * s.contact_radius)
        # h has a square-root edge: √(2e-12) of the live depth at most.
        assert above == approx(below, abs=2e-6 * D_C)

    def test_work_of_the_force_is_stored_or_dissipated(self, shape, history):
        path = np.concatenate([[0.0], history])
        gained = integrate(
            lambda d: mdr.indent(shape, MEDIUM, d).force, sorted({0.0, min(D_C, max(path)), max(path)})
        )
        if len(history) > 1:
            gained -= integrate(
                lambda d: mdr.indent(shape, MEDIUM, [history[0], d])[-1].force, history[::-1]
            )
        s = state(shape, history)
        # Balance to quad's accuracy.
        assert gained == approx(s.stored_energy + s.plastic_work, rel=1e-9)

    def test_stiffness_is_the_slope_of_the_force(self, shape, history):
        s, h = state(shape, history), 1e-4 * D_C
        steps = np.array([[*history, s.depth + k * h] for k in (1, 2, 3)]) if len(history) == 1 else None
        if steps is None:
            steps = np.array([[*history, s.depth + k * h] for k in (-1, 1, 2)])
        f = mdr.indent(shape, MEDIUM, steps).force[:, -1]
        forward = (
            (-3 * s.force + 4 * f[0] - f[1]) / (2 * h) if len(history) == 1 else (f[1] - f[0]) / (2 * h)
        )
        # Second-order difference with h = 1e-4 d_c, where a jump by 2E*a/1e4 cannot hide.
        scale = 2 * MEDIUM.E_star * s.contact_radius
        assert forward == approx(s.stiffness, abs=1e-5 * scale)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
class TestMemory:
    def test_reloading_retraces_unloading_and_rejoins_the_first_loading(self, shape):
        peak = 7 * D_C
        down = np.linspace(peak, peak - D_C, 9)
        path = mdr.indent(shape, MEDIUM, np.concatenate([down, down[::-1], [9 * D_C]]))
        np.testing.assert_allclose(path.force[:9], path.force[9:18][::-1], rtol=ULPS)
        assert path.force[-1] == approx(mdr.indent(shape, MEDIUM, 9 * D_C).force, rel=ULPS)

    def test_contact_is_lost_at_the_plastic_depth(self, shape):
        path = mdr.indent(shape, MEDIUM, [4 * D_C, 2.9 * D_C, 1 * D_C, -1e-9])
        np.testing.assert_array_equal(path.force[1:], 0.0)
        np.testing.assert_array_equal(path.contact_radius[1:], 0.0)
        np.testing.assert_array_equal(path.stored_energy[1:], 0.0)
        np.testing.assert_array_equal(path.plastic_depth, path.plastic_depth[0])
        np.testing.assert_allclose(path.plastic_work, path.plastic_work[0], rtol=ULPS)
        assert path[2].pressure(0.0) == path[2].surface(0.0) == path[2].line_load(0.0) == 0.0

    def test_without_yield_the_path_does_not_matter(self, shape):
        depth = np.array([1.0, 5.0, 2.0]) * D_C
        path, single = (
            mdr.indent(shape, mdr.Medium(1e9), depth),
            mdr.indent(shape, mdr.Medium(1e9), 2.0 * D_C),
        )
        assert path.force[-1] == approx(single.force, rel=ULPS)
        assert path.plastic_work[-1] == 0.0

    def test_elastic_curve_is_the_limit_of_large_yield_constant(self, shape):
        elastic, hard = (mdr.indent(shape, mdr.Medium(1e9, q_c=q), 2e-9) for q in (np.inf, 1e9))
        assert hard.force == approx(elastic.force, rel=ULPS)
        assert hard.pressure(1e-8) == approx(elastic.pressure(1e-8), rel=ULPS)


def test_scalars_and_shapes():
    single = mdr.indent(mdr.Cone(0.3), MEDIUM, 2 * D_C)
    for field in ("depth", "force", "contact_radius", "plastic_radius", "plastic_depth", "stored_energy",
                  "plastic_work", "stiffness"):  # fmt: skip
        assert isinstance(getattr(single, field), float), field
        assert getattr(mdr.indent(mdr.Cone(0.3), MEDIUM, [D_C, 2 * D_C]), field).shape == (2,), field
    assert isinstance(single.pressure(0.0), float)
    assert single.pressure(np.zeros((2, 3))).shape == (2, 3)
    assert mdr.indent(mdr.Cone(0.3), MEDIUM, []).force.shape == (0,)
    assert mdr.indent(mdr.Cone(0.3), MEDIUM, [1, 2]).depth.dtype == float


def test_bad_arguments_are_refused():
    with pytest.raises(TypeError, match="profile must be"):
        mdr.indent(0.3, MEDIUM, 1e-9)
    with pytest.raises(TypeError, match="medium must be"):
        mdr.indent(mdr.Cone(0.3), 1e9, 1e-9)
    with pytest.raises(ValueError, match="needs a single state, but this result has shape"):
        mdr.indent(mdr.Cone(0.3), MEDIUM, [D_C, 2 * D_C]).pressure(0.0)
    with pytest.raises(ValueError, match="path"):
        mdr.indent(mdr.Cone(0.3), mdr.Medium([1e9, 2e9]), [1e-9, 2e-9])
    with pytest.raises(ValueError, match="radius r = inf m must be finite"):
        mdr.indent(mdr.Cone(0.3), MEDIUM, D_C).pressure(math.inf)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_live_depth_shorter_than_the_spacing_of_doubles(shape):
    """Unloaded all but completely from far beyond d_c: a flat punch of radius a."""
    deep = min(1e6 * D_C, 1e-5)
    s = mdr.indent(shape, MEDIUM, [deep, np.nextafter(deep - D_C, 1)])[-1]
    a, live = s.contact_radius, s.live_interval.length
    assert live > 0
    assert s.force == approx(2 * MEDIUM.E_star * a * live, rel=1e-9)
    assert s.pressure(0.5 * a) == approx(MEDIUM.E_star / math.pi * live / (a * 0.75**0.5), rel=1e-6)
    assert s.surface(2 * a) == approx(live / 3, rel=1e-6)


def test_results_do_not_change_under_the_hands():
    depth = np.array([D_C, 2 * D_C])
    result = mdr.indent(mdr.Cone(0.3), MEDIUM, depth)
    depth[:] = 0
    assert result.depth[1] == 2 * D_C
    for field in ("depth", "force", "contact_radius", "plastic_depth"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(result, field)[0] = 1.0


@pytest.mark.parametrize("shape", [*SHAPES, mdr.Sampled([0, 1e-6, 1e-3], [0, 1e-7, 1e-3])], ids=name)
def test_results_can_be_pickled(shape):
    result = mdr.indent(shape, MEDIUM, [D_C, 3 * D_C])
    force = result.force
    np.testing.assert_allclose(pickle.loads(pickle.dumps(result)).force, force, rtol=ULPS)


@pytest.mark.parametrize(
    "shape",
    [shape for shape in (*SHAPES, mdr.Sphere(1e-6), mdr.PowerLaw(4e-9, 0.1)) if shape.wall == np.inf],
    ids=str,
)
def test_forces_of_any_size_are_found(shape):
    """Every force of a dense range has its depth, however noisy its last digits are."""
    deepest = 3e-6 if isinstance(shape, mdr.Sphere) else 1e3 * D_C
    force = mdr.indent(shape, MEDIUM, np.geomspace(0.3 * D_C, deepest, 400)[:, None]).force[:, 0]
    # The last ones under a cusp are beyond the bound of forces.
    force = force[force <= 1e25]
    back = mdr.indent_to_force(shape, MEDIUM, force[:, None])
    np.testing.assert_allclose(back.force[:, 0], force, rtol=1e-12)


def test_force_that_no_depth_is_enough_for():
    """Once r⁵⁰ yields, F ∝ d^(1/50): a billion times the force would need 10⁴⁵⁰ times the depth."""
    tip, medium = mdr.PowerLaw(1e294, 50.0), mdr.Medium(1e10, q_c=1e-3)
    force = mdr.indent(tip, medium, 1e-6).force
    assert mdr.indent_to_force(tip, medium, force).depth == approx(1e-6, rel=1e-9)
    with pytest.raises(ValueError, match=r"presses deeper than 1e\+25 m, the largest depth"):
        mdr.indent_to_force(tip, medium, 1e9 * force)


def test_mean_pressure_of_a_cone_is_half_its_slope_times_the_modulus():
    path = mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9), [-1e-9, 0.0, 1e-9, 1e-6])
    # Sneddon: p_m = E* s/2; a few roundings.
    np.testing.assert_allclose(path.mean_pressure, [0.0, 0.0, 0.15e9, 0.15e9], rtol=1e-14)
