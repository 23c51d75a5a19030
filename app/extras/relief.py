"""The plot *Relief*: the contact pressure over the plane, in colours."""

from dataclasses import replace

import numpy as np

from mdr_core.show.figures import line
from mdr_core.show.units import written

from ..courses import Course
from ..extra import Extra
from ..plot import axis
from ..shared.maps import Map
from ..shared.rest import Found, Resting, Searched

_PIXELS = 96
#: Pressures over the mean one beyond which all have one colour: they may be infinite.
_MOST = 4


def plane(course: Course, asked) -> Found:
    """Pressure on a square about the contact, with its rim and the plastic zone."""
    state, half = course.state, 1.25 * float(course.turning_point.contact_radius)
    x = axis("x, coordinate", "length", half, -half)
    y = replace(x, title="y, coordinate")
    middle = (np.arange(_PIXELS) + 0.5) / _PIXELS
    place = x.start + (x.end - x.start) * middle
    image = state.pressure(np.hypot(place, place[:, None]))
    finite = float(np.max(image[np.isfinite(image)], initial=0.0))
    most = min(finite, _MOST * float(state.mean_pressure)) or 1.0
    colours = replace(axis("−σzz, pressure", "pressure", most), end=most)
    angle = np.linspace(0, 2 * np.pi, 181)
    around = np.cos(angle), np.sin(angle)
    radii = {"contact radius a": state.contact_radius, "plastic zone c": state.plastic_radius}
    rows = {name: tuple((radius or np.nan) * part for part in around) for name, radius in radii.items()}
    ends = np.array([x.start, x.end])
    rows["image"] = ends, ends, np.minimum(image, most)
    note = f"Largest finite pressure in the picture: {written(finite, 'pressure', 3)}."
    return Found(rows, [x, y, colours], note)


RELIEF = Searched(
    "relief", "Pressure over the plane", "(10)  −σ_zz(√(x² + y²))", (),
    (line("contact radius a", "chalk", 1.2, "dashed"), line("plastic zone c", "chalk", 1.2, "dotted")),
    find=plane, quick=lambda asked: True, of_state=True, tab="Relief", order=20, image=(_PIXELS, _PIXELS),
    picture=Map,
)  # fmt: skip


EXTRA = Extra("relief", plots=(RELIEF,), service=Resting)
