"""What is drawn, as one array: every row of every figure, end to end, each with its length before it."""

import numpy as np

from .plots import PLOTS


class Layer:
    """One renderer of a figure, with the rows of its plot that it draws."""

    def __init__(self, name, figure, renderer):
        self.plot, group = PLOTS[name], renderer.name
        self.kind, _, self.right = group.partition(" ")
        rows = [row for row in self.plot.rows if row.group == group]
        self.rows = [row.name for row in rows] or [group]
        looks = {key: [row.look[key] for row in rows] for key in (rows[0].look if rows else ())}
        looks |= {key: [getattr(row, key) for row in rows] for key in ("role", "symbol")}
        sources = {each.name: each.data_source for each in figure.renderers}
        self.described = {
            "source": renderer.data_source,
            "rows": self.rows,
            "kind": self.kind,
            "looks": looks | {"row": self.rows},
            "tips": sources.get(group.replace("lines", "tips")) if self.kind == "lines" else None,
        }

    def axes(self, view):
        """The axes along x and y, and that of the colours of an image; none where there is nothing yet."""
        axes = view.axes_of(self.plot)
        return [axes[0], axes[2]] if self.right else axes


def layers(figures):
    """All layers of some figures, in the order in which they are sent."""
    return [
        Layer(name, figure, renderer)
        for name, figure in figures.items()
        for renderer in figure.renderers
        if not renderer.name.startswith("tips")
    ]


def packed(view, layers, states, moving_only=False):
    """Some states as one array, where each of them begins in it, and the labels of each.

    With `moving_only` those layers are left out that stay while a scene is played.
    """
    chosen = [layer for layer in layers if not moving_only or moves(view, layer)]
    plots = dict.fromkeys(layer.plot for layer in chosen)
    parts, starts, labels, at = [], [], [], 0
    for i in states:
        columns = {plot: view.columns(plot, i) for plot in plots}
        starts.append(at)
        words = []
        for layer in chosen:
            rows, axes = columns[layer.plot], layer.axes(view)
            sizes = ([axis.factor for axis in axes] or [1.0] * 3)[: 3 if layer.kind == "image" else 2]
            for row in layer.rows:
                for values, size in zip(inside(layer.kind, axes, rows[row]), sizes, strict=False):
                    parts += [[np.size(values)], np.ravel(values) / size]
                    at += 1 + parts[-1].size
            words += [rows[row][2] for row in layer.rows if layer.kind == "labels"]
        labels.append(words)
    with np.errstate(over="ignore", under="ignore"):
        packet = np.concatenate([*parts, [0.0]], dtype=np.float32, casting="unsafe")
    return packet, starts, labels


def inside(kind, axes, row):
    """A line or area as far as it is within its axes, for a canvas that does not clip."""
    if kind not in ("areas", "lines") or not axes:
        return row
    x, y, *_ = axes
    row = row[:2]
    for k, sign, bound in ((1, 1, y.end), (0, 1, x.end), (0, -1, -x.start)):
        beyond = sign * row[k] > bound + 1e-9 * abs(bound)
        if not beyond.any():
            continue
        at = np.flatnonzero(beyond[:-1] != beyond[1:])
        share = (sign * bound - row[k][at]) / (row[k][at + 1] - row[k][at])
        row = [np.insert(part, at + 1, part[at] + share * (part[at + 1] - part[at])) for part in row]
        cut = sign * bound if kind == "areas" else np.nan
        row[k] = np.where(np.insert(beyond, at + 1, False), cut, row[k])
    return row


def moves(view, layer):
    """Whether any row of a layer changes from state to state."""
    return not view.moving(layer.plot, view.way.now).keys().isdisjoint(layer.rows)


def drawn(view, plot, states):
    """Names of the rows of a plot that have something to show in one of some states."""
    rows = [row for i in states for row in view.columns(plot, i).items()]
    return {row for row, values in rows if np.size(values[1]) and np.isfinite(values[1]).any()}
