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
    """States on elastic unloading from those of a path, which broadcast with `share`.

    `share` falls from 1 at the start to 0 where the contact is lost: at d = d_p, with adhesion at the
    pull-off, which under a given force (`under_force`) is earlier than at a given depth. Below 0 the
    indenter is lifted out of contact, at −1 to the undeformed surface, or from a pull-off above that
    surface to twice its height. States without contact stay without.
    """
    profile, medium, start = path.profile, path.medium, path.live_interval
    touching, held, lifted = path.contact_radius > 0, np.maximum(share, 0.0), np.minimum(share, 0.0)
    end = 0.0
    if medium.work_of_adhesion > 0:
        # Weak adhesion changes the curve just before the pull-off only.
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
    """Depths (m) and forces (N) of the elastic unloading of one state; the area below is what it stores.

    With adhesion it is less by what separates the surfaces up to the pull-off. Elements that dashpots hold
    back are compressed further than their load: the curve begins at the depth of the state, with the
    stiffness 2E* a.
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

    They differ only where the curves do, so that the arrays end there. Work is lost where the force of
    loading is above that of unloading, and gained where it is below, in reach of adhesion that an imprint
    no longer has.
    """

    depth: np.ndarray
    loading: np.ndarray
    unloading: np.ndarray

    @property
    def lost(self) -> float:
        """Work (J) that is lost, that of the jumps at first contact and at the pull-off included."""
        return float(trapezoid(np.maximum(self.loading - self.unloading, 0.0), self.depth))

    @property
    def gained(self) -> float:
        """Work (J) that is gained."""
        return float(trapezoid(np.maximum(self.unloading - self.loading, 0.0), self.depth))


def adhesive_loop(path: Indentation, under_force: bool = False) -> AdhesiveLoop:
    """The loop of a loading with adhesion, to its last state, and of its unloading to the pull-off.

    Areas are good to three digits. Where the contact is lost above the depth of first contact before
    anything has yielded, as may be under a given force, no loop is closed and more is gained than lost.
    """
    profile, medium, share = path.profile, path.medium, np.linspace(1, 0, _LOOP)
    back, first = (unloading(path[i], share, under_force) for i in (-1, 0))
    largest, end = path.depth[-1], back.depth[-1]
    # The force jumps at first contact and at the pull-off; what is below first contact is a small part.
    step = 1e-9 * max(largest, -end)
    even = largest * np.linspace(0, 1, _LOOP)
    d = np.concatenate([path.depth, even, back.depth, first.depth])
    d = np.concatenate([d[(d > end + step) | (d >= 0)], [-step, end, end - step]])
    d = np.unique(np.minimum(d, largest))
    loading = indent(profile, medium, d).force
    returning = indent(profile, medium, np.append(largest, d[::-1])).force[:0:-1]
    returning = np.where(d > end, returning, np.where(d == end, back.force[-1], 0.0))
    # Both are found to about 10⁻¹².
    returning = np.where(np.isclose(loading, returning, rtol=1e-9, atol=0), loading, returning)
    apart = slice(np.max(np.flatnonzero(loading != returning), initial=0) + 2)
    return AdhesiveLoop(d[apart], loading[apart], returning[apart])
