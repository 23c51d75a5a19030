"""The plot *In time*: depth and force over time."""

from mdr_core.show.figures import line, mark

from ..courses import Course
from ..extra import Extra
from ..plot import Plot, View
from ..plots import D, F
from ..shared.time import T, line_at_time


def places(view: View, i: int) -> dict:
    time, states = view.course.motion.time, view.course.states
    return {
        "depth d": (time, states.depth),
        "force F": (time, states.force),
        "now": (time[[i]], states.depth[[i]]),
        "F now": (time[[i]], states.force[[i]]),
        "time": line_at_time(view, i, D),
    }


def _law(course: Course) -> str:
    if course.hit is None:
        return "prescribed  § 8, § 14"
    return f"m d²{'(d + w)' if course.structure else 'd'}/dt² = −F,  § 9"


MOTION = Plot(
    "motion", "Depth and force over time",
    _law,
    (T, D, F),
    (
        line("depth d", "speed", 2.2, symbol="d"),
        line("force F", "elastic", 2.2, "dashed", "F", axis=2),
        line("time", "ink", 1.0, "dashed", legend=False),
        mark("now"),
        mark("F now", marker="diamond", size=11, axis=2, legend=False),
    ),
    places, applies=lambda view: view.course.motion is not None, tab="In time", order=30,
)  # fmt: skip


EXTRA = Extra("motion", plots=(MOTION,))
