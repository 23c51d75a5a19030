"""The page as one component: its scripts, and what travels between it and the session."""

import base64
import json
from pathlib import Path

import numpy as np
import panel as pn
import param

from .equations import EQUATIONS, KEYS, MODEL
from .presets import ASSETS
from .units import UNITS
from .views import DOCUMENTS, PLOTS

#: In the order in which they need each other: one module in the browser.
_SCRIPTS = (
    *("numbers", "theme", "scene", "springs", "draw", "axes", "layers", "plots", "form", "readouts"),
    *("compare", "player", "files", "tools", "talk", "page"),
)
_STYLE = (ASSETS / "style.css").read_text(encoding="utf-8")
_REPORT = base64.b64encode((ASSETS / "speed_against_error.svg").read_bytes()).decode()
_STATIC = json.dumps(
    {
        "report": f"data:image/svg+xml;base64,{_REPORT}",
        "plots": [plot.described() for plot in PLOTS.values()],
        "documents": DOCUMENTS,
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

    A change goes out as one message with `meta`, all that is text as JSON, and `values`, all arrays
    end to end; the first one as properties of the same names. What a person does comes back as one message.
    """

    static = param.String(_STATIC, constant=True)
    meta = param.String()
    values = param.Parameter()

    _esm = "\n".join(_script(name) for name in _SCRIPTS)
    _stylesheets = (_STYLE,)

    def __init__(self, receive):
        self._receive = receive
        super().__init__(values=_NOTHING, sizing_mode="stretch_both", margin=0)

    def _handle_msg(self, message):
        if isinstance(message, dict):
            self._receive(message)

    def show(self, meta, values):
        """Draw anew: as a message, so that nothing of it is kept."""
        if self._models:
            self.send({"meta": meta, "values": values})
        else:
            self.param.update(meta=meta, values=values)

    def send(self, message):
        """Say something to the page, once."""
        self._send_msg(message)
