"""The plots on the page, each in a frame with its title, formula, legend and controls, and its pictures."""

import panel as pn
from bokeh.events import Pan, PanEnd, PanStart, RangesUpdate
from bokeh.models import CustomJS, Title

from . import figures
from .described import described
from .packet import drawn, layers, moves
from .parts import FULL, JS, STYLE, WIDE, button, html, legend, linked
from .plots import PLOTS

#: As many pixels for a metre up as along, where that is asked for.
_TO_SCALE = """
const { x_range, y_range, inner_width, inner_height, tags } = figure
const parts = [[x_range, inner_width], [y_range, inner_height]]
const share = ([{ reset_start, reset_end }, size]) => (reset_end - reset_start) / size
const most = Math.max(...parts.map(share))
for (const [range, size] of parts) {
  const { reset_start, reset_end } = range
  const more = tags.length ? (most * size - reset_end + reset_start) / 2 : 0
  range.setv({ start: reset_start - more, end: reset_end + more }, { sync: false })
}
"""
#: Plots that stand under others, on one axis x.
_BELOW = {"pressure": "springs", "radii": "force", "residual": "force", "energy": "motion"}


class Grid:
    """The plots of one session: a figure is made when it is seen for the first time."""

    def __init__(self, show, theme, drag, controls):
        self._show, self._theme, self._drag, self._controls = show, theme, drag, controls
        self._zoom = CustomJS(code=JS["zoom"])
        self._inputs = Title(text_font_size="11px", text_font_style="normal")
        self.figures, self.layers, self.names, self._frames, self._moving = {}, [], [], {}, []
        self.view = pn.Column(css_classes=["plots"], **FULL)

    def show(self, view, names):
        """Show some plots, with axes that hold a view."""
        for name in names:
            if name not in self.figures:
                self._make(name)
            self._fit(name, view)
        shown, same = {name: self.figures[name] for name in names}, names == self.names
        self.layers = self.layers if same else layers(shown)
        moving = [moves(view, layer) for layer in self.layers]
        if same and moving == self._moving:
            return
        self._moving = moving
        told = zip(self.layers, moving, strict=True)
        told = [layer.described | {"moving": each} for layer, each in told]
        self._show.args = self._show.args | {"layers": told}
        if same:
            return
        self.names = names
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
        # Until something has been found there is nothing on them.
        figure.axis.axis_label = ""
        if _BELOW.get(name) in self.figures:
            figure.x_range = self.figures[_BELOW[name]].x_range
        if name == "force":
            for event in (PanStart, Pan, PanEnd):
                figure.js_on_event(event, self._drag)
            self._drag.args = self._drag.args | {"figure": figure}
        figure.js_on_event(RangesUpdate, self._zoom)
        if plot.to_scale:
            fit = CustomJS(args={"figure": figure}, code=_TO_SCALE)
            for size in ("inner_width", "inner_height"):
                figure.js_on_change(size, fit)
            figure.y_range.js_on_change("reset_end", fit)
        args = {"figure": figure, "title": plot.title, "look": figures.LEGEND, "inputs": self._inputs}
        args["named"] = [row.name for row in plot.rows if row.legend]
        save = [button(kind, "none", width=40) for kind in ("PNG", "SVG")]
        for each in save:
            each.js_on_click(args=args, code=f"(async (kind) => {{{JS['save']}}})('{each.name.lower()}')")
        self._frames[name] = _Frame(plot, figure, save, self._controls)

    def _fit(self, name, view):
        """Axes, units of the tooltips, and what the legend names."""
        plot, frame = PLOTS[name], self._frames[name]
        axes, shown = view.axes_of(plot), drawn(view, plot, {view.way.now, view.way.peak})
        if axes and axes != frame.axes:
            frame.axes = axes
            self.figures[name].tags = ["to scale"] * bool(plot.to_scale and plot.to_scale(view))
            figures.set_axes(self.figures[name], axes)
        if shown != frame.shown:
            frame.shown, frame.legend.object = shown, legend(plot, shown)
        if plot.title in view.found:
            frame.note.object = view.found[plot.title].note
        elif plot.note:
            frame.note.object = linked(plot.note(view))


class _Frame:
    """What stands around one plot, and what it shows last."""

    def __init__(self, plot, figure, save, controls):
        self.axes, self.shown = None, None
        self.legend, self.note = html("", "key"), html("", "note", "found")
        words = html(f"<h3>{plot.title}</h3>{linked(plot.formula)}", "formula")
        head = pn.Row(words, *save, css_classes=["head"], stylesheets=STYLE, **WIDE)
        above = [controls.above(plot.controls)] if plot.controls else []
        parts = [head, *above, self.legend, pn.pane.Bokeh(figure, **FULL)]
        below = [self.note] if plot.resting or plot.note else []
        below += [html(plot.below, "note", "found")] if plot.below else []
        self.view = pn.Column(*parts, *below, css_classes=["card", figure.name], **FULL)
