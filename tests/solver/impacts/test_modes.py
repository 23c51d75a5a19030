"""Where a plate without edges and a static support end: a simply supported square plate by its modes."""

import numpy as np
import pytest

import mdr_core as mdr

BALL, MEDIUM, MASS, SPEED = mdr.Paraboloid(5e-3), mdr.Medium(10e9), 4.1e-3, 3.0
STIFFNESS = 4 / 3 * 10e9 * 5e-3**0.5
THICKNESS, MODULUS, NU, DENSITY = 4e-3, 50e9, 0.3, 1600.0
BENDING = MODULUS * THICKNESS**3 / 12 / (1 - NU**2)
PLATE = mdr.Structure.plate(THICKNESS, MODULUS, NU, DENSITY)


def by_modes(length, count=41, steps=1000):
    """Restitution, largest force and number of contacts on the middle of a square plate of a length (m).

    Modes of odd numbers have the mass ρh L²/4 each. Over a step the force is the mean of its ends.
    """
    numbers = np.arange(1, count + 1, 2)
    squares = np.add.outer(numbers**2, numbers**2).ravel()
    rate = np.pi**2 * squares / length**2 * PLATE.wave_spread
    mass = DENSITY * THICKNESS * length**2 / 4
    dt = 3.2 * (MASS / (STIFFNESS * np.sqrt(SPEED))) ** 0.4 / steps
    cos, sin = np.cos(rate * dt), np.sin(rate * dt)
    pushed, thrust = (1 - cos) / rate**2 / mass, sin / rate / mass
    shape, pace = np.zeros_like(rate), np.zeros_like(rate)
    way, velocity, force, largest, contacts = 0.0, SPEED, 0.0, 0.0, 0
    for _ in range(60 * steps):
        free = cos * shape + sin / rate * pace
        mean = force
        # The contact is soft over a step: three iterations leave 10⁻⁹.
        for _ in range(3):
            ahead = way + velocity * dt - mean / MASS * dt**2 / 2
            after = STIFFNESS * max(ahead - np.sum(free + pushed * mean), 0.0) ** 1.5
            mean = (force + after) / 2
        pace = -rate * sin * shape + cos * pace + thrust * mean
        shape = free + pushed * mean
        velocity -= mean / MASS * dt
        contacts += after > 0 and force == 0
        way, force = ahead, after
        largest = max(largest, force)
        if force == 0 and velocity < 0 and way < -np.abs(shape).sum():
            break
    return -velocity / SPEED, largest, contacts


@pytest.mark.slow
def test_a_light_ball_does_not_feel_the_edges():
    """A fiftieth of the mass of the plate: the contact ends before a third of the waves' way back."""
    length = np.sqrt(50 * MASS / DENSITY / THICKNESS)
    plate = mdr.Structure.plate(THICKNESS, MODULUS, NU, DENSITY, edge=length / 2)
    hit = mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=plate)
    (edges,) = (limit for limit in hit.limits if limit.what == "edges")
    restitution, force, contacts = by_modes(length)
    assert not edges.exceeded
    assert contacts == 1
    # The claim of the limit, and the modes that are left out.
    assert abs(hit.restitution - restitution) < 0.014
    assert abs(hit.max_force / force - 1) < 0.01


@pytest.mark.slow
def test_a_heavy_ball_feels_the_static_support():
    """As heavy as the plate."""
    length = np.sqrt(MASS / DENSITY / THICKNESS)
    support = mdr.Structure(stiffness=BENDING / (0.0116 * length**2))
    hit = mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=support)
    _, force, _ = by_modes(length)
    assert abs(hit.max_force / force - 1) < 0.01


@pytest.mark.slow
def test_in_between_neither_holds():
    """A fifth of the mass of the plate: the waves come back and lift the ball."""
    length = np.sqrt(5 * MASS / DENSITY / THICKNESS)
    plate = mdr.Structure.plate(THICKNESS, MODULUS, NU, DENSITY, edge=length / 2)
    hit = mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=plate)
    (edges,) = (limit for limit in hit.limits if limit.what == "edges")
    restitution, _, _ = by_modes(length)
    assert edges.exceeded
    assert restitution > hit.restitution + 0.2
    assert restitution < 0.95
