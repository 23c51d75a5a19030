"""Adhesion by Hess's rule (Popov and Heß, Method of Dimensionality Reduction, 2015, ch. 4).

With the work of adhesion w, the springs at the rim of a contact of radius a are stretched by
Δl(a) = √(2π a w/E*). An adhesive state is the sum of the state without adhesion on the live interval
[d_p, D] and of a flat punch of radius a(D) with the line load −E*Δl:

    d = D − Δl(a(D))          F = 2E* [∫ a(s) ds over [d_p, D] − a Δl]          E = U − π w a²

It is stable at given depth while a g′(a) ≥ Δl/2, and at given force while a g′(a) ≥ 3Δl/2. The contact
begins when the surfaces touch, d ≥ d_p. It is lost at the end of the stable range or at the rim of the
imprint, D = d_p, whichever comes first.
"""

from functools import lru_cache

import numpy as np

from ...base import check
from ..numerics.roots import change_between, crossing
from .integrals import integrals
from .live_interval import LiveInterval
from .yielding import yield_rule

#: Least a g′(a)/Δl of a stable state at given depth, and at given force.
AT_DEPTH, AT_FORCE = 0.5, 1.5


def stretch(medium, radius):
    """Return the stretch Δl = √(2π a w/E*) (m) of the springs at the rim of a contact of radius a (m)."""
    return np.sqrt(2 * np.pi * radius * (medium.work_of_adhesion / medium.E_star))


def stretch_rate(profile, radius, length):
    """Return Δl/g′(a) (m) for the stretch `length` (m) at a radius a (m); 0 if a wall holds the rim."""
    slope = np.where(radius >= profile.wall, np.inf, profile.reduced_slope_at(radius))
    with np.errstate(divide="ignore", invalid="ignore"):
        return length / slope


def _half_rate(profile, radius, length):
    """Return Δl/(2a g′(a)) for the stretch `length` (m) at a radius a (m)."""
    rate = stretch_rate(profile, radius, length)
    with np.errstate(divide="ignore", invalid="ignore"):
        return rate / (2 * radius)


def tension_integral(profile, interval, radius, length):
    """Return the force over 2E* (m²), ∫ a ds − a Δl, for the stretch `length` (m) at a rim `radius` (m)."""
    return integrals(profile).radius_integral(interval) - radius * length


def tension_and_energy(profile, interval, radius, length):
    """Return `tension_integral`, and the energy U − π w a² of springs and surfaces over 2E* (m³).

    π w a² is E* a Δl²/2.
    """
    area, stored = integrals(profile).radius_and_energy(interval)
    return area - radius * length, stored - length * (area - radius * length / 4)


def stable_ranges(profile, medium, share):
    """Return the lower and upper ends (m) of the ranges of D with a g′(a) ≥ share·Δl(a).

    The ranges are along a first axis.

    Arrays of media or profiles have one range per entry. The upper end of the last range is infinite.
    """
    threshold = share * np.sqrt(2 * np.pi * (medium.work_of_adhesion / medium.E_star))
    exponent = integrals(profile).elastic_exponent
    if exponent is not None:
        low = _power_range(profile, threshold, 1 / np.maximum(exponent - 1, 1e-300))
        return low[None], np.full_like(low, np.inf)[None]
    unit, length, depth = integrals(profile).unit
    threshold = np.asarray(threshold * np.sqrt(length) / depth)
    ranges = [_ranges(unit, float(value)) for value in threshold.ravel()]
    if threshold.ndim == 0:
        return depth * ranges[0]
    if any(len(low) > 1 for low, _ in ranges):
        raise check.MDRError(
            "with adhesion, the rim of the contact jumps between several ranges of radii: take one medium "
            "at a time by medium.entries(i)"
        )
    ends = np.reshape([(low[0], high[0]) for low, high in ranges], (*threshold.shape, 2))
    return np.moveaxis(ends, -1, 0)[:, None] * depth


def single_range(profile, medium, share):
    """Return the start D (m) of the stable range; raise an error if there are several."""
    low, _ = stable_ranges(profile, medium, share)
    if len(low) > 1:
        raise check.MDRError(
            "with adhesion, the rim of this contact jumps between several ranges of radii, for a Sampled "
            "profile from facet to facet: use indent along one path of depths, or Smooth with the slope of "
            "a smooth curve through the samples"
        )
    return low[0]


