"""The 1D foundation under an indenter, for users: elements on both sides of the axis, in one state.

A `Row` computes one side.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from ...base import check, lazy
from ..applicability import check_pair, refuse_adhesion
from ..medium.medium import Medium
from ..profiles.profile import Profile
from . import narrow
from .row import Row


@dataclass(frozen=True, eq=False, repr=False)
class Foundation:
    """The 1D foundation as a row of independent springs and dashpots, which yield.

    See Popov (2015), Fig. 1. Each of the n elements between −half_width and half_width is a spring
    Δk = E*Δx in parallel with a dashpot Δγ = 4ηΔx (Eqs. (1), (12)). The spring carries at most π q_c/2 per
    length. With another hardness it carries at most π a σ_c(a)/2, with the contact radius a at the largest
    depth. A foundation is immutable: `advance` returns a new one, exact for a straight ramp of depth
    (plastic work to second order). The code is independent of `indent` and `impact`.

    Parameters
    ----------
    profile, medium
        The indenter, which touches the undeformed surface at depth 0, and the medium.
    n : int
        Number of elements on both sides of the axis together, even, at least 2.
    half_width : float
        Length (m) of the row on either side of the axis, at least the largest contact radius.
    nodes : sequence of float, optional
        Radii (m) of edges between elements, in addition to the flat face, kinks and wall of the profile.
        With the contact radius and the plastic radius as nodes, sums are of second order in 1/n.

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
    _row: Row | None = field(default=None, kw_only=True)
    #: The loss in a contact that has always been narrower than an element.
    _loss: narrow.ViscousLoss = field(default=narrow.ViscousLoss(), kw_only=True)

    def __post_init__(self):
        if self._row is not None:
            # A copy in another state was checked before.
            return
        check_pair(self.profile, self.medium, "a foundation")
        refuse_adhesion(self.medium, "a foundation")
        row = Row.virgin(self.profile, self.medium, self.n, self.half_width, self.nodes)
        check.store(self, n=row.n, half_width=row.half_width, nodes=row.nodes, _row=row)

    def __repr__(self) -> str:
        return lazy.report.foundation_text(self)

    def advance(self, depth: float, dt: float = np.inf) -> "Foundation":
        """Move the indenter along a straight ramp of depth in time.

        Parameters
        ----------
        depth : float
            New depth d (m); negative above the undeformed surface.
        dt : float, optional
            Duration (s) of the move, positive. The default is infinite: the dashpots carry no load, and
            released elements are relaxed.

        Returns
        -------
        Foundation
            The new state; its line load includes the dashpots at the rate of the ramp.

        Raises
        ------
        ValueError
            If the contact radius exceeds half_width, or the depth exceeds the known depth; or if a law of
            hardness is invalid up to that radius.

        Examples
        --------
        A dashpot adds 8ηb ḋ to the force of a flat punch, and nothing at constant depth:

        >>> from mdr_core import FlatPunch, Foundation, Medium
        >>> foundation = Foundation(FlatPunch(radius=1.0), Medium(E_star=1.0, eta=1.0), 2, half_width=1.0)
        >>> moved = foundation.advance(3.0, dt=1.5)
        >>> print(moved.force, moved.advance(3.0, dt=1.0).force)  # 2E*b d + 8ηb ḋ
        22.0 6.0
        """
        moved, loss = self._row.advance(depth, dt), self._loss
        if self.medium.eta > 0 and narrow.was_always_narrow(moved):
            loss = narrow.viscous_loss(loss, self._row, moved, dt)
        return replace(self, _row=moved, _loss=loss)

    @property
    def depth(self) -> float:
        """Present depth d (m) of the indenter."""
        return self._row.depth

    @property
    def viscous_work(self) -> float:
        """Energy (J) dissipated by the dashpots so far.

        For contacts narrower than one element it is an integral, like the force.
        """
        return self._loss.work if narrow.was_always_narrow(self._row) else self._row.viscous_work

    @property
    def history(self) -> tuple[tuple[float, float], ...]:
        """Moves so far, as (depth, dt); repeating them brings another foundation to the same state."""
        return self._row.history

    @check.frozen_property
    def x(self) -> np.ndarray:
        """Coordinates (m) of the elements, shape (n,), from −half_width to half_width."""
        return np.concatenate([-self._row.elements.x[:0:-1], self._row.elements.x[1:]])

    @check.frozen_property
    def width(self) -> np.ndarray:
        """Widths Δx (m) of the elements, the weights of sums over them."""
        return _mirrored(self._row.elements.width)

    @check.frozen_property
    def elastic(self) -> np.ndarray:
        """Elastic part u_e (m) of each element's compression, carried by its spring."""
        return _mirrored(self._row.elements.elastic)

    @check.frozen_property
    def plastic(self) -> np.ndarray:
        """Plastic part u_p (m) of each element's compression, the residual imprint."""
        return _mirrored(self._row.elements.plastic)

    @check.frozen_property
    def contact(self) -> np.ndarray:
        """Whether each element is in contact; a released element may still be relaxing.

        If the contact is narrower than the two elements in the middle, these two are in contact.
        """
        contact = self._row.elements.contact
        if narrow.was_always_narrow(self._row):
            contact = contact.copy()
            contact[1] = narrow.contact_within_an_element(self._row) is not None
        return _mirrored(contact)

    @check.frozen_property
    def line_load(self) -> np.ndarray:
        """Line load q = E* u_e + 4ηḋ (N/m), 0 out of contact; Popov (2015), Eqs. (1), (17), (18)."""
        return _mirrored(self._row.line_load)

    @check.frozen_property
    def state(self) -> np.ndarray:
        """State of each element: "yielded" with a plastic part, else "elastic" in contact, else "free"."""
        yielded, middle = self.plastic > 0, self.n // 2
        if narrow.was_always_narrow(self._row):
            yielded[middle - 1 : middle + 1] = self._row.elements.plastic[0] > 0
        return np.where(yielded, "yielded", np.where(self.contact, "elastic", "free"))

    @property
    def force(self) -> float:
        """Normal force F = Σ q Δx (N); Popov (2015), Eq. (9).

        For a contact narrower than one element it is ∫ q dx with the profile inside the element.
        """
        if (inside := narrow.contact_within_an_element(self._row)) is not None:
            width, elastic = inside
            return float(2 * self.medium.E_star * (width @ np.maximum(elastic + self._row.lag, 0.0)))
        return float(2 * (self._row.line_load @ self._row.elements.width))

    @property
    def stored_energy(self) -> float:
        """Elastic energy U = Σ E* u_e² Δx/2 (J), including elements that relax out of contact.

        For a contact narrower than one element it is an integral, like the force.
        """
        inside = narrow.contact_within_an_element(self._row)
        energy = 0.0 if inside is None else float(self.medium.E_star * (inside[0] @ inside[1] ** 2))
        if narrow.was_always_narrow(self._row):
            return energy + self._loss.relaxing
        relaxing = np.any(self._row.elements.elastic[~self._row.elements.contact])
        return self._row.stored_energy if inside is None or relaxing else energy

    @property
    def plastic_work(self) -> float:
        """Energy Σ ∫ E* u_c du_p Δx (J) dissipated by yielding so far.

        For contacts narrower than one element it is an integral, like the force.
        """
        if narrow.was_always_narrow(self._row):
            return narrow.plastic_work(self._row)
        return self._row.plastic_work


def foundation_of(row: Row) -> Foundation:
    """Return the `Foundation` in the final state of a row of a solver."""
    loss = narrow.ViscousLoss(row.viscous_work)
    return Foundation(row.profile, row.medium, row.n, row.half_width, row.nodes, _row=row, _loss=loss)


def _mirrored(values):
    """Return values on both sides of the axis, without the element of width 0."""
    return np.concatenate([values[:0:-1], values[1:]])
