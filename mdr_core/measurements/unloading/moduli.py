"""E* and H by force, stiffness and contact depth, and what remains of the depth."""

import numpy as np

from ...base.remark import MeasurementError, Remark
from ...solver.numerics.roots import increasing_root


def moduli(profile, contact_depth, force, stiffness, beta):
    """E* and H (Pa) at contact depths (m)."""
    a = _radius_at_height(profile, contact_depth)
    with np.errstate(divide="ignore", invalid="ignore"):
        return stiffness / (2 * beta * a), force / (np.pi * a**2)


def remaining(profile, contact_depth, stiffness, hardness, exponent, epsilon):
    """Share of the largest depth that remains after an unloading F = α (h − h_f)^m."""
    force = hardness * np.pi * _radius_at_height(profile, contact_depth) ** 2
    return 1 - exponent * force / stiffness / (contact_depth + epsilon * force / stiffness)


def _radius_at_height(profile, height):
    """Radius (m) of the profile at heights (m): 0 below its tip, infinite where it is not known."""
    known = np.minimum(profile.wall, profile.known_radius)
    # Without a slope the search is by bisection.
    radius = increasing_root(lambda r: (profile.height_at(r), np.inf), height, np.abs(height), known)
    return np.maximum(np.minimum(radius, profile.wall), profile.face_radius)


def not_from_contact(text):
    """The error of depths and forces that may count from elsewhere."""
    text = f"{text}: depths must count from first contact, and forces from the baseline"
    return MeasurementError(Remark(text, "no unloading"))