def _power_range(profile, threshold, exponent):
    """Return the start D (m) of the stable range of g ∝ xⁿ; √a g′(a) grows as a^(n − 1/2)."""
    bound = "is 1/2 or less: with adhesion the contact spreads without limit"
    advice = "set work_of_adhesion = 0, or take an exponent above 1/2"
    check.raise_if("exponent", np.asarray(exponent), exponent <= 0.5, bound, advice=advice)
    if np.any(profile.wall < np.inf):
        return np.zeros(np.broadcast_shapes(np.shape(threshold), profile.shape))
    # For a small exponent the radius may overflow.
    with np.errstate(over="ignore"):
        radius = (threshold / profile.reduced_slope_at(np.ones(()))) ** (1 / (exponent - 0.5))
        return np.asarray(profile.reduced_at(radius))


# The cache makes single states of a sampled tip 1.8 times as fast.
@lru_cache(maxsize=2**14)
def _ranges(profile, threshold):
    """Return the `stable_ranges`, √a g′(a) ≥ `threshold` (√m), of one profile without closed forms."""
    x, rate = _rates(profile)
    stable = rate >= threshold
    change = np.flatnonzero(stable[1:] != stable[:-1])
    up = stable[change + 1]

    def stable_at(x):
        return np.sqrt(x) * profile.reduced_slope_at(x) >= threshold

    inner, _ = change_between(stable_at, x[change], x[change + 1], ~up)
    low, high = profile.reduced_at(inner[up]), profile.reduced_at(inner[~up])
    if stable[0]:
        low = np.append(0.0, low)
    if not low.size:
        raise check.MDRError(
            "work_of_adhesion is too large for this profile: the rim of the contact would be outside its "
            f"known radius, {x[-1]:g} m; give the profile to a larger radius"
        )
    return np.array([low, np.append(high, np.inf)[: low.size]])


def _rates(profile):
    """Return radii x (m), ascending, and √x g′(x) there, infinite if a wall or a face holds the rim."""
    face, end = profile.face_radius, min(profile.wall, profile.known_radius)
    spaced = np.geomspace(1e-30, 1e30, 1801)
    x = [face * (1 + spaced[300:]) if face else spaced, spaced]
    edges = profile.radius_at(np.asarray(profile.kinks, dtype=float)) if len(profile.kinks) else np.zeros(0)
    near = np.geomspace(1e-12, 0.3, 24 if edges.size < 50 else 6)
    x = np.unique(np.concatenate([*x, *np.multiply.outer([*(1 - near), *(1 + near)], edges)]))
    x = x[(x > face) & (x < end)]
    # Radii may be far beyond any contact; the slope is checked below.
    with np.errstate(all="ignore"):
        rate = np.sqrt(x) * profile.reduced_slope_at(x)
    if profile.wall < np.inf:
        x, rate = np.append(x, profile.wall), np.append(rate, np.inf)
    return x[rate == rate], rate[rate == rate]


def contact_interval(profile, medium, lower, live_depth, low, high):
    """Return the live interval [d_p, D] at the depth d_p + `live_depth`, and Δl; D is in [`low`, `high`].

    All are in m.
    """

    def depth(length):
        radius = profile.radius_at(lower + length)
        stretched = stretch(medium, radius)
        return length - stretched - live_depth, 1 - _half_rate(profile, radius, stretched)

    low = np.maximum(low - lower, 0.0)
    start = live_depth + stretch(medium, profile.radius_at(lower + np.maximum(live_depth, low)))
    length = crossing(depth, np.clip(start, low, high - lower), low, high - lower)
    stretched = stretch(medium, profile.radius_at(lower + length))
    # Computed from the live depth, so that a state of loading is recognized.
    length = live_depth + stretched
    return LiveInterval.above(lower, length), stretched


def depth_path(profile, medium, depth):
    """Return live intervals and line loads −E*Δl (N/m) along paths of depths (m), 0 out of contact."""
    paths = np.atleast_1d(depth)
    results = np.zeros((4, *paths.shape))
    for row in np.ndindex(paths.shape[:-1]):
        one = tuple(each.entries((*row, 0), (*paths.shape[:-1], 1)) for each in (profile, medium))
        results[(slice(None), *row)] = _one_path(*one, paths[row])
    *interval, load = results.reshape(4, *np.shape(depth))
    return LiveInterval(*interval), load


