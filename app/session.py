"""One person's session: the state, its controls and its plots, wired together."""

import logging
from html import escape

import panel as pn
from param.parameterized import discard_events

from . import panels
from .controls import STYLE, QuantityControl, Text
from .curves import ForceView, RadiiView
from .presets import OPENING, PRESETS
from .run import solve
from .shapes import SHAPES
from .state import DRIVE, MEDIUM, QUANTITIES, Explorer
from .views import PressureView, SpringsView

_LOG = logging.getLogger(__name__)


class Session:
    """What one person sees. One change of the state is one solve and one update of every plot."""

    def __init__(self):
        self.state = Explorer()
        self.run = solve(self.state.scene())
        self._good = self.state.values()
        springs, force = SpringsView(), ForceView()
        self.views = {
            "springs": springs,
            "force": force,
            "pressure": PressureView(springs),
            "radii": RadiiView(force),
        }
        self.preset = _select("Preset", {label: label for label in PRESETS}, OPENING)
        self.shape = _select("Shape", {shape.label: key for key, shape in SHAPES.items()}, self.state.shape)
        self.controls = {}
        self.indenter = pn.Column(sizing_mode="stretch_width")
        texts = (Text() for _ in range(5))
        self.readouts, self.sketch, self.onset, self.validity, self.sources = texts
        self._follow()
        self._draw()
        self.preset.param.watch(lambda event: self.attempt(self.state.load, event.new), "value")
        self.shape.param.watch(self._choose, "value")
        self.state.param.watch(self._changed, list(self._good))
        if pn.state.notifications is not None:
            pn.state.on_session_destroyed(_forget(pn.state.notifications))

    def attempt(self, action, *args):
        """Do what a control asks for; if it is refused say why, and keep everything as it was."""
        with pn.io.hold():
            try:
                action(*args)
            except ValueError as error:
                _notify(str(error))
            finally:
                self._follow()

    def _choose(self, event):
        if event.new != self.state.shape:
            self.attempt(self.state.choose, event.new)

    def _changed(self, *_):
        try:
            self.run = solve(self.state.scene())
            self._draw()
        except Exception as error:
            if not isinstance(error, ValueError):
                _LOG.exception("a change could not be drawn")
            _notify(f"This cannot be shown, the last values are kept: {error}")
            with discard_events(self.state):
                self.state.param.update(**self._good)
            self.run = solve(self.state.scene())
            self._draw()
        self._good = self.state.values()

    def _draw(self):
        with pn.io.hold():
            for view in self.views.values():
                view.update(self.run)
            self.readouts.html = panels.readouts(self.run)
            self.sketch.html = panels.sketch(self.run, self.state.shape)
            self.onset.html = panels.onset(self.run)
            self.validity.html = panels.validity(self.run)
            self.sources.html = panels.sources(PRESETS[self.preset.value])

    def _follow(self):
        """Let the controls show what the state has."""
        self.shape.value = self.state.shape
        names = [name for name, _ in self.state.shape_quantities(self.state.shape)]
        controls = [self._control(name) for name in names]
        if self.indenter.objects != controls:
            self.indenter.objects = controls
        for name in [*names, *(quantity.name for quantity in MEDIUM + DRIVE)]:
            self._control(name).follow()

    def _control(self, name):
        if name not in self.controls:
            self.controls[name] = QuantityControl(self.state, name, QUANTITIES[name], self.attempt)
        return self.controls[name]

    def layout(self):
        """The whole page."""
        sidebar = _column(
            "sidebar",
            _html(
                "<h1>Indentation explorer</h1><p>non-local yield, solved by dimensionality reduction</p>"
            ),
            self.preset,
            self.sources,
            _html("<h2>Indenter</h2>"),
            self.shape,
            self.sketch,
            self.indenter,
            _html("<h2>Medium</h2>"),
            *(self._control(quantity.name) for quantity in MEDIUM),
            self.onset,
            _html("<h2>Drive</h2>"),
            *(self._control(quantity.name) for quantity in DRIVE),
            _html(
                '<p class="note">0 % at d<sub>max</sub>, 100 % load gone, 120 % tip back at the surface</p>'
            ),
            _html(panels.equations()),
        )
        plots = _column(
            "plots",
            *(
                _column(
                    "plot",
                    _html(self.views[name].heading),
                    pn.pane.Bokeh(self.views[name].figure, sizing_mode="stretch_both"),
                )
                for name in ("springs", "force", "pressure", "radii")
            ),
        )
        return _column("page", sidebar, _column("results", self.readouts, self.validity, plots))


def _forget(notifications):
    """A callback that lets go of a closed session's notification area, which Panel 1.9 keeps."""

    def forget(_context):
        views = pn.state._views
        for key in [key for key, (view, *_) in views.items() if view is notifications]:
            del views[key]

    return forget


def _column(name, *children):
    return pn.Column(*children, css_classes=[name], stylesheets=[STYLE], sizing_mode="stretch_both")


def _html(text):
    return pn.pane.HTML(text, stylesheets=[STYLE], sizing_mode="stretch_width", margin=0)


def _select(label, options, value):
    return pn.widgets.Select(
        name=label,
        options=options,
        value=value,
        stylesheets=[STYLE],
        sizing_mode="stretch_width",
        margin=(4, 0),
    )


def _notify(text):
    # A notification is shown as HTML, and the text may quote what was typed.
    if pn.state.notifications is not None:
        pn.state.notifications.send(escape(text), background="#8a4300", duration=6000)
