"""E* and H by force, stiffness and contact depth, and what remains of the depth."""

import numpy as np

from ...base.remark import MeasurementError, Remark


def moduli(profile, contact_depth, force, stiffness, beta):
    """E* and H (Pa) at contact depths (m); the radius below the tip is that of its face, or 0."""
    a = profile.radius_at_height(np.maximum(contact_depth, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return stiffness / (2 * beta * a), force / (np.pi * a**2)


def remaining(profile, contact_depth, stiffness, hardness, exponent, epsilon):
    """Share of the largest depth that remains after an unloading F = α (h − h_f)^m."""
    force = hardness * np.pi * profile.radius_at_height(contact_depth) ** 2
    return 1 - exponent * force / stiffness / (contact_depth + epsilon * force / stiffness)


def not_from_contact(text):
    """The error of depths and forces that may count from elsewhere."""
    text = f"{text}: depths must count from first contact, and forces from the baseline"
    return MeasurementError(Remark(text, "no unloading"))
