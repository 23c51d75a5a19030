"""Limits of the model for a result, as data and in words."""

import numpy as np

from ..base import check
from ..base.results import Limit, Limits
from ..solver.impacts.scaling import MAX_ERROR, depth_in_fast_limit
from ..solver.own.law import law_numbers
from ..solver.profiles.power import Cone
from ..solver.profiles.sampled import Sampled, bent_vertices
from .quantities import engineering
from .structure_limits import structure_limits

#: Largest slope for good results, largest slope for estimates, and slope above which a mistake is likely.
_SMALL = 0.3
_STEEP = 0.5
_NEEDLE = 3.0
#: Largest contact radius over the radius of the body, and largest speed over the wave speed.
_BODY = 0.5
_SLOW = 0.1
#: Smallest Tabor parameter with adhesion at the rim alone, and the range (m) of surface forces.
_TABOR = 5.0
_RANGE = 0.3e-9
#: Largest relative error of the pull-off force due to facets.
_FACETS = 0.02
#: Largest values at which errors of stick were measured (tests/benchmarks/oblique.py): depth over the
#: largest elastic compression of an element at this depth, and mass over tangential mass.
_DEEP = 1e3
_LIGHT = 10.0
#: Range of the effective moduli (Pa) of real media.
_SOFTEST = 1e3
_STIFFEST = 1e13
#: Range of H/E* of real media, and smallest d(a σ_c)/da over σ_c of a contact that flows.
_SOFT, _HARD, _FLOWS = 1e-5, 0.3, 0.5
#: Size (m) of an atom: no medium yields at a smaller depth.
_ATOM = 1e-10


def contact_limits(profile, medium, radius, *, slow=False):
    """Return the limits of contacts of radii up to `radius` (m).

    With `slow`, the dashpots carry no force.
    """
    limits = [_slope_limit(profile, radius), *_body_limit(profile, radius)]
    if np.any(np.asarray(medium.eta) > 0):
        limits.extend(_viscosity_limit(medium) if slow else _poisson_limit(medium))
    limits.extend(_modulus_limit(medium))
    limits.extend(_critical_depth_limit(medium))
    limits.extend(_hardness_limit(medium))
    limits.extend(_flow_limit(profile, medium, radius))
    return Limits((*limits, *_tabor_limit(profile, medium), *_facet_limit(profile, medium)))


def _slope_limit(profile, radius):
    """Return the limit for the slope within the contact: at its edge, or the mean up to the edge."""
    a = np.asarray(radius) if profile.shape else np.max(radius, initial=0.0)
    height = profile.height_at(a)
    inside = profile.height_at(a * (1 - 1e-6))
    with np.errstate(divide="ignore", invalid="ignore"):
        edge = (height - inside) / (1e-6 * a)
        slope = np.where(a > 0, np.fmax(edge, height / a), 0.0)
    # The difference has nine digits.
    value = float(f"{np.max(slope, initial=0.0):.9g}")
    text = f"Slopes reach {value:.3g} within the contact"
    if value > _NEEDLE and isinstance(profile, Cone):
        text += (
            ": the half-space approximation does not hold for such a needle. The slope is the "
            "cotangent of the half-angle: check that the slope is not an angle, and that a half-angle "
            "is in degrees, not in radians."
        )
    elif value >= 1:
        text += ": the approximation of small slopes does not hold."
    elif value > _SMALL:
        text += f": the approximation of small slopes is good to about s² = {100 * value**2:.2g} %."
    else:
        text += ", which is small."
    return Limit("slope", value, _SMALL, value > _SMALL, text, severe=value > _STEEP)


def _body_limit(profile, radius):
    """Yield the limit for the contact radius over the radius of the body, if the profile has a radius."""
    if np.all(profile.body_radius == np.inf):
        return
    value = float(np.max(radius / profile.body_radius, initial=0.0))
    text = f"The contact radius reaches {value:.3g} R"
    if value >= 1:
        text += ", beyond the equator of the body: check that depth and radius are in m."
    elif value > _BODY:
        text += f"; the half-space approximation is good up to about {_BODY:g} R."
    else:
        text += "."
    yield Limit("contact radius", value, _BODY, value > _BODY, text)


