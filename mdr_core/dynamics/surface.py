"""Motion along the surface of one oblique impact.

The normal motion does not depend on the tangential one, which has a closed form where all elements slip
throughout. Else it is solved by runs of `friction`, each with steps half as long as the last one.
"""

from dataclasses import dataclass, fields

import numpy as np

from .. import _check
from .._check import Array
from ..results.base import Entries
from .friction import RunQuantities, bound_ratio, slide, stick_instants
from .levels import MOST_LEVELS, levels

#: Relative error of the normal motion, and of closed forms that follow from it.
EXACT = 1e-9


@dataclass(frozen=True)
class SurfaceSolution(Entries):
    """Motion along the surface of one impact, or of many as arrays, with estimated errors.

    Change of the velocity over W₀, largest force (N), friction and viscous work (J) along the surface.
    Errors of works are relative to ½ m_t W₀². Closed forms have 0 `halvings` of the steps of the first run.
    """

    relative_change: Array
    max_force: Array
    friction_work: Array
    viscous_work: Array
    change_error: Array
    force_error: Array
    friction_error: Array
    viscous_error: Array
    halvings: Array
    slips_throughout: Array

    @classmethod
    def of(cls, solutions, shape):
        """Solutions of single impacts as arrays of a shape."""
        names = [field.name for field in fields(cls)]
        columns = {name: np.array([getattr(solution, name) for solution in solutions]) for name in names}
        return cls(**{name: _check.frozen(column.reshape(shape)) for name, column in columns.items()})


def solve_surface(hit, tolerance, tangential_speed, friction, tangential_mass):
    """The `SurfaceSolution` of one impact, in closed form where all elements slip throughout."""
    speed, kappa = abs(tangential_speed), float(hit.medium.tangential_ratio)
    stiffness, energy = 2 * kappa * float(hit.medium.E_star), tangential_mass * speed**2 / 2
    inertia, ratio = stiffness / tangential_mass, bound_ratio(hit, tangential_speed, friction)
    max_force = friction * float(hit.max_force)
    change = -friction * float(hit.mass) / tangential_mass * (1 + float(hit.restitution)) * float(hit.speed)
    slowest = friction / kappa * float(hit.speed)
    fast = speed >= slowest and speed + change >= -slowest * float(hit.restitution)
    slips = friction == 0 or (speed > 0 and fast)
    limit = error = RunQuantities(0.0, 0.0, 0.0, 0.0)
    halvings, viscous = 0, friction**2 / kappa * float(hit.viscous_work) if slips else 0.0
    if not slips or (hit.medium.eta > 0 and hit.plastic_work > 0 and friction > 0):
        limit, error, halvings = _limits(hit, inertia, ratio, tolerance)
        viscous = limit.viscous * stiffness * speed**2
    # The energy along the surface is 1/(2C) in the units of a run.
    viscous_error = error.viscous * 2 * inertia
    if slips:
        change = change / (speed or 1.0)
        friction_work = abs(change) * (2 + change) * energy - viscous
        change_error, force_error = EXACT * abs(change), EXACT
        friction_error = viscous_error = viscous_error + EXACT
    else:
        change, max_force = limit.change, min(limit.force * stiffness * speed, max_force) if speed else 0.0
        friction_work = limit.friction * stiffness * speed**2
        change_error, force_error = error.change, error.force / limit.force
        friction_error = error.friction * 2 * inertia
    errors = change_error, force_error, friction_error, viscous_error
    return SurfaceSolution(change, max_force, friction_work, viscous, *errors, halvings, slips)


def _limits(hit, inertia, ratio, tolerance):
    """Limits of `RunQuantities` for vanishing steps, their estimated errors, and the number of halvings."""
    run, last_limit = slide(hit, levels(hit, inertia, 0), inertia, ratio), None
    for halvings in range(1, 8):
        # The instants at which stick begins are known from the last run.
        grid = levels(hit, inertia, halvings, stick_instants(hit, run, ratio))
        coarse, run = run.quantities, slide(hit, grid, inertia, ratio)
        if halvings == 1:
            continue
        fine = np.array(run.quantities)
        limit = fine + (fine - coarse) / 3
        errors = np.abs(limit - fine) * (0.5 if last_limit is None else 0.1)
        if last_limit is not None:
            errors = np.maximum(errors, np.abs(limit - last_limit))
        last_limit = limit
        _, force, friction, viscous = limit
        # Work counts relative to itself, or to a hundredth of the energy along the surface, 1/(2C).
        smallest = 0.005 / inertia
        scale = np.array([1.0, force, max(friction, smallest), max(friction + viscous, smallest)])
        errors = np.maximum(errors, tolerance / 2 * scale)
        if np.all(errors <= tolerance * scale) or 2 * grid.depth.size > MOST_LEVELS:
            break
    change, *positive = limit
    return RunQuantities(change, *np.maximum(positive, 0.0)), RunQuantities(*errors), halvings
