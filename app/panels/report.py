"""The report: one HTML file with everything on the page."""

from datetime import UTC, datetime
from html import escape
from math import isclose

from bokeh.embed import components
from bokeh.resources import Resources
from jinja2 import Template

import mdr_core as mdr

from ..plots.draw import Picture, drawn
from ..plots.plot import Plot, View
from ..state import MEDIUM_CHOICES, PRESETS, State, altered, used
from ..state.quantities import CHOICES, LABELS, QUANTITIES, SHAPES
from ..state.units import written
from ..ui import HERE, STYLE, indexed, legend, marked, plain, symbol
from . import readouts

_TEMPLATE = Template((HERE / "static" / "report.html").read_text(encoding="utf-8"))
_SIZE = 500, 340


def report(view: View, plots: list[Plot], snippet: str, address: str = "") -> str:
    """The report as HTML."""
    state, course = view.state, view.course
    fit = state.curve.fit if state.curve is not None else None
    plots = [plot for plot in plots if view.axes_of(plot)]
    title = PRESETS[state.preset].label + ", altered" * bool(altered(state))
    words = {
        "title": f"Fit to {state.curve.name}" if fit is not None else title,
        "scene": marked(readouts.summary(state)),
        "held": [escape(each.name) for each in view.held],
        "made": f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC, mdr_core {mdr.__version__}",
        "inputs": list(_inputs(state)),
        "numbers": [
            (symbol(each.known.symbol), each.known.long_name, readouts.text(each, values, course.now, 5))
            for each, values in readouts.readings(course).items()
        ],
        "limits": [(level, marked(text)) for level, text in readouts.limits(course, state)],
        "fit": "" if fit is None else indexed(plain(fit._repr_html_())),
        "file": "" if fit is None else f"{escape(state.curve.name)}: {escape(state.curve.note)}.",
        "remarks": [] if fit is None else [marked(plain(remark)) for remark in fit.remarks],
        "python": escape(snippet),
        "link": escape(address),
    }
    pictures = [Picture(plot, "glyph", _SIZE) for plot in plots]
    for picture in pictures:
        picture.show(picture.columns(view, course.now, False), view, False)
    script, figures = components([picture.figure for picture in pictures])
    words["plots"] = []
    for plot, figure in zip(plots, figures, strict=True):
        key, found = legend(plot, drawn(view, plot, {course.now})), view.found.get(plot.name)
        words["plots"].append(
            (plot.title, key, figure, marked(plot.formula_of(course)), found.note if found else "")
        )
    # Of Bokeh alone what draws.
    bokeh = Resources(mode="inline", components=["bokeh"]).js_raw
    return _TEMPLATE.render(words, bokeh=bokeh, script=script, style=STYLE[0])


def _inputs(state: State):
    """Symbol, name, value and source of all inputs, as HTML."""
    preset, shape, fit = PRESETS[state.preset], SHAPES[state.shape], state.curve and state.curve.fit
    note = state.tip_note if state.shape == "sampled" else f"{shape.height},  {shape.reduced}"
    yield "", "indenter", escape(shape.label), marked(note)
    for choice in (*MEDIUM_CHOICES, "drive"):
        yield "", LABELS[choice].lower(), CHOICES[choice][state[choice]], ""
    given = used(state)
    for name in dict.fromkeys([*given, "E_star", *["q_c"] * (state.plasticity != "none")]):
        known, value = QUANTITIES[name], state[name]
        source = "set on the page" if name in given else "from the numbers above"
        if fit and name in ("E_star", "q_c"):
            source = "fitted"
        elif name in preset.sources and isclose(value, preset.values[name]):
            source = preset.sources[name]
        yield symbol(known.symbol), known.label, written(value, known.kind, 5), escape(source)
