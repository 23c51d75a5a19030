"""Impacts by the equation of motion: on a viscous medium, on a plate, and for comparison on others."""

from dataclasses import dataclass, field

import numpy as np

from ...base import check
from ...base.check import Array
from ...base.results import SCALAR_ODE
from ..applicability import check_reached, check_shape
from ..contact.indentation import Indentation
from ..contact.yielding import yield_rule
from ..medium.medium import Medium
from ..medium.structure import RIGID
from ..numerics.blocks import chunks
from .energy_balance import dry_impact, largest_force
from .equation_of_motion import ON_MEDIUM, ON_STRUCTURE, Bodies
from .motion_solver import ConvergenceError, solve
from .result import Impact

#: Errors of steps. On a plate a depth may have a small share in the work. Ten thousand critical depths
#: deep, the ledger has an error of 5·10⁻¹⁰ with the first tolerance, and of 3·10⁻¹² with the second.
_TOLERANCE = {ON_MEDIUM: 1e-5, ON_STRUCTURE: 1e-7}
#: Number of impacts solved at once. On a plate there are more kinds of steps, and fewer impacts in each:
#: 1000 elastic impacts of a paraboloid are 1.3 times as fast as in blocks of 256.
_TOGETHER = {ON_MEDIUM: 256, ON_STRUCTURE: 1024}
#: Least Λ = F₀/(Z v) at which a plate only follows the body.
_SOFT = 1e4


@dataclass(frozen=True, eq=False, repr=False)
class ViscousImpact(Impact):
    """Impacts solved by the equation of motion."""

    # As fields these hide the properties of the base class.
    restitution: Array = field()
    contact_time: Array = field()
    max_force: Array = field()
    viscous_work: Array = field()
    structure_work: Array = field()

    model = SCALAR_ODE

    @property
    def captured(self):
        """Whether the body never leaves: on a plate its velocity goes to 0 with the force."""
        return np.isinf(self.contact_time)


def viscous_impact(profile, medium, mass, speed, imprint_depth, structure=RIGID, in_time=False):
    """Solve impacts over imprints of given plastic depth (m).

    Without viscosity and without waves in the structure, the energy balance solves them, unless `in_time`
    is true. In a row with viscosity the structure is rigid.
    """
    dry = dry_impact(profile, medium, mass, speed, imprint_depth, structure)
    interval, increase = dry.turning_point.live_interval, dry.plastic_depth_increase
    penetration = np.where(interval.upper < np.inf, interval.length + increase, np.inf)
    if profile.shape:
        # With a wrong g′, or beyond the end of a table, steps do not end. One profile was checked before.
        check_shape(profile, interval.upper)
    bodies = Bodies.of(profile, medium, mass, speed, imprint_depth, penetration, structure)
    moving = (bodies.relaxation_time.reshape(mass.shape) > 0) | in_time
    on_structure = np.broadcast_to(structure.is_plate | structure.is_support, mass.shape)
    motions = np.zeros((4, *mass.shape))
    # An impact that is too deep raises an error later.
    balanced = ~moving & (penetration < np.inf)
    if balanced.any():
        remainder = dry[balanced]
        deceleration = remainder.max_force / remainder.mass
        work = np.zeros_like(deceleration)
        motions[:, balanced] = remainder.restitution, remainder.contact_time, work, deceleration
    penetrations = penetration.ravel()
    # A view, with one column for each impact.
    columns = motions.reshape(4, -1)
    for chosen, equations in (moving & ~on_structure, ON_MEDIUM), (moving & on_structure, ON_STRUCTURE):
        numbers = np.flatnonzero(chosen)
        for block in chunks(numbers.size, _TOGETHER[equations]):
            rows = numbers[block]
            try:
                penetrations[rows], columns[:, rows] = _solved(bodies[rows], equations)
            except ConvergenceError as error:
                # At the larger depths without losses, this check finds a faulty shape or law.
                check_reached(profile, medium, interval.upper)
                first = np.unravel_index(int(rows[error.rows][0]), mass.shape)
                soft = _soft(profile, medium, mass, speed, structure, first)
                _refuse_unsolved(error, rows[error.rows], speed, profile, interval.upper, soft)
    restitution, end_time, work, deceleration = motions
    rule = yield_rule(profile, medium)
    interval, increase = rule.turning(penetrations.reshape(mass.shape), imprint_depth)
    turning_point = Indentation(profile, medium, interval.upper, interval, in_time=True)
    force, work = mass * deceleration, 2 * medium.E_star * work
    if np.any(on_structure & moving) and np.all(interval.upper < np.inf):
        force = np.where(on_structure, largest_force(rule, turning_point, increase), force)
        plastic_work = 2 * medium.E_star * rule.plastic_integral(imprint_depth, increase)
        # The remaining energy of a body that never leaves goes into the waves.
        work = np.where(np.isinf(end_time), mass * speed**2 / 2 - plastic_work, work)
    return ViscousImpact(
        mass=mass[()],
        speed=speed[()],
        turning_point=turning_point,
        plastic_depth_increase=increase,
        restitution=check.frozen(np.minimum(restitution, 1.0)),
        contact_time=check.frozen(end_time),
        max_force=check.frozen(force),
        viscous_work=check.frozen(np.where(on_structure, 0.0, work)),
        structure_work=check.frozen(np.where(on_structure, work, 0.0)),
        structure=structure,
    )