def first_contacts(profile, medium, depth):
    """Return live intervals and line loads (N/m) of first loadings to depths (m), elementwise."""
    low = single_range(profile, medium, AT_DEPTH)
    loaded, _ = yield_rule(profile, medium).loading(np.maximum(depth, 0.0))
    lower, known = loaded.lower, profile.known_depth
    interval, stretched = contact_interval(profile, medium, lower, loaded.length, low, known)
    check.raise_if("depth", depth, np.isnan(stretched), f"presses {profile.too_deep()}", unit="m")
    length = np.where(depth >= 0, interval.length, 0.0)
    load = np.where(depth >= 0, -medium.E_star * stretched, 0.0)
    return LiveInterval.above(lower, length), load


def _one_path(profile, medium, depth):
    """Return lower end, upper end and length (m) of the live interval, and line load (N/m), on one path."""
    d_c, largest = medium.critical_depth, np.maximum.accumulate(depth)
    lower = yield_rule(profile, medium).plastic_depth(largest)
    live_depth = np.where(lower > 0, d_c - (largest - depth), depth)
    # The bottom of the imprint has the rounding of the largest depth.
    live_depth = np.where(np.abs(live_depth) <= 4e-16 * largest, 0.0, live_depth)
    low, high = stable_ranges(profile, medium, AT_DEPTH)
    ends = np.maximum(low[:, None], lower), np.minimum(high, profile.known_depth)[:, None]
    with np.errstate(invalid="ignore"):
        first, last = (end - lower - stretch(medium, profile.radius_at(end)) for end in ends)
    last = np.where(np.isnan(last), np.inf, last)
    first = np.where(ends[0] <= ends[1], first, np.inf)
    number = _ranges_along(live_depth, first.T.tolist(), last.T.tolist())
    touching = number >= 0
    bound = f"presses {profile.too_deep()}, with adhesion"
    check.raise_if(
        "depth", depth, touching & (live_depth > last[-1]), bound, unit="m", advice="press less deep"
    )
    # Out of contact the interval is empty.
    result = np.array([lower, lower, np.zeros_like(depth), np.zeros_like(depth)])
    number, held = number[touching], (lower[touching], live_depth[touching])
    interval, stretched = contact_interval(profile, medium, *held, low[number], high[number])
    result[:, touching] = interval.lower, interval.upper, interval.length, -medium.E_star * stretched
    return result


def _ranges_along(live_depth, first, last):
    """Return the number of the stable range with the rim at each live depth (m) of a path.

    It is −1 out of contact. `first` and `last` are the live depths at the ends of the ranges, one row per
    state. The rim jumps to the next range when the depth leaves its range.
    """
    numbers, number = [], -1
    for depth, begin, end in zip(live_depth.tolist(), first, last, strict=True):
        if number < 0 and depth >= 0:
            number = next(i for i, each in enumerate(begin) if each < np.inf)
        while number >= 0 and depth < begin[number]:
            number -= 1
        while 0 <= number < len(end) - 1 and depth > end[number]:
            number += 1
        numbers.append(number)
    return np.array(numbers, dtype=int)


def force_path(profile, medium, force):
    """Return depths (m), live intervals and line loads (N/m) along paths of forces (N).

    Under a tension larger than the pull-off force the contact is lost. The depth is then the depth of the
    imprint. A force that is not negative closes the contact again.
    """
    low, path = single_range(profile, medium, AT_FORCE), np.atleast_1d(force)
    target, closes = path / (2 * medium.E_star), path >= 0
    largest = np.maximum.accumulate(np.where(closes, target, 0.0), axis=-1)
    loaded, carried = _pressed(profile, medium, largest, low)
    bound = f"presses {profile.too_deep()}, or is not reached because adhesion draws the indenter in"
    not_carried = np.reshape(~carried, force.shape)
    check.raise_if("force", force, not_carried, bound, unit="N", advice="press to a depth instead")
    lower = np.where(np.logical_or.accumulate(closes, axis=-1), loaded.lower, 0.0)
    least = np.maximum(low - lower, 0.0)

    def unloading(length):
        interval = LiveInterval.above(lower, length)
        stretched = stretch(medium, profile.radius_at(interval.upper))
        return _tension(profile, interval, stretched, target, False)

    contact = _contact_along(closes, lost=unloading(least)[0] > 0)
    on_loading = target == largest
    length = np.where(on_loading, loaded.length, crossing(unloading, loaded.length, least, loaded.length))
    # Without contact the indenter is at the bottom of the imprint.
    length = np.where(contact, length, 0.0)
    stretched = np.where(contact, stretch(medium, profile.radius_at(lower + length)), 0.0)
    yielding = contact & on_loading & (lower > 0)
    live_depth = np.where(yielding, medium.critical_depth, length - stretched)
    length = np.where(yielding, medium.critical_depth + stretched, length)
    states = lower + live_depth, lower, length, -medium.E_star * stretched
    depth, lower, length, load = (np.reshape(each, force.shape) for each in states)
    return depth, LiveInterval.above(lower, length), load


