"""Plots of results as HoloViews elements: rows, their colours, and their columns in SI units.

The explorer draws the same rows from the same columns. HoloViews is imported when a result is plotted.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np

from .quantities import QUANTITIES, unit_of
from .report import imported

#: Colours of the roles on light and on dark background (Okabe–Ito), the same in every plot.
ROLES = {
    "free": ("#8a8f98", "#828a95"),
    "elastic": ("#0072b2", "#56b4e9"),
    "yielded": ("#d55e00", "#f0913a"),
    "held": ("#aa4499", "#dd8fd0"),
    "measured": ("#7a4a1e", "#d8b48a"),
    "speed": ("#009e73", "#35c79b"),
    "loss": ("#b8860b", "#e0c04c"),
    "stick": ("#4b3fa7", "#a99ff5"),
    "slip": ("#7a9700", "#c3dc3a"),
    "ink": ("#22272e", "#e4e7eb"),
    "body": ("#c9ced6", "#3a4049"),
    "paper": ("#ffffff", "#181b20"),
    "chalk": ("#fefefe", "#fefefe"),
}
NOTHING = np.array([np.nan]), np.array([np.nan])
#: Number of springs; heights of the vertices of one from base (0) to top (1), and their offsets; a gap.
SPRINGS = 60
_ALONG = np.array([0, 0.14, 0.23, 0.41, 0.59, 0.77, 0.86, 1, np.nan])
_BEND = np.array([0, 0, -0.72, 0.72, -0.72, 0.72, 0, 0, np.nan])
#: Depth of the base of the springs over the height of the plot above the surface.
REST = 1.5


@dataclass(frozen=True)
class Row:
    """One area, line, mark or label of a plot; `look` is its style, `legend` whether the legend names it.

    A line with a `symbol` has a tooltip with its values on the axis `axis` (0 x, 1 y, 2 right).
    """

    kind: str
    name: str
    role: str = "ink"
    legend: bool = True
    symbol: str = ""
    axis: int = 1
    look: dict[str, Any] = field(default_factory=dict)

    @property
    def group(self):
        """Name of the glyph that draws it: one for each kind and for the left and the right axis."""
        return self.kind if self.axis == 1 else f"{self.kind} right"

    def called(self, columns):
        """Name in legends and tooltips: its own, or that of a line in the third of its columns."""
        return (self.kind == "lines" and "".join(columns[2:])) or self.name


def area(name, role, alpha, hatch=" ", legend=True):
    return Row("areas", name, role, legend, look={"alpha": alpha, "hatch": hatch})


def line(name, role, width=2.0, dash="solid", symbol="", axis=1, legend=True):
    return Row("lines", name, role, legend, symbol, axis, {"width": width, "dash": dash})


def mark(name, role="ink", edge="paper", marker="circle", size=10, axis=1, legend=True):
    return Row("marks", name, role, legend, axis=axis, look={"edge": edge, "marker": marker, "size": size})


def label(name):
    return Row("labels", name, legend=False)


@dataclass(frozen=True)
class Axis:
    """An axis: name, title, unit and its size in SI, start and end (SI), and whether it is logarithmic."""

    name: str
    title: str
    unit: str
    factor: float
    start: float | None = None
    end: float | None = None
    log: bool = False

    @classmethod
    def fitting(cls, name, title, unit, largest, **ends):
        """An axis with the unit that fits its largest value (SI)."""
        fit = unit_of(largest, unit)
        return cls(name, title, fit.name, fit.factor, **ends)

    @property
    def ends(self):
        """Start and end in its unit."""
        return tuple(end and float(f"{end / self.factor:.9g}") for end in (self.start, self.end))

    @property
    def label(self):
        """The title with the unit."""
        return f"{self.title} ({self.unit})" if self.unit else self.title


def parts(symbol):
    """Rows of a curve in three parts: unloading, elastic, yielding."""
    return (
        line("unloading", "elastic", 1.8, "dashed", symbol),
        line("elastic", "elastic", 2.2, symbol=symbol),
        line("yielding", "yielded", 3.0, symbol=symbol),
    )


RADII = (
    line("at a", "ink", 1.0, "dashed", legend=False),
    line("at c", "yielded", 1.3, "dotted", legend=False),
    label("a"),
    label("c"),
)
SPRING_ROWS = (
    area("profile g(x)", "body", 0.55),
    line("edge", "ink", 1.8, legend=False),
    line("free", "free", 0.9),
    line("elastic", "elastic", 1.4),
    line("yielded", "yielded", 2.4),
    line("stretched", "stick", 1.8),
    line("residual imprint", "yielded", 1.4, "dotted"),
    *RADII,
)
PRESSURE_ROWS = (
    area("plastic zone r < c", "yielded", 0.13),
    area("below", "elastic", 0.12, legend=False),
    line("−σzz(r)", "elastic", 2.0, symbol="−σzz"),
    line("mean F/(πa²)", "ink", 1.0, "dotdash", "mean"),
    *RADII,
)


def both(values, sign=1):
    """Values mirrored to negative coordinates, with a sign for these."""
    return np.concatenate([sign * values[::-1], values])


def split(x, y, depth, plastic_depth):
    """A curve over the states of a path in its `parts`."""
    kind = np.where(np.diff(plastic_depth) > 0, 2, np.where(np.diff(depth) < 0, 0, 1))
    rows = {}
    for number, name in enumerate(("unloading", "elastic", "yielding")):
        steps = kind == number
        ends = np.flatnonzero(np.append(steps, False) | np.append(False, steps))
        # A gap between two states that are not joined by a step of this kind.
        gaps = [k + 1 for k, (one, two) in enumerate(pairwise(ends)) if two > one + 1 or not steps[one]]
        rows[name] = tuple(np.insert(np.asarray(v, float)[ends], gaps, np.nan) for v in (x, y))
    return {name: row if row[0].size else NOTHING for name, row in rows.items()}


def at_radii(a, c, half, bottom, top):
    """Lines at ±a and ±c and their labels; that of c is on the inside where both are close."""
    a, c = a or np.nan, c or np.nan
    y = np.array([bottom, top, np.nan, bottom, top])
    beside = -0.08 if a - c < 0.11 * half else 0.03
    return {
        "at a": (np.array([-a, -a, a, a, a]), y),
        "at c": (np.array([-c, -c, c, c, c]), y),
        "a": (a + 0.03 * half, 0.98 * top, "a"),
        "c": (c + beside * half, 0.98 * top, "c"),
    }


def reduced(profile, x):
    """Reduced profile (m), NaN beyond the known radius."""
    return np.where(x <= profile.known_radius, profile.reduced(np.minimum(x, profile.known_radius)), np.nan)


def _outline(profile, half):
    """Coordinates of the profile g(x) on both sides, with its wall and its edges."""
    edges = [profile.face_radius, profile.wall, profile.wall * (1 + 1e-9)]
    x = np.unique(np.append(np.linspace(0, half, 60), [edge for edge in edges if edge < half]))
    g = reduced(profile, x)
    x, g = x[np.isfinite(g)], g[np.isfinite(g)]
    return both(x, -1), both(g)


def _places(half, state):
    """Coordinates of springs; two are moved into an elastic ring that is narrower than their distance."""
    x = half * (2 * (np.arange(SPRINGS) + 0.5) / SPRINGS - 1)
    a, c = float(state.contact_radius), float(state.plastic_radius)
    if 0 < c < a and not ((np.abs(x) > c) & (np.abs(x) < a)).any():
        nearest = int(np.argmin(np.abs(x - (a + c) / 2)))
        x[[nearest, -1 - nearest]] = (a + c) / 2, -(a + c) / 2
    return x


def springs(state, half, height, relaxing=lambda g: 0.0, along=None):
    """Springs for |x| < `half` (m) below an indenter that is drawn up to a height (m).

    `relaxing` gives the elastic compression (m) of released elements at reduced heights. With friction,
    `along` gives the tangential displacement (m) of elements at radii, and whether they stick; it is drawn
    with half the scale of depths.
    """
    profile, interval, far, base_height = state.profile, state.live_interval, 3 * height, -REST * height
    x = _places(half, state)
    g = reduced(profile, np.abs(x))
    left = np.fmax(interval.lower - g, 0.0)
    contact = (state.contact_radius > 0) & (g < interval.upper)
    top = np.where(contact, g - state.depth, -left - np.where(contact, 0.0, relaxing(g)))
    lean, stick = (0.0 * x, None) if along is None else along(np.abs(x))
    lean = np.where(contact, lean, 0.0)[:, None] * (half / 2 / height) * _ALONG
    path = x[:, None] + _BEND * half / SPRINGS + lean, base_height + (top[:, None] - base_height) * _ALONG
    # Springs carry tension with adhesion only.
    adhesive = state.medium.work_of_adhesion > 0
    stretched = contact & adhesive & (np.maximum(g, interval.lower) > state.depth)
    states = {
        "free": ~contact & (left == 0),
        "elastic": contact & (left == 0) & ~stretched,
        "yielded": (left > 0) & ~stretched,
        "stretched": stretched,
    }
    if along is not None:
        states = {name: some & ~contact for name, some in states.items()}
        states |= {"sticks": contact & stick, "slips": contact & ~stick}
    rows = {name: tuple(part[some].ravel() for part in path) for name, some in states.items()}
    edge, (shape_x, shape_g) = np.array([far]), _outline(profile, 1.1 * half)
    body = np.minimum(shape_g - state.depth, far)
    rows["profile g(x)"] = (
        np.concatenate([shape_x[:1], shape_x, shape_x[-1:]]),
        np.concatenate([edge, body, edge]),
    )
    # The same as a line, which ends at the upper edge of the plot.
    rows["edge"] = rows["profile g(x)"]
    if interval.lower > 0:
        rows["residual imprint"] = shape_x, 0.0 - np.maximum(interval.lower - shape_g, 0)
    return rows | at_radii(
        float(state.contact_radius), float(state.plastic_radius), half, base_height, height
    )


def radii(state, half):
    """Radii from 0 to `half`, dense where the pressure has an edge: at 0, c, a and at kinks."""
    profile, dense = state.profile, (1 - np.cos(np.linspace(0, np.pi, 40))) / 2
    kinks = profile.kinks if len(profile.kinks) <= 3 else ()
    edges = [state.contact_radius, state.plastic_radius, *map(profile.contact_radius, kinks)]
    edges = np.array(sorted({0.0, half, *(float(e) for e in edges if e <= half)}))
    return np.unique(np.append(edges[:-1, None] + np.diff(edges)[:, None] * dense, edges))


def ceiling(state, half):
    """Largest pressure (Pa) of a plot; where it is infinite, at most four times the mean."""
    p = state.pressure(radii(state, half))
    largest = float(np.max(p[np.isfinite(p)], initial=0.0))
    return largest if not np.isposinf(p).any() else min(largest, 4 * float(state.mean_pressure))


def cut(p, top):
    """Pressures (Pa) within an axis that ends at `top`, and at −`top` with adhesion."""
    return np.clip(p, -top, 1e3 * top)


def pressure(state, r, p, half, top):
    """Rows of the pressures p (Pa) at radii r (m), for axes that end at ±`half` and `top`."""
    a, c, mean = (float(v) for v in (state.contact_radius, state.plastic_radius, state.mean_pressure))
    curve = both(r, -1), both(cut(p, top))
    return at_radii(a, c, half, 0.0, top) | {
        "plastic zone r < c": (np.array([-c, c, c, -c]), np.array([0, 0, top, top])) if c else NOTHING,
        "below": curve,
        "−σzz(r)": curve,
        "mean F/(πa²)": (np.array([-a, a]), np.array([mean, mean])) if a else NOTHING,
    }


DASHES = {"solid": "solid", "dashed": "6 4", "dotted": "2 3", "dotdash": "6 3 2 3"}


def _styled(row):
    """Style of a row in options of Bokeh."""
    colour = ROLES[row.role][0]
    if row.kind == "lines":
        return {"color": colour, "line_width": row.look["width"], "line_dash": DASHES[row.look["dash"]]}
    if row.kind == "areas":
        return {"fill_color": colour, "fill_alpha": row.look["alpha"], "line_alpha": 0}
    if row.kind == "marks":
        return {"color": colour, "size": row.look["size"], "line_alpha": 0}
    return {"text_color": colour, "text_font_style": "italic", "text_font_size": "12px"}


def overlay(title, rows, columns, axes):
    """A plot as a HoloViews overlay, with one element for each row that has data."""
    hv = imported("holoviews", "a plot", "holoviews bokeh")
    if not hv.Store.loaded_backends():
        hv.extension("bokeh", logo=False)
    bokeh, made = "bokeh" in hv.Store.loaded_backends(), []
    dims = [hv.Dimension((axis.name, axis.title), unit=axis.unit or None) for axis in axes]
    for row in rows:
        x, y, *text = columns.get(row.name, NOTHING)
        if not np.isfinite(y).any():
            continue
        x, y = (np.asarray(v) / axis.factor for v, axis in zip((x, y), axes, strict=True))
        named = {"label": row.name} if row.legend else {}
        if row.kind == "lines":
            element = hv.Curve((x, y), dims[0], dims[1], **named)
        elif row.kind == "marks":
            element = hv.Scatter((x, y), dims[0], dims[1], **named)
        elif row.kind == "areas":
            element = hv.Polygons([{dims[0].name: x, dims[1].name: y}], dims, **named)
        else:
            element = hv.Labels(([x], [y], text), dims, "text")
        made.append(element.opts(backend="bokeh", **_styled(row)) if bokeh else element)
    look = {"title": title, "width": 600, "height": 400, "show_grid": True, "legend_position": "right"}
    look |= {"xlim": axes[0].ends, "ylim": axes[1].ends}
    return hv.Overlay(made).opts(backend="bokeh", **look) if bokeh else hv.Overlay(made)


def plot_curve(result, quantity, over):
    """A quantity of a result over another one: `Result.plot`."""
    for name in {quantity, over} - set(result._quantities):
        known = ", ".join(result._quantities)
        raise ValueError(f"{type(result).__name__} has no {name!r} to plot; it has {known}")
    if len(result.shape) != 1:
        raise ValueError(f"plot() is for one path, this is of shape {result.shape}: take one of it")
    x, y = (np.asarray(getattr(result, name)) for name in (over, quantity))
    axes = [_axis_of(name, values) for name, values in ((over, x), (quantity, y))]
    if {"depth", "plastic_depth"} <= set(result._quantities):
        columns = split(x, y, result.depth, result.plastic_depth)
        return overlay(result._title(), parts(""), columns, axes)
    return overlay(result._title(), [line("", "elastic", legend=False)], {"": (x, y)}, axes)


def _axis_of(name, values):
    known = QUANTITIES[name]
    largest = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    return Axis.fitting(name, f"{known.symbol}, {known.long_name}", known.unit, largest)


def plot_pressure(state):
    """Contact pressure of one state: `Indentation.plot_pressure`."""
    half = _drawn_radius(state, "plot_pressure")
    top, r = 1.05 * ceiling(state, half), radii(state, half)
    axes = [
        Axis.fitting("r", "r, radius", "m", half, start=-half, end=half),
        Axis.fitting("pressure", "−σzz, contact pressure", "Pa", top, start=0.0, end=top),
    ]
    columns = pressure(state, r, state.pressure(r), half, top)
    return overlay("Contact pressure", PRESSURE_ROWS, columns, axes)


def plot_springs(state):
    """Springs of the 1D foundation in one state: `Indentation.plot_springs`."""
    half = _drawn_radius(state, "plot_springs")
    height = max(float(state.depth), float(state.live_interval.upper))
    axes = [
        Axis.fitting("x", "x, coordinate of the springs", "m", half, start=-half, end=half),
        Axis.fitting("z", "z, height", "m", height, start=-REST * height, end=height),
    ]
    return overlay("1D foundation", SPRING_ROWS, springs(state, half, height), axes)


def _drawn_radius(state, what):
    """Half-width (m) of a plot: the radius of the contact or of the imprint, and a quarter more."""
    state._one(what)
    largest = max(float(state.contact_radius), float(state.plastic_radius))
    if not largest:
        raise ValueError(f"{what} needs a contact or an imprint, and at d = {state.depth:g} m is none")
    return 1.25 * largest
