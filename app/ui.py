"""Style sheet, scripts, texts as HTML, and what server and browser tell each other."""

import re
from html import escape
from pathlib import Path

import panel as pn
from bokeh.core.properties import AnyRef, Bool, List, Nullable, String
from bokeh.document import Document
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

HERE = Path(__file__).parent
JS = {path.stem: path.read_text(encoding="utf-8") for path in (HERE / "js").glob("*.js")}
CSS = (HERE / "static" / "style.css").read_text(encoding="utf-8")
#: Inline where the size of a plot depends on it: Bokeh lays out before a linked sheet is there.
LAYOUT = [(HERE / "static" / "layout.css").read_text(encoding="utf-8")]
#: Linked by every component of Panel; components of Bokeh link them themselves.
SHEETS = ["app/static/layout.css", "app/static/style.css"]
WIDE = {"sizing_mode": "stretch_width", "margin": 0}
FULL = {"sizing_mode": "stretch_both", "margin": 0, "stylesheets": LAYOUT}


class Messages(DataModel):
    """What the server and the browser of a session tell each other beside the page."""

    #: The query of the present scene; empty to leave the address as it is, None until the input has rested.
    address = Nullable(String)
    dark = Bool(False)
    #: Sources and, as text, what they are in each state of the scene; empty until they are asked for.
    frames = List(AnyRef)
    #: Readouts of the state that is seen, as HTML.
    words = String("")


def indexed(text):
    """HTML with subscripts in symbols such as d_c, and in their differentials such as dd_c."""
    return re.sub(r"(\b[a-zA-Z]|(?<=\bd)[a-zA-Z]|[α-ω])_([a-zA-Z0-9]+)", r"<i>\1</i><sub>\2</sub>", text)


def marked(text):
    return indexed(escape(text))


def symbol(text):
    """A symbol as HTML, also a ratio such as d/d_c."""
    return "/".join(marked(each) if "_" in each else f"<i>{escape(each)}</i>" for each in text.split("/"))


def linked(text):
    """HTML of a text, with links from equations, (11), and sections, § 9, to the page of the theory."""
    led = r'<a href="?theory={}-\1" target="theory">\g<0></a>'
    html = re.sub(r"\(([1-9]\d?)\)", led.format("eq"), marked(text))
    return re.sub(r"§ (\d+)", led.format("section"), html)


def html(text="", *classes, **options):
    return pn.pane.HTML(text, css_classes=[*(classes or ["note"])], **WIDE | options)


def landmarks(document: Document, parts: dict[str, tuple[str, str]], to: str = "", label: str = "") -> None:
    """Tell those who do not see a page of its parts: roles and names by classes, the first one on top.

    `to` is the class of the part to which a link, the first tab stop, leads, and `label` its text.
    """
    told = {"landmarks": [[name, *part] for name, part in parts.items()], "to": to, "label": label}
    document.js_on_event(DocumentReady, CustomJS(args=told, code=JS["landmarks"]))


def show(part, **values):
    """Set parameters of a widget that have changed: setting is slow."""
    news = {name: value for name, value in values.items() if getattr(part, name) != value}
    if news:
        part.param.update(**news)
