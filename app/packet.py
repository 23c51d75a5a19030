"""What is drawn, as one array: every row of every figure, end to end, each with its length before it."""

import numpy as np

from .figures import placed
from .plots import PLOTS


class Layer:
    """One renderer of a figure, with the rows of its plot that it draws."""

    def __init__(self, name, figure, renderer):
        plot, source = PLOTS[name], renderer.data_source
        self.name, self.source, self.image = name, source, renderer.name == "image"
        self.kind, _, self.right = renderer.name.partition(" ")
        self.rows = (
            ["image"] if self.image else [r.name for group, _, r in placed(plot) if group == renderer.name]
        )
        sources = {each.name: each.data_source for each in figure.renderers}
        self.described = {
            "source": source,
            "rows": len(self.rows),
            "nested": type(renderer.glyph).__name__ == "MultiPolygons",
            "image": self.image,
            "labels": renderer.name == "labels",
            "tips": sources.get(renderer.name.replace("lines", "tips"))
            if "lines" in renderer.name
            else None,
        }


def layers(figures):
    """All layers of some figures, in the order in which they are sent."""
    return [
        Layer(name, figure, renderer)
        for name, figure in figures.items()
        for renderer in figure.renderers
        if not renderer.name.startswith("tips") and not PLOTS[name].log
    ]


def packed(view, layers, states, moving_only=False):
    """Some states as one array, where each of them begins in it, and the labels of each.

    With `moving_only` those layers are left out that stay while a scene is played.
    """
    names = dict.fromkeys(layer.name for layer in layers)
    parts, starts, labels, at = [], [], [], 0
    for i in states:
        columns = {name: view.columns(PLOTS[name], i) for name in names}
        starts.append(at)
        words = []
        for layer in layers:
            if moving_only and not moves(view, layer):
                continue
            rows = columns[layer.name]
            for row in layer.rows:
                for values in inside(view, layer, rows[row][:2]):
                    values = np.atleast_1d(values)
                    parts += [[values.size], values]
                    at += 1 + values.size
            words += [rows[row][2] for row in layer.rows if len(rows[row]) == 3]
        labels.append(words)
    with np.errstate(over="ignore", under="ignore"):
        return np.concatenate(parts, dtype=np.float32, casting="unsafe"), starts, labels


def inside(view, layer, row):
    """A line or area as far as it is within its axes, for a canvas that does not clip."""
    if layer.kind not in ("areas", "lines"):
        return row
    x, y, *right = (view.axes[key] for key in PLOTS[layer.name].axes)
    y = right[0] if layer.right else y
    for k, sign, bound in ((1, 1, y.end), (0, 1, x.end), (0, -1, -x.start)):
        beyond = sign * row[k] > bound * (1 + 1e-9)
        if not beyond.any():
            continue
        at = np.flatnonzero(beyond[:-1] != beyond[1:])
        share = (sign * bound - row[k][at]) / (row[k][at + 1] - row[k][at])
        row = [np.insert(part, at + 1, part[at] + share * (part[at + 1] - part[at])) for part in row]
        cut = sign * bound if layer.kind == "areas" else np.nan
        row[k] = np.where(np.insert(beyond, at + 1, False), cut, row[k])
    return row


def moves(view, layer):
    """Whether any row of a layer changes from state to state."""
    return not view.still(PLOTS[layer.name]).keys() >= set(layer.rows)


def drawn(view, name, states):
    """Names of the rows of a plot that have something to show in one of some states."""
    rows = [row for i in states for row in view.columns(PLOTS[name], i).items()]
    return {row for row, values in rows if np.size(values[1]) and np.isfinite(values[1]).any()}
