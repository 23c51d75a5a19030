"""Plots of measured curves: force over depth, and a fitted unloading."""

import numpy as np

from .figures import Axis, line, mark
from .plots import overlay

_MEASURED = mark("measured", "measured", "measured", size=3, legend=False)
_CURVES = (line("curves", "measured", 1.0, legend=False),)
_UNLOADING = (_MEASURED, line("unloading", "elastic"), line("contact depth h_c", "yielded", dash="dashed"))


def plot_measured(heading, samples):
    """Plot the measured force (N) over depth (m) of curves, each a pair of depths and forces."""
    # One line with gaps: a thousand separate lines would be slow.
    parts = zip(*samples, strict=True)
    depth, force = (np.concatenate([[*each, np.nan] for each in part])[:-1] for part in parts)
    return overlay(heading, _CURVES, {"curves": (depth, force)}, _axes(depth, force))


def plot_unloading(heading, depth, force, law, contact_depth):
    """Plot a measured curve, the fitted unloading (depths and forces), and its contact depth (m)."""
    mark = np.full(2, contact_depth), np.array([0.0, np.nanmax(force)])
    columns = {"measured": (depth, force), "unloading": law, "contact depth h_c": mark}
    return overlay(heading, _UNLOADING, columns, _axes(depth, force))


def _axes(depth, force):
    return (
        Axis.fitting("depth", "h, measured depth", "m", np.nanmax(np.abs(depth))),
        Axis.fitting("force", "F, measured force", "N", np.nanmax(np.abs(force))),
    )
