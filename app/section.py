"""The section under the tip: a stress below the surface, in colours, with lines of equal stress."""

from dataclasses import replace

import numpy as np
from contourpy import contour_generator

from mdr_core.results.figures import NOTHING

from .drives.chain import ChainStates
from .resting import Found
from .units import written
from .view import axis

#: Pixels down and along the radius, and lines of equal stress.
SHAPE, LINES = (72, 96), 9
#: What can be drawn: its title, and how it comes from a `Stress`.
_DRAWN = {
    "max_shear": ("τmax, largest shear stress", lambda stress: stress.max_shear),
    "von_mises": ("σvM, von Mises stress", lambda stress: stress.von_mises),
    "zz": ("−σzz, pressure downward", lambda stress: 0.0 - stress.zz),
}


def found(way, quantity):
    """The map of a quantity over r and z, with a, c, and the place where it is largest."""
    state, reach = way.state, 1.6 * float(way.deepest.contact_radius)
    r = axis("r", "r, radius", "length", reach, start=0.0)
    z = replace(axis("depth", "z, height", "length", reach, below=1.0), end=0.0)
    title, of_stress = _DRAWN[quantity]
    said = "The load is gone." if state.contact_radius == 0 else ""
    if isinstance(way.states, ChainStates):
        said = "Stresses below the surface are not known of a viscous path: its elements have a past each."
    if said:
        yield Found({}, [r, z, axis("stress", title, "pressure", 1.0)], said)
        return
    down, along = ((np.arange(count) + 0.5) / count for count in SHAPE)
    across, deep = r.end * along, -z.start * (1 - down)
    image = of_stress(state.stress(across, deep[:, None]))
    # Where it grows without bound, most of it.
    most, place, note = float(np.quantile(image, 0.998)), NOTHING, ""
    if quantity != "zz":
        peak = state.stress_peak(quantity)
        place = np.array([peak.r]), np.array([-peak.z])
        most = float(peak.value) if np.isfinite(peak.value) else most
        # A place is known to about 10⁻⁴ of the radius.
        at = (written(float(x) if x > 1e-4 * reach else 0.0, "length", 3) for x in (peak.r, peak.z))
        bound = written(float(peak.value), "pressure", 3) if np.isfinite(peak.value) else "without bound"
        note = "{} is largest at r = {}, {} below the surface: {}.".format(title.split(",")[0], *at, bound)
    colours, ends = axis("stress", title, "pressure", most), np.array([z.start, z.end])
    levels = colours.end * np.arange(1, LINES + 1) / (LINES + 1)
    rows = {
        "image": (np.array([r.start, r.end]), ends, np.minimum(image, colours.end)),
        "equal stress": _contours(across, -deep, image, levels),
        "contact radius a": (np.full(2, state.contact_radius), ends),
        "plastic zone c": (np.full(2, state.plastic_radius), ends) if state.plastic_radius else NOTHING,
        "largest": place,
    }
    yield Found(rows, [r, z, colours], note)


def _contours(x, y, image, levels):
    """Lines along which an image has some values, with gaps between them."""
    lines = [line for level in levels for line in contour_generator(x, y, image).lines(level)]
    return tuple(
        np.concatenate([[np.nan], *(np.append(line[:, k], np.nan) for line in lines)]) for k in (0, 1)
    )
