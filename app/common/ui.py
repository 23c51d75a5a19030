"""Style sheets, scripts, texts as HTML, plain widgets, and messages between server and browser."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import panel as pn
from bokeh.core.properties import AnyRef, Bool, List, Nullable, String
from bokeh.document import Document
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS
from markupsafe import Markup, escape

#: The folder of both pages.
HERE = Path(__file__).parents[1]
JS = {path.stem: path.read_text(encoding="utf-8") for path in (HERE / "common" / "js").glob("*.js")}
CSS = (HERE / "static" / "style.css").read_text(encoding="utf-8")
#: Inline for elements around a plot: Bokeh lays out the plot before a linked sheet arrives.
LAYOUT = [(HERE / "static" / "layout.css").read_text(encoding="utf-8")]
#: Links of every component of Panel; components of Bokeh set their own links.
SHEETS = ["app/static/layout.css", "app/static/style.css"]
WIDE = {"sizing_mode": "stretch_width", "margin": 0}
BOTH = {"sizing_mode": "stretch_both", "margin": 0}
FULL = BOTH | {"stylesheets": LAYOUT}


def call(name: str, *given: str) -> str:
    """Return the script of a callback that calls a function of page.js with the callback's variables."""
    return f"return pages.{name}({', '.join(given)})"


class Messages(DataModel):
    """Messages between the server and the browser of a session."""

    #: The query of the present scene; empty to keep the address, None until the input has rested.
    address = Nullable(String)
    dark = Bool(False)
    #: Whether the window is wide enough for larger letters.
    wide = Bool(False)
    #: Whether the user drags a slider or the indenter; axes then stay fixed.
    dragged = Bool(False)
    #: Sources and, as text, their data in each state of the scene; empty until the player needs them.
    frames = List(AnyRef)
    #: Readouts of the visible state, as HTML.
    words = String("")


# A `Markup` is HTML of the page; its `format` and `join` escape their arguments. Every `str` may come from
# a user and is escaped when it is shown: no name, link or file becomes HTML.


def as_html(text: str) -> str:
    """Return text for the browser: HTML unchanged, other text escaped."""
    return str(escape(text))


def notice(text: str) -> str:
    """Return text for a notice, with plain quotation marks: screen readers get the text unparsed."""
    return as_html(text).replace("&#34;", '"').replace("&#39;", "'")


def own_html(path: Path) -> Markup:
    """Return the HTML in a file of the page."""
    return Markup(path.read_text(encoding="utf-8"))


def replaced(pattern: str, html: str, text: Markup) -> Markup:
    """Replace matches of a pattern in HTML by other HTML, as `re.sub` does."""
    return Markup(re.sub(pattern, html, str(text)))


def html_subscripts(text: str) -> Markup:
    """Return text as HTML, with subscripts in symbols such as d_c and in differentials such as dd_c."""
    of_symbol = r"(\b[a-zA-Z]|(?<=\bd)[a-zA-Z]|[α-ω])_([a-zA-Z0-9]+)"
    return replaced(of_symbol, r"<i>\1</i><sub>\2</sub>", escape(text))


def symbol(text: str) -> Markup:
    """Return a symbol, or a ratio such as d/d_c, as HTML."""
    parts = (
        html_subscripts(each) if "_" in each else Markup("<i>{}</i>").format(each)
        for each in text.split("/")
    )
    return Markup("/").join(parts)


def linked(text: str) -> Markup:
    """Return text as HTML, with links from equations, (11), and sections, § 9, to the theory."""
    led = r'<a href="app/theory.html#{}-\1" target="theory">\g<0></a>'
    html = replaced(r"\(([1-9]\d?)\)", led.format("eq"), html_subscripts(text))
    return replaced(r"§ (\d+)", led.format("section"), html)


def html(text: str = "", *classes: str, **options: Any) -> Any:
    """Return a pane with text or HTML."""
    return pn.pane.HTML(as_html(text), css_classes=[*(classes or ["note"])], **WIDE | options)


def landmarks(document: Document, parts: dict[str, tuple[str, str]], to: str = "", label: str = "") -> None:
    """Give parts of a page roles and names for screen readers, by their classes, the topmost part first.

    The first tab stop is a link with the text `label` to the part with the class `to`.
    """
    told = {"landmarks": [[name, *part] for name, part in parts.items()], "to": to, "label": label}
    document.js_on_event(DocumentReady, CustomJS(args=told, code=call("landmarks", *told)))


def show(part, **values):
    """Set only the changed parameters of a widget, because setting is slow. `object` is text or HTML."""
    if "object" in values:
        values["object"] = as_html(values["object"])
    news = {name: value for name, value in values.items() if getattr(part, name) != value}
    if news:
        part.param.update(**news)


def button(label: str, act: Callable[[], Any] | None = None, *classes: str, **options: Any) -> Any:
    """Return a button that calls `act`."""
    made = pn.widgets.Button(label=label, css_classes=["button", *classes], margin=0, **options)
    if act is not None:
        made.on_click(lambda event: act())
    return made


def download(label: str, callback: Callable[[], Any], **options: Any) -> Any:
    """Return a button that saves a file."""
    return pn.widgets.FileDownload(
        label=label, callback=callback, auto=True, css_classes=["button"], margin=0, **options
    )


def field(kind: type, *classes: str, **options: Any) -> Any:
    return kind(css_classes=["choice", *classes], **WIDE | options)


def tools(*parts: Any, **options: Any) -> pn.Row:
    return pn.Row(*parts, css_classes=["tools"], **WIDE | options)
