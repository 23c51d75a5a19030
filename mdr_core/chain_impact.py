"""Impact of a free rigid body on the chain: also with viscosity, and on what an earlier one has left."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import _check
from .free_body import Body, Motion, fly, halved, pace, reach
from .medium import Medium
from .model import CHAIN
from .profiles import Profile

#: Elements of the first run; every refinement takes twice as many, and half the steps in time.
_ELEMENTS = 100
_REFINEMENTS = 8
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
        A fixed number of elements; by default as many as the tolerance needs.
    tolerance : float, optional
        Error allowed in the restitution coefficient, and in the largest depth relative to itself;
        positive. Elements and time steps are refined until the estimate is less, or eight times.

    Returns
    -------
    ChainImpact
        With the estimate reached, as `error`.

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
    body = Body(profile, medium, mass, speed, _history(profile, medium, start))
    tolerance = _check.positive_number("tolerance", tolerance)
    bound = reach(body)
    if bound > _DEEPEST * medium.critical_depth:
        raise ValueError(
            f"speed = {body.speed:g} m/s presses down to {bound:g} m, over {_DEEPEST:g} critical depths, "
            "so that what springs back is lost in rounding; hit less hard, or use impact"
        )
    motion = pace(body, body.row(n or _ELEMENTS, bound), bound)
    scale = float(np.max(np.abs(motion.depth)))
    legs, hits, values = motion.legs, [], []
    for level in range(_REFINEMENTS):
        legs = halved(legs) if level else legs
        row = body.row(n or _ELEMENTS * 2**level, float(np.max(motion.depth)))
        motion = fly(body, row, legs, bound, tolerance)
        hits.append(motion)
        reached = [_reached(motion, body.speed, scale) for motion in hits[-2:]]
        values.append(reached[-1] + (reached[-1] - reached[0]) / 3)
        error = _error(values, reached[-1])
        if error <= tolerance:
            break
    return ChainImpact(profile, medium, body.mass, body.speed, error, *hits[-2:])


def _history(profile, medium, start):
    """The moves that led to the foundation `start`, if it is one under this indenter on this medium."""
    if start is None:
        return ()
    if start.profile != profile or start.medium != medium:
        raise ValueError(
            f"start is a foundation under {start.profile!r} on {start.medium!r}, which are not the profile "
            "and medium of this impact; give the same"
        )
    return start.history


def _reached(motion, speed, scale):
    """Velocity at the end and largest depth of a run, in units of a speed (m/s) and a depth (m)."""
    return np.array([motion.velocity[-1] / speed, np.max(motion.depth) / scale])


def _error(values, finest):
    """Estimated error of the last of the limits `values`, given the finest run's own value.

    The limits are of higher order than two, but never trusted to be thirty times better than what
    they are made of.
    """
    if len(values) < 2:
        return np.inf
    gained = np.max(np.abs(values[-1] - finest))
    return float(
        max(np.max(np.abs(values[-1] - values[-2])), gained / 30) if len(values) > 2 else gained / 4
    )


@dataclass(frozen=True, eq=False)
class ChainImpact:
    """One impact on the chain; made by `chain_impact`.

    Numbers are limits for vanishing steps and elements, from the last two runs; `error` is the
    estimated error of the restitution coefficient and of the largest depth, relative to itself.
    `motion` is the finest run as it is, whose ledger closes whatever the steps.
    """

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    error: float
    _coarse: Motion
    _fine: Motion

    #: How it was found.
    model = CHAIN

    def motion(self):
        """Time, depth, velocity, force and the energies of the finest run, step by step."""
        return self._fine

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
        return self._limit(lambda motion: np.max(motion.depth))

    @property
    def max_force(self):
        """Largest force (N) of the finest run."""
        return float(np.max(self._fine.force))

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
        return max(0.0, -self._limit(lambda motion: motion.velocity[-1]) / self.speed)

    @property
    def rebound_speed(self):
        """Speed e v₀ (m/s) at which the body leaves."""
        return self.restitution * self.speed

    @cached_property
    def contact_time(self):
        """Time (s) from first contact to the last one."""
        return self._limit(lambda motion: motion.time[-1] - motion.met)

    @cached_property
    def plastic_work(self):
        """Energy (J) dissipated by yielding in this impact."""
        return self._limit(lambda motion: motion.plastic_work[-1] - motion.plastic_work[0])

    @cached_property
    def viscous_work(self):
        """Energy (J) dissipated by the dashpots, with what relaxing elements still store at the end."""

        def lost(motion):
            return np.sum(motion.viscous_work[[-1, 0]] * [1, -1] + motion.stored_energy[[-1, 0]] * [1, -1])

        return self._limit(lost)
