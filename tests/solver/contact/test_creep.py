"""Creep by its scalar laws: closed forms, another integrator, and the chain as the independent witness."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp, trapezoid

import mdr_core as mdr
from mdr_core.solver.foundation.force_path import chain_creep
from mdr_core.solver.foundation.row import Row

from ...approx import approx
from ...shapes import SHAPES, name

E, TAU = 1e9, 1e-9
ETA = E * TAU / 4
ELASTIC = mdr.Medium(E)
MEDIA = {
    "a": {"hardness": 5e7},
    "b": {"q_c": 1.0},
    "a+b": {"hardness": 3e7, "q_c": 0.5},
    "deep b": {"q_c": 1e-4},
}


def viscous(given):
    return mdr.Medium(E, eta=ETA, **given)


@pytest.mark.parametrize("pace", [1e-9, 1e-3, 1.0, 1e3, 1e9])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_without_yield_the_elastic_force_relaxes_exponentially(shape, pace):
    """τ dφ/dt + φ = F for every shape: a ramp of duration T, and a hold."""
    depth = min(1e-8, 0.5 * shape.known_depth)
    force = float(mdr.indent(shape, ELASTIC, depth).force)
    time = pace * np.array([0.0, 0.5, 1.0, 1.5, 3.0])
    path = mdr.creep(shape, viscous({"q_c": np.inf}), force * np.minimum(time / pace, 1), time * TAU)
    t = time[1:3]
    with np.errstate(under="ignore"):
        # t − 1 + e⁻ᵗ by its series where the difference cancels: its third term is 10⁻¹⁸ of the first.
        ramp = np.where(t < 1e-6, t**2 / 2 - t**3 / 6, t + np.expm1(-t)) / pace
        held = ramp[1] * np.exp(pace - time[3:]) - np.expm1(pace - time[3:])
    expected = force * np.concatenate([ramp, held])
    # Differences of t lose digits at 10⁻³; roots and integrals are good to some units of rounding.
    carried = mdr.indent(shape, ELASTIC, path.depth[1:]).force
    np.testing.assert_allclose(carried, expected, rtol=1e-9)
    assert path.model == "scalar ODE"


class Reference:
    """Cone (n = 1) or paraboloid (n = 2), g = k xⁿ, of hardness H + q_c/a, by formulas of its own."""

    def __init__(self, shape, medium):
        self.n, self.k = (
            (1, np.pi / 2 * shape.slope) if isinstance(shape, mdr.Cone) else (2, 1 / shape.radius)
        )
        self.share, self.hardness, self.q_c = np.pi / 2 / E, float(medium.hardness), float(medium.q_c)

    def radius(self, s):
        # Trial steps of the integrator may be negative.
        return (np.maximum(s, 1e-30) / self.k) ** (1 / self.n)

    def integral(self, s):
        return self.radius(s) * s / (1 + 1 / self.n)

    def plastic(self, d):
        return max(0.0, d - self.share * (self.hardness * self.radius(d) + self.q_c))

    def path(self, area, time):
        """Depths at times in units of τ, the first one under no force: one law after the other."""

        def f(t):
            return np.interp(t, time, area)

        # The start of a sharp contact: y = ∫ f dt.
        begin = 1e-9 * time[1]
        y = area[1] * begin**2 / time[1] / 2
        d = ((1 + 1 / self.n) * self.k ** (1 / self.n) * y) ** (self.n / (self.n + 1))
        depths, state, t, turned = [0.0], d, begin, None
        for stop in time[1:]:
            if turned is None:

                def excess(t, y):
                    return f(t) - self.integral(y[0]) + self.integral(self.plastic(y[0]))

                excess.terminal, excess.direction = True, -1
                falls = f(stop) < f(t)
                if falls and excess(t, [state]) <= 0:
                    turned, edge = self.plastic(state), state
            if turned is None:
                run = solve_ivp(
                    lambda t, y: [excess(t, y) / self.radius(y[0])], (t, stop), [state], "Radau",
                    rtol=1e-11, atol=1e-22, events=excess if falls else None,
                )  # fmt: skip
                t, state = run.t[-1], float(run.y[0, -1])
                if run.status == 1:
                    turned, edge = self.plastic(state), state
            if turned is not None and t < stop:
                # The edge D of the contact follows the force; the indenter follows the edge.
                fall = (f(stop) - f(t)) / (stop - t)
                run = solve_ivp(
                    lambda t, y, fall=fall: [y[1] - y[0], fall / self.radius(y[1])],
                    (t, stop), [state, edge], "Radau", rtol=1e-11, atol=1e-22,
                )  # fmt: skip
                state, edge, t = float(run.y[0, -1]), float(run.y[1, -1]), stop
            depths.append(state)
        return np.array(depths)


@pytest.mark.few(2)
@pytest.mark.parametrize("given", MEDIA.values(), ids=MEDIA)
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Paraboloid(1e-5)], ids=name)
@pytest.mark.parametrize("pace", [1e-2, 1.0, 30.0])
def test_against_another_integrator(shape, given, pace):
    """Ramp, hold, a fall in which the indenter still goes deeper, another fall, a hold."""
    medium = viscous(given)
    slow = mdr.indent(shape, mdr.Medium(E, **given), 1e-8)
    force = float(slow.force) * np.array([0, 1, 1, 0.95, 0.4, 0.4, 0.1])
    time = pace * np.array([0, 1, 2.5, 2.6, 3.0, 4.0, 5.0])
    expected = Reference(shape, medium).path(force / (2 * E), time)
    for tolerance in (1e-2, 1e-4, 1e-8):
        path = mdr.creep(shape, medium, force, time * TAU, tolerance=tolerance)
        deviation = np.max(np.abs(path.depth - expected)) / np.max(expected)
        assert path.error <= tolerance
        # The reference is good to about 10⁻¹⁰.
        assert deviation <= path.error + 3e-10
        assert path.model == "scalar ODE"


def test_a_cone_of_constant_hardness_has_a_slower_exponential():
    """Self-similar: d² relaxes with τ/(κ(2 − κ)) to the slow one, κ = H/(E* s)."""
    kappa, slope, force = 0.2, 0.3, 1e-3
    medium = viscous({"hardness": kappa * slope * E})
    rate = kappa * (2 - kappa)
    time = np.array([0.0, 1e-7, 0.1, 1.0, 10.0, 100.0])
    path = mdr.creep(mdr.Cone(slope), medium, np.where(time > 0, force, 0.0), time * TAU, tolerance=1e-8)
    expected = force * np.pi * slope / (2 * E) / rate * -np.expm1(-rate * (time[2:] - 5e-8))
    # The ramp of 10⁻⁷ τ counts as a step in its middle, to its square.
    np.testing.assert_allclose(path.depth[2:] ** 2, expected, rtol=1e-7)


def test_a_flat_punch_remembers_the_force_exponentially():
    """As long as nothing yields d is F over 2E*b averaged with e^(−t/τ), rises and falls alike."""
    radius = 1e-6
    force = 1e-7 * np.array([0.3, 1.0, 1.0, 0.2, 0.2, 0.9, 0.9, 0.5])
    time = np.array([0.0, 0.5, 1.5, 1.8, 2.5, 3.0, 4.0, 4.5])
    average = [force[0]]
    for f, g, t in zip(force, np.diff(force) / np.diff(time), np.diff(time), strict=False):
        average.append(average[-1] * np.exp(-t) + f * -np.expm1(-t) + g * (t + np.expm1(-t)))
    path = mdr.creep(mdr.FlatPunch(radius), viscous({"hardness": 1e9}), force, time * TAU)
    expected = np.array(average) / (2 * E * radius)
    # Up to the rise closed, afterwards by the chain.
    np.testing.assert_allclose(path.depth[:5], expected[:5], rtol=1e-11)
    np.testing.assert_allclose(path.depth, expected, rtol=0, atol=1e-4 * expected.max())
    assert np.max(np.abs(path.depth - expected)) <= path.error * expected.max()
    assert path.model == "chain"


@pytest.mark.slow
@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("shape", "given"),
    [
        (mdr.Cone(0.3), MEDIA["a"]),
        (mdr.TruncatedCone(2e-7, 0.3), MEDIA["b"]),
        (mdr.Cone(0.3), MEDIA["a+b"]),
    ],
    ids=["a", "b", "a+b"],
)
def test_the_chain_bears_witness_and_goes_on(shape, given):
    """The same path by elements alone, to its own error; it rises again while elements relax."""
    medium, force = viscous(given), float(mdr.indent(shape, mdr.Medium(E, **given), 4e-8).force)
    force = force * np.array([0.3, 1.0, 0.98, 0.2, 0.6, 0.6])
    time = np.array([0.0, 0.5, 4.0, 6.0, 7.0, 9.0]) * TAU
    path = mdr.creep(shape, medium, force, time, tolerance=1e-3)
    chain = chain_creep(shape, medium, force, time, tolerance=1e-3)
    size = np.max(path.depth)
    assert np.max(np.abs(path.depth - chain.depth)) <= (path.error + chain.error) * size
    first = mdr.creep(shape, medium, force[:4], time[:4], tolerance=1e-3)
    assert first.model == "scalar ODE" != path.model
    np.testing.assert_allclose(path[:4].depth, first.depth, rtol=0, atol=2 * first.error * size)
    # The turning point lies between two times.
    assert path.plastic_depth[-1] > path.plastic_depth[2] > 0
    np.testing.assert_allclose(path.plastic_depth, chain.plastic_depth, rtol=0, atol=3e-3 * size)
    total = max(
        np.max(each.stored_energy + each.plastic_work + each.viscous_work) for each in (path, chain)
    )
    for energy in ("stored_energy", "plastic_work", "viscous_work"):
        np.testing.assert_allclose(getattr(path, energy), getattr(chain, energy), rtol=0, atol=3e-3 * total)
    # Springs have the error of the depth over the depth that they recover.
    x = np.linspace(0, 1.2, 61) * np.max(path.contact_radius)
    for i in (1, 3, 5):
        load, other = path[i].line_load(x), chain[i].line_load(x)
        assert trapezoid(np.abs(load - other), x) <= 0.02 * trapezoid(other, x)


def released_path(shape, given):
    force = float(mdr.indent(shape, mdr.Medium(E, **given), 1e-8).force)
    time = np.concatenate([np.linspace(0, 1, 41), np.linspace(1, 2, 41)[1:], np.linspace(2, 3.5, 601)[1:]])
    force = force * np.interp(time, [0, 1, 1.5, 3.0, 3.5], [0, 1, 1, 0.05, 0.05])
    return mdr.creep(shape, viscous(given), force, time * TAU, tolerance=1e-8)


@pytest.mark.parametrize("given", MEDIA.values(), ids=MEDIA)
@pytest.mark.parametrize(
    "shape", [mdr.Cone(0.3), mdr.RoundedCone(1e-6, 0.3), mdr.FlatPunch(1e-7)], ids=name
)
def test_states_agree_in_themselves(shape, given):
    """The line load carries the force; the work of the force is in the energies."""
    path = released_path(shape, given)
    for i in (10, 40, 80, 200, 500, 680):
        x = np.append(
            np.linspace(0, path.contact_radius[i], 4001)[:-1], path.contact_radius[i] * (1 - 1e-12)
        )
        # Trapezia over a kink in the load, or its jump at the rim: the square of 1/4000.
        assert 2 * trapezoid(path[i].line_load(x), x) == approx(path.force[i], rel=1e-6)
    energy = path.stored_energy + path.plastic_work + path.viscous_work
    # Trapezia over steps in which the depth starts as a fractional power of the time.
    work = np.append(0.0, np.cumsum((path.force[1:] + path.force[:-1]) / 2 * np.diff(path.depth)))
    np.testing.assert_allclose(energy, work, rtol=0, atol=2e-3 * work[-1])
    # While it is let go, each step is short and smooth.
    back = np.diff(work - energy)[80:]
    assert np.max(np.abs(np.cumsum(back))) <= 2e-5 * work[-1]
    for rising in (path.plastic_work, path.viscous_work, path.plastic_depth):
        assert np.all(np.diff(rising) >= 0)


@pytest.mark.parametrize("given", [MEDIA["a"], MEDIA["b"]], ids=["a", "b"])
def test_elements_follow_their_law_along_the_depths(given):
    """A row of elements on the same depths: also what is released and relaxes."""
    shape = mdr.Cone(0.3)
    path = released_path(shape, given)
    row = Row.virgin(shape, path.medium, 2000, shape.contact_radius(1.01 * path.depth.max()))
    for depth, dt in zip(path.depth, np.append(np.inf, np.diff(path.time)), strict=True):
        row = row.ramp_to(depth, dt)
    elements = row.elements
    relaxing = ~elements.contact & (elements.elastic > 0)
    assert relaxing.sum() > 100
    # The row moves in straight steps, of which the mean rate releases elements a little late.
    step = np.max(np.abs(np.diff(path.depth[81:])))
    np.testing.assert_allclose(path[-1].elements(elements.x)[1], elements.elastic, rtol=0, atol=3 * step)


@pytest.mark.slow
def test_the_error_covers_the_error():
    """Random histories, shapes and media, against the laws to 10⁻¹⁰."""
    rng = np.random.default_rng(3)
    for _ in range(10):
        shape = SHAPES[rng.integers(len(SHAPES))]
        given = list(MEDIA.values())[rng.integers(len(MEDIA))]
        if "hardness" in given and isinstance(shape, mdr.PowerLaw) and shape.exponent < 1:
            continue
        depth = min(1e-8, 0.2 * shape.known_depth)
        force = float(mdr.indent(shape, mdr.Medium(E, **given), depth).force)
        up, down = np.sort(rng.random(3)), np.sort(rng.random(3))[::-1]
        force = 0.9 * force * np.concatenate([up, [1.0, 1.0], down])
        time = np.cumsum(10.0 ** rng.uniform(-3, 2, force.size)) * TAU
        path, fine = (mdr.creep(shape, viscous(given), force, time, tolerance=t) for t in (1e-3, 1e-10))
        deviation = np.max(np.abs(path.depth - fine.depth)) / np.max(fine.depth)
        assert deviation <= path.error <= 1e-3, (shape, given)


@pytest.mark.parametrize("given", MEDIA.values(), ids=MEDIA)
def test_without_dashpots_it_is_the_slow_path(given):
    medium, force = mdr.Medium(E, **given), 1e-6 * np.array([0.0, 1.0, 0.3, 0.0, 0.7, 2.0])
    path, slow = mdr.creep(mdr.Cone(0.3), medium, force, np.arange(6.0)), None
    slow = mdr.indent_to_force(mdr.Cone(0.3), medium, force)
    for quantity in ("depth", "contact_radius", "plastic_depth", "stored_energy", "plastic_work"):
        np.testing.assert_array_equal(getattr(path, quantity), getattr(slow, quantity))
    assert path.model == "closed form"
    x = np.linspace(0, 2, 9) * slow.contact_radius[1]
    for i in range(6):
        np.testing.assert_allclose(path[i].line_load(x), slow[i].line_load(x), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("given", [{"q_c": np.inf}, *MEDIA.values()])
@pytest.mark.parametrize(
    "shape", [mdr.Cone(0.3), mdr.Paraboloid(1e-6), mdr.TruncatedCone(1e-7, 0.3)], ids=name
)
def test_a_single_time_is_the_state_of_a_slow_path(shape, given):
    """The first force is carried by the springs alone. To rounding of the roots."""
    force = [float(mdr.indent(shape, ELASTIC, 1e-8).force)]
    slow = mdr.indent_to_force(shape, mdr.Medium(E, **given), force)
    state = mdr.creep(shape, viscous(given), force, [0.0])
    assert state.depth == approx(slow.depth, rel=1e-12)
    assert state.plastic_work == approx(slow.plastic_work, rel=1e-9)


def test_times_within_a_long_slow_fall_change_nothing():
    """Of a thousand times τ, in one piece or in many."""
    force, end = 1e-6 * np.array([0.0, 1.0, 0.2]), 1000 * TAU
    between = np.geomspace(2, 999, 30) * TAU
    many = np.interp(between, [TAU, end], force[1:])
    one = mdr.creep(mdr.Cone(0.3), viscous(MEDIA["b"]), force, [0.0, TAU, end])
    all_force, all_time = np.insert(force, 2, many), np.insert([0.0, TAU, end], 2, between)
    several = mdr.creep(mdr.Cone(0.3), viscous(MEDIA["b"]), all_force, all_time)
    assert one.depth[-1] == approx(several.depth[-1], rel=one.error + several.error)
    # The energies of the springs go as the third power of the depth.
    rel = 3 * (one.error + several.error)
    for energy in ("stored_energy", "plastic_work", "viscous_work"):
        assert getattr(one, energy)[-1] == approx(getattr(several, energy)[-1], rel=rel)


def test_a_punch_of_a_metal_flows_beyond_its_hardness():
    """At (F − π b² H)/(8ηb), and stops where the force falls to what the hardness carries."""
    radius, hardness = 1e-6, 1e7
    capacity = np.pi * radius**2 * hardness
    medium, time = viscous({"hardness": hardness}), np.array([0.0, 0.1, 20.0, 21.0, 22.0, 30.0]) * TAU
    path = mdr.creep(mdr.FlatPunch(radius), medium, capacity * np.array([0, 2, 2, 2, 0, 0]), time)
    rate = (path.depth[3] - path.depth[2]) / TAU
    assert rate == approx(capacity / (8 * ETA * radius), rel=1e-6)
    turned = path.depth[3] + capacity / (8 * ETA * radius) * TAU / 4
    # What it recovers is the cap.
    assert path.plastic_depth[-1] == approx(turned - np.pi / 2 * hardness * radius / E, rel=1e-6)
    assert path.depth[-1] == approx(path.plastic_depth[-1], rel=1e-3)


def test_what_it_does_not_compute_is_said():
    time, cone = [0.0, TAU], mdr.Cone(0.3)
    with pytest.raises(ValueError, match=r"f_c above 0: .* indent_in_time"):
        mdr.creep(cone, viscous({"f_c": 1e-6}), [0.0, 1e-6], time)
    with pytest.raises(ValueError, match="not computed with adhesion"):
        mdr.creep(cone, mdr.Medium(E, work_of_adhesion=0.1), [0.0, 1e-6], time)
    tip = mdr.Sampled([0.0, 1e-7, 2e-7], [0.0, 1e-8, 4e-8])
    with pytest.raises(ValueError, match=r"force\[2\] = 0.001 N presses deeper"):
        mdr.creep(tip, viscous(MEDIA["a"]), [0.0, 1e-7, 1e-3], [0.0, TAU, 50 * TAU])
    punch, most = mdr.FlatPunch(1e-6), np.pi * 1e-12 * 5e7
    with pytest.raises(ValueError, match=r"force\[0\] = .* N must be less than the 0.00015708 N"):
        mdr.creep(punch, viscous(MEDIA["a"]), [1.01 * most, most], time)
