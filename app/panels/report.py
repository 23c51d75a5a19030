"""The report: one HTML file with everything on the page."""

from datetime import UTC, datetime
from html import escape
from math import isclose

from bokeh.embed import components
from bokeh.resources import Resources
from jinja2 import Template

import mdr_core as mdr

from ..plots.draw import Picture, described, drawn
from ..plots.plot import Plot, View
from ..solve import numbers_of
from ..state import PRESETS, State, altered
from ..state.quantities import CHOICES, LABELS, QUANTITIES, SHAPES
from ..state.units import written
from ..ui import HERE, STYLE, indexed, legend, marked, plain, symbol
from . import readouts

_TEMPLATE = Template((HERE / "static" / "report.html").read_text(encoding="utf-8"))
_SIZE = 500, 340


def report(state: State, view: View, plots: list[Plot], snippet: str, address: str = "", held=()) -> str:
    """The report as HTML."""
    course, fit = view.course, state.curve.fit if state.curve is not None else None
    plots = [plot for plot in plots if view.axes_of(plot)]
    title = PRESETS[state.preset].label + ", altered" * bool(altered(state))
    words = {
        "title": f"Fit to {state.curve.name}" if fit is not None else title,
        "scene": marked(readouts.summary(state)),
        "held": [escape(name) for name in held],
        "made": f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC, mdr_core {mdr.__version__}",
        "inputs": list(_inputs(state, view)),
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
    script, figures = components([printed(view, plot) for plot in plots])
    words["plots"] = []
    for plot, figure in zip(plots, figures, strict=True):
        key, found = legend(plot, drawn(view, plot, {course.now})), view.found.get(plot.name)
        words["plots"].append(
            (plot.title, key, figure, marked(plot.says(course)), found.note if found else "")
        )
    # Of Bokeh alone what draws.
    bokeh = Resources(mode="inline", components=["bokeh"]).js_raw
    return _TEMPLATE.render(words, bokeh=bokeh, script=script, style=STYLE[0])


def _inputs(state: State, view: View):
    """Symbol, name, value and source of all inputs, as HTML."""
    preset, shape, fit = PRESETS[state.preset], SHAPES[state.shape], state.curve and state.curve.fit
    note = state.tip_note if state.shape == "sampled" else f"{shape.height},  {shape.reduced}"
    yield "", "indenter", escape(shape.label), marked(note)
    for choice in ("elasticity", "plasticity", "damping", "adhesion", "drive"):
        yield "", LABELS[choice].lower(), CHOICES[choice][state[choice]], ""
    given = numbers_of(state)
    for name in dict.fromkeys([*given, "E_star", *["q_c"] * (state.plasticity != "none")]):
        known, value = QUANTITIES[name], state[name]
        source = "set on the page" if name in given else "from the numbers above"
        if fit and name in ("E_star", "q_c"):
            source = "fitted"
        elif name in preset.sources and isclose(value, preset.values[name]):
            source = preset.sources[name]
        yield symbol(known.symbol), known.label, written(value, known.kind, 5), escape(source)


def printed(view: View, plot: Plot):
    picture = Picture(plot, "glyph", _SIZE)
    picture.figure.html_attributes = {"role": "img", "aria-label": described(view, plot)}
    picture.show(picture.columns(view, view.course.now, False), view, False)
    return picture.figure
