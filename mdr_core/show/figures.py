"""Content of the plots of results: rows, their colours, and their columns in SI units.

`plots` draws the rows with HoloViews, and the explorer draws the same rows and columns with Bokeh. The
springs of the 1D foundation are in `springs`.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np

from ..solver.contact.unloading import unloading_curve
from .quantities import unit_of
from .units import format_quantity

#: Colours of the roles on a light and on a dark background (Okabe–Ito), the same in every plot.
ROLES = {
    "free": ("#8a8f98", "#828a95"),
    "elastic": ("#0072b2", "#56b4e9"),
    "yielded": ("#d55e00", "#f0913a"),
    "held": ("#aa4499", "#dd8fd0"),
    "held-2": ("#117733", "#6fcf8e"),
    "held-3": ("#8a5a00", "#d9b45a"),
    "held-4": ("#332288", "#b3a8ff"),
    "measured": ("#7a4a1e", "#d8b48a"),
    "speed": ("#009e73", "#35c79b"),
    "loss": ("#b8860b", "#e0c04c"),
    "stick": ("#4b3fa7", "#a99ff5"),
    "slip": ("#7a9700", "#c3dc3a"),
    "elastic-text": ("#005a8e", "#b4dcf7"),
    "yielded-text": ("#8c3a00", "#ffc793"),
    "soft": ("#566070", "#a9b1bb"),
    "ink": ("#22272e", "#e4e7eb"),
    "body": ("#c9ced6", "#3a4049"),
    "paper": ("#ffffff", "#181b20"),
    "chalk": ("#fefefe", "#fefefe"),
}
#: Dashes of lines by their names.
DASHES = {"solid": "solid", "dashed": "6 4", "dotted": "2 3", "dotdash": "6 3 2 3"}
NOTHING = np.array([np.nan]), np.array([np.nan])


@dataclass(frozen=True)
class Row:
    """One area, line, mark or label of a plot.

    With `legend`, the legend names the row. A label can replace the legend for the rows in `names`. `look`
    has the properties of the Bokeh glyph, with roles as colours and names as dashes. A line with a `symbol`
    has a tooltip with its values on the axis `axis` (0 x, 1 y, 2 right).
    """

    kind: str
    name: str
    role: str = "ink"
    legend: bool = True
    symbol: str = ""
    axis: int = 1
    look: dict[str, Any] = field(default_factory=dict)
    names: tuple[str, ...] = ()

    @property
    def group(self):
        """Name of the glyph that draws the row: one glyph for each kind and for each vertical axis."""
        return self.kind if self.axis == 1 else f"{self.kind} right"

    def called(self, columns):
        """Return the name in legends and tooltips: the third column of a line, or else `name`."""
        return (self.kind == "lines" and "".join(columns[2:])) or self.name

    def look_in(self, dark):
        """Return the properties of the glyph on a light or a dark background."""
        seen = {name: ROLES[value][dark] for name, value in self.look.items() if name.endswith("color")}
        if self.kind == "lines":
            seen["line_dash"] = DASHES[self.look["line_dash"]]
        elif self.kind == "areas" and dark:
            # A pale area would be nearly black.
            seen["fill_alpha"] = min(1.6 * self.look["fill_alpha"], 1.0)
        return self.look | seen


def area(name, role, alpha, hatch=" ", legend=True):
    # The edge has the full colour, because a pale area alone is hard to see.
    look = {"fill_color": role, "fill_alpha": alpha, "line_color": role}
    look |= {"hatch_pattern": hatch, "hatch_color": role, "hatch_alpha": 0.18}
    return Row("areas", name, role, legend, look=look)


def line(name, role, width=2.0, dash="solid", symbol="", axis=1, legend=True, alpha=1.0):
    look = {"line_color": role, "line_width": width, "line_dash": dash, "line_alpha": alpha}
    # Round ends would make dashes and ribbons longer.
    look["line_cap"] = "round" if dash == "solid" and alpha == 1 else "butt"
    return Row("lines", name, role, legend, symbol, axis, look)


def mark(name, role="ink", edge="paper", marker="circle", size=10, axis=1, legend=True):
    look = {"fill_color": role, "line_color": edge, "line_width": 1.6, "marker": marker, "size": size}
    return Row("marks", name, role, legend, axis=axis, look=look)


def label(name, alpha=0.8, align="left"):
    look = {"text_color": "ink", "text_font_size": "12px", "text_font_style": "italic", "text_align": align}
    look |= {"text_baseline": "top", "background_fill_color": "paper", "background_fill_alpha": alpha}
    return Row("labels", name, legend=False, look=look)


def word(name, role, align="center", baseline="middle", alpha=0.0, names=()):
    """Return a label that names rows instead of the legend, next to the drawn rows or on them."""
    look = label(name, alpha, align).look | {"text_color": role, "text_font_style": "normal"}
    look["text_baseline"] = baseline
    return Row("labels", f"label {name}", legend=False, look=look, names=names)


@dataclass(frozen=True)
class Axis:
    """Axis with a name, a title, a unit and its size in SI, both ends (SI), and a linear or log scale."""

    name: str
    title: str
    unit: str
    factor: float
    start: float | None = None
    end: float | None = None
    log: bool = False

    @classmethod
    def fitting(cls, name, title, unit, largest, **ends):
        """Return an axis with the unit that fits its largest value (SI)."""
        fit = unit_of(largest, unit)
        return cls(name, title, fit.name, fit.factor, **ends)

    @property
    def ends(self):
        """Start and end in the unit of the axis."""
        return tuple(end and float(f"{end / self.factor:.9g}") for end in (self.start, self.end))

    @property
    def label(self):
        """Title with the unit."""
        return f"{self.title} ({self.unit})" if self.unit else self.title


def parts(symbol):
    """Return the rows of a curve in three parts: unloading, elastic, yielding."""
    return (
        line("unloading", "elastic", 1.8, "dashed", symbol),
        line("elastic", "elastic", 2.2, symbol=symbol),
        line("yielding", "yielded", 3.0, symbol=symbol),
    )


RADII = (
    line("at a", "ink", 1.0, "dashed", legend=False),
    line("at c", "yielded", 1.3, "dotted", legend=False),
    label("a", 0.0),
    label("c", 0.0),
)
PRESSURE_ROWS = (
    area("plastic zone r < c", "yielded", 0.22),
    area("elastic zone", "elastic", 0.22, legend=False),
    line("p(r)", "elastic", 2.0, symbol="p"),
    line("mean F/(πa²)", "ink", 1.0, "dotdash", "mean"),
    *RADII,
    label("exceeds"),
)
FORCE_ROWS = (
    area("plastic work Wₚ", "yielded", 0.13, "/"),
    area("dissipated", "yielded", 0.13, "/"),
    area("stored", "elastic", 0.25),
    *parts("F"),
)


def both(values, sign=1):
    """Return values mirrored to negative coordinates; the mirrored values are multiplied by `sign`."""
    return np.concatenate([sign * values[::-1], values])


def split(x, y, depth, plastic_depth):
    """Split a curve over the states of a path into its `parts`."""
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
    """Return lines at ±a and ±c and their labels; if a and c are close, the label of c is on the inside."""
    a, c = a or np.nan, c or np.nan
    y = np.array([bottom, top, np.nan, bottom, top])
    beside = -0.08 if a - c < 0.11 * half else 0.03
    return {
        "at a": (np.array([-a, -a, a, a, a]), y),
        "at c": (np.array([-c, -c, c, c, c]), y),
        "a": (a + 0.03 * half, 0.98 * top, "a"),
        "c": (c + beside * half, 0.98 * top, "c"),
    }


def radii(state, half):
    """Return radii from 0 to `half`, dense at the edges of the pressure: at 0, c, a and at kinks."""
    profile, dense = state.profile, (1 - np.cos(np.linspace(0, np.pi, 40))) / 2
    kinks = profile.kinks if len(profile.kinks) <= 3 else ()
    edges = [state.contact_radius, state.plastic_radius, *map(profile.contact_radius, kinks)]
    edges = np.array(sorted({0.0, half, *(float(e) for e in edges if e <= half)}))
    return np.unique(np.append(edges[:-1, None] + np.diff(edges)[:, None] * dense, edges))


def ceiling(state, half):
    """Return the largest pressure (Pa) of a plot; if the pressure is infinite, at most four times the mean.

    With adhesion the result is at least twice the tension on the axis due to adhesion alone.
    """
    p = state.pressure(radii(state, half))
    largest = float(np.max(p[np.isfinite(p)], initial=0.0))
    if np.isposinf(p).any():
        largest = min(largest, 4 * float(state.mean_pressure))
    if state.medium.work_of_adhesion > 0:
        largest = max(largest, -2 / np.pi * float(state.uniform_load / state.contact_radius))
    return largest


def cut(p, top):
    """Limit pressures (Pa) for an axis that ends at `top`, and at −`top` with adhesion."""
    return np.clip(p, -top, 1e3 * top)


def pressure(state, half, top):
    """Return rows of the pressure (Pa) over the radius (m), for axes that end at ±`half` and `top`."""
    r = radii(state, half)
    p = state.pressure(r)
    a, c, mean = (float(v) for v in (state.contact_radius, state.plastic_radius, state.mean_pressure))
    curve = both(r, -1), both(cut(p, top))
    return at_radii(a, c, half, 0.0, top) | {
        "plastic zone r < c": _below(r, cut(p, top), 0.0, min(c, a)),
        "elastic zone": _below(r, cut(p, top), min(c, a), a),
        "p(r)": curve,
        "mean F/(πa²)": (np.array([-a, a]), np.array([mean, mean])) if a else NOTHING,
        # One line below the labels of a and c.
        "exceeds": (-0.97 * half, 0.86 * top, exceeds(r, p, top) if a else "no contact"),
    }


def _below(r, p, inner, outer):
    """Return the area below a pressure between two of the `radii`, on both sides of the axis."""
    some = (r >= inner) & (r <= outer)
    if inner >= outer or np.count_nonzero(some) < 2:
        return NOTHING
    x, y = r[some], p[some]
    if inner == 0:
        x, y = both(x, -1), both(y)
    x, y = np.concatenate([x[:1], x, x[-1:]]), np.concatenate([[0.0], y, [0.0]])
    return (x, y) if inner == 0 else (np.concatenate([-x, [np.nan], x]), np.concatenate([y, [np.nan], y]))


def exceeds(r, p, top):
    """Return a text on the pressure (Pa) at radii r (m) that exceeds the axis, or an empty text."""
    infinite, k = np.isinf(p), int(np.argmax(np.where(np.isinf(p), -1.0, p)))
    if infinite.any():
        # Before yield, the pressure of a sharp tip is infinite on the axis, that of a flat face at its rim.
        at = np.argmax(infinite)
        sign = "↑ p → ∞" if p[at] > 0 else "↓ p → −∞"
        return f"{sign} at the " + ("axis" if r[at] == 0 else "rim")
    if p[k] <= top:
        return ""
    where = "on the axis" if r[k] == 0 else f"at r = {format_quantity(float(r[k]), 'length', 3)}"
    return f"↑ p = {format_quantity(float(p[k]), 'pressure', 3)} {where}"


def work(path, i):
    """Return areas of force over depth up to state i of a path: lost energy and stored energy.

    `path` is an `Indentation` without adhesion. With viscosity in time, the lost energy is not only plastic
    work.
    """
    depth, force = path.depth[: i + 1], path.force[: i + 1]
    plastic_depth, viscous = path.live_interval.lower[: i + 1], path.in_time and path.medium.eta > 0
    back, back_force = unloading_curve(path[i])
    # The lost energy is the area of a loop: along the path so far, and back along the elastic unloading.
    loop = (
        np.concatenate([depth[:1], depth, back, back[-1:]]),
        np.concatenate([[0.0], force, back_force, [0.0]]),
    )
    loses = viscous or plastic_depth[-1] > plastic_depth[0]
    return {
        "dissipated" if viscous else "plastic work Wₚ": loop if loses else NOTHING,
        "stored": (np.append(back[:1], back), np.append(0.0, back_force)),
    }
