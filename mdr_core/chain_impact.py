"""Impact of a free rigid body on the chain: also with viscosity, and on what an earlier one has left."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from . import _check
from .flight import Run, fly, halved, pace
from .foundation import Foundation, check_pair, element_count
from .free_body import Body, reach
from .medium import Medium
from .model import CHAIN
from .profiles import Profile

#: Elements of the first run; every refinement takes twice as many, and half the steps in time.
_ELEMENTS = 150
_REFINEMENTS = 8
#: What the velocity at the end is right to at best, relative to itself.
_ROUNDING = 2e-15
#: The deepest that the chain can tell the critical depth from rounding, in critical depths.
_DEEPEST = 1e11


def chain_impact(profile, medium, mass, speed, *, start=None, n=None, tolerance=1e-6):
    """Let a body hit the chain of springs, dashpots and yield caps, with no other force acting.

    Newton's equation m v̇ = −F in steps of constant ḋ, along each of which every element is followed
    exactly; the force's impulse over a step is the body's change of momentum, so that what the body
    loses is what the elements store and dissipate. Contact ends when the last element lets go.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium, viscous or not.
    mass : float
        Mass m (kg), positive.
    speed : float
        Speed v₀ (m/s) at the start, positive.
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
        `errors`.

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
    check_pair(profile, medium)
    body = Body(profile, medium, mass, speed, _history(profile, medium, start))
    tolerance = _check.positive_number("tolerance", tolerance)
    bound = reach(body)
    if bound > _DEEPEST * medium.critical_depth:
        raise ValueError(
            f"speed = {body.speed:g} m/s presses down to {bound:g} m, over {_DEEPEST:g} critical depths, "
            "so that what springs back is lost in rounding; hit less hard, or use impact"
        )
    fixed = None if n is None else element_count(n)
    # To a number that is given none are added for the tip.
    row = body.row(fixed or _ELEMENTS, bound, tip=fixed is None)
    (legs, depth), runs, limits = pace(body, row, bound), [], []
    for level in range(_REFINEMENTS):
        legs = halved(legs)
        row = body.row(fixed or _ELEMENTS * 2**level, depth, tip=fixed is None)
        runs.append(fly(body, row, legs, bound))
        coarse, fine = (_quantities(runs[i]) for i in (max(level - 1, 0), level))
        depth = fine[1]
        limits.append(fine + (fine - coarse) / 3)
        scale = np.append(body.speed, np.abs(fine[1:]))
        errors = _errors(np.array(limits) / scale, fine / scale)
        # Where the contact ends the body is as fast as the elements are, but for rounding.
        errors[3] = max(errors[3], _ROUNDING * medium.relaxation_time / fine[3])
        # Steps and elements err against each other, so that changes may be small by chance.
        errors = Errors(*np.maximum(errors, tolerance / 2).tolist())
        if max(errors.restitution, errors.max_depth) <= tolerance:
            break
    return ChainImpact(profile, medium, body.mass, body.speed, errors, *runs[-2:])


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


def _quantities(run):
    """Velocity (m/s) at the end, largest depth (m) and force (N), contact time (s) of a run."""
    return np.array([run.motion.velocity[-1], np.max(run.motion.depth), run.max_force, run.contact_time])


def _errors(limits, finest):
    """Estimated errors of the last of some limits, given the finest run's own values.

    The limits are of fourth order where the motion is smooth. That is taken for granted ever more, but
    they are never trusted to be thirty times better than what they are made of; the first one only
    four times, in force and time rather worse, and never to the last digits: errors of steps and of
    elements may happen to cancel, and where τ outlasts the contact its end hangs on τ δv/v.
    """
    if len(limits) < 2:
        return np.full(finest.shape, np.inf)
    gained, changes = np.abs(limits[-1] - finest), np.abs(np.diff(limits, axis=0))
    if len(limits) == 2:
        return np.maximum(gained * [1 / 4, 1 / 4, 3, 4], 2e-6)
    if len(limits) == 3:
        return np.maximum(changes[-1], gained / 4)
    return np.maximum(np.maximum(changes[-1], changes[-2] / 8), gained / 30)


class Errors(NamedTuple):
    """Estimated errors: of the coefficient of restitution, and of others relative to themselves."""

    restitution: float
    max_depth: float
    max_force: float
    contact_time: float


@dataclass(frozen=True, eq=False)
class ChainImpact:
    """One impact on the chain; made by `chain_impact`.

    Numbers are limits for vanishing steps and elements, from the last two runs, with estimates of
    their `errors`; if the number of elements is fixed, limits and errors of the steps alone.
    """

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    errors: Errors
    _coarse: Run = field(repr=False)
    _fine: Run = field(repr=False)

    #: How it was found.
    model = CHAIN

    @property
    def error(self):
        """The error that the tolerance is for: of the restitution coefficient, and of the largest depth."""
        return max(self.errors.restitution, self.errors.max_depth)

    def motion(self):
        """The `Motion` of the finest run as it is, step by step; its ledger closes whatever the steps."""
        return self._fine.motion

    @property
    def foundation(self):
        """The chain when contact ends: what a next body meets."""
        return self._fine.foundation

    def _limit(self, value):
        coarse, fine = value(self._coarse), value(self._fine)
        return float(fine + (fine - coarse) / 3)

    @cached_property
    def max_depth(self):
        """Largest indentation depth d_max (m)."""
        return self._limit(lambda run: np.max(run.motion.depth))

    @cached_property
    def max_force(self):
        """Largest force (N)."""
        return self._limit(lambda run: run.max_force)

    @property
    def contact_radius(self):
        """Largest contact radius a (m)."""
        return self.profile.contact_radius(self.max_depth)

    @property
    def plastic_depth(self):
        """Plastic depth d_p (m) that remains."""
        return max(0.0, self.max_depth - self.medium.critical_depth)

    @property
    def plastic_radius(self):
        """Radius c (m) of the plastic zone that remains."""
        return self.profile.contact_radius(self.plastic_depth) if self.plastic_depth > 0 else 0.0

    @property
    def damaged_area(self):
        """Area π c² (m²) of the plastic zone."""
        return np.pi * self.plastic_radius**2

    @cached_property
    def restitution(self):
        """Coefficient of restitution, the speed of leaving over the speed of coming."""
        # Where next to nothing comes back, the limit may miss zero by its error.
        return max(0.0, -self._limit(lambda run: run.motion.velocity[-1]) / self.speed)

    @property
    def rebound_speed(self):
        """Speed e v₀ (m/s) at which the body leaves."""
        return self.restitution * self.speed

    @cached_property
    def contact_time(self):
        """Time (s) from first contact to the last one."""
        # Where it is all but unknown, the limit may lie anywhere.
        return max(self._limit(lambda run: run.contact_time), self._fine.contact_time / 2)

    @cached_property
    def plastic_work(self):
        """Energy (J) dissipated by yielding in this impact."""
        return self._limit(lambda run: run.motion.plastic_work[-1] - run.motion.plastic_work[0])

    @cached_property
    def viscous_work(self):
        """Energy (J) dissipated by the dashpots, with what relaxing elements still store at the end."""

        def lost(run):
            motion = run.motion
            return np.sum(motion.viscous_work[[-1, 0]] * [1, -1] + motion.stored_energy[[-1, 0]] * [1, -1])

        return self._limit(lost)
