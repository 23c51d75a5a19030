"""The row of elements on one side of the axis, in one state, for the solvers of the chain.

`Foundation` shows users a row on both sides of the axis. Solvers use the row itself: its elements, the
ramps from its present depth, and the row at their ends.
"""

from dataclasses import dataclass, replace

import numpy as np

from ...base import check
from ..applicability import check_reached
from ..medium.medium import Medium
from ..profiles.profile import Profile, check_known
from . import element
from .cap import elastic_limit, onset_depth
from .element import Elements, Exchange, Ramp
from .grid import cell_edges

#: Largest number of elements; such a state needs some GB.
_MAX_ELEMENTS = 10**7


def element_count(n):
    """Return the number of elements n as an int if it is even and positive; otherwise raise an error."""
    count = check.positive_number("n", n)
    if count % 2 or count > _MAX_ELEMENTS:
        raise check.MDRError(
            f"n = {count:g} must be an even whole number up to {_MAX_ELEMENTS:g}, half of it on either side"
        )
    return int(count)


class NarrowRow(check.MDRError):
    """Error of a contact that is wider than its row of elements."""


@dataclass(frozen=True, eq=False)
class Row:
    """Independent elements on one side of the axis, in one state; immutable.

    `Row.virgin` makes an undeformed row. `advance` and `ramp_to` return the row after a move. To find its
    next move, a solver makes a `ramp`, tries it by `element.advance(row.elements, ramp)`, and gets the new
    row by `after`. Works are sums over both sides of the axis.
    """

    #: The indenter, which touches the undeformed surface at depth 0, and the medium.
    profile: Profile
    medium: Medium
    #: Length (m) of the row, and requested radii (m) of edges between elements.
    half_width: float
    nodes: tuple[float, ...]
    #: Arrays of shape (n/2 + 1,) from the axis outward. The first element has the width 0: on the axis
    #: itself, contact begins and ends.
    elements: Elements
    #: Depth (m) at which the contact reaches the half-width, and at which the first element yields.
    edge_depth: float
    onset: float
    #: Present depth d (m), and largest depth so far; its contact radius determines the elastic limit.
    depth: float = 0.0
    largest: float = 0.0
    #: τḋ (m) at the present rate of the depth.
    lag: float = 0.0
    #: Energies (J) dissipated so far by the dashpots, and by yielding.
    viscous_work: float = 0.0
    plastic_work: float = 0.0
    #: Moves so far: depth (m) and duration (s) of each.
    history: tuple[tuple[float, float], ...] = ()

    @classmethod
    def virgin(cls, profile, medium, n, half_width, nodes=()):
        """Make an undeformed row of n elements on both sides, to a half-width (m), with edges at nodes.

        It raises ValueError if n is odd or too small, or the half-width exceeds the known radius.
        """
        n = element_count(n)
        known = profile.known_radius
        half_width = check.positive_number("half_width", half_width, unit="m")
        if half_width > known:
            raise check.MDRError(
                f"half_width = {half_width:g} m exceeds the known radius of the profile, {known:g} m; "
                "give a smaller half_width"
            )
        nodes = check.finite_array("nodes", nodes, unit="m").ravel()
        edges = cell_edges(profile, n // 2, half_width, nodes)
        x = np.append(0.0, (edges[1:] + edges[:-1]) / 2)
        width = np.append(0.0, np.diff(edges))
        # The tolerance admits a half-width equal to the rounded contact radius.
        edge_depth = profile.reduced(min(half_width * (1 + 1e-9), known))
        edge_depth = np.inf if half_width >= profile.wall else edge_depth
        elements, onset = Elements.virgin(profile, x, width), onset_depth(profile, medium)
        return cls(profile, medium, half_width, tuple(nodes.tolist()), elements, edge_depth, onset)

    @property
    def n(self) -> int:
        """Number of elements on both sides of the axis together."""
        return 2 * (self.elements.x.size - 1)

    @property
    def elastic_limit(self):
        """Largest elastic compression u_c (m) of the elements at present."""
        return elastic_limit(self.profile, self.medium, self.largest)

    @property
    def line_load(self) -> np.ndarray:
        """Line load q = E* u_e + 4ηḋ (N/m) of each element, 0 out of contact."""
        load = self.medium.E_star * np.maximum(self.elements.elastic + self.lag, 0.0)
        return np.where(self.elements.contact, load, 0.0)

    @property
    def stored_energy(self) -> float:
        """Σ E* u_e² Δx/2 (J); it balances the works along the ramps to rounding."""
        return self.total(self.elements.elastic**2 / 2)

    def total(self, values) -> float:
        """Return E* times the sum, over both sides, of a quantity of the elements times their width.

        For compressions (m) it is a force (N), for energies (m²) of an `Exchange` an energy (J).
        """
        return float(2 * self.medium.E_star * (values @ self.elements.width))

    def advance(self, depth, dt=np.inf) -> "Row":
        """Return the row after a straight ramp to a depth (m) in a time (s), checked; see `Foundation`."""
        depth = check.number("depth", depth, "m")
        depth = float(check.finite_array("depth", depth, unit="m", most=check.LONGEST))
        dt = check.positive_number("dt", dt, unit="s", infinite=True)
        if depth > self.largest:
            check_reached(self.profile, self.medium, depth)
        moved, travel = self, depth - self.depth
        for end in self._ends(depth):
            share = (end - moved.depth) / travel if travel else 1.0
            moved = moved.ramp_to(end, dt * share)
        return replace(moved, history=(*self.history, (depth, dt)))

    def ramp_to(self, depth, dt) -> "Row":
        """Advance in one short ramp, even if the elastic limit changes along it.

        Then only the plastic work has an error, of second order in the length of the ramp.
        """
        ramp = self.ramp(depth - self.depth, dt, depth)
        return self.after(ramp, *element.advance(self.elements, ramp))

    def _ends(self, depth):
        """Return depths (m) of ramps to a depth: many past the onset if the elastic limit changes."""
        start = max(self.largest, self.onset)
        if self.medium.inverse_to_radius or depth <= start:
            return [depth]
        # Between the ends of a ramp the plastic depth is linear, with an error of second order in 1/n.
        count = max(self.n // 4, 1)
        shares = (np.arange(count + 1) / count) ** 2
        ends = start + (depth - start) * shares
        return [*ends[(ends > self.depth) & (ends < depth)].tolist(), depth]

    def ramp(self, travel, dt, depth=None) -> Ramp:
        """Return a `Ramp` by a travel (m) in a time (s), to a rounded depth (m) if given."""
        profile, medium, before = self.profile, self.medium, self.largest
        depth = self.depth + travel if depth is None else depth
        limit, ratio = elastic_limit(profile, medium, max(before, depth)), 1.0
        start = max(before, self.onset)
        if depth > start and not medium.inverse_to_radius:
            gain = depth - limit - max(start - elastic_limit(profile, medium, start), 0.0)
            # A smaller gain is rounding, next to the onset or to the largest depth.
            ratio = (depth - start) / gain if gain > 1e-9 * depth else 1.0
        return Ramp(depth, travel, dt, medium.relaxation_time, limit, ratio)

    def after(self, ramp: Ramp, elements: Elements, exchange: Exchange, rate=None) -> "Row":
        """Return the row at the end of a ramp, with its elements there and their exchange along the ramp.

        The dashpots have the rate (m/s) of the ramp, or `rate`. It raises ValueError if the depth exceeds
        the known depth, or the contact radius exceeds the half-width.
        """
        if ramp.depth > self.profile.known_depth:
            check_known(self.profile, np.asarray(ramp.depth))
        if ramp.depth > self.edge_depth:
            radius = self.profile.contact_radius(ramp.depth)
            raise NarrowRow(
                f"half_width = {self.half_width:g} m is less than the contact radius {radius:g} m at "
                f"depth = {ramp.depth:g} m; give a larger half_width"
            )
        return replace(
            self,
            elements=elements,
            depth=float(ramp.depth),
            largest=max(self.largest, float(ramp.depth)),
            lag=ramp.lag if rate is None else ramp.tau * rate,
            viscous_work=self.viscous_work + self.total(exchange.viscous),
            plastic_work=self.plastic_work + self.total(exchange.plastic),
            history=(*self.history, (ramp.depth, ramp.duration)),
        )
