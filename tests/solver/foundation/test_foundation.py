"""`Foundation` against the closed forms."""

import math

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.foundation.fronts import force_and_radius
from mdr_core.solver.foundation.row import Row

from ...approx import approx
from ...laws import NixGao
from ...shapes import SHAPES, name

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0)
D_C = MEDIUM.critical_depth
HISTORIES = (
    (0.4 * D_C,),
    (3.0 * D_C,),
    (40.0 * D_C,),
    (3.0 * D_C, 2.6 * D_C),
    (4.0 * D_C, 2.9 * D_C, 5 * D_C),
)
# τ = 1 ns.
VISCOUS = mdr.Medium(E_star=1e9, q_c=1.0, eta=0.25)
TAU = VISCOUS.relaxation_time


def pressed(shape, history, n, medium=MEDIUM):
    """The chain after a history, with edges on the last contact and plastic radius; and the closed form."""
    closed = mdr.indent(shape, medium, history)
    state = closed[-1]
    nodes = (state.contact_radius, state.plastic_radius)
    foundation = mdr.Foundation(shape, medium, n, np.max(closed.contact_radius), nodes=nodes)
    for depth in history:
        foundation = foundation.advance(depth)
    return foundation, state


@pytest.mark.parametrize("history", HISTORIES)
@pytest.mark.parametrize("shape", SHAPES, ids=name)
class TestClosedForm:
    """Infinitely slowly, the chain is the rate-independent solution element by element."""

    def test_line_load_and_states(self, shape, history):
        foundation, state = pressed(shape, history, 400)
        # d − g(x) loses the digits by which the depth exceeds d_c.
        scale = MEDIUM.E_star * max(history)
        np.testing.assert_allclose(
            foundation.line_load, state.line_load(foundation.x), rtol=0, atol=4e-15 * scale
        )
        contact, plastic = (np.abs(foundation.x) < r for r in (state.contact_radius, state.plastic_radius))
        expected = np.where(plastic, "yielded", np.where(contact, "elastic", "free"))
        np.testing.assert_array_equal(foundation.state, expected)
        imprint = np.maximum(state.plastic_depth - shape.reduced(foundation.x), 0.0)
        np.testing.assert_allclose(foundation.plastic, imprint, rtol=0, atol=4e-15 * max(history))

    def test_sums_converge_in_second_order(self, shape, history):
        errors = []
        for n in (200, 400):
            foundation, state = pressed(shape, history, n)
            sums = np.array([foundation.force, foundation.stored_energy, foundation.plastic_work])
            exact = np.array([state.force, state.stored_energy, state.plastic_work])
            errors.append(np.abs(sums - exact) / np.where(exact > 0, exact, 1.0))
        # Halved elements quarter the error; 3.4 allows for a whole number of them in every stretch.
        assert np.all((errors[1] <= errors[0] / 3.4) | (errors[1] < 1e-12))
        # The midpoint rule errs by up to about h², h = 1/100 where a zone has half of the elements.
        assert np.max(errors[1]) < 1e-4


@pytest.mark.parametrize(("medium", "dt"), [(MEDIUM, np.inf), (VISCOUS, TAU)], ids=["slow", "viscous"])
def test_force_with_fronts_from_first_contact_on(medium, dt):
    """For a cone it is exact wherever contact ends: before the first element, and inside each one."""
    cone, d = mdr.Cone(0.3), 0.5 * D_C
    row = Row.virgin(cone, medium, 40, cone.contact_radius(1.1 * d))
    for depth in np.linspace(0.003, 1.0, 400) * d:
        force, radius = force_and_radius(row.advance(depth, dt))
        rate = depth / dt
        expected = (medium.E_star * depth + 8 * medium.eta * rate) * cone.contact_radius(depth)
        # Straight line loads, summed over twenty elements.
        assert force == approx(expected, rel=1e-12, abs=0)
        assert radius == approx(cone.contact_radius(depth), rel=1e-14, abs=0)


def test_force_is_the_sum_over_the_elements():
    foundation, state = pressed(mdr.Cone(0.3), (3 * D_C,), 100)
    assert np.all(np.diff(foundation.x) > 0)
    np.testing.assert_array_equal(foundation.x, -foundation.x[::-1])
    assert np.sum(foundation.width) == approx(2 * foundation.half_width, rel=1e-14)
    # A straight line load, with its kinks on edges: exact.
    assert np.sum(foundation.line_load * foundation.width) == approx(state.force, rel=1e-14)
    assert foundation.force == approx(state.force, rel=1e-14)


