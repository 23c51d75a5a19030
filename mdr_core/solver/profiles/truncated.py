"""Profiles with a flat face: truncated cone and paraboloid, punch with a rounded edge."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base.check import ArrayLike, Parameter
from .radius_table import OneLength


class _FlatFaced(OneLength):
    """Base class of profiles with a flat face. With τ = √(u² − 1), arccos(1/u) = arctan τ."""

    flat_radius: Parameter
    _edge = 1.0
    _length = property(lambda self: self.flat_radius)


@dataclass(frozen=True, eq=False)
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
    >>> from mdr_core import TruncatedCone
    >>> print(round(TruncatedCone(flat_radius=1.0, slope=3.0).reduced(2.0), 12))  # 2π
    6.28318530718
    """

    flat_radius: Parameter
    slope: Parameter

    if TYPE_CHECKING:

        def __init__(self, flat_radius: ArrayLike, slope: ArrayLike) -> None: ...

    _depth = property(lambda self: self.slope * self.flat_radius)
    _Z = staticmethod(lambda u: np.maximum(u - 1, 0.0))
    _G = staticmethod(lambda u: u * np.arctan(_tau(u)))

    @staticmethod
    def _G_slope(u):
        tau = _tau(u)
        with np.errstate(divide="ignore"):
            return np.where(u < 1, 0.0, np.arctan(tau) + 1 / tau)

    def radius_at_height(self, height):
        return self.flat_radius + height / self.slope


@dataclass(frozen=True, eq=False)
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
    >>> from mdr_core import TruncatedParaboloid
    >>> print(round(TruncatedParaboloid(flat_radius=3.0, radius=1.0).reduced(5.0), 12))
    20.0
    """

    flat_radius: Parameter
    radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, flat_radius: ArrayLike, radius: ArrayLike) -> None: ...

    _depth = property(lambda self: self.flat_radius * (self.flat_radius / self.radius))
    _Z = staticmethod(lambda u: np.maximum(u - 1, 0.0) * ((u + 1) / 2))
    _G = staticmethod(lambda u: u * _tau(u))

    @staticmethod
    def _G_slope(u):
        tau = _tau(u)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(u < 1, 0.0, tau + u * (u / tau))

    def radius_at_height(self, height):
        return np.hypot(self.flat_radius, np.sqrt(2 * self.radius * height))


@dataclass(frozen=True, eq=False)
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
    >>> from mdr_core import RoundedPunch
    >>> print(round(RoundedPunch(flat_radius=1.0, edge_radius=1.0).reduced(2.0), 12))  # 2(√3 − π/3)
    1.369706512745
    """

    flat_radius: Parameter
    edge_radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, flat_radius: ArrayLike, edge_radius: ArrayLike) -> None: ...

    _depth = property(lambda self: self.flat_radius * (self.flat_radius / self.edge_radius))
    _Z = staticmethod(lambda u: np.maximum(u - 1, 0.0) ** 2 / 2)
    _G = staticmethod(lambda u: u * _arctan_gap(_tau(u)))

    @staticmethod
    def _G_slope(u):
        tau = _tau(u)
        return _arctan_gap(tau) + tau

    def radius_at_height(self, height):
        return self.flat_radius + np.sqrt(2 * self.edge_radius * height)


def _tau(u):
    """Return √(u² − 1) without cancellation, 0 for u < 1."""
    return np.sqrt(np.maximum(u - 1, 0.0) * (u + 1))


#: Coefficients 1/3, −1/5, 1/7, … of the series of (τ − arctan τ)/τ³ in τ², highest first, for τ ≤ 1/2.
_GAP = (1 / np.arange(3, 55, 2) * (-1.0) ** np.arange(26))[::-1]


def _arctan_gap(tau):
    """Return τ − arctan τ without cancellation, for τ ≥ 0."""
    small = np.minimum(tau, 0.5)
    square = small * small
    return np.where(tau < 0.5, np.polyval(_GAP, square) * square * small, tau - np.arctan(tau))
