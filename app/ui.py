"""Style sheet, scripts, texts as HTML, and widgets."""

import re
from html import escape
from pathlib import Path

import panel as pn

from .state.quantities import QUANTITIES
from .state.units import written

HERE = Path(__file__).parent
JS = {path.stem: path.read_text(encoding="utf-8") for path in (HERE / "js").glob("*.js")}
# Inline where the size of a plot depends on it: Bokeh lays out before a linked sheet is there.
STYLE = [(HERE / "static" / "style.css").read_text(encoding="utf-8")]
WIDE = {"sizing_mode": "stretch_width", "margin": 0}
FULL = {"sizing_mode": "stretch_both", "margin": 0, "stylesheets": STYLE}

_LABELS = {name: quantity.label for name, quantity in QUANTITIES.items()}
#: Parts of messages of the core that do not apply to the page.
_EXPONENT = re.compile(r"(\d(?:\.\d+)?)e([+-]?)0?(\d+)\b")
_LENGTH = re.compile(r"(?<![\d.])(\d(?:\.\d+)?)(e[+-]?\d+) m(?![\w/·²³^])")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_PYTHON = re.compile(
    r"Sampled\.fit:? "
    r"|\[[\d, ]+\](?= = )| \(and \d+ more of \d+ entries\)|; or give unit='nm'| \(indent_in_time, creep\)"
)


def indexed(text):
    """HTML with subscripts in symbols such as d_c."""
    return re.sub(r"(\b[a-zA-Z]|[α-ω])_([a-zA-Z0-9]+)", r"<i>\1</i><sub>\2</sub>", text)


def plain(text):
    """Message of the core in words of the page: labels for names, no indices, lengths as 32 nm."""
    for name, label in _LABELS.items():
        text = text.replace(f"{label} {name} ", f"{label} ")
    text = _PYTHON.sub("", text)
    text = _LENGTH.sub(lambda e: written(float(e[1] + e[2]), "length", len(e[1].replace(".", ""))), text)
    text = _EXPONENT.sub(lambda e: f"{e[1]} × 10{(e[2].strip('+') + e[3]).translate(_RAISED)}", text)
    return re.sub(r"\b[a-zA-Z]+_[a-z_]{2,}\b", lambda name: _LABELS.get(name[0], name[0]), text)


def marked(text):
    return indexed(escape(text))


def symbol(text):
    """A symbol as HTML, also a ratio such as d/d_c."""
    return "/".join(marked(each) if "_" in each else f"<i>{escape(each)}</i>" for each in text.split("/"))


def linked(text):
    """HTML with links from equations, (11), and sections, § 9, to the theory."""
    led = r'<a href="?theory={}-\1" target="theory">\g<0></a>'
    text = re.sub(r"\(([1-9]\d?)\)", led.format("eq"), marked(text))
    return re.sub(r"§ (\d+)", led.format("section"), text)


def explained(key, label, about, look='class="word"'):
    """A label with an explanation in a popover."""
    return f'<button {look} popovertarget="{key}">{label}</button><div popover id="{key}">{about}</div>'


def legend(plot, shown):
    """Legend of the visible rows of a plot, as HTML."""
    text = ""
    for row in plot.rows:
        if row.legend and row.name in shown:
            hatch = "hatch" * (row.look.get("hatch", " ") != " ")
            look = " ".join((row.kind, hatch, row.look.get("dash", ""), row.look.get("marker", "")))
            text += f'<span class="{row.role}"><i class="{look}"></i>{row.name}</span>'
    return text


def html(text="", *classes, **options):
    return pn.pane.HTML(text, css_classes=[*(classes or ["note"])], **WIDE | options)


def button(name, key="", kind=pn.widgets.Button, **options):
    return kind(label=name, css_classes=["button", *[f"key-{key}"] * bool(key)], **{"margin": 0} | options)


def toggle(name, key):
    return button(name, key, pn.widgets.Toggle)


def field(kind, *classes, **options):
    return kind(css_classes=["choice", *classes], **WIDE | options)


def tools(*parts, **options):
    return pn.Row(*parts, css_classes=["tools"], **WIDE | options)


def reveal(column, part, visible, place=None):
    """Show or hide a part of a column; the browser gets it when it is shown for the first time."""
    show(part, visible=visible)
    if visible and part not in column.objects:
        column.insert(len(column) if place is None else place, part)


def show(part, **values):
    """Set parameters of a widget that have changed: setting is slow."""
    news = {name: value for name, value in values.items() if getattr(part, name) != value}
    if news:
        part.param.update(**news)