def _pressed(profile, medium, target, low):
    """Return live intervals under the largest forces so far, and whether they carry these forces.

    `target` is these forces over 2E* (m²). D is at least `low` (m).
    """
    d_c, known = medium.critical_depth, profile.known_depth

    def loading(upper):
        interval, stretched = loaded_interval(profile, medium, upper)
        return _tension(profile, interval, stretched, target, interval.lower > 0)

    start = np.full(target.shape, max(2 * low, d_c if d_c < np.inf else 0.0, 1e-30))
    upper = crossing(loading, np.minimum(start, known), np.full(target.shape, low), known)
    miss, slope = loading(upper)
    carried = (upper <= known) & (slope > 0) & (np.abs(miss) <= 1e-6 * upper * slope)
    return loaded_interval(profile, medium, upper)[0], carried


def _contact_along(closes, lost):
    """Whether there is contact at the end of each load of paths along the last axis.

    Contact lasts from a load that closes it to a load that loses it.
    """
    contact, along = np.zeros(closes.shape[:-1], bool), np.empty(closes.shape, bool)
    for i in range(closes.shape[-1]):
        contact = (contact | closes[..., i]) & ~lost[..., i]
        along[..., i] = contact
    return along


def loaded_interval(profile, medium, upper, before=0.0):
    """Return [d_p, D] on loading up to D (m), over an imprint of depth `before` (m), and Δl (m)."""
    stretched = stretch(medium, profile.radius_at(upper))
    depth = upper - stretched
    lower = np.maximum(before, yield_rule(profile, medium).plastic_depth(depth))
    length = np.where(lower > before, medium.critical_depth + stretched, upper - before)
    return LiveInterval(*np.broadcast_arrays(lower, upper, length)), stretched


def _tension(profile, interval, stretched, target, yielding):
    """Return the force over 2E* minus a target (m²), and its derivative with respect to D (m)."""
    radius = profile.radius_at(interval.upper)
    rate = stretch_rate(profile, radius, stretched)
    lower = profile.radius_at(interval.lower) * (1 - _half_rate(profile, radius, stretched))
    inner = np.where(yielding, lower, 0.0)
    value = tension_integral(profile, interval, radius, stretched)
    return value - target, radius - 1.5 * rate - inner


def stiffness(state):
    """Return `Indentation.stiffness` (N/m) with adhesion; the contact radius follows the depth."""
    profile, medium, interval = state.profile, state.medium, state.live_interval
    radius, stretched = state.contact_radius, -state.uniform_load / medium.E_star
    loaded = np.isclose(interval.length, medium.critical_depth + stretched, rtol=1e-14, atol=0.0)
    yielding = (interval.lower > 0) & loaded
    rate, part = stretch_rate(profile, radius, stretched), _half_rate(profile, radius, stretched)
    inner = np.where(yielding, state.plastic_radius, 0.0)
    width = np.where(yielding, integrals(profile).radius_difference(interval), radius)
    # (a − 3Δl/(2g′))/(1 − Δl/(2a g′)) − c, with the difference a − c.
    with np.errstate(divide="ignore", invalid="ignore"):
        width = (width - 1.5 * rate + inner * part) / (1 - part)
    return np.where(radius > 0, 2 * medium.E_star * width, 0.0)


def pull_off_integral(profile, medium, interval):
    """Return the pull-off force over 2E* (m²): the largest tension on unloading from a live interval."""

    def tension(interval):
        radius = profile.radius_at(interval.upper)
        return -tension_integral(profile, interval, radius, stretch(medium, radius))

    result = tension(interval)
    for number, low in enumerate(stable_ranges(profile, medium, AT_FORCE)[0]):
        largest = np.maximum(tension(last_interval(interval.lower, low)), result)
        # A further range counts only if the rim is in it now. A rim held by the depth pulls most now.
        result = np.where((number == 0) | (low <= interval.upper), largest, result)
    return result


def last_interval(lower, low):
    """Return the live interval at the end of the stable range from `low` (m), or at the imprint's rim."""
    return LiveInterval.above(lower, np.maximum(low - lower, 0.0))
