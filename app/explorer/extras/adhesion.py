"""Adhesion in the force–depth plot: first contact, pull-off, and lost and returned energies of a loop."""

from functools import lru_cache

import numpy as np
from scipy.integrate import trapezoid

from mdr_core.scene import ForcePath
from mdr_core.show.figures import NOTHING, area, label, line, mark
from mdr_core.show.units import format_quantity
from mdr_core.solver.contact.unloading import AdhesiveLoop, adhesive_loop, unloading_curve

from ..courses import Course
from ..extra import Extra
from ..plot import Overlay, View
from ..plots import D, F

ROWS = (
    area("gained", "stick", 0.25),
    area("given back", "elastic", 0.25),
    line("jump", "elastic", 1.2, "dotted", legend=False),
    mark("jump into contact", "elastic", marker="square", size=9),
    mark("pull-off", "stick", marker="square", size=9),
    label("Fₐ"),
    label("W_a"),
    label("W_U"),
)


def places(view: View, i: int) -> dict:
    """Return contact and pull-off; for a single loading also the lost and returned energies in state i."""
    if not view.course.adhesive:
        return {}
    # Loops of several loadings overlap.
    return _ends(view) | ({} if view.course.turns else _energies(view, i))


def _ends(view: View) -> dict:
    """Return the point of first contact, and the largest tension of unloading with its value."""
    depth, force = view.course.states.depth, view.course.states.force
    last = view.course.peak + int(np.argmin(force[view.course.peak :]))
    text = f"Fₐ = {format_quantity(view.course.states.pull_off_force[last], 'force', 3)}"
    beside = 0.02 * (view.end(D) - view.axis(D).start)
    above = 0.05 * (view.end(F) - view.axis(F).start)
    return {
        "jump into contact": (depth[:1], force[:1]),
        "jump": (depth[[0, 0]], np.array([0.0, force[0]])),
        "pull-off": (depth[[last]], force[[last]]),
        "Fₐ": (depth[last] + beside, force[last] + above, text),
    }


def _under_force(course: Course) -> bool:
    """Whether the drive prescribes a force: contact is then lost earlier."""
    return isinstance(course.scene.drive, ForcePath)


@lru_cache(maxsize=4)
def _loop(course: Course, turn: int) -> AdhesiveLoop:
    """Return the loop of loading to a state and unloading; all states of unloading share it."""
    return adhesive_loop(course.states[: turn + 1], _under_force(course))


def _energies(view: View, i: int) -> dict:
    """Return areas of a loading and unloading with adhesion, with their energies as text.

    The stored energy is no area below the curve, because it also separates surfaces. The plot shows the
    energy that returns before the force becomes tensile.
    """
    course = view.course
    loop = _loop(course, min(i, course.peak))
    returned = _before_tension(*unloading_curve(course.states[i], _under_force(course)))
    around = np.append(loop.depth, loop.depth[::-1])
    lost = np.maximum(loop.loading, loop.unloading), loop.unloading[::-1]
    gained = loop.unloading, np.minimum(loop.loading, loop.unloading)[::-1]
    closed, gains = loop.lost > loop.gained, loop.lost > loop.gained > 1e-3 * loop.lost
    left, top = view.axis(D).start, view.end(F)
    height, width = top - view.axis(F).start, view.end(D) - left
    said, back = "", float(trapezoid(returned[1], returned[0]))
    # An early loop may reach below the axis, which covers the whole course.
    if closed and loop.depth[0] > left - 1e-6 * width:
        net = loop.lost - loop.gained
        said = f"dissipated {format_quantity(loop.lost, 'energy', 3)}"
        said += (
            f" − {format_quantity(loop.gained, 'energy', 3)} gained = {format_quantity(net, 'energy', 3)}"
            * gains
        )
    left += 0.02 * width
    return {
        "dissipated": (around, np.concatenate(lost)) if closed else NOTHING,
        "gained": (around, np.concatenate(gained)) if gains else NOTHING,
        "given back": returned,
        "W_a": (left, top - 0.02 * height, said),
        "W_U": (
            left,
            top - 0.14 * height,
            f"given back {format_quantity(-back, 'energy', 3)}" if back < 0 else "",
        ),
    }


def _before_tension(d, force) -> tuple:
    """Return the area below an unloading, from its beginning to zero force; nothing if it has none."""
    # The pull-off, at its end, is always tensile.
    count = int(np.argmax(force <= 0))
    if count == 0:
        return NOTHING
    zero = np.interp(0.0, force[[count, count - 1]], d[[count, count - 1]])
    return np.concatenate([d[:1], d[:count], [zero]]), np.concatenate([[0.0], force[:count], [0.0]])


EXTRA = Extra("adhesion", overlays=(Overlay("force", ROWS, places),))