@pytest.mark.parametrize("shape", [mdr.FlatPunch(1e-6), mdr.ParabolicPunch(1e-5, 1e-6)], ids=name)
def test_elements_outside_a_wall_stay_free(shape):
    foundation = mdr.Foundation(shape, VISCOUS, 40, 2e-6).advance(5 * D_C, TAU).advance(2 * D_C, TAU)
    outside = np.abs(foundation.x) > 1e-6
    assert np.any(outside)
    assert not np.any(foundation.contact[outside] | (foundation.elastic + foundation.plastic > 0)[outside])
    assert np.isfinite(foundation.force)


@pytest.mark.parametrize("history", [(0.1e-9,), (1e-9,), (3e-9,), (3e-9, 2.97e-9), (3e-9, 1e-9, 3.1e-9)])
@pytest.mark.parametrize("given", [{}, {"q_c": 0.5}, {"hardness": 0.1e9}], ids=["elastic", "q", "H"])
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Sphere(1e-8), mdr.PowerLaw(1e16, 3.0)], ids=name)
def test_a_contact_narrower_than_an_element(shape, given, history):
    """No element of 10 nm has its middle in it: force and energy are those of the profile."""
    medium, row = mdr.Medium(1e9, **given), None
    row = mdr.Foundation(shape, medium, 20, half_width=100e-9)
    for depth in history:
        row = row.advance(depth)
    state = mdr.indent(shape, medium, history)[-1]
    assert 0 < state.contact_radius < row.width[0]
    assert row.force == approx(float(state.force), rel=1e-13)
    assert row.stored_energy == approx(float(state.stored_energy), rel=1e-12)


def test_dashpots_of_a_contact_narrower_than_an_element():
    """2.1 nN of springs and 8ηaḋ of dashpots; on the way out springs are ahead by τḋ."""
    cone, medium = mdr.Cone(0.3), mdr.Medium(1e9, eta=0.25)
    pressed = mdr.Foundation(cone, medium, 20, half_width=100e-9).advance(1e-9, dt=2e-9)
    a = cone.contact_radius(1e-9)
    assert pressed.force == approx(1e9 * a * 1e-9 + 8 * 0.25 * a * 0.5, rel=1e-13)
    assert pressed.advance(1e-9, dt=1e-9).force == approx(1e9 * a * 1e-9, rel=1e-13)
    a = cone.contact_radius(0.8e-9)
    assert pressed.advance(0.9e-9, dt=1e-9).force == approx(1e9 * a * 0.8e-9, rel=1e-13)


def test_a_foundation_does_not_change():
    foundation = mdr.Foundation(mdr.Cone(0.3), MEDIUM, 10, 1e-6)
    before = foundation.force, foundation.line_load.copy()
    deeper = foundation.advance(D_C)
    assert foundation.depth == 0.0
    assert deeper.depth == D_C
    np.testing.assert_array_equal(foundation.line_load, before[1])
    with pytest.raises(ValueError, match="read-only"):
        foundation.line_load[0] = 1.0


def test_unloading_from_a_billion_critical_depths():
    """The elements carry the live depth to rounding; a difference of two depths would lose it."""
    punch, deep = mdr.FlatPunch(1e-6), 1e9 * D_C
    foundation = mdr.Foundation(punch, MEDIUM, 10, 1e-6).advance(deep)
    live = (deep - 0.25 * D_C) - deep + D_C
    back = foundation.advance(deep - 0.25 * D_C)
    assert back.elastic[0] == approx(live, rel=1e-15)
    assert back.line_load[0] == approx(MEDIUM.E_star * live, rel=1e-15)


def test_without_yield_there_is_no_imprint():
    foundation = (
        mdr.Foundation(mdr.Cone(0.3), mdr.Medium(1e9, eta=1.0), 100, 1e-6).advance(1e-7, 1e-9).advance(0.0)
    )
    assert foundation.plastic_work == 0.0
    assert not np.any(foundation.plastic)
    assert foundation.stored_energy == 0.0


