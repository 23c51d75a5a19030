"""The page as one component: its figures, and what travels between it and the session."""

import json
from pathlib import Path

import numpy as np
import panel as pn
import param

from .equations import EQUATIONS, KEYS, MODEL
from .presets import ASSETS
from .units import UNITS
from .views import PLOTS

#: In the order in which they need each other: one module in the browser.
_SCRIPTS = (
    *("numbers", "theme", "draw", "plots", "form", "readouts"),
    *("player", "files", "talk", "page"),
)
_STYLE = (ASSETS / "style.css").read_text(encoding="utf-8")
_STATIC = json.dumps(
    {
        "plots": [plot.described() for plot in PLOTS.values()],
        "equations": EQUATIONS,
        "help": [MODEL, KEYS],
        "units": {kind: [[unit.name, unit.factor] for unit in units] for kind, units in UNITS.items()},
    }
)

_NOTHING = np.zeros(1, np.float32)


def _script(name):
    return (Path(__file__).parent / "js" / f"{name}.js").read_text(encoding="utf-8")


class Page(pn.custom.JSComponent):
    """Everything a person sees. All drawing is done in the browser, from one buffer of numbers.

    A change goes out as `meta`, all that is text as JSON, and `values`, all arrays end to end;
    what a person does comes back as one message.
    """

    figures = pn.custom.Children()
    static = param.String(_STATIC, constant=True)
    meta = param.String()
    values = param.Parameter()

    _esm = "\n".join(_script(name) for name in _SCRIPTS)
    _stylesheets = (_STYLE,)

    def __init__(self, receive):
        self._receive = receive
        figures = {name: plot.copy() for name, plot in PLOTS.items()}
        # One axis for both plots, so that what belongs together stands under each other.
        for lower, upper in (("pressure", "springs"), ("radii", "force"), ("energy", "motion")):
            figures[lower].x_range = figures[upper].x_range
        panes = [pn.pane.Bokeh(figure, sizing_mode="stretch_both") for figure in figures.values()]
        super().__init__(figures=panes, values=_NOTHING, sizing_mode="stretch_both", margin=0)

    def _handle_msg(self, message):
        if isinstance(message, dict):
            self._receive(message)

    def send(self, message):
        """Say something to the page, once."""
        self._send_msg(message)