def _modulus_limit(medium):
    """Yield a limit for a modulus beyond those of real media, for example in GPa instead of Pa."""
    softest = float(np.min(medium.E_star, initial=np.inf))
    stiffest = float(np.max(medium.E_star, initial=0.0))
    text = "The effective modulus E* is {}: check that it is given in Pa."
    if softest < _SOFTEST:
        yield Limit("modulus", softest, _SOFTEST, True, text.format(engineering(softest, "Pa")))
    if stiffest > _STIFFEST:
        yield Limit("modulus", stiffest, _STIFFEST, True, text.format(engineering(stiffest, "Pa")))


def _critical_depth_limit(medium):
    """Yield a limit for a critical depth below the size of an atom, for example from q_c in other units."""
    if not medium.inverse_to_radius:
        return
    depths, q_c = np.broadcast_arrays(medium.critical_depth, medium.q_c)
    # The critical depth is NaN for curves without a fit.
    small = depths < _ATOM
    if not np.any(small):
        return
    least, q_c = float(np.min(depths[small])), float(np.min(q_c[small]))
    text = (
        f"The critical depth π q_c/(2E*) is {engineering(least, 'm')}, less than an atom (0.1 nm), so "
        f"the medium carries almost no force: check that q_c = {q_c:.3g} is a yield constant in N/m."
    )
    yield Limit("critical depth", least, _ATOM, True, text)


def _hardness_limit(medium):
    """Yield a limit for H/E* beyond real media, if H is the only hardness constant.

    Fused silica has H/E* = 0.16.
    """
    hardness = np.asarray(0.0 if medium.has_own_law else medium.hardness)
    ratio = hardness / medium.E_star
    alone = (ratio > 0) & ~(np.asarray(medium.q_c) + np.asarray(medium.f_c) > 0)
    for bad, bound, what in (
        (alone & (ratio < _SOFT), _SOFT, "less than for any medium"),
        (alone & (ratio > _HARD), _HARD, "more than for any medium"),
    ):
        if np.any(bad):
            value, given, _ = (part[bad][0] for part in np.broadcast_arrays(ratio, hardness, bad))
            text = (
                f"The hardness H = {given:.4g} Pa is {value:.2g} E*, {what} ({_SOFT:g} to {_HARD:g}): "
                "check that H and E* are given in Pa."
            )
            yield Limit("hardness", float(value), bound, True, text)


def _flow_limit(profile, medium, radius):
    """Yield the ratio of the contact area with plastic flow to the contact area of this model.

    A contact flows if a σ_c grows with a, as for H, but not if q_c/a or f_c/a² dominates the hardness. The
    ratio of d(a σ_c)/da to σ_c is 1 for H, 0 for q_c/a and −1 for f_c/a².
    """
    reached = np.asarray(radius) > 0
    a = np.where(reached, radius, 1.0)
    with np.errstate(invalid="ignore"):
        share = law_numbers(medium.law, "line_load_rate", a) / law_numbers(medium.law, "at", a)
    if not np.any(reached & (share > _FLOWS)):
        return
    text, value = "On loading the model has the contact radius of an elastic contact", 2.0
    if isinstance(profile, Cone):
        value = np.pi**2 / 4
        text += ". With plastic flow the radius is π/2 times as large, and the area 2.5 times."
    elif np.all(profile.body_radius < np.inf):
        text += ", a² = R d under a ball. With plastic flow a² = 2 R d."
        if not medium.has_own_law:
            text += (
                " Under a ball yield starts at a mean pressure of 2H/3, and the restitution is about 0.7 "
                "times the value of Johnson's law for metals."
            )
    else:
        text += ". With plastic flow the radius is larger, and the area under a ball is twice as large."
    yield Limit("flow", value, 1.0, True, text, severe=False)


def _tabor_limit(profile, medium):
    """Yield the limit for Tabor's parameter, if the medium is adhesive and the tip is curved."""
    w = np.asarray(medium.work_of_adhesion)
    curvature = _tip_radius(profile) if np.any(w > 0) else None
    if curvature is None:
        return
    with np.errstate(divide="ignore"):
        tabor = np.min(np.where(w > 0, np.cbrt(curvature * (w / medium.E_star) ** 2 / _RANGE**3), np.inf))
    text = (
        f"Tabor's parameter (R w²/(E*² z₀³))^(1/3) is {tabor:.3g} for surface forces of range z₀ = 0.3 nm"
    )
    text += ": below 5 the attraction outside the contact is not negligible." if tabor < _TABOR else "."
    yield Limit("Tabor's parameter", float(tabor), _TABOR, bool(tabor < _TABOR), text)


