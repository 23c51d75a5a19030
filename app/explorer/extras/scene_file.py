"""A scene as one HTML file, which plays in a browser without a server and a network."""

import json
from base64 import b64encode
from collections.abc import Iterator
from datetime import UTC, datetime
from math import isclose
from pathlib import Path
from zlib import compress

import panel as pn
from bokeh.document import Document
from bokeh.embed import file_html
from bokeh.events import DocumentReady
from bokeh.models import CustomJS
from bokeh.resources import Resources
from markupsafe import Markup

import mdr_core as mdr
from mdr_core.show.units import format_quantity

from ...common.quantities import CHOICES, QUANTITIES
from ...common.ui import CSS, HERE, JS, Messages, as_html, html_subscripts, symbol
from .. import link, readouts
from ..extra import EXTRAS, Extra
from ..figures import PLACES, Picture, drawn, legend, picture_of
from ..layout import frames, look
from ..link import summary
from ..plot import Plot, View
from ..plots import DRAGGED, NAMED, PLOTS, drag_path, enable_drag
from ..state import (
    MEDIUM_CHOICES,
    PRESETS,
    State,
    changed_from_preset,
    rounded_to_display,
    used,
    yield_constant,
)

_HERE = Path(__file__)
_TEMPLATE = _HERE.with_suffix(".html").read_text(encoding="utf-8")
_PLAYER = (HERE / "static" / "player.js").read_text(encoding="utf-8").replace("export ", "")
#: The page's script of the player as a function, and the script that calls it.
_CODE = f"""{_PLAYER}
{_HERE.with_suffix(".js").read_text(encoding="utf-8")}"""
_PAPER = "V. L. Popov, Facta Universitatis, Series: Mechanical Engineering 13(1), 2015, 39–46"


def address(state: State) -> str:
    """Return the link to a scene on this server; empty without a server, or if the scene has no link."""
    if pn.state.location is None:
        return ""
    try:
        query = link.write(rounded_to_display(state))
    except ValueError:
        return ""
    return pn.state.location.href.split("?")[0] + f"?{query}" * bool(query)


def scene_file(view: View, bokeh: str = "") -> str:
    """Return a view as one HTML file: the three plots, a slider along the path, readouts, and notes.

    `bokeh` is the address of Bokeh's script; by default the file contains the script.
    """
    state, course = view.state, view.course
    title = PRESETS[state.preset].label + ", altered" * bool(changed_from_preset(state))
    numbers = readouts.line(course)
    pictures = [picture_of(PLOTS[name]) for name in NAMED]
    document = Document()
    for picture in pictures:
        picture.show(picture.columns(view, course.now), view)
        document.add_root(picture.figure)
    readout = readouts.values(course, numbers, course.now)
    _connect(document, view, pictures, Messages(words=as_html(readout)))
    words = {
        "style": CSS,
        "private": JS["private"] + JS["page"],
        # Only the script that draws; file_html would add a script of Panel's server.
        "bokeh": "" if bokeh else Resources(mode="inline", components=["bokeh"]).js_raw[0],
        "bokeh_at": bokeh,
        "dark": str(state.dark).lower(),
        "heading": title,
        "scene": html_subscripts(summary(state)),
        "heads": readouts.heads(numbers),
        "readout": readout,
        "plots": [_card(view, picture.plot) for picture in pictures],
        "folded": list(_folded(view)),
        "link": address(state),
        "made": f"{datetime.now(UTC):%d %B %Y}, mdr_core {mdr.__version__}. Equations: {_PAPER}.",
    }
    return file_html(document, "inline", title, template=_TEMPLATE, template_variables=words)


def _card(view: View, plot: Plot) -> tuple[str, ...]:
    """Return name and title of a plot, the text next to the title, and the legend as HTML."""
    key = legend(plot, drawn(view, plot))
    return plot.name, plot.title, html_subscripts(plot.aside(view)), key


def _connect(document: Document, view: View, pictures: list[Picture], messages: Messages) -> None:
    """Let the browser play and drag the scene, and change the theme."""
    sources, *sent = frames(view, pictures)
    course, looks = view.course, []
    for dark in (False, True):
        shaded = View(view.state.replace(dark=dark), course, view.computed)
        columns = [each for picture in pictures for each in picture.columns(shaded, course.now).items()]
        looks.append([{name: data[name] for name in data if name not in PLACES} for _, data in columns])
    told = {
        "messages": messages,
        "figures": [picture.figure for picture in pictures],
        "sources": sources,
        "layers": [source for source, _ in columns],
        "looks": looks,
        "dragging": {"path": json.dumps(drag_path(view) | {"pressing": False})},
        "look": look(view.course),
        # Compressed to a tenth of its size.
        "packed": b64encode(compress(json.dumps(sent).encode(), 9)).decode(),
    }
    document.js_on_event(DocumentReady, CustomJS(args=told, code=_CODE))
    for picture in pictures:
        if picture.plot.name in DRAGGED:
            enable_drag(picture.figure)


def _folded(view: View) -> Iterator[tuple[str, str]]:
    """Yield titles and texts (HTML) below the plots."""
    yield from (each for extra in EXTRAS.values() for each in extra.scene_file_texts(view) if each[1])
    row = Markup("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>")
    rows = Markup("").join(row.format(*cells) for cells in _inputs(view.state))
    yield "Inputs and their sources", Markup("<table>{}</table>").format(rows)


def _inputs(state: State) -> Iterator[tuple[str, str, str, str]]:
    """Yield symbol, name, value and source of all inputs, as texts or HTML."""
    preset, shape = PRESETS[state.preset], state.chosen("shape")
    note = state.tip_note if state.shape == "sampled" else f"{shape.height},  {shape.reduced}"
    yield "", "indenter", shape.label, html_subscripts(note)
    for choice in (*MEDIUM_CHOICES, "drive"):
        yield "", CHOICES[choice].label.lower(), html_subscripts(state.chosen(choice).label), ""
    given = used(state)
    for name in dict.fromkeys([*given, "E_star", *yield_constant(state)]):
        known, value = QUANTITIES[name], state[name]
        source = "set on the page" if name in given else "from the numbers above"
        if name in preset.sources and isclose(value, preset.values[name]):
            source = preset.sources[name]
        yield symbol(known.symbol), known.label, format_quantity(value, known.kind, 5), source


EXTRA = Extra("scene_file", order=19, files=(("Scene as a file", "scene.html", scene_file),))
