"""The plot *Section*: the stress below the surface."""

from dataclasses import replace

import numpy as np

from mdr_core.show.figures import NOTHING, line, mark
from mdr_core.show.units import format_quantity

from ..courses import Course
from ..extra import Extra
from ..figures import Map
from ..plot import axis
from ..search import AsyncPlot, IdleSearch, SearchResult

#: Pixels down and along the radius.
_PIXELS = (72, 96)
#: Stresses that can be drawn: title, and function of a `Stress`.
_DRAWN = {
    "max_shear": ("τmax, largest shear stress", lambda stress: stress.max_shear),
    "von_mises": ("σvM, von Mises stress", lambda stress: stress.von_mises),
    "zz": ("p, pressure downward", lambda stress: 0.0 - stress.zz),
}


def section(course: Course, asked):
    """Return the map of a stress over r and z, with a, c and the place of the maximum."""
    (quantity,), state, reach = asked, course.state, 1.6 * float(course.turning_point.contact_radius)
    r = axis("r, radius", "length", reach)
    z = replace(axis("z, upward", "length", reach, -reach), end=0.0)
    title, of_stress = _DRAWN[quantity]
    reason = "No contact, and so no stress." if state.contact_radius == 0 else ""
    if course.chained:
        reason = "Stresses below the surface are not available along a viscous path."
    if reason:
        return SearchResult({}, [r, z, axis(title, "pressure", 1.0)], reason)
    down, along = ((np.arange(count) + 0.5) / count for count in _PIXELS)
    across, deep = r.end * along, -z.start * (1 - down)
    image = of_stress(state.stress(across, deep[:, None]))
    # A quantile, as the maximum may be infinite.
    most, place, note = float(np.quantile(image, 0.998)), NOTHING, ""
    if quantity != "zz":
        peak = state.stress_peak(quantity)
        place = np.array([peak.r]), np.array([-peak.z])
        most = float(peak.value) if np.isfinite(peak.value) else most
        # The place is accurate to about 10⁻⁴ of the radius.
        at = (format_quantity(float(x) if x > 1e-4 * reach else 0.0, "length", 3) for x in (peak.r, peak.z))
        bound = format_quantity(float(peak.value), "pressure", 3) if np.isfinite(peak.value) else "infinite"
        note = "{} is largest at r = {}, {} below the surface: {}.".format(title.split(",")[0], *at, bound)
    colours, ends = axis(title, "pressure", most), np.array([z.start, z.end])
    rows = {
        "image": (np.array([r.start, r.end]), ends, np.minimum(image, colours.end)),
        "contact radius a": (np.full(2, state.contact_radius), ends),
        "plastic zone c": (np.full(2, state.plastic_radius), ends) if state.plastic_radius else NOTHING,
        "largest": place,
    }
    return SearchResult(rows, [r, z, colours], note)


SECTION = AsyncPlot(
    "section", "Section under the tip", "σ(r, z): each increment a flat punch of radius a(s)  § 7", (),
    (
        line("contact radius a", "chalk", 1.2, "dashed"),
        line("plastic zone c", "chalk", 1.2, "dotted"),
        mark("largest", "yielded", "chalk", "diamond", 12),
    ),
    find=section, of_state=True, tab="Section", order=80, controls=("section.stress",),
    image=_PIXELS, picture=Map,
)  # fmt: skip


EXTRA = Extra("section", plots=(SECTION,), service=IdleSearch)