def _facet_limit(profile, medium):
    """Estimate the relative error of the pull-off force due to samples of a smooth tip, with adhesion.

    At pull-off a ḡ′ = 3Δl/2 with the mean slope ḡ′ of a facet. The inner vertex of the facet, of radius r
    and bend β, bows g by up to β √(2rh)/4 over the length h of the facet. This deviation times a is a force
    over 2E*; the pull-off force over 2E* is about a Δl/2.
    """
    ratio = np.ravel(medium.work_of_adhesion / medium.E_star)
    ratio = ratio[ratio > 0]
    if not isinstance(profile, Sampled) or not ratio.size:
        return
    r, g, bend = bent_vertices(profile)
    # A polygon with at most one bend is not a sampled smooth tip.
    if r.size < 4:
        return
    length = np.diff(r)
    slope = np.diff(g) / length
    # Within the first facet the tip is sharp; the second facet shows whether it is rounded.
    facet = np.clip(np.searchsorted(r[1:] * slope**2 / (4.5 * np.pi), ratio), 1, slope.size - 1)
    error = 0.75 * bend * np.sqrt(2 * r[:-1] * length) / (r[1:] * slope)
    value = float(error[facet].max())
    text = f"The facets between the samples change the pull-off force by about {100 * value:.2g} %"
    remedy = " or more: if the tip is smooth, give denser samples or fit a smooth profile to them."
    text += remedy if value > _FACETS else "."
    yield Limit("facets", value, _FACETS, value > _FACETS, text, severe=value > 5 * _FACETS)


def _tip_radius(profile):
    """Return the radius of curvature (m) at the tip, or None for a flat or sharp tip."""
    radius = getattr(profile, "tip_radius", None)
    if radius is not None:
        return radius
    return profile.body_radius if np.all(profile.body_radius < np.inf) else None


def _poisson_limit(medium):
    """Yield the limit for the Poisson ratio of the dashpots.

    Without a Poisson ratio all constants relax with the same time, and there is no limit.
    """
    if medium.poisson is None:
        return
    value = float(np.min(medium.poisson))
    text = f"Dashpots parallel to the springs are exact only for ν = ½; here ν = {value:.3g}"
    text += ", and viscous results are estimates." if value < 0.5 else "."
    yield Limit("Poisson ratio", value, 0.5, value < 0.5, text)


def _viscosity_limit(medium):
    value = float(np.max(medium.relaxation_time))
    text = (
        "A path without times is quasi-static, so the viscosity has no effect (τ = "
        f"{engineering(value, 's')}). To include viscosity, prescribe the path in time."
    )
    yield Limit("viscosity", value, 0.0, True, text, severe=False)


def jump_limits(jumps):
    """Yield limits of a path of prescribed force that jumps between depths (m)."""
    for first, last in jumps:
        text = (
            "On loading the force decreases after the onset of yield: a path of prescribed force jumps "
            f"from {engineering(first, 'm')} to beyond {engineering(last, 'm')}. Prescribe depths to "
            "follow it."
        )
        yield Limit("jump", float(last - first), 0.0, True, text, severe=False)


def friction_limits(medium):
    """Yield the limits of the model of friction.

    The ratio of slip across the velocity to slip along the velocity is ν/(4 − 2ν).
    """
    nu = float(np.min(medium.poisson))
    value = (1 - 2 * nu) / (2 - 2 * nu)
    text = "Normal and tangential displacements are taken as uncoupled"
    text += f". This is exact only for ν = ½; here ν = {nu:.3g}." if value > 0 else ", exact for ν = ½."
    yield Limit("coupling", value, 0.0, value > 0, text, severe=False)
    value = float(np.max(np.abs(medium.poisson / (4 - 2 * medium.poisson))))
    text = f"Slip across the velocity, up to {value:.2g} of the slip, is neglected."
    yield Limit("slip direction", value, 0.2, value > 0.2, text, severe=False)


