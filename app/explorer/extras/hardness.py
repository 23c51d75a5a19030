"""The plot *Hardness*: mean pressure and hardness over the contact radius."""

from dataclasses import replace

import numpy as np

from mdr_core.show.figures import line, mark, parts, split
from mdr_core.show.units import digits, format_quantity

from ...common.ui import html_subscripts
from ..courses import Course
from ..extra import Extra
from ..figures import Logarithmic
from ..plot import View, axis
from ..search import AsyncPlot, IdleSearch, SearchResult

#: Decades of logarithmic axes of radii and of pressures.
_RADII, _PRESSURES = 2, 3
#: End of the axis relative to the pressure at the largest depth, if the pressure is unbounded towards first
#: contact: with dashpots, or under a tip sharper than a cone.
_MOST = 4


def found(course: Course, asked: tuple[str]) -> SearchResult:
    """Return the mean pressure along the path, the hardness at each contact radius, and the axes."""
    (scale,), states, made = asked, course.states, course.scene.medium
    # Without contact there is no pressure.
    a, p = states.contact_radius, np.where(states.contact_radius > 0, states.mean_pressure, np.nan)
    rows = split(a, p, states.depth, states.live_interval.lower)
    widest, largest = float(np.max(a)), float(course.turning_point.mean_pressure)
    yields = made.q_c < np.inf
    hardness = float(made.hardness_at(widest)) if yields else 0.0
    if yields:
        r = widest * np.geomspace(10.0**-_RADII, 2, 161)
        rows["hardness"] = r, made.hardness_at(r)
    highest = float(np.nanmax(p))
    seen = min(highest, _MOST * abs(largest)) if _unbounded(course, p) else highest
    most = 1.3 * max(seen, hardness)
    x, y = (
        axis("a, contact radius", "length", 1.2 * widest),
        axis("pₘ, pressure", "pressure", most),
    )
    if scale == "log":
        x = replace(x, start=10.0**-_RADII * x.end, log=True)
        end = 10.0 ** np.ceil(np.log10(most / y.factor)) * y.factor
        y = replace(y, start=10.0**-_PRESSURES * end, end=end, log=True)
    elif course.adhesive:
        y = replace(y, start=max(1.1 * float(np.nanmin(p)), -y.end))
    beyond = f" Beyond the axis: p_m = {format_quantity(highest, 'pressure')}." * (highest > most)
    return SearchResult(rows, [x, y], _note(course, largest, yields) + html_subscripts(beyond))


def _unbounded(course: Course, p: np.ndarray) -> bool:
    """Whether mean pressures (Pa) along a path grow without bound towards first contact."""
    first = p[np.isfinite(p)][:2]
    return course.dashpots or bool(first[0] > 1.01 * first[-1])


def _note(course: Course, mean: float, yields: bool) -> str:
    """Return a note on mean pressure and hardness at the largest depth."""
    text = f"At the largest depth p_m = {format_quantity(mean, 'pressure')}"
    if not yields:
        return html_subscripts(f"{text}; nothing yields.")
    hardness = float(course.scene.medium.hardness_at(course.turning_point.contact_radius))
    return html_subscripts(
        f"{text} is {digits(mean / hardness, 3)} of σ_c = {format_quantity(hardness, 'pressure')}."
    )


def now(view: View, i: int) -> dict:
    states = view.course.states
    return {"now": (states.contact_radius[[i]], states.mean_pressure[[i]])}


HARDNESS = AsyncPlot(
    "hardness", "Mean pressure and hardness", "(11)  p_m = F/(π a²),  σ_c = H + q_c/a + f_c/a²  § 20", (),
    (line("hardness", "ink", 1.4, "dotted", "σ"), *parts("pₘ"), mark("now", size=13)),
    places=now, find=found, quick=lambda asked: True, tab="Hardness", order=15,
    picture=Logarithmic, controls=("hardness.axes",),
)  # fmt: skip


EXTRA = Extra("hardness", plots=(HARDNESS,), service=IdleSearch)
