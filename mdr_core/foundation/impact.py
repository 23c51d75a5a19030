"""Impact of a free rigid body on the chain: also with viscosity, and on what an earlier one has left.

Three runs or more of `free_body`, each with twice the elements and half the steps of the one before. Both
errors are of second order: limits are f + (f − c)/3, and the last change of a limit is what it is said to
err by.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .. import _check
from ..medium import Medium, check_pair
from ..results import CHAIN, ImpactResult, Limit, Motion, contact_limits, instants
from ..shapes.profile import Profile
from .free_body import Body, Flight
from .row import Foundation, element_count

#: Elements, and steps in the time T₀, of the first run; each later one has twice as many, up to so often.
_ELEMENTS, _STEPS, _RUNS = 150, 12, 8
#: The part of what a limit has gained on its last run that it errs by at least, in the order of `Errors`.
_TRUST = np.array([0.1, 0.2, 2.0, 1.0])


def chain_impact(
    profile: Profile,
    medium: Medium,
    mass: float,
    speed: float,
    *,
    start: Foundation | None = None,
    n: int | None = None,
    tolerance: float = 1e-6,
) -> "ChainImpact":
    """Let a body hit the chain of springs, dashpots and yield caps, with no other force acting.

    Parameters
    ----------
    profile, medium
        The indenter, and the medium, viscous or not.
    mass, speed : float
        Mass m (kg), and speed v₀ (m/s) at the start, positive.
    start : Foundation, optional
        What the body meets, and where it starts from; by default it touches the virgin surface.
        It is set up anew, through the same moves, on the grids of the solver.
    n : int, optional
        A fixed number of elements; by default as many as the tolerance needs. What a fixed number
        errs by is not in the estimates.
    tolerance : float, optional
        Error allowed in the restitution coefficient, and in the largest depth relative to itself;
        positive. Elements and time steps are refined until the estimate is less, or eight times.

    Returns
    -------
    ChainImpact
        With the estimate reached as `error`, and those of largest force and contact time as well in
        `errors`; they cover relaxation times up to 10³ contact times.

    Raises
    ------
    ValueError
        If mass or speed is not positive, `start` is of another profile or medium, or the body goes
        deeper than the shape is known.

    Examples
    --------
    A flat punch on a medium that does not yield is a damped oscillator until its force is zero. At
    half of the critical damping, e = exp(−ζφ/√(1 − ζ²)) with tan φ = 2ζ√(1 − ζ²)/(2ζ² − 1):

    >>> from mdr_core import FlatPunch, Medium
    >>> hit = chain_impact(FlatPunch(radius=0.5), Medium(E_star=1.0, eta=0.25), 1.0, 1.0)
    >>> print(round(hit.restitution, 5))  # ζ = 1/2: exp(−2π/(3√3))
    0.29844
    """
    check_pair(profile, medium, "an impact on the chain")
    body = Body(profile, medium, mass, speed, _history(profile, medium, start))
    tolerance = _check.positive_number("tolerance", tolerance)
    count = None if n is None else element_count(n)
    room = body.room()
    # How deep the body comes, for the edges of the first run.
    depth = Flight(body, body.row(count or _ELEMENTS, room), _STEPS / 2, room).run().quantities[1]
    runs, limits = [], []
    for level in range(_RUNS):
        row = body.row(count or _ELEMENTS * 2**level, depth)
        runs.append(Flight(body, row, _STEPS * 2**level, room).run())
        fine, coarse = runs[-1].quantities, runs[max(level - 1, 0)].quantities
        depth = fine[1]
        limits.append(fine + (fine - coarse) / 3)
        if level > 1:
            # Errors of steps and elements may cancel by chance.
            before, last = (limit[:4] for limit in limits[-2:])
            changes = np.maximum(np.abs(last - before), np.abs(last - fine[:4]) * _TRUST)
            scale = np.append(1.0, np.abs(last[1:]))
            errors = Errors(*np.maximum(changes / scale, tolerance / 2).tolist())
            if max(errors.restitution, errors.max_depth) <= tolerance:
                break
    # Where next to nothing comes back, the limit may miss zero by its error.
    restitution, *others = limits[-1].tolist()
    values = max(0.0, restitution), *others
    return ChainImpact(
        profile, medium, body.mass, body.speed, *values, errors, runs[-1].foundation, runs[-1].motion
    )


def _history(profile, medium, start):
    """The moves that led to the foundation `start`, if it is one under this indenter on this medium."""
    if start is None:
        return ()
    if not isinstance(start, Foundation):
        raise TypeError(f"start must be a Foundation, as made by advance, got {type(start).__name__}")
    if start.profile != profile or start.medium != medium:
        raise ValueError(
            f"start is a foundation under {start.profile!r} on {start.medium!r}, which are not the profile "
            "and medium of this impact; give the same"
        )
    return start.history


class Errors(NamedTuple):
    """Estimated errors: of the coefficient of restitution, and of others relative to themselves."""

    restitution: float
    max_depth: float
    max_force: float
    contact_time: float


@dataclass(frozen=True, eq=False, repr=False)
class ChainImpact(ImpactResult):
    """One impact on the chain; made by `chain_impact`.

    Numbers are limits for vanishing steps and elements, from the last two runs, with estimates of
    their `errors`; if the number of elements is fixed, limits and errors of the steps alone.
    """

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    #: Coefficient of restitution, the speed of leaving over the speed of coming.
    restitution: float
    #: Largest indentation depth d_max (m), largest force (N), time (s) from first contact to the last one.
    max_depth: float
    max_force: float
    contact_time: float
    #: Elastic energy (J) at the turning point.
    stored_energy: float
    #: Energy (J) dissipated by yielding, and by the dashpots with what relaxing elements store at the end.
    plastic_work: float
    viscous_work: float
    #: Estimated errors of the first four of these numbers.
    errors: Errors
    #: The chain when contact ends: what a next body meets.
    foundation: Foundation = field(repr=False)
    _motion: Motion = field(repr=False)

    #: How it was found.
    model = CHAIN

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Where the model's assumptions end for this impact, as data."""
        return contact_limits(self.profile, self.medium, self.contact_radius)

    @property
    def error(self) -> float:
        """The error that the tolerance is for: of the restitution coefficient, and of the largest depth."""
        return max(self.errors.restitution, self.errors.max_depth)

    def motion(self, n: int | None = None) -> Motion:
        """The `Motion` of the finest run step by step, or at n equally spaced instants in between.

        Its ledger closes whatever the steps.
        """
        steps = replace(self._motion, impact=self)
        if n is None:
            return steps
        time = instants(n, steps.time[steps.turning_index], steps.time[-1], steps.time[0])
        columns = {name: values for name, values in steps.to_dict().items() if name != "time"}
        values = {name: np.interp(time, steps.time, column) for name, column in columns.items()}
        return Motion(time, **values, impact=self)

    @property
    def contact_radius(self) -> float:
        """Largest contact radius a (m)."""
        return self.profile.contact_radius(self.max_depth)

    @property
    def plastic_depth(self) -> float:
        """Plastic depth d_p (m) that remains."""
        return max(0.0, self.max_depth - self.medium.critical_depth)

    @property
    def plastic_radius(self) -> float:
        """Radius c (m) of the plastic zone that remains."""
        return self.profile.contact_radius(self.plastic_depth) if self.plastic_depth > 0 else 0.0
