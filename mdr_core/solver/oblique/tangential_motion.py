"""Motion along the surface of one oblique impact.

The normal motion does not depend on the tangential motion. The tangential motion has a closed form if all
elements slip throughout. Otherwise it is solved by runs, each with half the step size of the last run:
`dry_friction` solves many impacts without viscosity at a time, `viscous_friction` one viscous impact.
"""

from dataclasses import dataclass, fields

import numpy as np

from ...base import check, lazy
from ...base.check import Array
from ...base.results import Entries
from .dry_friction import solve_dry
from .dry_levels import NormalMotions
from .viscous_friction import MOST_LEVELS, SLOWEST, RunQuantities, bound_ratio, levels, slide

#: Relative error of the normal motion, and of closed forms from it.
EXACT = 1e-9


@dataclass(frozen=True)
class SurfaceSolution(Entries):
    """Motion along the surface of one impact, or of many as arrays, with estimated errors.

    `relative_change` is the change of the velocity over v_t0. Force (N) and works (J) are along the
    surface. Errors of works are relative to ½ m_t v_t0², and `tolerance` applies to the velocity.
    `halvings` is the number of halvings of the steps, 0 for closed forms.
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
    tolerance: Array


def solve_surface(hit, tolerance, tangential_speed, friction, tangential_mass):
    """Return the `SurfaceSolution` of impacts, in closed form if all elements slip throughout.

    The arguments are arrays of the shape of the normal `Impact`.
    """
    shape, names = hit.shape, [field.name for field in fields(SurfaceSolution)]
    speed, friction, tangential_mass = _flat(hit, np.abs(tangential_speed), friction, tangential_mass)
    eta, plastic_work = _flat(hit, hit.medium.eta, hit.plastic_work)
    columns = slip_throughout(hit, speed, friction, tangential_mass)
    slips = columns["slips_throughout"]
    viscous = (eta > 0) & (~slips | ((plastic_work > 0) & (friction > 0)))
    rows = np.flatnonzero(viscous)
    for place in lazy.progress.tracked_chunks(rows.size, 1, "viscous impacts"):
        (row,) = rows[place]
        one = hit[np.unravel_index(row, shape)] if shape else hit
        values = _viscous(one, tolerance, speed[row], friction[row], tangential_mass[row])
        if slips[row]:
            # Only the viscous share of the work has no closed form.
            values = {name: values[name] for name in ("viscous_work", "viscous_error", "halvings")}
            both = columns["friction_work"][row] + columns["viscous_work"][row]
            values["friction_work"] = both - values["viscous_work"]
            values["friction_error"] = values["viscous_error"] = values["viscous_error"] + EXACT
        for name, value in values.items():
            columns[name][row] = value
    rows = np.flatnonzero((eta == 0) & ~slips)
    if rows.size:
        values = _dry(hit, rows, tolerance, speed[rows], friction[rows], tangential_mass[rows])
        for name, value in values.items():
            columns[name][rows] = value
    columns["tolerance"] = np.full(speed.size, float(tolerance))
    return SurfaceSolution(**{name: check.frozen(columns[name].reshape(shape)) for name in names})


def _flat(hit, *values):
    """Return values of impacts as flat arrays."""
    return (np.broadcast_to(value, hit.shape).ravel() for value in values)


def slip_throughout(hit, speed, friction, tangential_mass):
    """Return fields of a `SurfaceSolution` as flat arrays, valid if all elements slip throughout."""
    normal_speed, restitution, mass = _flat(hit, hit.speed, hit.restitution, hit.mass)
    given = hit.max_force, hit.viscous_work, hit.medium.tangential_ratio
    max_force, viscous_work, kappa = _flat(hit, *given)
    with np.errstate(invalid="ignore"):
        change = -friction * mass / tangential_mass * (1 + restitution) * normal_speed
        slowest = friction / kappa * normal_speed
        fast = (speed >= slowest) & (speed + change >= -slowest * restitution)
        slips = (friction == 0) | ((speed > 0) & fast)
        share = np.where(slips, change / np.where(speed > 0, speed, 1.0), 0.0)
        viscous = np.where(slips, friction**2 / kappa * viscous_work, 0.0)
    exact = np.full(speed.size, EXACT)
    return {
        "relative_change": share,
        "max_force": friction * max_force,
        "friction_work": np.abs(share) * (2 + share) * tangential_mass * speed**2 / 2 - viscous,
        "viscous_work": viscous,
        "change_error": EXACT * np.abs(share),
        "force_error": exact,
        "friction_error": exact.copy(),
        "viscous_error": exact.copy(),
        "halvings": np.zeros(speed.size, int),
        "slips_throughout": slips,
    }


def _dry(hit, rows, tolerance, speed, friction, tangential_mass):
    """Return fields of impacts at flat rows without viscosity, in which some elements stick."""
    given = hit.medium.tangential_ratio, hit.medium.E_star, hit.speed, hit.max_force
    kappa, E_star, normal_speed, max_force = (value[rows] for value in _flat(hit, *given))
    motions = NormalMotions.of(hit, rows)
    # Without speed, as for the friction at which everything sticks.
    slowest = SLOWEST * normal_speed
    velocity = np.maximum(kappa * speed / friction, slowest)
    inertia = 2 * kappa * E_star / tangential_mass
    after, force, change_error, force_error, halvings = solve_dry(motions, inertia, velocity, tolerance)
    # Friction dissipates energy, so that no step may increase it.
    remaining = np.clip(after / velocity, -1.0, 1.0)
    change_error = np.minimum(change_error, 1 + np.abs(remaining))
    force = np.minimum(2 * kappa * E_star * speed / velocity * force, friction * max_force)
    return {
        "relative_change": remaining - 1,
        "max_force": np.where(speed > 0, force, 0.0),
        "friction_work": tangential_mass * speed**2 / 2 * np.maximum(1 - remaining**2, 0.0),
        "change_error": change_error,
        "force_error": force_error,
        "friction_error": np.minimum(change_error * (2 * np.abs(remaining) + change_error), 1.0),
        "viscous_error": np.zeros(rows.size),
        "halvings": halvings,
    }


def _viscous(hit, tolerance, speed, friction, tangential_mass):
    """Return fields of one viscous impact, in which some elements stick."""
    stiffness = 2 * float(hit.medium.tangential_ratio) * float(hit.medium.E_star)
    inertia, ratio = stiffness / tangential_mass, bound_ratio(hit, speed, friction)
    limit, error, halvings = _limits(hit, inertia, ratio, tolerance)
    # The energy along the surface is 1/(2C) in the units of a run.
    return {
        "relative_change": limit.change,
        "max_force": min(limit.force * stiffness * speed, friction * float(hit.max_force))
        if speed
        else 0.0,
        "friction_work": limit.friction * stiffness * speed**2,
        "viscous_work": limit.viscous * stiffness * speed**2,
        "change_error": error.change,
        "force_error": error.force / limit.force,
        "friction_error": error.friction * 2 * inertia,
        "viscous_error": error.viscous * 2 * inertia,
        "halvings": halvings,
    }


def _limits(hit, inertia, ratio, tolerance):
    """Return limits of `RunQuantities` for vanishing steps, their estimated errors, and the halvings."""
    run = slide(hit, levels(hit, inertia, 1), inertia, ratio)
    for halvings in range(2, 8):
        grid, coarse = levels(hit, inertia, halvings), np.array(run.quantities)
        run = slide(hit, grid, inertia, ratio)
        limit = run.quantities + (run.quantities - coarse) / 3
        errors = np.abs(limit - run.quantities)
        _, force, friction, viscous = limit
        # Errors of work are relative to it, or to a hundredth of the energy along the surface, 1/(2C).
        smallest = 0.005 / inertia
        scale = np.array([1.0, force, max(friction, smallest), max(friction + viscous, smallest)])
        errors = np.maximum(errors, tolerance / 2 * scale)
        if np.all(errors <= tolerance * scale) or 2 * grid.depth.size > MOST_LEVELS:
            break
    change, *positive = limit
    return RunQuantities(change, *np.maximum(positive, 0.0)), RunQuantities(*errors), halvings
