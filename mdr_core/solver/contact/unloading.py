"""Elastic unloading to the loss of contact, and the loop of loading and unloading with adhesion."""

from dataclasses import dataclass

import numpy as np

from ..numerics.stable import trapezoid
from . import adhesion
from .indentation import Indentation
from .live_interval import LiveInterval
from .loading import indent

#: States of an unloading and of a loop.
_STATES, _LOOP = 25, 80


def unloading(path: Indentation, share: np.ndarray, under_force: bool = False) -> Indentation:
    """Return states of elastic unloading from the states of a path, which broadcast with `share`.

    `share` falls from 1 at the start to 0 at the loss of contact. This is d = d_p, or with adhesion the
    pull-off, which under a given force (`under_force`) is earlier than at a given depth. Below 0 the
    indenter is out of contact. At −1 it is at the undeformed surface, or, after a pull-off above that
    surface, at twice the height of the pull-off. States without contact remain without contact.
    """
    profile, medium, start = path.profile, path.medium, path.live_interval
    touching, held, lifted = path.contact_radius > 0, np.maximum(share, 0.0), np.minimum(share, 0.0)
    end = 0.0
    if medium.work_of_adhesion > 0:
        # Weak adhesion changes the curve only just before the pull-off.
        held = held**3
        least = adhesion.AT_FORCE if under_force else adhesion.AT_DEPTH
        low = adhesion.stable_ranges(profile, medium, least)[0][0]
        end = adhesion.last_interval(start.lower, low).length
    interval = LiveInterval.above(start.lower, np.where(touching, end + held * (start.length - end), 0.0))
    stretched = np.where(touching, adhesion.stretch(medium, profile.radius_at(interval.upper)), 0.0)
    depth = interval.upper - stretched
    depth = depth + lifted * (depth - np.minimum(2 * depth, 0.0))
    interval = LiveInterval.above(start.lower, np.where(share < 0, 0.0, interval.length))
    return Indentation(
        profile, medium, depth, interval, np.where(share < 0, 0.0, -medium.E_star * stretched)
    )


def unloading_curve(state: Indentation, under_force: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return depths (m) and forces (N) of the elastic unloading of one state.

    The area below this curve is the stored energy. With adhesion it is smaller by the work that separates
    the surfaces up to the pull-off. Elements held back by dashpots are compressed more than their load
    requires. The curve then begins at the depth of the state, with the stiffness 2E* a.
    """
    interval, depth = state.live_interval, float(state.depth)
    back = unloading(state, np.linspace(1, 0, _STATES), under_force)
    d, force = back.depth, back.force
    if interval.length > 0 and depth > interval.upper * (1 + 1e-9):
        stiffness = 2 * state.medium.E_star * state.contact_radius
        d, force = np.append(depth, d), np.append(force[0] + stiffness * (depth - d[0]), force)
    return d, force


@dataclass(frozen=True)
class AdhesiveLoop:
    """Forces (N) of loading and of unloading at the same depths (m), ascending, with adhesion.

    Both curves agree at larger depths than those of the arrays. Work is lost at depths where loading has
    the larger force, and gained where unloading has the larger force. There loading is in reach of an
    adhesion that the imprint no longer has.
    """

    depth: np.ndarray
    loading: np.ndarray
    unloading: np.ndarray

    @property
    def lost(self) -> float:
        """Lost work (J), with the work of the jumps at first contact and at the pull-off."""
        return float(trapezoid(np.maximum(self.loading - self.unloading, 0.0), self.depth))

    @property
    def gained(self) -> float:
        """Gained work (J)."""
        return float(trapezoid(np.maximum(self.unloading - self.loading, 0.0), self.depth))


def adhesive_loop(path: Indentation, under_force: bool = False) -> AdhesiveLoop:
    """Return the loop of a loading with adhesion to its last state and of its unloading to the pull-off.

    Areas are accurate to three digits. Under a given force, the contact may be lost above the depth of
    first contact before anything has yielded. Then the loop is not closed, and more is gained than lost.
    """
    profile, medium, share = path.profile, path.medium, np.linspace(1, 0, _LOOP)
    back, first = (unloading(path[i], share, under_force) for i in (-1, 0))
    largest, end = path.depth[-1], back.depth[-1]
    # The force jumps at first contact and at the pull-off; the part below first contact is small.
    step = 1e-9 * max(largest, -end)
    even = largest * np.linspace(0, 1, _LOOP)
    d = np.concatenate([path.depth, even, back.depth, first.depth])
    d = np.concatenate([d[(d > end + step) | (d >= 0)], [-step, end, end - step]])
    d = np.unique(np.minimum(d, largest))
    loading = indent(profile, medium, d).force
    returning = indent(profile, medium, np.append(largest, d[::-1])).force[:0:-1]
    returning = np.where(d > end, returning, np.where(d == end, back.force[-1], 0.0))
    # Both forces are accurate to about 10⁻¹².
    returning = np.where(np.isclose(loading, returning, rtol=1e-9, atol=0), loading, returning)
    apart = slice(np.max(np.flatnonzero(loading != returning), initial=0) + 2)
    return AdhesiveLoop(d[apart], loading[apart], returning[apart])
