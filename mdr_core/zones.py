"""Stretches of a reduced profile between kinks, in coordinates in which they are smooth."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


def root(x, r):
    """√(x² − r²) (m) of two radii without cancellation or underflow, 0 for x < r."""
    return np.sqrt(np.maximum(x - r, 0.0)) * np.sqrt(x + r)


@dataclass(frozen=True)
class Zone:
    """A stretch of the reduced profile between two kinks.

    Behind a kink at x = k a profile is smooth in t = √(x² − k²), not in x. In a zone that ends on
    an equator x = L (a sphere's), it is smooth in t = x/√(1 − x²/L²).

    Parameters
    ----------
    rate : callable
        dg/dt as a function of t (m), vectorised.
    coordinate : callable
        t as a function of depth (m), vectorised: 0 for depths before the zone, √(end² − k²) for
        depths beyond it.
    order : float
        Exponent of the leading power of `rate` at t → 0.
    kink : float
        Radius k (m) where the zone begins; 0 for the zone at the tip.
    scale : float
        Distance from t = 0 (m) of the nearest singularity, on the imaginary axis; infinite for a
        pure power.
    equator : float
        Radius L (m) that x approaches as t grows without bound.
    end : float
        Largest t (m) of the zone.
    """

    rate: Callable
    coordinate: Callable
    order: float
    kink: float = 0.0
    scale: float = np.inf
    equator: float = np.inf
    end: float = np.inf

    def radius(self, t):
        """x (m) at the coordinate t."""
        if self.equator < np.inf:
            return t / np.hypot(1.0, t / self.equator)
        return np.hypot(self.kink, t) if np.ndim(self.kink) or self.kink else t

    def radius_rate(self, t):
        """dx/dt at the coordinate t."""
        if self.equator < np.inf:
            return self.stretch(t) ** -3
        return t / self.radius(t) if self.kink else np.ones_like(t)

    def coordinate_at(self, x):
        """t (m) at the radius x, 0 before the kink; infinite on an equator."""
        if self.equator < np.inf:
            with np.errstate(divide="ignore"):
                return x / np.sqrt(np.maximum(1 - x / self.equator, 0.0) * (1 + x / self.equator))
        return root(x, self.kink)

    def stretch(self, t):
        """√(1 + t²/L²): x² − r² is t² − t_r² over the squares of both stretches."""
        return np.hypot(1.0, t / self.equator) if self.equator < np.inf else 1.0
