"""The plots on the page, each in a frame with its title, formula, legend and the pictures to save."""

from pathlib import Path

import panel as pn
from bokeh.events import Pan, PanEnd, PanStart, RangesUpdate
from bokeh.models import ColorBar, CustomJS, HoverTool, Title

from . import figures
from .controls import JS, WIDE, html, legend, marked
from .figures import FONT, TIP
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


def button(kind, name, key, **options):
    """A button or toggle, which a key presses as well."""
    return kind(name=name, css_classes=["button", f"key-{key}"], margin=0, **options)


class Grid:
    """The plots of one session: a figure is made when it is seen for the first time."""

    def __init__(self, show, theme, drag, comparing):
        self._show, self._theme, self._drag, self._comparing = show, theme, drag, comparing
        self.figures, self.layers, self.names = {}, [], []
        self._cards, self._inputs, self._keys, self._legends, self._axes, self._told = (
            {},
            {},
            {},
            {},
            {},
            {},
        )
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
        self.view.css_classes = ["plots", *["wide"] * many, *["more"] * ("speed" in names)]
        self.view[:] = [self._cards[name] for name in names]

    def tell(self, inputs):
        """What the scene is, below the pictures that are saved."""
        for name in self.names:
            self._inputs[name].text = inputs

    def _make(self, name):
        figure = self.figures[name] = figures.figure(name)
        # One axis for plots that stand under each other.
        for lower, upper in (("pressure", "springs"), ("radii", "force"), ("energy", "motion")):
            if name == lower and upper in self.figures:
                figure.x_range = self.figures[upper].x_range
        self._inputs[name] = Title(text_font_size="11px", text_font_style="normal")
        title = Title(text=PLOTS[name].title, text_font=FONT, text_font_size="14px")
        self._keys[name], self._legends[name] = figures.legend(figure), html("", css_classes=["key"])
        save = [button(pn.widgets.Button, kind, "none", width=40) for kind in ("PNG", "SVG")]
        for each in save:
            args = {"figure": figure, "kind": each.name.lower(), "legend": self._keys[name]}
            args |= {"title": title, "inputs": self._inputs[name]}
            each.js_on_click(args=args, code=f"(async () => {{{JS['save']}}})()")
        if name == "force":
            for event in (PanStart, Pan, PanEnd):
                figure.js_on_event(event, self._drag)
            self._drag.args = self._drag.args | {"figure": figure}
        if not PLOTS[name].log:
            figure.js_on_event(RangesUpdate, CustomJS(args={"figure": figure}, code=JS["zoom"]))
        if PLOTS[name].image:
            square = CustomJS(args={"figure": figure}, code=_SQUARE)
            for model, change in (
                (figure, "inner_width"),
                (figure, "inner_height"),
                (figure.y_range, "reset_end"),
            ):
                model.js_on_change(change, square)
        words = html(f"<h3>{PLOTS[name].title}</h3>{marked(PLOTS[name].formula)}", css_classes=["formula"])
        head = pn.Row(words, *save, css_classes=["head"], stylesheets=STYLE, **WIDE)
        more = [self._comparing.shown_in(figure, self._keys[name])] if PLOTS[name].log else []
        if PLOTS[name].log:
            self._legends[name].object = legend(name, {row.name for row in PLOTS[name].rows})
        parts = (head, self._legends[name], pn.pane.Bokeh(figure, **FULL), *more)
        self._cards[name] = pn.Column(*parts, css_classes=["card", name], **FULL)

    def _fit(self, name, view):
        """Axes, units of the tooltips, and what the legend names."""
        plot, axes = PLOTS[name], [view.axes[key] for key in PLOTS[name].axes]
        if not axes:
            return
        if axes != self._axes.get(name):
            self._axes[name] = axes
            self._set_axes(self.figures[name], axes)
            for bar in self.figures[name].right if plot.image else ():
                if isinstance(bar, ColorBar):
                    bar.title, bar.color_mapper.high = f"−σzz ({view.axes['p'].unit})", view.end["p"]
        shown = drawn(view, name, {view.way.now, view.way.peak})
        if shown != self._told.get(name):
            self._told[name] = shown
            for item in self._keys[name].items:
                item.visible = item.name in shown
            self._legends[name].object = legend(name, shown)

    @staticmethod
    def _set_axes(figure, axes):
        ranges = (figure.x_range, figure.y_range, figure.extra_y_ranges.get("right"))
        sides = (*figure.below[:1], *figure.left[:1], *figure.right[:1])
        for bounds, side, axis in zip(ranges, sides, axes, strict=False):
            bounds.update(start=axis.start, end=axis.end, reset_start=axis.start, reset_end=axis.end)
            side.axis_label = axis.title
        for renderer in figure.renderers:
            data = renderer.data_source.data
            if "unit" in data:
                data["unit"] = [axes[2 if renderer.name.endswith("right") else 1].unit] * len(data["unit"])
        for hover in (tool for tool in figure.toolbar.tools if isinstance(tool, HoverTool)):
            hover.tooltips = TIP.format(symbol=axes[0].title.split(",")[0], unit=axes[0].unit)
