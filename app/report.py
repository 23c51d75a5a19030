"""The report: one file of HTML with all that the page shows, to be read and printed alone."""

from datetime import UTC, datetime
from html import escape
from math import isclose

import numpy as np
from bokeh.embed import components
from bokeh.models import Range1d
from bokeh.resources import Resources
from jinja2 import Template

import mdr_core as mdr

from . import figures, link, readouts
from .described import described
from .packet import drawn, layers
from .parts import HERE, STYLE, legend, marked, symbol
from .plots import PLOTS
from .presets import PRESETS
from .quantities import CHOICES, LABELS, QUANTITIES, SHAPES
from .units import written
from .view import phase

_TEMPLATE = Template((HERE / "static" / "report.html").read_text(encoding="utf-8"))
_WIDTH, _HEIGHT = 500, 340


def report(explorer, view, names, snippet, here="", held=()):
    """All that a page shows, as HTML: some plots, the Python, `here` where it is served, names `held`."""
    way, plots = view.way, [name for name in names if view.axes_of(PLOTS[name])]
    query, title = link.query(explorer), explorer.preset or "Scene from a file"
    words = {
        "title": f"{title}, altered" if explorer.altered else title,
        "scene": marked(readouts.summary(explorer)),
        "held": [escape(name) for name in held],
        "made": f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC, mdr_core {mdr.__version__}",
        "inputs": list(_inputs(explorer, way)),
        "state": phase(way, way.now),
        "numbers": [
            (symbol(name), label, written(readouts.here(values, way.now), kind, 5))
            for name, label, kind, values in readouts.cells(way)
        ],
        "limits": [(level, marked(text)) for level, text in readouts.lights(way, explorer)],
        "python": escape(snippet),
        "link": escape(f"{here}?{query}") if query else "",
    }
    script, figures = components([drawing(view, name) for name in plots])
    words["plots"] = []
    for plot, figure in zip(map(PLOTS.get, plots), figures, strict=True):
        key, found = legend(plot, drawn(view, plot, {way.now})), view.found.get(plot.title)
        words["plots"].append((plot.title, key, figure, marked(plot.formula), found.note if found else ""))
    # Of Bokeh alone what draws.
    bokeh = Resources(mode="inline", components=["bokeh"]).js_raw
    return _TEMPLATE.render(words, bokeh=bokeh, script=script, style=STYLE[0])


def _inputs(explorer, way):
    """Symbol, name, value and source of all that was set, as HTML."""
    preset, medium, shape = PRESETS.get(explorer.preset), way.scene.medium, SHAPES[explorer.shape]
    formulas = f"{shape.height},  {shape.reduced}"
    yield "", "indenter", escape(shape.label), marked(explorer.tip_note) or marked(formulas)
    for choice in ("elasticity", "plasticity", "damping", "drive"):
        yield "", LABELS[choice].lower(), CHOICES[choice][getattr(explorer, choice)], ""
    for name in explorer.used():
        quantity, value = QUANTITIES[name], getattr(explorer, name)
        source = "set on the page"
        if preset and name in preset.sources and isclose(value, preset.values[name]):
            source = preset.sources[name][2]
        yield symbol(quantity.symbol), quantity.label, written(value, quantity.kind, 5), escape(source)
    yield "", "as solved, in SI", "", escape(repr(way.scene.drive))
    if explorer.elasticity != "modulus":
        yield symbol("E*"), "effective modulus", written(medium.E_star, "pressure", 5), marked("from (2)")
    if explorer.plasticity == "hardness":
        yield symbol("q_c"), "yield constant", written(medium.q_c, "yield constant", 5), marked("from (11)")


def drawing(view, name):
    """A plot as it stands on the page, to be printed."""
    plot, made = PLOTS[name], figures.figure(name)
    # On the page some share an axis, and all are drawn on a canvas that does not clip.
    own = {} if plot.log else {"x_range": Range1d(), "y_range": Range1d()}
    said = {"role": "img", "aria-label": described(view, plot)}
    size = {"sizing_mode": "fixed", "width": _WIDTH, "height": _HEIGHT}
    made.update(html_attributes=said, output_backend="svg", **size, **own)
    if name == "map":
        made.update(frame_width=_HEIGHT - 70, frame_height=_HEIGHT - 70)
    figures.set_axes(made, view.axes_of(plot))
    for layer in layers({name: made}):
        fill(layer, view, view.columns(plot, view.way.now))
    for renderer in made.renderers:
        renderer.level = "glyph"
    return made


def fill(layer, view, columns):
    """Write columns of a plot (SI) into the source of one of its layers, as `show.js` does on the page."""
    source, axes = layer.described["source"], layer.axes(view)
    rows = [columns[row] for row in layer.rows]
    xs, ys = ([np.asarray(row[k]) / axes[k].factor for row in rows] for k in (0, 1))
    if layer.kind == "image":
        (left, right), (bottom, top) = xs[0], ys[0]
        corner = {"x": [left], "y": [bottom], "dw": [right - left], "dh": [top - bottom]}
        source.data = dict(source.data) | corner | {"image": [rows[0][2] / axes[2].factor]}
    elif "xs" in source.data:
        wrap = (lambda row: [[row]]) if layer.kind == "areas" else (lambda row: row)
        source.data = dict(source.data) | {"xs": list(map(wrap, xs)), "ys": list(map(wrap, ys))}
    else:
        sizes = [row.size for row in map(np.atleast_1d, xs)]
        looks = {key: np.repeat(looks, sizes) for key, looks in layer.described["looks"].items() if looks}
        if layer.kind == "labels":
            looks = {"Label": [row[2] for row in rows]}
        data = {key: value for key, value in source.data.items() if key in looks}
        source.data = data | looks | {"x": np.hstack(xs), "y": np.hstack(ys)}
