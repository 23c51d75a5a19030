"""Check whether a law of hardness is admissible up to the contact radius of a calculation."""

import numpy as np

from . import _check
from ._check import shown
from .hardness import NARROWEST, HardnessLaw, law_values, refused_law, steep_places

#: Radii at which a law is checked, over so many decades; relative step of its differences.
_RADII, _DECADES, _STEP = 200, 6, 2e-6
#: Indenters of an ensemble that are checked at a time.
_ROWS = 512


def check_law(law, profile, depth):
    """Refuses a law of hardness that is not valid at the contact radii (m) of depths (m) up to the largest.

    Below them it is checked from 10⁻⁶ of the radius on; depths that are infinite or not positive are left
    out.
    """
    depth = np.asarray(depth, dtype=float)
    shape = np.broadcast_shapes(depth.shape, law.shape, profile.shape)
    depth = np.minimum(np.broadcast_to(depth, shape), profile.known_depth).ravel()
    rows = np.flatnonzero((depth > 0) & (depth <= _check.LONGEST))
    if not rows.size:
        return
    if not law.shape:
        # One law for all: its values are looked at once, over all radii.
        if profile.shape:
            radius = profile.flat_entries(rows, shape).contact_radius(depth[rows])
        else:
            radius = profile.contact_radius([np.min(depth[rows]), np.max(depth[rows])])
        ends = np.array([[np.min(radius)], [np.max(radius)]])
        radii = _radii_below(*ends, np.min(profile.face_radius))
        _check_values(law, radii)
        if not profile.shape:
            _refuse_growth(law, profile, radii)
            return
    for start in range(0, rows.size, _ROWS):
        some = rows[start : start + _ROWS]
        own = profile.flat_entries(some, shape)
        radius = np.broadcast_to(own.contact_radius(depth[some]), some.shape)
        face = np.broadcast_to(own.face_radius, some.shape)
        radii = _radii_below(radius, radius, face)
        column = (slice(None), None), some.shape
        each = law.flat_entries(some, shape).entries(*column)
        if law.shape:
            _check_values(each, radii)
        _refuse_growth(each, own.entries(*column), radii)


def _radii_below(least, largest, face):
    """Radii (m), one row each, from 10⁻⁶ of the least contact radius, or a flat face, to the largest."""
    low = np.maximum(np.maximum(10.0**-_DECADES * least, face), NARROWEST)
    share = np.max(np.log10(largest / low)) / _DECADES
    radii = np.geomspace(low, largest, int(np.ceil(_RADII * max(share, 1.0))), axis=-1)
    return np.minimum(radii, largest[:, None])


def _check_values(law, a):
    """Refuses a law whose functions are not valid at radii (m) in ascending order along the last axis."""
    hardness = law_values(law, "at", a)
    _refuse_radii(
        law, a, ~((hardness > 0) & (hardness < np.inf)),
        lambda i: f"σ_c = {hardness[i]:g} Pa at a = {a[i]:g} m is not finite and above 0",
        "a contact of this calculation has that radius: mend its at(a)",
    )  # fmt: skip
    # The difference of a step back from each radius, over the step, and the derivative in its middle.
    change = (hardness - law_values(law, "at", a * (1 - _STEP))) / _STEP
    rate = a * law_values(law, "rate", a * (1 - _STEP / 2))
    _refuse_radii(
        law, a, ~(np.abs(change - rate) <= 1e-3 * np.abs(rate) + 1e-5 * hardness),
        lambda i: f"rate(a) = {rate[i] / a[i]:g} Pa/m at a = {a[i]:g} m, but at(a) changes by "
        f"{change[i] / a[i]:g} Pa/m there",
        "rate is the derivative of at, which has no jumps",
    )  # fmt: skip
    _refuse_jumps(law, a, hardness)
    for name in ("line_load", "line_load_rate", "wall_load"):
        if getattr(type(law), name) is not getattr(HardnessLaw, name):
            own, made = law_values(law, name, a), getattr(HardnessLaw, name)(law, a)
            scale = a * hardness if name == "line_load" else np.maximum(hardness, a * a * hardness)
            _refuse_radii(
                law, a, ~(np.abs(own - made) <= 1e-6 * scale),
                lambda i, name=name, own=own, made=made: f"{name}(a) = {own[i]:g} at a = {a[i]:g} m, "
                f"but by at(a) and rate(a) it is {made[i]:g}",
                "leave it out, or mend it",
            )  # fmt: skip


def _refuse_growth(law, profile, a):
    """Refuses a law of which a σ_c/g(a) grows between radii (m) in ascending order along the last axis."""
    # Depth over the elastic limit, which must not fall.
    depth = profile.reduced(a) / (a * law_values(law, "at", a))
    falls = np.zeros(a.shape, bool)
    falls[:, 1:] = depth[:, 1:] < depth[:, :-1] * (1 - 1e-9)
    _refuse_radii(
        law, a, falls,
        lambda i: f"a σ_c/g(a) grows with the contact radius at a = {a[i]:g} m under "
        f"{shown(profile.entries(i, a.shape))}",
        "elements that have yielded would become elastic again on loading: take a law that grows less, or "
        "an indenter whose g grows more",
    )  # fmt: skip


def _refuse_radii(law, a, bad, what, advice):
    """Refuses a law at the first of the radii (m) that are `bad`; `what` says so for its index."""
    if np.any(bad):
        index = np.unravel_index(np.argmax(bad), bad.shape)
        one = law.entries(index, a.shape) if law.shape else law
        raise refused_law(one, what(index), advice)


def _refuse_jumps(law, a, hardness):
    """Refuses a law that jumps between neighbouring radii (m), however near these are."""
    *_, (below, above, low) = steep_places(law, a, hardness, 1e-7)
    if low.size:
        i = np.argmax(np.abs(above - below) / np.maximum(above, below))
        what = f"σ_c jumps from {below[i]:g} to {above[i]:g} Pa at a = {low[i]:g} m"
        raise refused_law(law, what, "a law is smooth in a: join its parts over a range of radii")
