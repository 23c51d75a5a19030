"""Axes that stay while something is dragged."""

from typing import Any

from bokeh.core.properties import Bool
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

from mdr_core.show.figures import Axis

from .plot import Along
from .plots import NAMED, PLOTS
from .state import State
from .ui import JS


class Dragged(DataModel):
    """Whether something is being dragged in the browser."""

    on = Bool(False)


class Scales:
    """Keeps the axes of the three plots while something is dragged, unless the drive or preset changes."""

    def __init__(self, page: Any):
        self._page, self._kept, self.dragged = page, False, Dragged()
        page.document.add_root(self.dragged)
        script = CustomJS(args={"dragged": self.dragged}, code=JS["dragged"])
        page.document.js_on_event(DocumentReady, script)
        self.dragged.on_change("on", self._released)

    def _released(self, attr, old, new):
        if not new and self._kept:
            self._page.draw(self._page.state)

    def kept(self, state: State) -> dict[Along, Axis]:
        """Axes on which another state is drawn; all others fit it."""
        shown = self._page.shown
        self._kept = shown is not None and self.dragged.on
        if not self._kept or any(state[name] != shown.state[name] for name in ("preset", "drive")):
            return {}
        return {along: shown.axis(along) for name in NAMED for along in PLOTS[name].axes}