def stick_limits(error, tolerance, depth, mass):
    """Yield limits of impacts with stick, from the largest error, its tolerance, d_max/u_c and m/m_t."""
    exceeded = error > tolerance
    text = (
        f"The error of the tangential velocity or force, {error:.2g}, exceeds the tolerance {tolerance:.2g}"
    )
    text += ": even the smallest steps are too long for the oscillations of elements that stick."
    if not exceeded:
        text = f"The error of the tangential velocity and force, {error:.2g}, is within the tolerance."
    yield Limit("tolerance", error, tolerance, exceeded, text)
    measured = (
        f"; the errors of the tangential motion were verified up to {_DEEP:g} times the elastic "
        f"compression and for m_t of {1 / _LIGHT:g} m or more."
    )
    for what, value, bound, text in (
        ("depth", depth, _DEEP, f"The depth reaches {depth:.3g} times the elastic compression"),
        ("mass", mass, _LIGHT, f"The tangential mass m_t is {1 / mass:.3g} m"),
    ):
        over = value > bound * (1 + 1e-9)
        yield Limit(what, value, bound, over, text + (measured if over else "."), severe=False)


def speed_limit(speed, medium, density):
    """Return the limit for the speed (m/s) over the wave speed √(E*/ρ), with the density ρ (kg/m³)."""
    density = check.positive("density", density, unit="kg/m³")
    value = float(np.max(speed / np.sqrt(medium.E_star / density)))
    text = f"The speed is {value:.3g} times the wave speed √(E*/ρ)"
    text += (
        ": the energy carried away by waves is not negligible."
        if value > _SLOW
        else ": the contact is quasi-static."
    )
    return Limit("speed", value, _SLOW, value > _SLOW, text)


def path_limits(path):
    """Return the limits of the states of an `Indentation`."""
    limits = contact_limits(path.profile, path.medium, path.contact_radius, slow=not path.in_time)
    return Limits((*limits, *jump_limits(path.jumps)))


def impact_limits(hit):
    """Return the limits of an `Impact`, including the fast limit (23), (24)."""
    limits = contact_limits(hit.profile, hit.medium, hit.contact_radius)
    return Limits((*limits, *structure_limits(hit), *fast_impact_limits(hit)))


def chain_limits(hit):
    """Return the limits of a `ChainImpact`."""
    limits = contact_limits(hit.profile, hit.medium, hit.contact_radius)
    return Limits((*limits, *structure_limits(hit)))


def fast_impact_limits(hit):
    """Return the `Limit` for the fast limit (23), (24) of an `Impact` from its errors, if it yields."""
    first_class = hit.medium.inverse_to_radius and hit.structure.rigid
    if not (first_class and np.any(hit.plastic_depth_increase > 0)):
        return ()
    if np.any(np.isinf(hit.medium.critical_depth)):
        return ()
    equations, first = "Eqs. (23), (24)", np.all(hit.plastic_depth == hit.plastic_depth_increase)
    if np.any(np.isinf(depth_in_fast_limit(hit))):
        known = np.min(hit.profile.known_depth)
        text = (
            f"{equations} do not hold: in this limit the largest depth exceeds the known depth of the "
            f"profile, {engineering(known, 'm')}."
        )
        return (Limit("fast limit", np.inf, MAX_ERROR, True, text, equations),)
    limit = hit.fast_limit
    errors = limit.contact_area_error, limit.max_depth_error
    area, depth = (float(np.ravel(error)[np.argmax(np.abs(error))]) for error in errors)
    # Without yield the errors may cross zero by chance, so the share of the viscous work also counts.
    viscous = float(np.max(hit.viscous_work / (hit.mass * hit.speed**2 / 2)))
    value = max(abs(area), abs(depth), viscous)
    exceeded = value > MAX_ERROR or not first
    errors = f"{100 * area:+.3g} % in the area and {100 * depth:+.3g} % in the depth".replace("-", "−")
    text = f"The fast-impact limit, {equations}, {'does not hold: it ' * exceeded}differs by {errors}"
    if viscous > MAX_ERROR:
        text += f"; the viscous work is {100 * viscous:.3g} % of the energy"
    if not first:
        text += "; the limit applies only to the first impact on a virgin surface"
    return (Limit("fast limit", value, MAX_ERROR, exceeded, f"{text}.", equations),)
