"""Style sheets, scripts, texts as HTML, plain widgets, and what server and browser tell each other."""

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
#: Inline where the size of a plot depends on it: Bokeh lays out before a linked sheet is there.
LAYOUT = [(HERE / "static" / "layout.css").read_text(encoding="utf-8")]
#: Linked by every component of Panel; components of Bokeh link them themselves.
SHEETS = ["app/static/layout.css", "app/static/style.css"]
WIDE = {"sizing_mode": "stretch_width", "margin": 0}
BOTH = {"sizing_mode": "stretch_both", "margin": 0}
FULL = BOTH | {"stylesheets": LAYOUT}


def call(name: str, *given: str) -> str:
    """Script of a callback that calls a function of page.js with what the callback knows by these names."""
    return f"return pages.{name}({', '.join(given)})"


class Messages(DataModel):
    """What the server and the browser of a session tell each other beside the page."""

    #: The query of the present scene; empty to leave the address as it is, None until the input has rested.
    address = Nullable(String)
    dark = Bool(False)
    #: Whether the window is so wide that all is larger.
    wide = Bool(False)
    #: Whether a slider or the indenter is being dragged: axes stay.
    dragged = Bool(False)
    #: Sources and, as text, what they are in each state of the scene; empty until they are asked for.
    frames = List(AnyRef)
    #: Readouts of the state that is seen, as HTML.
    words = String("")


# HTML is a `Markup`: a literal of the page, into which `format` and `join` escape what they are given. All
# else is a text of somebody, which is escaped where it is shown: no name, link or file is taken for HTML.


def as_html(text: str) -> str:
    """What the browser is given to show: HTML as it is, a text escaped."""
    return str(escape(text))


def notice(text: str) -> str:
    """A text for a notice: screen readers are told it itself, in which quotation marks need no escape."""
    return as_html(text).replace("&#34;", '"').replace("&#39;", "'")


def own_html(path: Path) -> Markup:
    """A file of the page with HTML."""
    return Markup(path.read_text(encoding="utf-8"))


def replaced(pattern: str, html: str, text: Markup) -> Markup:
    """HTML with other HTML in the place of what matches, as in `re.sub`."""
    return Markup(re.sub(pattern, html, str(text)))


def html_subscripts(text: str) -> Markup:
    """HTML of a text, with subscripts in symbols such as d_c, and in their differentials such as dd_c."""
    of_symbol = r"(\b[a-zA-Z]|(?<=\bd)[a-zA-Z]|[α-ω])_([a-zA-Z0-9]+)"
    return replaced(of_symbol, r"<i>\1</i><sub>\2</sub>", escape(text))


def symbol(text: str) -> Markup:
    """A symbol as HTML, also a ratio such as d/d_c."""
    parts = (
        html_subscripts(each) if "_" in each else Markup("<i>{}</i>").format(each)
        for each in text.split("/")
    )
    return Markup("/").join(parts)


def linked(text: str) -> Markup:
    """HTML of a text, with links from equations, (11), and sections, § 9, to the page of the theory."""
    led = r'<a href="app/theory.html#{}-\1" target="theory">\g<0></a>'
    html = replaced(r"\(([1-9]\d?)\)", led.format("eq"), html_subscripts(text))
    return replaced(r"§ (\d+)", led.format("section"), html)


def html(text: str = "", *classes: str, **options: Any) -> Any:
    """A text, or HTML, as a part of the page."""
    return pn.pane.HTML(as_html(text), css_classes=[*(classes or ["note"])], **WIDE | options)


def landmarks(document: Document, parts: dict[str, tuple[str, str]], to: str = "", label: str = "") -> None:
    """Tell those who do not see a page of its parts: roles and names by classes, the first one on top.

    `to` is the class of the part to which a link, the first tab stop, leads, and `label` its text.
    """
    told = {"landmarks": [[name, *part] for name, part in parts.items()], "to": to, "label": label}
    document.js_on_event(DocumentReady, CustomJS(args=told, code=call("landmarks", *told)))


def show(part, **values):
    """Set parameters of a widget that have changed: setting is slow. `object` is a text, or HTML."""
    if "object" in values:
        values["object"] = as_html(values["object"])
    news = {name: value for name, value in values.items() if getattr(part, name) != value}
    if news:
        part.param.update(**news)


def button(label: str, act: Callable[[], Any] | None = None, *classes: str, **options: Any) -> Any:
    """A button that calls `act`."""
    made = pn.widgets.Button(label=label, css_classes=["button", *classes], margin=0, **options)
    if act is not None:
        made.on_click(lambda event: act())
    return made


def download(label: str, callback: Callable[[], Any], **options: Any) -> Any:
    """A button that saves a file."""
    return pn.widgets.FileDownload(
        label=label, callback=callback, auto=True, css_classes=["button"], margin=0, **options
    )


def field(kind: type, *classes: str, **options: Any) -> Any:
    return kind(css_classes=["choice", *classes], **WIDE | options)


def tools(*parts: Any, **options: Any) -> pn.Row:
    return pn.Row(*parts, css_classes=["tools"], **WIDE | options)
