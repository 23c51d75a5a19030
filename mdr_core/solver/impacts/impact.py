"""Impact of a free rigid body.

Without viscosity it is solved by the energy balance and quadrature, without time stepping. With viscosity
it is solved by the equation of motion.
"""

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ..applicability import check_pair, check_reached, refuse_adhesion, shape_with
from ..medium.medium import Medium
from ..medium.structure import Structure, structure_of
from ..profiles.profile import Profile
from .adhesive import adhesive_impact
from .energy_balance import dry_impact
from .modal import modal_impact
from .result import Impact
from .viscous import viscous_impact


@check.keywords_explained
def impact(
    profile: Profile,
    medium: Medium,
    mass: ArrayLike,
    speed: ArrayLike,
    *,
    plastic_depth: ArrayLike = 0.0,
    structure: Structure | None = None,
) -> Impact:
    """Solve the impact of a free body of given mass and speed on a medium.

    Contact starts at the bottom of the imprint (depth 0 on a virgin medium), and ends at zero force, with
    adhesion at the pull-off. Without viscosity the energy balance is solved, else the equation of motion.
    Eqs. (23), (24) of Popov (2015) are its limit for fast impacts, `Impact.fast_limit`.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium; viscous if `eta` is positive.
    mass, speed : float or array_like
        Mass m (kg), and speed v₀ (m/s) at first contact, positive.
    plastic_depth : float or array_like, optional
        Plastic depth (m) of a relaxed imprint of the same indenter; for repeated impacts, the
        `plastic_depth` of the previous impact. 0 (the default) is a virgin medium.
    structure : Structure, optional
        The plate, rod or support that carries the medium; by default the body behind the surface is at
        rest. A plate without edges is at rest again after an impact, before the next impact on the imprint.

    Returns
    -------
    Impact
        Quantities of the shape to which all arguments broadcast: one impact or a million.

    Raises
    ------
    ValueError
        If an argument is out of its range. If the indenter would go deeper than the known depth of its
        profile. If a `HardnessLaw` is invalid (negative, jumps) below the largest contact radius. On a
        structure, if the medium is viscous (`chain_impact` solves this case, but not with modes) or
        adhesive, or if the contact snaps on a support: its force falls with depth by more than the
        stiffness of the support.

    Examples
    --------
    Restitution of a cone whose largest depth is five times the critical depth:

    >>> from mdr_core import Cone, Medium, impact, indent
    >>> medium = Medium(E_star=1.0, q_c=1.0)
    >>> state = indent(Cone(slope=1.0), medium, 5 * medium.critical_depth)
    >>> energy = state.stored_energy + state.plastic_work
    >>> hit = impact(Cone(slope=1.0), medium, 2.0, energy**0.5)
    >>> print(round(hit.restitution, 9))
    0.461643536
    """
    return solve_impact(profile, medium, mass, speed, plastic_depth, structure)


def solve_impact(profile, medium, mass, speed, plastic_depth, structure=None, *, in_time=False):
    """Solve `impact`; with `in_time`, use the equation of motion also without viscosity."""
    check_pair(profile, medium)
    mass = check.positive("mass", mass, unit="kg")
    speed = check.positive("speed", speed, unit="m/s")
    imprint_depth = check.positive("plastic_depth", plastic_depth, unit="m", zero=True)
    values = {"mass": mass, "speed": speed, "plastic_depth": imprint_depth}
    structure = structure_of(structure)
    if structure.shape:
        values["structure"] = np.empty(structure.shape)
    shape = shape_with("impact", profile, medium, **values)
    if not structure.rigid:
        _refuse_losses(medium, structure, shape)
    mass, speed, imprint_depth = (np.broadcast_to(values, shape) for values in (mass, speed, imprint_depth))
    outside = imprint_depth > profile.known_depth
    if np.any(outside):
        bound, advice = f"is {_too_deep(profile, outside)}", "give a smaller plastic_depth"
        check.raise_if("plastic_depth", imprint_depth, outside, bound, unit="m", advice=advice)
    hit = _solved(profile, medium, mass, speed, imprint_depth, structure, in_time)
    check_reached(profile, medium, hit.turning_point.live_interval.upper)
    known = np.minimum(profile.known_depth, check.LONGEST)
    unknown = ~(hit.turning_point.live_interval.upper <= known)
    if np.any(unknown):
        bound, advice = f"presses {_too_deep(profile, unknown)}", "reduce speed or mass"
        check.raise_if("speed", speed, unknown, bound, unit="m/s", advice=advice)
    return hit


def _too_deep(profile, where):
    """Return words for the known depth of the first indenter of an ensemble at a mask."""
    return profile.flat_entries(int(np.argmax(where)), where.shape).too_deep()


def _refuse_losses(medium, structure, shape):
    """Raise an error for adhesion or viscosity of entries on a structure, or adhesion next to these."""
    on_structure = np.broadcast_to(
        structure.is_plate | structure.is_support | (structure.modes is not None), shape
    )
    work, quantity = np.broadcast_to(medium.work_of_adhesion, shape), "work of adhesion work_of_adhesion"
    bound, advice = "is not supported together with a structure", "set work_of_adhesion = 0"
    check.raise_if(quantity, work, (work > 0) & on_structure, bound, unit="J/m²", advice=advice)
    bound, advice = "is not supported together with entries on a structure", "solve these separately"
    check.raise_if(quantity, work, work > 0, bound, unit="J/m²", advice=advice)
    eta = np.broadcast_to(medium.eta, shape)
    bound = "is not supported together with a structure by `impact`"
    advice = "take chain_impact(…, structure=…), or set eta = 0"
    if structure.modes is not None:
        bound, advice = "is not supported together with a structure with modes", "set eta = 0"
    check.raise_if("viscosity eta", eta, (eta > 0) & on_structure, bound, unit="Pa·s", advice=advice)


def _solved(profile, medium, mass, speed, imprint_depth, structure, in_time):
    """Return the `Impact` by the solver for its medium; depths below the known depth are infinite."""
    if structure.modes is not None:
        return modal_impact(profile, medium, mass, speed, imprint_depth, structure)
    if np.any(np.asarray(medium.work_of_adhesion) > 0):
        if in_time:
            refuse_adhesion(medium, "an equation of motion")
        return adhesive_impact(profile, medium, mass, speed, imprint_depth)
    if in_time or np.any(np.asarray(medium.eta) > 0) or np.any(structure.is_plate):
        return viscous_impact(profile, medium, mass, speed, imprint_depth, structure, in_time)
    return dry_impact(profile, medium, mass, speed, imprint_depth, structure)
