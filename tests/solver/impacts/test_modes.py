"""Where a plate without edges and a static support end: a simply supported square plate by its modes."""

import numpy as np

import mdr_core as mdr

from ...said import limit_of

BALL, MEDIUM, MASS, SPEED = mdr.Paraboloid(5e-3), mdr.Medium(10e9), 4.1e-3, 3.0
THICKNESS, MODULUS, NU, DENSITY = 4e-3, 50e9, 0.3, 1600.0
BENDING = MODULUS * THICKNESS**3 / 12 / (1 - NU**2)
PLATE = mdr.Structure.plate(THICKNESS, MODULUS, NU, DENSITY)


def on_modes(length):
    """The impact on the middle of a simply supported square plate of a length (m), by its modes."""
    plate = mdr.Structure.supported_isotropic_plate(length, length, THICKNESS, MODULUS, NU, DENSITY)
    return mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=plate)


def test_a_light_ball_does_not_feel_the_edges():
    """A fiftieth of the mass of the plate: the contact ends before a third of the waves' way back."""
    length = np.sqrt(50 * MASS / DENSITY / THICKNESS)
    plate = mdr.Structure.plate(THICKNESS, MODULUS, NU, DENSITY, edge=length / 2)
    hit = mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=plate)
    edges = limit_of(hit, "edges")
    exact = on_modes(length)
    assert not edges.exceeded
    assert exact.contacts == 1
    # The claim of the limit, and the modes that are left out.
    assert abs(hit.restitution - exact.restitution) < 0.014
    assert abs(hit.max_force / exact.max_force - 1) < 0.01


def test_a_heavy_ball_feels_the_static_support():
    """As heavy as the plate."""
    length = np.sqrt(MASS / DENSITY / THICKNESS)
    support = mdr.Structure(stiffness=BENDING / (0.0116 * length**2))
    hit = mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=support)
    exact = on_modes(length)
    assert abs(hit.max_force / exact.max_force - 1) < 0.01


def test_in_between_neither_holds():
    """A fifth of the mass of the plate: the waves come back and lift the ball."""
    length = np.sqrt(5 * MASS / DENSITY / THICKNESS)
    plate = mdr.Structure.plate(THICKNESS, MODULUS, NU, DENSITY, edge=length / 2)
    hit = mdr.impact(BALL, MEDIUM, MASS, SPEED, structure=plate)
    edges = limit_of(hit, "edges")
    exact = on_modes(length)
    assert edges.exceeded
    assert exact.restitution > hit.restitution + 0.2
    assert exact.restitution < 0.95
