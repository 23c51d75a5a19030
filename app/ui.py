"""Parts of which the page is made: its sheet and scripts, texts as HTML, and widgets with their looks."""

import re
from html import escape
from pathlib import Path

import panel as pn

from .state.quantities import QUANTITIES

HERE = Path(__file__).parent
JS = {path.stem: path.read_text(encoding="utf-8") for path in (HERE / "js").glob("*.js")}
# Inline where the size of a plot depends on it: Bokeh lays out before a linked sheet is there.
STYLE = [(HERE / "static" / "style.css").read_text(encoding="utf-8")]
WIDE = {"sizing_mode": "stretch_width", "margin": 0}
FULL = {"sizing_mode": "stretch_both", "margin": 0, "stylesheets": STYLE}

_LABELS = {name: quantity.label for name, quantity in QUANTITIES.items()}


#: What the core says to those who call it alone: indices, counts, names of functions.
_EXPONENT = re.compile(r"(\d(?:\.\d+)?)e([+-]?)0?(\d+)\b")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_PYTHON = re.compile(
    r"\[[\d, ]+\](?= = )| \(and \d+ more of \d+ entries\)|; or give unit='nm'| \(indent_in_time, creep\)"
)


def indexed(text):
    """HTML in which every symbol such as d_c has its index."""
    return re.sub(r"(\b[a-zA-Z]|[α-ω])_([a-zA-Z0-9]+)", r"<i>\1</i><sub>\2</sub>", text)


def plain(text):
    """What the core says of arguments, in words of the page: numbers by their labels, and of one place."""
    for name, label in _LABELS.items():
        text = text.replace(f"{label} {name} ", f"{label} ")
    text = _PYTHON.sub("", text)
    text = _EXPONENT.sub(lambda e: f"{e[1]} × 10{(e[2].strip('+') + e[3]).translate(_RAISED)}", text)
    return re.sub(r"\b[a-zA-Z]+_[a-z_]{2,}\b", lambda name: _LABELS.get(name[0], name[0]), text)


def marked(text):
    """A text as HTML, in which every symbol such as d_c has its index."""
    return indexed(escape(text))


def symbol(text):
    """A symbol as HTML: q_c with its index; of two with a stroke between them each has its own."""
    return "/".join(marked(each) if "_" in each else f"<i>{escape(each)}</i>" for each in text.split("/"))


def linked(text):
    """A text as HTML in which equations, (11), and sections, § 9, lead to the theory."""
    led = r'<a href="?theory={}-\1" target="theory">\g<0></a>'
    text = re.sub(r"\(([1-9]\d?)\)", led.format("eq"), marked(text))
    return re.sub(r"§ (\d+)", led.format("section"), text)


def explained(key, label, about, look='class="word"'):
    """A label that says what it is about when it is pressed."""
    return f'<button {look} popovertarget="{key}">{label}</button><div popover id="{key}">{about}</div>'


def legend(plot, shown):
    """The legend of a plot, of those rows that are shown, as HTML."""
    return "".join(
        f'<span class="{row.role}"><i class="{row.kind} {_style(row.look)}"></i>{row.name}</span>'
        for row in plot.rows
        if row.legend and row.name in shown
    )


def _style(look):
    hatch = "hatch" * (look.get("hatch", " ") != " ")
    return " ".join((hatch, look.get("dash", ""), look.get("marker", "")))


def html(text="", *classes, **options):
    """A text, a note unless it is of another class."""
    return pn.pane.HTML(text, css_classes=[*(classes or ["note"])], **WIDE | options)


def button(name, key="", kind=pn.widgets.Button, **options):
    """A button or toggle, which a key may press as well."""
    return kind(label=name, css_classes=["button", *[f"key-{key}"] * bool(key)], **{"margin": 0} | options)


def toggle(name, key):
    """A button that stays pressed."""
    return button(name, key, pn.widgets.Toggle)


def field(kind, *classes, **options):
    """A widget to choose with or to type in."""
    return kind(css_classes=["choice", *classes], **WIDE | options)


def upload(name, accept, **options):
    """A field that takes a file."""
    return pn.widgets.FileInput(accept=accept, css_classes=["file", name], **WIDE | options)


def brought(widget, act):
    """Call a function with the bytes of each file that is brought; there are none in an empty one."""

    def bring(*events):
        if widget.filename:
            act(widget.value or b"")
            # The same file is read again when it is brought again.
            widget.clear()

    widget.param.watch(bring, ["value", "filename"])


def tools(*parts, **options):
    """Parts in a row that is wrapped where it is narrow."""
    return pn.Row(*parts, css_classes=["tools"], **WIDE | options)


def show(part, **values):
    """Tell a widget or pane what it does not know yet: telling takes a good part of a move."""
    news = {name: value for name, value in values.items() if getattr(part, name) != value}
    if news:
        part.param.update(**news)