def _soft(profile, medium, mass, speed, structure, index):
    """Return words on a plate that only follows the body at an index; empty if it does not.

    Λ = F₀/(Z v) compares the elastic force on a rigid body with the force of a plate at the body's speed.
    """
    shape = mass.shape
    profile, medium, structure = (each.entries(index, shape) for each in (profile, medium, structure))
    if not structure.is_plate:
        return ""
    m, v, impedance = (
        float(np.broadcast_to(each, shape)[index]) for each in (mass, speed, structure.impedance)
    )
    elastic = dry_impact(profile, Medium(medium.E_star), *(np.asarray(each) for each in (m, v, 0.0)))
    softness, deflection = float(elastic.max_force) / (impedance * v), m * v / impedance
    if softness < _SOFT:
        return ""
    thick = structure.thickness
    many = f"{deflection / thick:.3g} thicknesses" if thick else f"{deflection:.3g} m"
    return f"the plate follows the body, Λ = F₀/(Z v) = {softness:.3g}, and would be deflected by {many}"


def _refuse_unsolved(error, rows, speed, profile, depth, soft):
    """Raise an error for the unsolved impacts at some rows of the flattened ensemble.

    `depth` (m) is the depth without viscosity; `soft` has words on a plate that only follows the first
    body.
    """
    bad = np.zeros(speed.size, bool)
    bad[rows] = True
    one = profile.flat_entries(int(rows[0]), speed.shape)
    if not depth.flat[rows[0]] <= one.known_depth:
        bound, advice = f"presses {one.too_deep()}", "reduce speed or mass"
    elif soft:
        bound, advice = (
            f"has no solution: {soft}",
            "give the modes of the structure, or check its impedance",
        )
    else:
        bound = f"has no solution: {error}"
        advice = "check mass, eta and the structure, and the functions of a custom shape or law"
    raise check.InvalidEntries("speed", speed, bad.reshape(speed.shape), bound, "m/s", advice) from error


def _solved(bodies, equations):
    """Return penetrations (m); restitution, contact time, work over 2E*, largest deceleration (or 0)."""
    solution = solve(bodies, _TOLERANCE[equations], equations)
    end, endless = solution.end, solution.endless
    restitution = np.where(endless, 0.0, -end.velocity / bodies.speed)
    time = np.where(endless, np.inf, end.time)
    # On a structure, the equation does not give the deceleration of the body.
    deceleration = solution.max_deceleration if equations is ON_MEDIUM else np.zeros(len(time))
    values = restitution, time, end.work, deceleration[:, None]
    return solution.turning_point.depth[:, 0], np.hstack(values).T
