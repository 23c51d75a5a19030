"""The 1D foundation under an indenter: a row of independent springs with yield cap and dashpots.

One side of the axis is computed. It starts with an element of no width, where contact begins and ends.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from .. import _check
from ..applicability import check_pair, check_reached, refuse_adhesion
from ..medium import Medium
from ..numerics.gauss import gauss_legendre
from ..numerics.results import above
from ..profiles.profile import Profile
from . import element
from .cap import elastic_limit, onset_depth
from .element import Elements, Ramp
from .grid import cell_edges

#: Largest number of elements; a state of these takes some GB.
_MAX_ELEMENTS = 10**7


def element_count(n):
    """Number of elements n as an int, if it is even and positive."""
    count = _check.positive_number("n", n)
    if count % 2 or count > _MAX_ELEMENTS:
        raise ValueError(
            f"n = {count:g} must be an even whole number up to {_MAX_ELEMENTS:g}, half of it on either side"
        )
    return int(count)


@dataclass(frozen=True, eq=False)
class FoundationState:
    """State of a `Foundation` after the moves of its history."""

    elements: Elements
    #: Depth (m) at which the contact reaches the half-width.
    edge_depth: float
    #: Depth (m) at which the first element yields.
    onset: float
    depth: float = 0.0
    #: Largest depth (m) so far, whose contact radius sets the elastic limit.
    largest: float = 0.0
    #: τḋ (m) at the present rate of the depth.
    lag: float = 0.0
    viscous_work: float = 0.0
    plastic_work: float = 0.0
    history: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Foundation:
    """The 1D foundation of Popov (2015), Fig. 1, as a row of independent elements.

    Each of the n elements between −half_width and half_width is a spring Δk = E*Δx, which carries at most
    π q_c/2 per length, in parallel with a dashpot Δγ = 4ηΔx (Eqs. (1), (12)); with another hardness at most
    π a σ_c(a)/2, where a is the contact radius at the largest depth. A foundation is immutable: `advance`
    returns a new one, exact for a straight ramp of depth (plastic work to second order). Independent of
    `indent` and `impact`.

    Parameters
    ----------
    profile, medium
        The indenter, which touches the undeformed surface at depth 0, and the medium.
    n : int
        Number of elements on both sides of the axis together, even, at least 2.
    half_width : float
        Length (m) of the row on either side of the axis, at least the largest contact radius.
    nodes : sequence of float, optional
        Radii (m) of edges between elements, besides the flat face, kinks and wall of the profile. With the
        contact radius and the plastic radius as nodes, sums are of second order in 1/n.

    Raises
    ------
    ValueError
        If n is odd or too small for the kinks and nodes, or half_width exceeds the known radius.

    Examples
    --------
    Cone of slope 1 pressed to three times the critical depth, F = 5 F_c (Popov 2015, Eqs. (20), (22)):

    >>> from mdr_core import Cone, Foundation, Medium
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)
    >>> depth = 3 * medium.critical_depth
    >>> foundation = Foundation(cone, medium, 12, half_width=cone.contact_radius(depth)).advance(depth)
    >>> print(round(foundation.force / (3.141592653589793 * 2.0**2 / 2), 12))
    5.0
    >>> foundation.state[6:].tolist()
    ['yielded', 'yielded', 'yielded', 'yielded', 'elastic', 'elastic']
    """

    profile: Profile
    medium: Medium
    n: int
    half_width: float
    nodes: tuple[float, ...] = ()
    _current: FoundationState | None = field(default=None, kw_only=True)

    def __post_init__(self):
        if self._current is not None:
            # A copy in another state has been checked before.
            return
        check_pair(self.profile, self.medium, "a foundation")
        refuse_adhesion(self.medium, "a foundation")
        n = element_count(self.n)
        known = self.profile.known_radius
        half_width = _check.positive_number("half_width", self.half_width, unit="m")
        if half_width > known:
            raise ValueError(
                f"half_width = {half_width:g} m exceeds the known radius of the profile, {known:g} m; "
                "give at most that"
            )
        nodes = _check.finite_array("nodes", self.nodes, unit="m").ravel()
        edges = cell_edges(self.profile, n // 2, half_width, nodes)
        x = np.append(0.0, (edges[1:] + edges[:-1]) / 2)
        width = np.append(0.0, np.diff(edges))
        # The tolerance admits a half-width equal to the rounded contact radius.
        edge_depth = self.profile.reduced(min(half_width * (1 + 1e-9), known))
        edge_depth = np.inf if half_width >= self.profile.wall else edge_depth
        onset = onset_depth(self.profile, self.medium)
        current = FoundationState(Elements.virgin(self.profile, x, width), edge_depth, onset)
        _check.store(self, n=n, half_width=half_width, nodes=tuple(nodes.tolist()), _current=current)

    def __repr__(self) -> str:
        return above("show.report").foundation_text(self)

    def advance(self, depth: float, dt: float = np.inf) -> "Foundation":
        """Move the indenter along a straight ramp of depth in time.

        Parameters
        ----------
        depth : float
            New depth d (m); negative above the undeformed surface.
        dt : float, optional
            Duration (s) of the move, positive; by default infinite: the dashpots carry no load, and
            released elements are relaxed.

        Returns
        -------
        Foundation
            In the new state; its line load includes the dashpots at the rate of the ramp.

        Raises
        ------
        ValueError
            If the contact radius exceeds half_width, or the depth the known depth; or if a law of hardness
            is none up to that radius.

        Examples
        --------
        A dashpot adds 8ηb ḋ to the force of a flat punch, and nothing at constant depth:

        >>> from mdr_core import FlatPunch, Foundation, Medium
        >>> foundation = Foundation(FlatPunch(radius=1.0), Medium(E_star=1.0, eta=1.0), 2, half_width=1.0)
        >>> moved = foundation.advance(3.0, dt=1.5)
        >>> print(moved.force, moved.advance(3.0, dt=1.0).force)  # 2E*b d + 8ηb ḋ
        22.0 6.0
        """
        depth = _check.number("depth", depth, "m")
        depth = float(_check.finite_array("depth", depth, unit="m", most=_check.LONGEST))
        dt = _check.positive_number("dt", dt, unit="s", infinite=True)
        if depth > self._current.largest:
            check_reached(self.profile, self.medium, depth)
        moved, travel = self, depth - self.depth
        for end in self._ends(depth):
            share = (end - moved.depth) / travel if travel else 1.0
            ramp = moved._ramp(end - moved.depth, dt * share, end)
            moved = moved._after(ramp, *element.advance(moved._elements, ramp))
        current = replace(moved._current, history=(*self.history, (depth, dt)))
        return replace(moved, _current=current)

    def ramp_to(self, depth, dt):
        """`advance` in one ramp also where the elastic limit changes along it: for short ramps.

        Then the plastic work has an error of second order in the length of the ramp, and nothing else has.
        """
        ramp = self._ramp(depth - self.depth, dt, depth)
        return self._after(ramp, *element.advance(self._elements, ramp))

    def _ends(self, depth):
        """Depths (m) of ramps to a depth: one, or where the elastic limit changes many past the onset."""
        start = max(self._current.largest, self._current.onset)
        if self.medium.inverse_to_radius or depth <= start:
            return [depth]
        # Between the ends of a ramp the plastic depth is taken as linear: an error of second order in 1/n.
        shares = (np.arange(self.n // 4 + 1) / (self.n // 4)) ** 2
        ends = start + (depth - start) * shares
        return [*ends[(ends > self.depth) & (ends < depth)].tolist(), depth]

    def _ramp(self, travel, dt, depth=None):
        """`Ramp` from the present depth by a travel (m) in a time (s), to a rounded depth (m) if given."""
        profile, medium = self.profile, self.medium
        depth, before = self.depth + travel if depth is None else depth, self._current.largest
        limit, ratio = elastic_limit(profile, medium, max(before, depth)), 1.0
        start = max(before, self._current.onset)
        if depth > start and not medium.inverse_to_radius:
            gain = depth - limit - max(start - elastic_limit(profile, medium, start), 0.0)
            # Less is rounding, next to the onset or to the largest depth.
            ratio = (depth - start) / gain if gain > 1e-9 * depth else 1.0
        return Ramp(depth, travel, dt, medium.relaxation_time, limit, ratio)

    def _after(self, ramp, elements, exchange, rate=None):
        """Foundation with these elements at the end of a ramp, at the rate (m/s) of the ramp or another."""
        if ramp.depth > self.profile.known_depth:
            self.profile._known(np.asarray(ramp.depth))
        edge_depth = self._current.edge_depth
        if ramp.depth > edge_depth:
            radius = self.profile.contact_radius(ramp.depth)
            raise ValueError(
                f"half_width = {self.half_width:g} m is less than the contact radius {radius:g} m at "
                f"depth = {ramp.depth:g} m; give at least that"
            )
        lag = ramp.lag if rate is None else ramp.tau * rate
        new = replace(
            self._current,
            elements=elements,
            depth=float(ramp.depth),
            largest=max(self._current.largest, float(ramp.depth)),
            lag=lag,
            viscous_work=self.viscous_work + self._total(exchange.viscous),
            plastic_work=self.plastic_work + self._total(exchange.plastic),
            history=(*self.history, (ramp.depth, ramp.duration)),
        )
        return replace(self, _current=new)

    def _total(self, values):
        """E* times the sum over both sides of a quantity of the elements times their width."""
        return float(2 * self.medium.E_star * (values @ self._elements.width))

    @property
    def _elements(self):
        return self._current.elements

    @property
    def _limit(self):
        """Largest elastic compression (m) of the elements at present."""
        return elastic_limit(self.profile, self.medium, self._current.largest)

    @property
    def _load(self):
        """Line load (N/m) of the elements on one side."""
        load = self.medium.E_star * np.maximum(self._elements.elastic + self._current.lag, 0.0)
        return np.where(self._elements.contact, load, 0.0)

    @property
    def depth(self) -> float:
        """Present depth d (m) of the indenter."""
        return self._current.depth

    @property
    def viscous_work(self) -> float:
        """Energy (J) dissipated by the dashpots so far."""
        return self._current.viscous_work

    @property
    def history(self) -> tuple[tuple[float, float], ...]:
        """Moves so far, as (depth, dt); they bring another foundation to the same state."""
        return self._current.history

    @_check.frozen_property
    def x(self) -> np.ndarray:
        """Coordinates (m) of the elements, shape (n,), from −half_width to half_width."""
        return np.concatenate([-self._elements.x[:0:-1], self._elements.x[1:]])

    @_check.frozen_property
    def width(self) -> np.ndarray:
        """Widths Δx (m) of the elements, the weights of sums over them."""
        return _mirrored(self._elements.width)

    @_check.frozen_property
    def elastic(self) -> np.ndarray:
        """Elastic part u_e (m) of each element's compression, carried by its spring."""
        return _mirrored(self._elements.elastic)

    @_check.frozen_property
    def plastic(self) -> np.ndarray:
        """Plastic part u_p (m) of each element's compression, the residual imprint."""
        return _mirrored(self._elements.plastic)

    @_check.frozen_property
    def contact(self) -> np.ndarray:
        """Whether each element is in contact; a released element may still be relaxing."""
        return _mirrored(self._elements.contact)

    @_check.frozen_property
    def line_load(self) -> np.ndarray:
        """Line load q = E* u_e + 4ηḋ (N/m), 0 out of contact; Popov (2015), Eqs. (1), (17), (18)."""
        return _mirrored(self._load)

    @_check.frozen_property
    def state(self) -> np.ndarray:
        """State of each element: "yielded" with a plastic part, else "elastic" in contact, else "free"."""
        names = np.where(self._elements.contact, "elastic", "free")
        return _mirrored(np.where(self._elements.plastic > 0, "yielded", names))

    @property
    def force(self) -> float:
        """Normal force F = Σ q Δx (N); Popov (2015), Eq. (9).

        Of a contact that is narrower than one element it is ∫ q dx with the profile inside the element.
        """
        if (inside := self._inside_an_element()) is not None:
            width, elastic = inside
            return float(2 * self.medium.E_star * (width @ np.maximum(elastic + self._current.lag, 0.0)))
        return float(2 * (self._load @ self._elements.width))

    @property
    def stored_energy(self) -> float:
        """Elastic energy U = Σ E* u_e² Δx/2 (J), including elements that relax out of contact.

        Of a contact that is narrower than one element it is an integral, as the force is.
        """
        inside = self._inside_an_element()
        if inside is not None and not np.any(self._elements.elastic[~self._elements.contact]):
            width, elastic = inside
            return float(self.medium.E_star * (width @ elastic**2))
        return self.energy_of_elements

    @property
    def energy_of_elements(self) -> float:
        """Σ E* u_e² Δx/2 (J), which the works along the ramps of the elements balance to rounding."""
        return self._total(self._elements.elastic**2 / 2)

    def _inside_an_element(self):
        """Widths (m) and elastic parts (m) on a side of a contact narrower than an element, else None."""
        elements, lag = self._elements, self._current.lag
        if not elements.contact[0] or elements.contact[2:].any():
            return None
        plastic, elastic = float(elements.plastic[0]), float(elements.elastic[0])
        # Contact ends where springs and dashpots together carry nothing.
        rim = plastic + elastic + min(lag, 0.0)
        ends = self.profile.contact_radius(np.array([min(plastic, rim), rim])) * [plastic > 0, 1.0]
        if rim <= 0 or ends[1] >= elements.width[1]:
            return None
        node, weight = gauss_legendre(24)
        # From the axis and from the edge of the imprint on, g may be a root: even in t⁴.
        x = np.append(ends[0] * node**4, ends[0] + (ends[1] - ends[0]) * node**4)
        width = np.append(ends[0] * weight, (ends[1] - ends[0]) * weight) * np.tile(4 * node**3, 2)
        return width, elastic - np.maximum(self.profile.reduced(x) - plastic, 0.0)

    @property
    def plastic_work(self) -> float:
        """Energy Σ ∫ E* u_c du_p Δx (J) dissipated by yielding so far."""
        return self._current.plastic_work


def _mirrored(values):
    """Values on both sides of the axis, without the element of no width."""
    return np.concatenate([values[:0:-1], values[1:]])
