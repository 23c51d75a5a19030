"""The indenters that the tests run over: every shape, in micrometres and of moderate slope."""

import itertools
import math

import numpy as np
from scipy.integrate import quad

import mdr_core as mdr

POWER_LAWS = (
    mdr.Cone(slope=0.3),
    mdr.Paraboloid(radius=1e-5),
    mdr.PowerLaw(coefficient=2e-4, exponent=0.5),
    mdr.PowerLaw(coefficient=1e11, exponent=3.0),
)
SHAPES = (
    *POWER_LAWS,
    mdr.FlatPunch(radius=1e-6),
    mdr.Sphere(radius=1e-5),
    mdr.Hyperboloid(slope=0.3, tip_radius=1e-6),
    mdr.RoundedCone(tip_radius=1e-6, slope=0.3),
    mdr.ParabolicPunch(radius=1e-5, cylinder_radius=1e-6),
    mdr.TruncatedCone(flat_radius=1e-6, slope=0.3),
    mdr.TruncatedParaboloid(flat_radius=1e-6, radius=1e-5),
    mdr.RoundedPunch(flat_radius=1e-6, edge_radius=1e-5),
)


def name(value):
    """Test id of a shape."""
    return type(value).__name__ + (f"{value.exponent:g}" if isinstance(value, mdr.PowerLaw) else "")


def integrate(function, breaks):
    """∫ over [breaks[0], breaks[-1]], where every break may carry a square root."""
    total = 0.0
    for low, high in itertools.pairwise(b for b in breaks if b <= breaks[-1]):
        middle, half = (low + high) / 2, (high - low) / 2

        def unfolded(s, low=low, high=high, middle=middle, half=half):
            x = middle + half * math.sin(s)
            # A node that rounds to an end has no weight, but may have an infinite value.
            return function(x) * half * math.cos(s) if low < x < high else 0.0

        total += quad(unfolded, -math.pi / 2, math.pi / 2, limit=200, epsabs=0, epsrel=1e-9)[0]
    return total


def lower_hull(r, z):
    """Radii and heights of the convex polygon below samples."""
    hull = []
    for point in np.column_stack([r, z]):
        while len(hull) > 1:
            (r1, z1), (r2, z2) = hull[-1] - hull[-2], point - hull[-1]
            if r1 * z2 >= z1 * r2:
                break
            hull.pop()
        hull.append(point)
    return np.transpose(hull)
