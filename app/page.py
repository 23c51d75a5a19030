"""The page of one session: one change is one solve and one array of columns; playing is the browser's."""

import logging
from dataclasses import replace
from html import escape
from urllib.parse import urlencode

import panel as pn
import param
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import CustomJS, Div

from . import link, readouts
from .controls import Controls
from .drives import follow
from .explorer import Explorer
from .figures import DARK, LIGHT
from .grid import Grid
from .held import Table, held, is_held, renamed, toggled
from .measured import Curve
from .measuring import Measuring
from .parts import FULL, HERE, JS, STYLE, WIDE, brought, button, decoded, html, linked, plain, toggle, tools
from .player import Player
from .plots import PLOTS
from .quantities import CHOICES, DATA
from .resting import Resting, about, in_time
from .takeaway import TakeAway
from .tip import read_tip
from .tour import Tour
from .trajectory import Trajectory, nearest
from .vertices import Vertices
from .view import View

_LOG = logging.getLogger(__name__)
#: Milliseconds without a change after which the address follows.
SETTLED = 300
_FAULT = "This cannot be shown, because of a fault of the explorer. Everything is as it was before."


class Page:
    """What one person sees and does."""

    def __init__(self, arguments=None):
        self.document, self.explorer, self.held = pn.state.curdoc, Explorer(), []
        self.solved, self._waiting, self._ready = {}, None, False
        self._widgets()
        notice = self._open(arguments or {})
        self.resting = Resting(self._show_found)
        self.controls = Controls(self.explorer, self.attempt, self.tell)
        self.controls.parts["vertices"] = Vertices(self.explorer, self.attempt)
        self.away, self.tour = TakeAway(self), Tour(self)
        self.measuring = Measuring(self)
        self._connect()
        self._solve()
        self._layout()
        self._watch()
        self._around()
        if notice:
            self.notify(notice)

    def _open(self, arguments):
        """The state of a link; what is said if it cannot be opened."""
        try:
            if arguments:
                link.restore(self.explorer, arguments)
                follow(self.explorer.scene(), self.explorer.progress)
                self._hold()
        except Exception as error:
            self.explorer, self.held = Explorer(), []
            return f"The link was not opened: {self._refusal(error)}"
        return ""

    # What is on the page.

    def _widgets(self):
        self.undo, self.redo, self.reset = button("Undo", "z"), button("Redo", "y"), button("Reset", "r")
        self.hold, self.dark = toggle("Hold", "h"), toggle("Dark", "d")
        self.take, self.guide = toggle("Take with you", "t"), toggle("Guide", "g")
        self.measure = toggle("Fit a measurement", "f")
        self.asked = {name: toggle(*plot.button) for name, plot in PLOTS.items() if plot.button}
        self.readout = Div(css_classes=["readouts"], stylesheets=STYLE, **WIDE)
        self.player, self.address = Player(self.readout), Div(visible=False)
        self.lights, self.table = html("", "lights"), Table(self._rename, self._remove)

    def _layout(self):
        title = html("<h1>Indentation explorer</h1>non-local yield, solved by dimensionality reduction")
        about = html((HERE / "static" / "about.html").read_text(encoding="utf-8"))
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 320}
        side = pn.Column(title, self.controls.form, about, **look)
        axes = self.controls.rows["axes"]
        axes.param.update(sizing_mode=None, width=180)
        buttons = (self.undo, self.redo, self.reset, self.hold, *self.asked.values())
        buttons = (*buttons, self.dark, self.take, self.measure, self.guide, axes)
        parts = (tools(*buttons, stylesheets=STYLE), self.table.view)
        parts += (self.away.panel, self.measuring.panel, self.tour.panel, pn.pane.Bokeh(self.readout))
        parts += (self.lights, self.player.view, self.grid.view, pn.pane.Bokeh(self.address))
        results = pn.Column(*parts, css_classes=["results"], **FULL)
        self.view = pn.Row(side, results, css_classes=["page"], **FULL)

    def _connect(self):
        """What happens in the browser alone."""
        self.theme = CustomJS(args={"light": LIGHT, "dark": DARK, "figures": []}, code=JS["theme"])
        self.grid = Grid(self.player.show, self.theme, self.player.drag, self.controls)
        self.dark.jscallback(args={"theme": self.theme}, value="theme.execute(cb_obj)")
        self.theme.js_on_change("args", CustomJS(args={"theme": self.theme}, code="theme.execute(theme)"))
        self.address.js_on_change("text", CustomJS(code="history.replaceState(null, '', cb_obj.text)"))
        parts = {"named": DATA["named"], "theme": self.theme}
        parts |= {"show": self.player.show, "packet": self.player.packet}
        if self.document is not None:
            self.document.on_event(DocumentReady, self._begin)
            self.document.js_on_event(DocumentReady, CustomJS(args=parts, code=JS["ready"]))
            # What was shown is in the address; the session behind it may be gone.
            self.document.js_on_event(ConnectionLost, CustomJS(code=JS["again"]))

    def _watch(self):
        explorer = self.explorer
        names = [name for name in explorer.param if name not in (*explorer.VIEW, "name")]
        seen = [name for name in explorer.VIEW if name in (*CHOICES, "hold", "plots")]
        explorer.param.watch(self._hold, "hold")
        explorer.param.watch(self._changed, names, precedence=1)
        explorer.param.watch(self._viewed, seen, precedence=1)
        acts = {self.undo: explorer.undo, self.redo: explorer.redo}
        acts[self.reset] = lambda: explorer.load(explorer.preset)
        acts[self.controls.parts["again"]] = lambda: explorer.hit_again(self.way.hit)
        for pressed, act in acts.items():
            pressed.on_click(lambda event, act=act: self.tell(act))
        brought(self.controls.tip, self._bring_tip)
        self.hold.param.watch(self._held, "value")
        for name, asked in self.asked.items():
            asked.param.watch(lambda event, name=name: self._asked(name, event.new), "value")
        self.dark.value = explorer.dark
        self.dark.param.watch(self._darkened, "value")
        self.player.state.on_change("value_throttled", self._stood)

    # What a person does, and what is refused.

    @pn.io.hold()
    def attempt(self, act):
        """Make a change and show it, or leave everything as it was.

        Raises
        ------
        ValueError
            With what the person is told, if it is refused.
        """
        try:
            return act()
        except Exception as error:
            said = self._refusal(error)
            self.explorer.refuse()
            raise ValueError(said) from None

    def tell(self, act):
        """Make a change; a refusal is a notice."""
        try:
            self.attempt(act)
            for number in self.controls.numbers.values():
                number.forget()
        except ValueError as error:
            self.notify(str(error))
            self.controls.show(self.way)

    def open(self, query):
        """Show the scene of a link, as a change that can be undone; plots and theme stay."""
        kept = {"plots": " ".join(self.explorer.plots), "dark": int(self.explorer.dark)}

        def act():
            with param.parameterized.batch_call_watchers(self.explorer):
                link.apply(self.explorer, link.arguments(f"{query}&{urlencode(kept)}"))
            self._changed()

        self.tell(act)

    def notify(self, text):
        """Tell the person, who may have written some of it."""
        if pn.state.notifications is not None:
            pn.state.notifications.error(escape(text), duration=7000)

    def _refusal(self, error):
        """What is said of an error; one that is not the person's is logged with what led to it."""
        if isinstance(error, ValueError):
            return plain(str(error))
        _LOG.error("a change could not be shown, scene %s", self.explorer.described(), exc_info=error)
        return _FAULT

    @pn.io.hold()
    def _changed(self, *events):
        self._solve()
        self._around()

    def _bring_tip(self, data):
        self.tell(lambda: self.explorer.take_tip(*read_tip(decoded(data))))

    def _asked(self, name, shown):
        plots = {*self.explorer.plots, name} if shown else {*self.explorer.plots} - {name}
        if plots != {*self.explorer.plots}:
            self.tell(lambda: self.explorer.param.update(plots=[n for n in self.asked if n in plots]))

    @pn.io.hold()
    def _viewed(self, *events):
        self._show()
        self._around()

    def _darkened(self, event):
        self.explorer.dark = event.new
        self._settle()

    def _held(self, event):
        if event.new != is_held(self.explorer):
            self._keep(lambda: toggled(self.explorer))
            self.hold.value = is_held(self.explorer)

    def _rename(self, k, name):
        if name != self.held[k].name:
            hold = self.explorer.hold
            self._keep(lambda: [*hold[:k], renamed(hold[k], name), *hold[k + 1 :]])

    def _remove(self, k):
        self._keep(lambda: [*self.explorer.hold[:k], *self.explorer.hold[k + 1 :]])

    def _keep(self, queries):
        self.tell(lambda: self.explorer.param.update(hold=queries()))

    def _hold(self, *events):
        """Solve the scenes that are held, from their queries."""
        self.held = [held(query, self._follow) for query in self.explorer.hold]

    # What changes what is drawn.

    def _follow(self, explorer):
        """The trajectory of what is set, in time if it has been solved so."""
        scene = explorer.scene()
        way = self.solved.get(scene) or follow(scene, explorer.progress)
        return replace(way, now=nearest(way.progress, explorer.progress))

    def _solve(self):
        self.way = self._follow(self.explorer)
        self.cells = readouts.cells(self.way)
        self.player.stand(self.way)
        self._show()

    def _show(self, anew=True):
        """Draw the present state: one array of all columns; `anew` if other states are to be played."""
        found = {plot.title: self.resting.known(plot, self.way, values) for plot, values in self._asks()}
        held, curve = [each.way for each in self.held], Curve.of(self.explorer)
        self.drawn = View(self.way, held, found, self.explorer.choices, curve)
        self.grid.show(self.drawn, self._shown())
        self.readout.text = readouts.heads(self.cells)
        self.player.send(self.drawn, self.grid.layers, self.cells, anew)

    def _asks(self):
        """The plots on request that find what they show, each with what it asks for."""
        plots = [PLOTS[name] for name in self.explorer.plots if PLOTS[name].resting]
        return [(plot, plot.values(self.explorer)) for plot in plots]

    def _shown(self):
        """The plots that are seen, in their order."""
        pressed, known = self.way.motion is None, self.drawn.axes.keys()
        for name, asked in self.asked.items():
            asked.visible = known >= set(PLOTS[name].axes)
        asked = [name for name in self.explorer.plots if self.asked[name].visible]
        names = [n for n, plot in PLOTS.items() if not plot.button and known >= set(plot.axes)]
        # Three in a row: the pressure stays below the springs, and radii or residual below the force.
        first = [name for name in asked if not PLOTS[name].log][:1] or ["radii"] * ("residual" in names)
        first *= pressed
        return [*names[:2], *first, *(name for name in (*names[2:], *asked) if name not in first)]

    @pn.io.hold()
    def _show_found(self, title, found):
        """Draw what was found while the input was at rest; if that fails, go on without it."""
        solved = self.solved
        try:
            if isinstance(found, str):
                self.notify(plain(found))
            elif isinstance(found, Trajectory):
                self.solved = dict([*solved.items(), (found.scene, found)][-4:])
                self._hold()
                self._changed()
            else:
                self._show(anew=False)
        except Exception as error:
            self.solved = solved
            self.resting.give_up(title)
            self.notify(self._refusal(error))
            self._hold()
            self._changed()

    @pn.io.hold()
    def _stood(self, attr, old, new):
        """The page stands at another state; it has drawn that already."""
        now = min(int(new), len(self.way) - 1)
        self.drawn.way = self.way = replace(self.way, now=now)
        self.player.stand(self.way)
        self.explorer.progress = float(self.way.progress[now])
        if any(plot.of_state for plot, _ in self._asks()):
            self._show(anew=False)
        self._around()

    def _around(self):
        """Everything beside the plots."""
        explorer, way = self.explorer, self.way
        self.controls.show(way)
        self.controls.notes["sketch"].object = readouts.sketch(way, explorer.shape)
        said = readouts.lights(way, explorer)
        self.lights.object = "".join(f'<span class="{level}">{linked(text)}</span>' for level, text in said)
        self.hold.value = is_held(explorer)
        for name, asked in self.asked.items():
            asked.value = name in explorer.plots
        self.table.show(way, self.held)
        self.grid.tell(readouts.summary(explorer))
        self.away.show()
        self.measuring.show()
        self.tour.show()
        explorer.accept()
        self.undo.disabled, self.redo.disabled = not explorer.past, not explorer.future
        self._settle()

    def _begin(self, event):
        """The browser is there: what is found before that, for a link, would not be sent to it."""
        self._ready = True
        self._settle()

    def _settle(self):
        """The address follows once the input is still."""
        if self.document is None or self.document.session_context is None or not self._ready:
            return
        if self._waiting is not None:
            self.document.remove_timeout_callback(self._waiting)
        self._waiting = self.document.add_timeout_callback(self._settled, SETTLED)

    def _settled(self):
        self._waiting = None
        query = link.query(self.explorer)
        self.address.text = f"?{query}" if query else "?"
        way = self.way
        self.grid.describe(self.drawn)
        for k, each in enumerate([way, *(each.way for each in self.held)]):
            self.resting.follow(f"way {k}", each.scene if each.pending else None, in_time, each)
        asked = {plot: values for plot, values in self._asks() if not plot.quick(*values)}
        for plot in (plot for plot in PLOTS.values() if plot.resting):
            values = asked.get(plot, ())
            of = about(plot, way, values) if plot in asked else None
            self.resting.follow(plot.title, of, plot.resting, way, *values)
