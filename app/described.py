"""What is seen in a plot, as a text for those who do not see it, from the columns that are drawn."""

import numpy as np

from .units import digits


def described(view, plot):
    """The plot in words: its axes, and of each row where it is, how far it goes, and how high it comes."""
    axes = view.axes_of(plot)
    if not axes:
        return f"{plot.title}: nothing yet."
    x, y, *more = axes
    said = [f"{plot.title}: {y.title}, over {x.title}, from {_at(x, x.start)} to {_at(x, x.end)}."]
    stacked = all(row.kind == "areas" for row in plot.rows if row.legend)
    for row in plot.rows:
        columns = view.columns(plot, view.way.now)[row.name]
        if row.legend and (text := _row(row, columns, x, more[0] if row.axis == 2 else y, stacked)):
            said.append(f"{row.name}: {text}.")
    if plot.image:
        values = view.columns(plot, view.way.now)["image"][2]
        if np.isfinite(values).any():
            said.append(f"colours: {_at(more[0], np.nanmax(values))} at most.")
    return " ".join(said)


def _row(row, columns, x, y, stacked):
    """Where one row is; nothing if it is not drawn."""
    at, values = (np.ravel(part) for part in columns[:2])
    drawn = np.isfinite(at) & np.isfinite(values)
    if not drawn.any():
        return ""
    if row.kind == "areas" and stacked:
        # Between two edges, of which the second is gone along backward.
        half = values.size // 2
        return f"{_at(y, np.max(np.abs(values[:half] - values[half:][::-1])))} high at most"
    at, values = at[drawn], values[drawn]
    if row.kind == "marks":
        return "; ".join(f"{_of(x, a)}, {_of(y, b)}" for a, b in zip(at[:4], values[:4], strict=True))
    if row.symbol:
        # Of two sides that are alike the right one.
        top = values.size - 1 - int(np.argmax(values[::-1]))
        return f"{row.symbol} from {_at(y, values.min())} to {_at(y, values[top])} at {_of(x, at[top])}"
    return f"from {_of(x, at.min())} to {_at(x, at.max())}"


def _at(axis, value):
    return f"{digits(float(value) / axis.factor, 3)} {axis.unit}".strip()


def _of(axis, value):
    return f"{axis.title.split(',')[0]} = {_at(axis, value)}"
