"""Exports: link, report, Python, and curves as CSV in SI."""

from datetime import UTC, datetime
from html import escape
from io import StringIO
from math import isclose
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn
from bokeh.embed import components
from bokeh.resources import Resources
from jinja2 import Template

import mdr_core as mdr

from .. import readouts
from ..draw import drawn, legend, picture_of
from ..extra import EXTRAS, Extra
from ..plot import Plot, View
from ..plots import visible
from ..quantities import CHOICES, LABELS, QUANTITIES, SHAPES
from ..readouts import readings
from ..shared.summary import summary
from ..shared.widgets import field, tools
from ..state import MEDIUM_CHOICES, PRESETS, YIELD_CONSTANT, State, altered, used
from ..ui import CSS, WIDE, html, marked, show, symbol
from ..units import written

_TEMPLATE = Template(Path(__file__).with_suffix(".html").read_text(encoding="utf-8"))
#: A plot in a report.
_PRINTED = {"sizing_mode": "fixed", "width": 500, "height": 340, "output_backend": "svg"}


def csv(view: View) -> str:
    """All states along the path: every readout that changes."""
    columns = {
        f"{each.known.long_name} {each.known.symbol} ({each.known.unit or '1'})": values
        for each, values in readings(view.course).items()
        if np.ndim(values)
    }
    return _table(view, "states along the path", columns)


def pressure_csv(view: View, points: int = 401) -> str:
    """Pressure, line load and reduced profile of the present state."""
    now, profile = view.course.state, view.course.scene.profile
    largest = 1.25 * float(view.course.turning_point.contact_radius)
    r = np.linspace(0, min(largest, profile.known_radius), points)
    columns = {
        "radius r (m)": r,
        "sigma_zz (Pa)": 0.0 - now.pressure(r),
        "line load q (N/m)": now.line_load(r),
        "reduced profile g (m)": profile.reduced(r),
    }
    title = f"state at depth d = {float(now.depth)!r} m, force F = {float(now.force)!r} N"
    return _table(view, title, columns)


def _table(view: View, title: str, columns: dict[str, Any]) -> str:
    """Columns in SI, with the scene in a header."""
    head = f"mdr_core {mdr.__version__}: {title}\n{summary(view.state)}\n{view.course.scene.to_python()}"
    rows = zip(*(np.asarray(column, float).tolist() for column in columns.values()), strict=True)
    lines = [*(f"# {line}".rstrip() for line in head.splitlines()), ",".join(columns)]
    return "\n".join([*lines, *(",".join(map(repr, row)) for row in rows)]) + "\n"


def report(view: View, plots: list[Plot], snippet: str, address: str = "") -> str:
    """The report as HTML."""
    state, course = view.state, view.course
    plots = [plot for plot in plots if plot.axes_of(view)]
    title = PRESETS[state.preset].label + ", altered" * bool(altered(state))
    words = {
        "title": title,
        "scene": marked(summary(state)),
        "made": f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC, mdr_core {mdr.__version__}",
        "inputs": list(_inputs(state)),
        "numbers": [
            (symbol(each.known.symbol), each.known.long_name, readouts.text(each, values, course.now, 5))
            for each, values in readouts.readings(course).items()
        ],
        "limits": [(level, marked(text)) for level, text in readouts.limits(course, state)],
        "told": [each for extra in EXTRAS.values() for each in extra.told(view) if each[1]],
        "python": escape(snippet),
        "link": escape(address),
    }
    pictures = [picture_of(plot, "glyph") for plot in plots]
    for picture in pictures:
        picture.figure.update(**_PRINTED)
        picture.show(picture.columns(view, course.now, False), view, False)
    script, figures = components([picture.figure for picture in pictures])
    words["plots"] = []
    for plot, figure in zip(plots, figures, strict=True):
        key, note = legend(plot, drawn(view, plot, {course.now})), plot.note_of(view)
        words["plots"].append((plot.title, key, figure, marked(plot.formula_of(course)), note))
    # Of Bokeh alone what draws.
    bokeh = Resources(mode="inline", components=["bokeh"]).js_raw
    return _TEMPLATE.render(words, bokeh=bokeh, script=script, style=CSS)


def _inputs(state: State):
    """Symbol, name, value and source of all inputs, as HTML."""
    preset, shape = PRESETS[state.preset], SHAPES[state.shape]
    note = state.tip_note if state.shape == "sampled" else f"{shape.height},  {shape.reduced}"
    yield "", "indenter", escape(shape.label), marked(note)
    for choice in (*MEDIUM_CHOICES, "drive"):
        yield "", LABELS[choice].lower(), CHOICES[choice][state[choice]], ""
    given = used(state)
    for name in dict.fromkeys([*given, "E_star", *YIELD_CONSTANT[state.plasticity]]):
        known, value = QUANTITIES[name], state[name]
        source = "set on the page" if name in given else "from the numbers above"
        if name in preset.sources and isclose(value, preset.values[name]):
            source = preset.sources[name]
        yield symbol(known.symbol), known.label, written(value, known.kind, 5), escape(source)


class Share:
    """The panel *Share*."""

    def __init__(self, page: Any):
        self._page = page
        self.link = field(pn.widgets.TextInput, label="Link to this page")
        self.python = field(pn.widgets.TextAreaInput, label="This scene in Python", rows=12)
        self._note = html()
        buttons = [
            pn.widgets.FileDownload(
                label=label, filename=name, callback=lambda write=write: StringIO(write(self._page.shown)),
                auto=True, css_classes=["button"], margin=0,
            )
            for label, name, write in (
                ("Report", "report.html", self._report),
                ("Curves (CSV)", "curves.csv", csv),
                ("Pressure (CSV)", "pressure.csv", pressure_csv),
            )
        ]  # fmt: skip
        self.view = pn.Column(self.link, self._note, tools(*buttons), self.python, **WIDE)

    def address(self) -> tuple[str, str]:
        """Link to the page, or why it has none."""
        query, note = self._page.query()
        base = pn.state.location.href.split("?")[0] if pn.state.location else ""
        return "" if note else base + f"?{query}" * bool(query), note

    def show(self, view: View) -> None:
        address, note = self.address()
        show(self.link, value=address)
        show(self._note, object=note)
        show(self.python, value=view.course.scene.to_python())

    def _report(self, view):
        return report(view, visible(view), view.course.scene.to_python(), self.address()[0])


EXTRA = Extra("share", order=20, tab="Share", place="header", side=Share)
