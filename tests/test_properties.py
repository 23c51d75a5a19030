"""Laws that hold for every shape, medium and history, tried at random."""

import numpy as np
import pytest

pytest.importorskip("hypothesis")

from hypothesis import given, settings
from hypothesis import strategies as st

import mdr_core as mdr

from .approx import approx
from .shapes import SHAPES

MEDIA = st.builds(
    lambda modulus, ratio: mdr.Medium(10.0**modulus, q_c=10.0 ** (modulus + ratio)),
    st.floats(6, 12),
    st.floats(-10, -8),
)
SHAPE = st.sampled_from(SHAPES)
# Depths in units of d_c; a sphere of 10 µm is not pressed in by more than its radius.
PATHS = st.lists(st.floats(-1, 100), min_size=1, max_size=8)


def path_of(shape, medium, path):
    limit = shape.radius if isinstance(shape, mdr.Sphere) else np.inf
    return np.minimum(np.array(path) * medium.critical_depth, limit)


@settings(max_examples=50, deadline=None)
@given(SHAPE, MEDIA, PATHS)
def test_every_state_is_sound(shape, medium, path):
    result = mdr.indent(shape, medium, path_of(shape, medium, path))
    for quantity in ("force", "contact_radius", "plastic_radius", "plastic_depth", "stored_energy",
                     "plastic_work", "stiffness"):  # fmt: skip
        values = getattr(result, quantity)
        assert np.all(np.isfinite(values)), quantity
        assert np.all(values >= 0), quantity
    assert np.all(np.diff(result.plastic_depth) >= 0)
    assert np.all(np.diff(result.plastic_work) >= 0)
    # Contact outside the plastic zone, and a force that the yielded contact can carry (11).
    touching = result.force > 0
    assert np.all((result.contact_radius >= result.plastic_radius * (1 - 1e-15))[touching])
    assert np.all(result.force <= np.pi * medium.q_c * result.contact_radius * (1 + 1e-14))


@settings(max_examples=50, deadline=None)
@given(SHAPE, MEDIA, st.floats(0.01, 100), st.floats(0, 1), st.floats(1e-9, 1.5))
def test_fields_of_a_state_are_sound(shape, medium, deepest, unloading, where):
    path = path_of(shape, medium, [deepest, deepest - unloading])
    state = mdr.indent(shape, medium, path)[-1]
    r = where * (state.contact_radius or 1e-6)
    assert state.pressure(r) >= 0
    assert 0 <= state.line_load(r) <= medium.yield_line_load * (1 + 1e-15)
    assert 0 <= state.surface(r) <= state.live_interval.length * (1 + 1e-14)
    assert 0 <= state.imprint(r) <= state.plastic_depth * (1 + 1e-14)


@settings(max_examples=50, deadline=None)
@given(SHAPE, MEDIA, PATHS, st.integers(-20, 20))
def test_modulus_scales_the_force(shape, medium, path, power):
    path = path_of(shape, medium, path)
    scaled = mdr.Medium(medium.E_star * 2.0**power, q_c=medium.q_c * 2.0**power)
    force, larger = mdr.indent(shape, medium, path).force, mdr.indent(shape, scaled, path).force
    # A power of two changes no digit, but for the order of sums and for the smallest numbers.
    np.testing.assert_allclose(larger, force * 2.0**power, rtol=4e-15, atol=1e-300)


@settings(max_examples=50, deadline=None)
@given(SHAPE, MEDIA, PATHS)
def test_what_lies_between_peaks_is_forgotten(shape, medium, path):
    """Only the largest depth counts: sorted or not, the last state is the same."""
    path = path_of(shape, medium, path)
    last = mdr.indent(shape, medium, path)[-1]
    short = mdr.indent(shape, medium, [path.max(), path[-1]])[-1]
    assert last.force == approx(short.force, rel=1e-14)
    assert last.stored_energy == approx(short.stored_energy, rel=1e-14)


@settings(max_examples=50, deadline=None)
@given(SHAPE, MEDIA, st.lists(st.floats(1e-3, 0.9), min_size=1, max_size=6))
def test_force_path_is_the_inverse_of_a_depth_path(shape, medium, fractions):
    """Forces up to 0.9 of what a flat face of the shape carries lead to depths of those forces."""
    largest = 0.9 * np.pi * medium.q_c * min(shape.wall, 1e-6)
    force = np.array(fractions) * largest
    states = mdr.indent_to_force(shape, medium, force)
    np.testing.assert_allclose(states.force, force, rtol=1e-13)
    again = mdr.indent(shape, medium, states.depth)
    # Unloaded from far beyond d_c the depth holds the live depth with few digits: 10¹⁵ d_c/d.
    error = 1e-14 * states.depth.max() / states.live_interval.length * force
    assert np.all(np.abs(again.force - force) <= error + 1e-13 * force)


@settings(max_examples=4, deadline=None)
@given(
    st.sampled_from([0, 1, 4, 5]),
    st.floats(0, 3),
    st.floats(-1, 1.5),
    st.floats(-2.0, 2.0),
    st.floats(0.25, 1.0),
)
def test_similarity_of_oblique_impacts(shape, yields, viscosity, psi, share):
    """W and μ enter as W/μ; work is dissipated, and no more of it than there is."""
    medium = mdr.Medium(1e9, q_c=10.0**yields, eta=10.0**viscosity)
    mass, mu = 1e-9, 0.3
    speed = 0.045 * (psi if abs(psi) > 1e-3 else 0.5)
    one, other = (
        mdr.oblique_impact(
            SHAPES[shape],
            medium,
            mass,
            0.1,
            k * speed,
            k * mu,
            tangential_mass=share * mass,
            tolerance=1e-2,
        )
        for k in (1.0, 7.0)
    )
    assert other.tangential_restitution == approx(one.tangential_restitution, abs=1e-9)
    assert other.friction_work == approx(49 * one.friction_work, rel=1e-7)
    assert abs(one.tangential_restitution) <= 1 + one.errors.tangential_restitution
    assert 0 <= one.friction_work <= share * mass * speed**2 / 2 * 1.01
    assert one.max_tangential_force <= mu * one.max_force * (1 + 1e-9)
