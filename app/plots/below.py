"""The deformed surface with its imprint, and the stress below it."""

from dataclasses import replace

import numpy as np

from mdr_core.results.figures import NOTHING, RADII, area, at_radii, both, line, mark

from ..drives import Course
from ..solve import Found
from ..state.units import written
from .plot import Plot, View, axis

#: Where points lie between edges, at which the surface is steep.
_DENSE = (1 - np.cos(np.linspace(0, np.pi, 20))) / 2
#: Pixels down and along the radius.
_PIXELS = (72, 96)
#: What can be drawn: its title, and how it comes from a `Stress`.
_DRAWN = {
    "max_shear": ("τmax, largest shear stress", lambda stress: stress.max_shear),
    "von_mises": ("σvM, von Mises stress", lambda stress: stress.von_mises),
    "zz": ("−σzz, pressure downward", lambda stress: 0.0 - stress.zz),
}


def surface(view: View, i: int) -> dict:
    state, profile = view.course.states[i], view.course.scene.profile
    across, z = view.axis("far r"), view.axis("far z")
    half, far = 1.1 * across.end, 3 * z.end
    a, c = float(state.contact_radius), float(state.plastic_radius)
    edges = {0.0, c, a, profile.face_radius, profile.wall, np.nextafter(profile.wall, np.inf), half}
    edges = np.array(sorted(edge for edge in edges if edge <= half))
    r = np.unique(np.append(edges[:-1, None] + np.diff(edges)[:, None] * _DENSE, edges))
    known = r[r <= profile.known_radius]
    # As far up as the axis reaches, also at the wall of a punch.
    tip = np.minimum(profile.height(known) - state.depth, far)
    imprint = 0.0 - state.imprint(r)
    beside, height = r > a, imprint.copy()
    height[beside] -= state.surface(r[beside])
    if a > 0:
        # Under the contact the surface is the tip.
        height[~beside] = tip[: np.count_nonzero(~beside)]
    ends, bottom = np.array([-half, half]), np.full(2, z.start)
    surface = both(r, -1), both(height)
    return at_radii(a, c, across.end, z.start, z.end) | {
        "tip z(r)": (np.pad(both(known, -1), 1, "edge"), np.pad(both(tip), 1, constant_values=far)),
        "medium": (np.append(surface[0], ends[::-1]), np.append(surface[1], bottom)),
        "undeformed": (ends, np.zeros(2)),
        "deformed surface": surface,
        "residual imprint": (both(r, -1), both(imprint)) if state.live_interval.lower > 0 else NOTHING,
    }


SURFACE = Plot(
    "surface", "Surface and imprint", "u(r) = ∫ (2/π) arcsin(a(s)/r) ds,  a(s) < r  § 7",
    ("far r", "far z"),
    (
        area("tip z(r)", "body", 0.55),
        area("medium", "free", 0.16, legend=False),
        line("undeformed", "free", 1.0, "dashed", legend=False),
        line("deformed surface", "elastic", 2.2, symbol="z"),
        line("residual imprint", "yielded", 2.0, "dotted", symbol="z"),
        *RADII,
    ),
    moving=surface, tab=("Surface", "u"),
)  # fmt: skip


def section(course: Course, asked):
    """Map of a stress over r and z, with a, c and the place of the maximum."""
    (quantity,), state, reach = asked, course.state, 1.6 * float(course.turning_point.contact_radius)
    r = axis("r", "r, radius", "length", reach)
    z = replace(axis("depth", "z, height", "length", reach, below=1.0), end=0.0)
    title, of_stress = _DRAWN[quantity]
    reason = "The load is gone." if state.contact_radius == 0 else ""
    if course.chained:
        reason = "Stresses below the surface are not known of a viscous path."
    if reason:
        return Found({}, [r, z, axis("stress", title, "pressure", 1.0)], reason)
    down, along = ((np.arange(count) + 0.5) / count for count in _PIXELS)
    across, deep = r.end * along, -z.start * (1 - down)
    image = of_stress(state.stress(across, deep[:, None]))
    # A quantile, as the maximum may be infinite.
    most, place, note = float(np.quantile(image, 0.998)), NOTHING, ""
    if quantity != "zz":
        peak = state.stress_peak(quantity)
        place = np.array([peak.r]), np.array([-peak.z])
        most = float(peak.value) if np.isfinite(peak.value) else most
        # A place is known to about 10⁻⁴ of the radius.
        at = (written(float(x) if x > 1e-4 * reach else 0.0, "length", 3) for x in (peak.r, peak.z))
        bound = written(float(peak.value), "pressure", 3) if np.isfinite(peak.value) else "infinite"
        note = "{} is largest at r = {}, {} below the surface: {}.".format(title.split(",")[0], *at, bound)
    colours, ends = axis("stress", title, "pressure", most), np.array([z.start, z.end])
    rows = {
        "image": (np.array([r.start, r.end]), ends, np.minimum(image, colours.end)),
        "contact radius a": (np.full(2, state.contact_radius), ends),
        "plastic zone c": (np.full(2, state.plastic_radius), ends) if state.plastic_radius else NOTHING,
        "largest": place,
    }
    return Found(rows, [r, z, colours], note)


SECTION = Plot(
    "section", "Section under the tip", "σ(r, z): each increment a flat punch of radius a(s)  § 7", (),
    (
        line("contact radius a", "chalk", 1.2, "dashed"),
        line("plastic zone c", "chalk", 1.2, "dotted"),
        mark("largest", "yielded", "chalk", "diamond", 12),
    ),
    find=section, of_state=True, tab=("Section", "e"), controls=("section",), image=_PIXELS,
)  # fmt: skip
