"""The state in words, among the springs: what has yielded, or what yields first and where."""

import numpy as np

from mdr_core.show.figures import NOTHING, area, label
from mdr_core.show.units import written

from ..courses import Course, onset_depth
from ..extra import Extra
from ..plot import Overlay, View
from ..plots import D, F, Z


def sentence(course: Course, i: int) -> str:
    """Radii of yield and of the elastic ring, or where and at what depth yield begins."""
    a, c = (float(radii[i]) for radii in (course.states.contact_radius, course.states.plastic_radius))
    if a == 0:
        return f"no contact; imprint of radius c = {written(c, 'length', 3)}" if c else "no contact"
    if c == 0:
        return f"elastic; {_first(course)}"
    inside = f"yielded inside c = {written(c, 'length', 3)}"
    return inside if a <= c else f"{inside}; elastic ring {written(a - c, 'length', 3)} wide"


def _first(course: Course) -> str:
    """What yields first, where, and at what depth, on a virgin surface."""
    depth = onset_depth(course.scene)
    if course.onset is None:
        return "nothing yields" if depth == np.inf else "yield begins deeper than the tip is known"
    where = "the whole flat face" if course.scene.profile.face_radius else "the axis"
    # With adhesion the depth is less by what the rim is stretched.
    return f"{where} yields first" + f", at d = {written(depth, 'length', 3)}" * (not course.adhesive)


def words(view: View, i: int) -> dict:
    return {"reading": (0.0, 0.97 * view.end(Z), sentence(view.course, i))}


def zone(view: View, i: int) -> dict:
    """Depths beyond the onset of yield, at which loading has a plastic zone, where the scene yields."""
    course, top = view.course, view.end(F)
    known = course.onset is not None and not (course.dashpots or course.initial_plastic_depth)
    if not known or course.onset.depth >= np.max(course.states.depth):
        return {"plastic zone, on loading": NOTHING}
    ends, bottom = (float(course.onset.depth), view.end(D)), view.axis(F).start
    columns = np.array([ends[0], *ends, ends[1]]), np.array([bottom, top, top, bottom])
    return {"plastic zone, on loading": columns}


EXTRA = Extra(
    "reading",
    overlays=(
        Overlay("springs", (label("reading", 0.0, "center"),), words),
        Overlay("force", (area("plastic zone, on loading", "yielded", 0.07),), zone),
    ),
)
