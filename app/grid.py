"""The plots on the page, each in a frame with its title, formula, legend and controls, and its pictures."""

from pathlib import Path

import panel as pn
from bokeh.events import Pan, PanEnd, PanStart, RangesUpdate
from bokeh.models import CustomJS, Title

from . import figures
from .controls import JS, WIDE, html, legend, linked
from .described import described
from .packet import drawn, layers, moves
from .plots import PLOTS

# Inline where the size of a plot depends on it: Bokeh lays out before a linked sheet is there.
STYLE = [(Path(__file__).parent / "static" / "style.css").read_text(encoding="utf-8")]
FULL = {"sizing_mode": "stretch_both", "margin": 0, "stylesheets": STYLE}
_SQUARE = """
const { x_range, y_range, inner_width: width, inner_height: height } = figure
const set = (range, end) => range.setv({ start: -end, end }, { sync: false })
set(x_range, y_range.reset_end * Math.max(width / height, 1))
set(y_range, y_range.reset_end * Math.max(height / width, 1))
"""
#: Plots that stand under others, on one axis x.
_BELOW = {"pressure": "springs", "radii": "force", "energy": "motion"}


def button(kind, name, key, **options):
    """A button or toggle, which a key presses as well."""
    return kind(name=name, css_classes=["button", f"key-{key}"], margin=0, **options)


class Grid:
    """The plots of one session: a figure is made when it is seen for the first time."""

    def __init__(self, show, theme, drag, controls):
        self._show, self._theme, self._drag, self._controls = show, theme, drag, controls
        self._zoom = CustomJS(code=JS["zoom"])
        self._inputs = Title(text_font_size="11px", text_font_style="normal")
        self.figures, self.layers, self.names, self._frames = {}, [], [], {}
        self.view = pn.Column(css_classes=["plots"], **FULL)

    def show(self, view, names):
        """Show some plots, with axes that hold a view."""
        for name in names:
            if name not in self.figures:
                self._make(name)
            self._fit(name, view)
        if names == self.names:
            return
        self.names, shown = names, {name: self.figures[name] for name in names}
        self.layers = layers(shown)
        described = [layer.described | {"moving": moves(view, layer)} for layer in self.layers]
        self._show.args = self._show.args | {"layers": described}
        self._theme.args = self._theme.args | {"figures": list(shown.values())}
        many = len(set(names) - {"speed"}) > 4
        more = "speed" in names or len(names) > 6
        self.view.css_classes = ["plots", *["wide"] * many, *["more"] * more]
        self.view[:] = [self._frames[name].view for name in names]

    def tell(self, inputs):
        """What the scene is, below the pictures that are saved."""
        self._inputs.text = inputs

    def describe(self, view):
        """Say what is seen in the plots, to those who do not see them."""
        for name in self.names:
            said = {"role": "img", "aria-label": described(view, PLOTS[name])}
            self.figures[name].html_attributes = said

    def _make(self, name):
        figure, plot = figures.figure(name), PLOTS[name]
        self.figures[name] = figure
        if _BELOW.get(name) in self.figures:
            figure.x_range = self.figures[_BELOW[name]].x_range
        if name == "force":
            for event in (PanStart, Pan, PanEnd):
                figure.js_on_event(event, self._drag)
            self._drag.args = self._drag.args | {"figure": figure}
        figure.js_on_event(RangesUpdate, self._zoom)
        if name == "map":
            square = CustomJS(args={"figure": figure}, code=_SQUARE)
            sizes = ((figure, "inner_width"), (figure, "inner_height"), (figure.y_range, "reset_end"))
            for model, change in sizes:
                model.js_on_change(change, square)
        args = {"figure": figure, "title": plot.title, "look": figures.LEGEND, "inputs": self._inputs}
        args["named"] = [row.name for row in plot.rows if row.legend]
        save = [button(pn.widgets.Button, kind, "none", width=40) for kind in ("PNG", "SVG")]
        for each in save:
            code = f"(async (kind) => {{{JS['save']}}})('{each.name.lower()}')"
            each.js_on_click(args=args, code=code)
        self._frames[name] = _Frame(plot, figure, save, self._controls)

    def _fit(self, name, view):
        """Axes, units of the tooltips, and what the legend names."""
        plot, frame = PLOTS[name], self._frames[name]
        axes, shown = view.axes_of(plot), drawn(view, plot, {view.way.now, view.way.peak})
        if axes and axes != frame.axes:
            frame.axes = axes
            figures.set_axes(self.figures[name], axes)
        if shown != frame.shown:
            frame.shown, frame.legend.object = shown, legend(plot, shown)
        if plot.title in view.found:
            frame.note.object = view.found[plot.title].note


class _Frame:
    """What stands around one plot, and what it shows last."""

    def __init__(self, plot, figure, save, controls):
        self.axes, self.shown = None, None
        self.legend, self.note = html("", css_classes=["key"]), html("", css_classes=["note", "found"])
        words = html(f"<h3>{plot.title}</h3>{linked(plot.formula)}", css_classes=["formula"])
        head = pn.Row(words, *save, css_classes=["head"], stylesheets=STYLE, **WIDE)
        above = [controls.above(plot.controls)] if plot.controls else []
        parts = [head, *above, self.legend, pn.pane.Bokeh(figure, **FULL)]
        below = [self.note] if plot.resting else []
        below += [html(plot.below, css_classes=["note", "found"])] if plot.below else []
        self.view = pn.Column(*parts, *below, css_classes=["card", figure.name], **FULL)
