"""Impact of a free rigid body on the chain, also with viscosity, and on the imprint of earlier impacts.

Each run has twice the elements and half the step size of the previous run; both errors are of second order.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...base import check, lazy
from ...base.motions import ImpactResult, Motion, instants
from ...base.results import CHAIN, Limit
from ..applicability import check_pair, check_reached, refuse_adhesion
from ..medium.medium import Medium
from ..medium.structure import Structure, structure_of
from ..profiles.profile import Profile
from .cap import plastic_depth
from .foundation import Foundation, foundation_of
from .free_body import ImpactSolver, impact_depth_bound, row_before
from .refinement import refine
from .row import NarrowRow, element_count

#: Elements, and steps per time scale, of the coarsest run; number of runs.
_ELEMENTS, _STEPS, _RUNS = 150, 12, 8
#: Refined quantities, and their smallest errors as a share of the correction by extrapolation.
_TRUST = {
    "restitution": 0.1, "max_depth": 0.2, "max_force": 2.0, "contact_time": 1.0,
    "stored_energy": 0.0, "plastic_work": 0.0, "viscous_work": 0.0, "structure_work": 0.0,
}  # fmt: skip


@check.keywords_explained
def chain_impact(
    profile: Profile,
    medium: Medium,
    mass: float,
    speed: float,
    *,
    start: Foundation | None = None,
    structure: Structure | None = None,
    n: int | None = None,
    tolerance: float = 1e-6,
) -> "ChainImpact":
    """Solve the impact of a free body on the chain of springs with yield cap and dashpots.

    Parameters
    ----------
    profile, medium
        The indenter, and the medium, with or without viscosity.
    mass, speed : float
        Mass m (kg), and speed v₀ (m/s) at the start, positive.
    start : Foundation, optional
        The foundation before the impact, at the starting depth of the body; by default undeformed at first
        contact. The solver repeats its moves on its own grids.
    structure : Structure, optional
        The plate, rod or support that carries the medium, which may be viscous; by default the body behind
        the surface is at rest.
    n : int, optional
        A fixed number of elements, without an estimate of their error; by default it is refined.
    tolerance : float, optional
        Largest error of the rebound speed relative to `speed`, and of the largest depth relative to itself;
        positive. Elements and steps are refined until it is reached, at most seven times.

    Returns
    -------
    ChainImpact
        The result, with the estimated `error`, and estimates for each quantity in `errors`. They hold for
        relaxation times up to 10³ contact times.

    Raises
    ------
    ValueError
        If mass or speed is not positive, `start` has another profile or medium, the largest depth exceeds
        the known depth of the profile, or a `HardnessLaw` is invalid below the largest contact radius.

    Examples
    --------
    A flat punch on a medium that does not yield is a damped oscillator until its force is zero. At half of
    the critical damping, e = exp(−ζφ/√(1 − ζ²)) with tan φ = 2ζ√(1 − ζ²)/(2ζ² − 1):

    >>> from mdr_core import FlatPunch, Medium, chain_impact
    >>> hit = chain_impact(FlatPunch(radius=0.5), Medium(E_star=1.0, eta=0.25), 1.0, 1.0)
    >>> print(round(hit.restitution, 5))  # ζ = 1/2: exp(−2π/(3√3))
    0.29844
    """
    check_pair(profile, medium, "an impact on the chain")
    structure = structure_of(structure)
    if structure.shape:
        raise check.MDRError(
            "an impact on the chain needs a single structure, not parameters of shape "
            f"{structure.shape}: take one at a time, for example structure.entries(i)"
        )
    if structure.modes is not None:
        raise check.MDRError("an impact on the chain does not support modes of a structure; take impact(…)")
    refuse_adhesion(medium, "an impact on the chain")
    mass = check.positive_number("mass", mass, unit="kg")
    speed = check.positive_number("speed", speed, unit="m/s")
    tolerance = check.positive_number("tolerance", tolerance)
    count, history = None if n is None else element_count(n), _history(profile, medium, start)
    if medium.has_own_law and medium.eta == 0:
        # Without dashpots the body goes at least as deep as on an elastic medium, whose bound adds 5 %.
        elastic = impact_depth_bound(profile, Medium(medium.E_star), mass, speed, history) / 1.1
        check_reached(profile, medium, elastic)
    bound = impact_depth_bound(profile, medium, mass, speed, history)

    def solve(elements, depth, steps):
        row = row_before(profile, medium, history, count or elements, depth)
        try:
            return ImpactSolver(row, mass, speed, steps, bound, structure, depth).solved()
        except NarrowRow:
            if depth == bound:
                raise
            # If the force jumps at yield, a coarse run on a support may end far above the largest depth.
            return solve(elements, bound, steps)

    # A first run determines the largest depth; the next run has an edge at its radius.
    runs = [solve(_ELEMENTS, bound, _STEPS / 2)]

    def run(level):
        runs.append(solve(_ELEMENTS * 2**level, runs[-1].motion.depth.max(), _STEPS * 2**level))
        return np.array([runs[-1].quantities[name] for name in _TRUST])

    trust = np.array([*_TRUST.values()])
    # Errors are relative to the quantity itself, for the restitution (rebound over impact speed) to 1.
    floor = np.array([1.0 if name == "restitution" else 0.0 for name in _TRUST])
    limit, errors = refine(run, tolerance, _RUNS, 2, orders=(2,), runs=3, trust=trust, floor=floor)
    quantities = dict(zip(_TRUST, limit.tolist(), strict=True))
    check_reached(profile, medium, quantities["max_depth"])
    errors = dict(zip(_TRUST, errors.tolist(), strict=True))
    error = max(errors["restitution"], errors["max_depth"])
    # Close to zero, the limit may be negative within its error.
    restitution = quantities["restitution"] = max(0.0, quantities["restitution"])
    if runs[-1].endless:
        quantities["contact_time"], errors["contact_time"] = np.inf, 0.0
    errors["restitution"] = errors["restitution"] / restitution if restitution > 0 else np.inf
    errors = ChainErrors(**{name: errors[name] for name in ChainErrors._fields})
    return ChainImpact(
        profile, medium, mass, speed, structure, **quantities, error=error, errors=errors,
        foundation=foundation_of(runs[-1].row), _motion=runs[-1].motion,
    )  # fmt: skip


def _history(profile, medium, start):
    """Return the moves of the foundation `start`; raise an error if its profile or medium differ."""
    if start is None:
        return ()
    if not isinstance(start, Foundation):
        raise TypeError(f"start must be a Foundation, as made by advance, got {type(start).__name__}")
    if start.profile != profile or start.medium != medium:
        raise check.MDRError(
            f"start is a foundation under {start.profile!r} on {start.medium!r}, which differ from the "
            "profile and medium of this impact: give the same profile and medium"
        )
    return start.history


class ChainErrors(NamedTuple):
    """Estimated errors of a `ChainImpact`, each relative to the quantity; infinite if it is zero."""

    restitution: float
    max_depth: float
    max_force: float
    contact_time: float


@dataclass(frozen=True, eq=False, repr=False)
class ChainImpact(ImpactResult):
    """One impact on the chain; returned by `chain_impact`.

    Quantities are limits for vanishing steps and elements. For a fixed number of elements, limits and
    errors concern the steps alone.

    Examples
    --------
    >>> from mdr_core import Medium, Paraboloid, chain_impact
    >>> hit = chain_impact(Paraboloid(radius=1.0), Medium(E_star=1.0), mass=1.0, speed=0.1)
    >>> print(abs(hit.restitution - 1) <= hit.errors.restitution)
    True
    """

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    #: The structure that carries the medium; rigid by default.
    structure: Structure
    #: Coefficient of restitution, rebound speed over impact speed.
    restitution: float
    #: Largest indentation depth d_max (m), largest force (N), time (s) from first contact to its end.
    max_depth: float
    max_force: float
    contact_time: float
    #: Elastic energy (J) at the turning point.
    stored_energy: float
    #: Energies (J) dissipated by yielding, and by the dashpots including the final relaxation.
    plastic_work: float
    viscous_work: float
    #: Energy (J) that waves of the structure carry away.
    structure_work: float
    #: Estimated error, which the tolerance bounds: the larger error of rebound speed (over `speed`) and of
    #: the largest depth.
    error: float
    errors: ChainErrors
    #: The foundation at the end of contact; another impact may start from it.
    foundation: Foundation = field(repr=False)
    _motion: Motion = field(repr=False)

    model = CHAIN

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model's assumptions for this impact."""
        return lazy.limits.chain_limits(self)

    @property
    def captured(self) -> bool:
        """Whether the body never leaves, because a plate damps it to rest in the contact."""
        return bool(np.isinf(self.contact_time))

    def motion(self, n: int | None = None) -> Motion:
        """Return the `Motion` of the finest run at every step, or interpolated at n instants.

        The n instants are equally spaced before the turning point, and again after it. The sum of the
        energies is the initial energy for every step size.
        """
        steps = replace(self._motion, impact=self)
        if n is None:
            return steps
        time = instants(n, steps.time[steps.turning_index], steps.time[-1], steps.time[0])
        values = {name: np.interp(time, steps.time, column) for name, column in steps.to_dict().items()}
        return Motion(**(values | {"time": time}), impact=self)

    @property
    def contact_radius(self) -> float:
        """Largest contact radius a (m)."""
        return self.profile.contact_radius(self.max_depth)

    @property
    def plastic_depth(self) -> float:
        """Plastic depth d_p (m) after the impact."""
        return float(plastic_depth(self.profile, self.medium, self.max_depth))

    @property
    def plastic_radius(self) -> float:
        """Plastic radius c (m) after the impact."""
        return self.profile.contact_radius(self.plastic_depth) if self.plastic_depth > 0 else 0.0
