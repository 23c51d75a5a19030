"""Indenter shapes with a flat face: truncated cone and paraboloid, punch with a rounded edge.

In the coordinate τ = √(x² − b²)/b behind the edge of the face, arccos(b/x) = arctan τ.
"""

from dataclasses import dataclass

import numpy as np

from . import _check
from .inverse import arctan_gap, newton
from .profiles import Profile
from .zones import Zone


class _FlatFaced(Profile):
    """A shape with a flat face of radius `flat_radius`, then one smooth zone."""

    #: Exponent of dg/dt at the edge of the face.
    _order = 0

    unit = property(lambda self: (type(self)(1.0, 1.0), self.flat_radius, self._depth_scale))

    @property
    def zones(self):
        b = self.flat_radius
        return (
            Zone(
                lambda t: self._rate(t / b),
                lambda depth: b * self._tau(depth),
                order=self._order,
                kink=b,
                scale=b,
            ),
        )

    def _reduced(self, x):
        b = self.flat_radius
        return np.where(x > b, self._behind(np.sqrt(np.maximum(x - b, 0.0) * (x + b)) / b), 0.0)


@dataclass(frozen=True)
class TruncatedCone(_FlatFaced):
    """Truncated cone z = s (r − b)₊, with g = s x arccos(b/x) for x > b.

    From Popov (2015), Eq. (3).

    Parameters
    ----------
    flat_radius : float
        Radius b of the flat face (m), positive.
    slope : float
        Slope s of the cone, positive.

    Examples
    --------
    >>> print(round(TruncatedCone(flat_radius=1.0, slope=3.0).reduced(2.0), 12))  # 2π
    6.28318530718
    """

    flat_radius: float
    slope: float

    def __post_init__(self):
        _check.set_positive(self, flat_radius="m", slope="")

    def _height(self, r):
        return self.slope * np.maximum(r - self.flat_radius, 0.0)

    @property
    def _depth_scale(self):
        return self.slope * self.flat_radius

    def _behind(self, tau):
        return self._depth_scale * np.hypot(1.0, tau) * np.arctan(tau)

    def _rate(self, tau):
        return self.slope * (tau * np.arctan(tau) + 1) / np.hypot(1.0, tau)

    def _tau(self, depth):
        D = depth / self._depth_scale

        def step(tau):
            x, arctan = np.hypot(1.0, tau), np.arctan(tau)
            return (x * arctan - D) * x / (tau * arctan + 1)

        return newton(step, D)


@dataclass(frozen=True)
class TruncatedParaboloid(_FlatFaced):
    """Truncated paraboloid z = (r² − b²)₊/(2R), with g = x √(x² − b²)/R for x > b.

    From Popov (2015), Eq. (3).

    Parameters
    ----------
    flat_radius : float
        Radius b of the flat face (m), positive.
    radius : float
        Radius of curvature R of the paraboloid (m), positive.

    Examples
    --------
    >>> print(round(TruncatedParaboloid(flat_radius=3.0, radius=1.0).reduced(5.0), 12))
    20.0
    """

    flat_radius: float
    radius: float

    def __post_init__(self):
        _check.set_positive(self, flat_radius="m", radius="m")

    @property
    def _depth_scale(self):
        return self.flat_radius * (self.flat_radius / self.radius)

    def _height(self, r):
        b = self.flat_radius
        return np.maximum(r - b, 0.0) * ((r + b) / (2 * self.radius))

    def _behind(self, tau):
        return self._depth_scale * tau * np.hypot(1.0, tau)

    def _rate(self, tau):
        return self.flat_radius / self.radius * (1 + 2 * tau * tau) / np.hypot(1.0, tau)

    def _tau(self, depth):
        D = depth / self._depth_scale
        # Root of τ²(1 + τ²) = D².
        return D * np.sqrt(2 / (1 + np.hypot(1.0, 2 * D)))


@dataclass(frozen=True)
class RoundedPunch(_FlatFaced):
    """Flat punch with a rounded edge: z = (r − b)₊²/(2R).

    Reduced: g = (x/R)(√(x² − b²) − b arccos(b/x)) for x > b, from Popov (2015), Eq. (3).

    Parameters
    ----------
    flat_radius : float
        Radius b of the flat face (m), positive.
    edge_radius : float
        Radius of curvature R of the edge (m), positive.

    Examples
    --------
    >>> print(round(RoundedPunch(flat_radius=1.0, edge_radius=1.0).reduced(2.0), 12))  # 2(√3 − π/3)
    1.369706512745
    """

    flat_radius: float
    edge_radius: float
    _order = 2

    def __post_init__(self):
        _check.set_positive(self, flat_radius="m", edge_radius="m")

    @property
    def _depth_scale(self):
        return self.flat_radius * (self.flat_radius / self.edge_radius)

    def _height(self, r):
        edge = np.maximum(r - self.flat_radius, 0.0)
        return edge * (edge / (2 * self.edge_radius))

    def _behind(self, tau):
        return self._depth_scale * np.hypot(1.0, tau) * arctan_gap(tau)

    def _rate(self, tau):
        # τ (τ − arctan τ)/x + x τ²/x², with x = √(1 + τ²).
        x = np.hypot(1.0, tau)
        return self.flat_radius / self.edge_radius * tau * (arctan_gap(tau) + tau) / x

    def _tau(self, depth):
        D = depth / self._depth_scale

        def step(tau):
            x, gap = np.hypot(1.0, tau), arctan_gap(tau)
            return (x * gap - D) * x / np.maximum(tau * (gap + tau), np.finfo(float).tiny)

        return newton(step, np.where(D < 1, np.cbrt(3 * D), np.sqrt(D) + np.pi / 4))