def test_bad_arguments_are_refused():
    cone = mdr.Cone(0.3)
    for n, message in (
        (7, "n = 7 must be an even whole number"),
        (0, "n = 0 must be"),
        (2.5, "even whole"),
    ):
        with pytest.raises(ValueError, match=message):
            mdr.Foundation(cone, MEDIUM, n, 1e-6)
    with pytest.raises(ValueError, match=r"half_width = -1 m must be finite and positive"):
        mdr.Foundation(cone, MEDIUM, 10, -1.0)
    with pytest.raises(ValueError, match=r"half_width = 3 m exceeds the known radius .* 2 m"):
        mdr.Foundation(mdr.Sampled([0, 1, 2], [0, 1, 3]), MEDIUM, 10, 3.0)
    with pytest.raises(ValueError, match=r"n = 2 elements are too few for the 3 intervals"):
        mdr.Foundation(mdr.TruncatedCone(1e-6, 0.3), MEDIUM, 2, 3e-6, nodes=[2e-6])
    foundation = mdr.Foundation(cone, MEDIUM, 10, 1e-6)
    with pytest.raises(ValueError, match=r"half_width = 1e-06 m is less than the contact radius"):
        foundation.advance(1e-6)
    with pytest.raises(ValueError, match=r"dt = 0 s must be positive"):
        foundation.advance(1e-9, 0.0)
    with pytest.raises(ValueError, match="depth = nan m must be finite"):
        foundation.advance(math.nan)
    with pytest.raises(TypeError, match="profile must be"):
        mdr.Foundation(0.3, MEDIUM, 10, 1e-6)


def test_two_elements_of_a_constant_hardness():
    """One element on each side, which yields at u_c = π a H/(2E*), with no division by 0."""
    medium = mdr.Medium(1.0, hardness=0.1)
    foundation = mdr.Foundation(mdr.Cone(1.0), medium, 2, half_width=1.0).advance(1.0).advance(1.5)
    a = mdr.Cone(1.0).contact_radius(1.5)
    assert foundation.elastic.max() == approx(np.pi * a * 0.1 / 2, rel=1e-12)


def ledger(foundation, path, dt, steps):
    """∫ F dd over straight moves to depths (m) in a time (s) each, by five Gauss nodes in each step."""
    node, weight = np.polynomial.legendre.leggauss(5)
    work = 0.0
    for end in path:
        travel, time = (end - foundation.depth) / steps, dt / steps
        for _ in range(steps):
            start = foundation.depth
            places = [(start + travel * u, time * u) for u in (1 + node) / 2]
            work += weight @ [foundation.advance(*place).force for place in places] * travel / 2
            foundation = foundation.advance(start + travel, time)
    return work, foundation


@pytest.mark.few(2)
@pytest.mark.parametrize("dt", [np.inf, 2e-9], ids=["slow", "viscous"])
@pytest.mark.parametrize(
    "given", [{"q_c": 0.5}, {"hardness": 0.1e9}, {"f_c": 1e-9}, {"hardness": NixGao(0.05e9, 1e-9)}]
)
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Sphere(1e-8)], ids=name)
def test_the_ledger_of_a_contact_narrower_than_an_element(shape, given, dt):
    """∫ F dd = U + W_p + W_v: a step errs by 10⁻⁴ at the onset, and by 10⁻³ where dashpots begin."""
    medium = mdr.Medium(1e9, eta=0.25, **given)
    virgin = mdr.Foundation(shape, medium, 20, half_width=100e-9)
    work, pressed = ledger(virgin, (3e-9,), dt, 8)
    assert pressed.state[9:11].tolist() == ["yielded", "yielded"]
    assert pressed.contact[9:11].all()
    assert (pressed.viscous_work > 0.3 * work) == (dt < np.inf)
    assert pressed.plastic_work == approx(mdr.indent(shape, medium, 3e-9).plastic_work, rel=1e-12)
    total = pressed.stored_energy + pressed.plastic_work + pressed.viscous_work
    assert total == approx(work, rel=1e-4)
    more, again = ledger(pressed, (1e-9, 3.1e-9), dt, 40)
    total = again.stored_energy + again.plastic_work + again.viscous_work
    assert total == approx(work + more, rel=1e-3)


def test_an_elastic_contact_narrower_than_an_element_is_free_when_it_is_released():
    """What its dashpots have not dissipated yet relaxes by exp(−2t/τ); τ = 1 ns."""
    medium = mdr.Medium(1e9, eta=0.25)
    pressed = mdr.Foundation(mdr.Cone(0.3), medium, 20, half_width=100e-9).advance(1e-9, dt=2e-9)
    assert pressed.state[9:11].tolist() == ["elastic", "elastic"]
    released = pressed.advance(-1e-9, dt=1e-9)
    assert set(released.state) == {"free"}
    later = released.advance(-1e-9, dt=1e-9)
    assert later.stored_energy == approx(released.stored_energy * np.exp(-2), rel=1e-12)
    lost = released.stored_energy - later.stored_energy
    assert later.viscous_work - released.viscous_work == approx(lost, rel=1e-12)
