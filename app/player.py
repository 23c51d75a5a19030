"""The player: what is drawn as one array, all states sent once, and the slider that moves through them."""

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource, CustomJS, Div, Select, Slider, Toggle

from . import readouts
from .packet import packed
from .parts import JS, STYLE, WIDE


class Player:
    """The states of one page in the browser, which moves through them without the server."""

    def __init__(self, readout):
        nothing = {"values": np.zeros(1, np.float32)}
        self.packet = ColumnDataSource(nothing, name="packet", tags=[0, [0], [[]], [""], [], [[], []]])
        self.frames = ColumnDataSource(nothing, name="frames", tags=[-1, [], [], []])
        self._serial, styled = 0, {"stylesheets": STYLE, "margin": 0}
        paces = [(str(pace), f"{pace} ×") for pace in (0.1, 0.25, 0.5, 1, 2)]
        self.play = Toggle(label="▶ Play", css_classes=["button", "key-space"], width=84, **styled)
        self.state = Slider(
            start=0, end=1, value=1, show_value=False, css_classes=["slider"], title=None, **styled
        )
        self.state.update(tooltips=False, sizing_mode="stretch_width")
        pace = Select(options=paces, value="1", width=70, css_classes=["choice", "pace"], **styled)
        standing = Div(text="<output></output>", css_classes=["standing"], width=160, **styled)
        parts = map(pn.pane.Bokeh, (self.play, self.state, pace, standing))
        self.view = pn.Row(*parts, css_classes=["player"], stylesheets=STYLE, **WIDE)
        self._connect(pace, {"readout": readout, "standing": standing})
        self.state.on_change("value", self._scrubbed)
        self.play.on_change("active", lambda attr, old, new: self._send_frames() if new else None)

    def _connect(self, pace, texts):
        """What happens in the browser alone."""
        parts = {"packet": self.packet, "frames": self.frames, "slider": self.state}
        self.show = CustomJS(args=parts | texts | {"layers": []}, code=JS["show"])
        for source, name in ((self.packet, "data"), (self.state, "value")):
            source.js_on_change(name, self.show)
        # The slider waits where it stands until the states are there.
        again = CustomJS(args={"show": self.show, "slider": self.state}, code="show.execute(slider)")
        self.frames.js_on_change("data", again)
        self.play.js_on_change("active", CustomJS(args=parts | {"pace": pace}, code=JS["play"]))
        self.drag = CustomJS(args=parts | {"play": self.play}, code=JS["drag"])

    def stand(self, way):
        """Put the slider where a trajectory stands."""
        self._way = way
        self.state.update(end=len(way) - 1, value=way.now)

    def send(self, drawn, layers, cells, anew):
        """Draw the present state on some layers; `anew` if other states are to be played."""
        self._drawn, self._layers, self._cells = drawn, layers, cells
        way, motion = drawn.way, drawn.way.motion
        values, starts, labels = packed(drawn, layers, [way.now])
        times = np.linspace(0, 1, len(way))
        if motion is not None:
            times = (motion.time - motion.time[0]) / (motion.time[-1] - motion.time[0])
        path = (("d", way.states.depth), ("F", way.force))
        path = [(each / drawn.axes[name].factor).tolist() for name, each in path]
        words = [readouts.values(way, cells, way.now)]
        self._serial += anew
        self.packet.tags = [self._serial, starts, labels, words, times.tolist(), path]
        self.packet.data = {"values": values}
        if self.play.active:
            self._send_frames()

    def _send_frames(self):
        """Send all states, once, so that the browser can move through them alone."""
        if self.frames.tags[0] == self._serial:
            return
        way = self._drawn.way
        states = range(len(way))
        values, starts, labels = packed(self._drawn, self._layers, states, moving_only=True)
        words = [readouts.values(way, self._cells, i) for i in states]
        with pn.io.hold(pn.state.curdoc):
            self.frames.tags = [self._serial, starts, labels, words]
            self.frames.data = {"values": values}

    def _scrubbed(self, attr, old, new):
        if int(new) != self._way.now:
            self._send_frames()
