"""Viscous indentation in time: relaxation, rates, cycles with re-contact; against scalar equations."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, trapezoid

import mdr_core as mdr
from mdr_core.solver.foundation import depth_path

from ...approx import approx
from ...shapes import SHAPES, name
from .small_steps import SmallSteps

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0, eta=0.25)
DRY = mdr.Medium(E_star=1e9, q_c=1.0)
ELASTIC = mdr.Medium(E_star=1e9)
D_C, TAU = MEDIUM.critical_depth, MEDIUM.relaxation_time
# Pressed, held, withdrawn and pressed again.
CYCLE = np.array([0, 3, 3, 2.2, 2.7, 2.0, 2.9, 3.5, 3.5]) * D_C


def elastic_force(shape, depth):
    """φ(d), 0 without contact."""
    return mdr.indent(shape, ELASTIC, np.maximum(depth, 0.0)[..., None]).force[..., 0]


@pytest.mark.parametrize("shape", SHAPES, ids=name)
class TestScalarEquations:
    """Without returning contact the force follows from the depth and its rate."""

    def test_loading_and_hold(self, shape):
        """F = φ(d) − φ(d_p) + 8ηa ḋ; at constant depth the dashpots carry nothing."""
        depth = np.array([0, 0.5, 1.5, 4.0, 4.0]) * D_C
        time = np.array([0, 1.0, 1.5, 4.0, 4.1]) * TAU
        result = mdr.indent_in_time(shape, MEDIUM, depth, time)
        rate = np.append(0.0, np.diff(depth) / np.diff(time))
        dry = mdr.indent(shape, DRY, depth)
        expected = dry.force + 8 * MEDIUM.eta * dry.contact_radius * rate
        # The default tolerance.
        np.testing.assert_allclose(result.force, expected, rtol=0, atol=1e-6 * np.max(expected))
        assert result.error <= 1e-6
        np.testing.assert_allclose(result.contact_radius, dry.contact_radius, rtol=1e-9)
        np.testing.assert_allclose(result.plastic_depth, dry.plastic_depth, rtol=0, atol=1e-15 * 4 * D_C)
        np.testing.assert_allclose(result.plastic_radius, dry.plastic_radius, rtol=1e-9)
        for energy in ("stored_energy", "plastic_work"):
            expected = getattr(dry, energy)
            np.testing.assert_allclose(
                getattr(result, energy), expected, rtol=0, atol=1e-6 * np.max(expected)
            )

    def test_unloading(self, shape):
        """F = φ(d + τḋ) − φ(d_p): outside of g = d + τḋ the elements are released."""
        depth = np.append(0.0, np.array([4.0, 3.9, 3.6, 3.4, 3.2, 2.8]) * D_C)
        time = np.append(0.0, 1.0 + np.array([0, 1, 4, 6, 8, 12]) / 4) * TAU
        result = mdr.indent_in_time(shape, MEDIUM, depth, time)
        edge_depth = depth - 0.4 * D_C
        plastic = 3.0 * D_C
        expected = np.where(
            edge_depth > plastic,
            elastic_force(shape, edge_depth) - elastic_force(shape, np.array(plastic)),
            0.0,
        )[2:]
        np.testing.assert_allclose(result.force[2:], expected, rtol=0, atol=1e-6 * np.max(result.force))
        radius = np.where(edge_depth > plastic, shape.contact_radius(np.maximum(edge_depth, 0.0)), 0.0)[2:]
        np.testing.assert_allclose(result.contact_radius[2:], radius, rtol=1e-6)

    def test_slow_paths_are_rate_independent(self, shape):
        result = mdr.indent_in_time(shape, MEDIUM, CYCLE, np.arange(9) * 1e8 * TAU)
        dry = mdr.indent(shape, DRY, CYCLE)
        # τ/T = 1e-8 of the force remains.
        np.testing.assert_allclose(result.force, dry.force, rtol=0, atol=1e-6 * np.max(dry.force))
        np.testing.assert_allclose(result.contact_radius, dry.contact_radius, rtol=1e-6)

    @pytest.mark.parametrize("pace", [0.1, 3.0])
    def test_re_contact_against_fine_elements(self, shape, pace):
        time = np.arange(9) * pace * TAU
        result = mdr.indent_in_time(shape, MEDIUM, CYCLE, time)
        assert result.error <= 1e-6
        foundation = mdr.Foundation(shape, MEDIUM, 20000, shape.contact_radius(CYCLE.max()))
        force = [0.0]
        for depth in CYCLE[1:]:
            foundation = foundation.advance(depth, pace * TAU)
            force.append(foundation.force)
        # Error of whole elements: half an element, 1/20000 of the width, times the jump of the load.
        np.testing.assert_allclose(result.force, force, rtol=0, atol=1e-4 * np.max(force))


def test_an_early_return_has_no_contact():
    """The elements recover to the depth of the returning indenter only after a time of the order of τ."""
    shape, depth = mdr.Paraboloid(1e-5), np.array([0, 4, 4, 3.1, 3.3]) * D_C
    x = np.linspace(0, 1.1, 23) * shape.contact_radius(4 * D_C)
    forces = []
    for wait in (0.3, 2.0, 30.0):
        time = np.array([0, 1, 2, 2.1, 2.1 + wait]) * TAU
        state = mdr.indent_in_time(shape, MEDIUM, depth, time)[-1]
        steps = SmallSteps(MEDIUM, shape.reduced(x)).follow(time, depth, 3000)
        load = steps.load(0.2 * D_C / (wait * TAU))
        # The small steps delay an event by one, at most 4 d_c/3000; next to a front by the whole jump.
        far = np.abs(state.line_load(x) - load) > 3e-3 * MEDIUM.yield_line_load
        assert np.count_nonzero(far) <= 1
        forces.append(state.force)
    assert forces[0] == 0.0
    # Contact returns with the springs at 0.3 d_c; the dashpots' force decreases with the rate.
    assert forces[1] > forces[2] > 0


def test_work_of_the_force_is_the_ledger():
    depth = np.concatenate([np.linspace(a, b, 80) for a, b in itertools.pairwise(CYCLE)])
    depth = depth[np.append(True, np.diff(depth) != 0)]
    result = mdr.indent_in_time(
        mdr.Cone(0.3), MEDIUM, depth, np.arange(len(depth)) * TAU / 80, tolerance=1e-5
    )
    energy = result.stored_energy + result.plastic_work + result.viscous_work
    work = cumulative_trapezoid(result.force, depth, initial=0.0)
    # At a turning point the force is that before it: half the jump times a step, eight times.
    np.testing.assert_allclose(work, energy, rtol=0, atol=3e-2 * energy[-1])


def test_states_and_fields():
    result = mdr.indent_in_time(mdr.Paraboloid(1e-5), MEDIUM, CYCLE, np.arange(9) * TAU)
    state = result[1]
    assert len(result) == 9
    assert isinstance(state.force, float)
    assert state.force == result.force[1]
    held = result[2]
    dry = mdr.indent(mdr.Paraboloid(1e-5), DRY, CYCLE[2])
    x = np.linspace(0, 1.2 * dry.contact_radius, 30)
    np.testing.assert_allclose(held.line_load(x), dry.line_load(x), rtol=0, atol=1e-14 * 3 * D_C * 1e9)
    # While pressing, the dashpots add 4ηḋ everywhere in contact.
    jump = 4 * MEDIUM.eta * 3 * D_C / TAU
    expected = np.where(x < dry.contact_radius, dry.line_load(x) + jump, 0.0)
    np.testing.assert_allclose(state.line_load(x), expected, rtol=1e-12)
    r = np.linspace(0, 0.95, 20) * dry.contact_radius
    # 4000 straight pieces of a smooth line load.
    np.testing.assert_allclose(held.pressure(r), dry.pressure(r), rtol=2e-4)
    # r = a sin θ removes the root at the rim; 2000 midpoints are of second order.
    angle = (np.arange(2000) + 0.5) * math.pi / 4000
    r = state.contact_radius * np.sin(angle)
    ring = 2 * math.pi * r * state.contact_radius * np.cos(angle) * math.pi / 4000
    assert state.pressure(r) @ ring == approx(state.force, rel=1e-4)


def test_depths_of_a_million_critical_depths_and_negative_ones():
    cone = mdr.Cone(0.3)
    depth = np.array([-1.0, 1e6, 1e6 - 0.5, -1.0, 1e6]) * D_C
    result = mdr.indent_in_time(cone, MEDIUM, depth, np.arange(5) * 1e9 * TAU)
    dry = mdr.indent(cone, DRY, depth)
    # τḋ = 1e-3 d_c, of which the dashpots make 8ηaḋ next to 2E* d_c a.
    np.testing.assert_allclose(result.force[[0, 1, 3, 4]], dry.force[[0, 1, 3, 4]], rtol=2e-3)
    assert result.force[3] == result.contact_radius[3] == 0.0


def test_bad_arguments_are_refused():
    cone = mdr.Cone(0.3)
    with pytest.raises(ValueError, match=r"time\[2\] = 1 s does not increase; drop repeated times"):
        mdr.indent_in_time(cone, MEDIUM, [0, 1e-9, 2e-9], [0, 1, 1])
    with pytest.raises(ValueError, match=r"time of shape \(2,\) and depth of shape \(3,\) must be"):
        mdr.indent_in_time(cone, MEDIUM, [0, 1e-9, 2e-9], [0, 1])
    with pytest.raises(ValueError, match="tolerance = 0 must be"):
        mdr.indent_in_time(cone, MEDIUM, [0, 1e-9], [0, 1], tolerance=0.0)
    with pytest.raises(ValueError, match="needs a single instant, but this result has shape"):
        mdr.indent_in_time(cone, MEDIUM, [0, 1e-9], [0, 1]).pressure(0.0)


def test_elements_of_all_states_sum_to_force_and_energy():
    """F = 2 ∫ q dx and U = E* ∫ u² dx of every state, along a path with release and returning contact."""
    shape = mdr.Paraboloid(radius=1e-3)
    time = np.arange(len(CYCLE)) * 0.7 * TAU
    result = mdr.indent_in_time(shape, MEDIUM, CYCLE, time, tolerance=1e-5)
    x = np.linspace(0, 1.1 * result.contact_radius.max(), 20_001)
    load, elastic = result.elements(x)
    assert load.shape == (len(CYCLE), len(x))
    # The rule's error where the load ends with a jump is that of half a step: 3·10⁻⁵.
    force, energy = 2 * trapezoid(load, x), MEDIUM.E_star * trapezoid(elastic**2, x)
    np.testing.assert_allclose(force, result.force, rtol=0, atol=1e-4 * result.force.max())
    np.testing.assert_allclose(energy, result.stored_energy, rtol=0, atol=1e-4 * result.stored_energy.max())
    single = [float(value) for value in result[4].elements(x[7])]
    np.testing.assert_allclose(single, [load[4, 7], elastic[4, 7]], rtol=1e-12)


def test_the_error_is_that_of_the_least_known_of_force_and_energies(monkeypatch):
    """Of two runs, whose energies are known ten times worse than the force."""
    shape, time = mdr.Paraboloid(1e-6), np.arange(CYCLE.size) * TAU
    fine = mdr.indent_in_time(shape, MEDIUM, CYCLE, time)
    monkeypatch.setattr(depth_path, "_MAX_ELEMENT_STEPS", 2 * depth_path._ELEMENTS * CYCLE.size)
    coarse = mdr.indent_in_time(shape, MEDIUM, CYCLE, time, tolerance=1e-12)
    assert coarse.error < 1e-3
    for quantity in ("force", "stored_energy", "plastic_work", "viscous_work"):
        exact = getattr(fine, quantity)
        miss = np.max(np.abs(getattr(coarse, quantity) - exact)) / np.max(exact)
        assert miss <= coarse.error + fine.error, quantity
