"""The page of one session, a function of one state."""

import logging
from dataclasses import dataclass, replace
from html import escape
from typing import Any

import panel as pn
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import ColumnDataSource, CustomJS

from mdr_core.shapes.tables import decoded

from . import changes
from .drives import Course
from .panels import Frame, readouts
from .panels.board import Board
from .panels.controls import Choices, Controls
from .panels.fitting import Fitting
from .panels.guide import Guide
from .panels.held import Held, Table, held_scene, is_held, toggle_hold
from .panels.share import Share
from .plots import NAMED, PLOTS, TILES
from .plots.plot import Plot, View
from .solve import Resting, described, follow, is_served
from .state import VIEW, State, link, preset_state
from .state.files import Curve, read_tip
from .ui import JS, on_upload, plain, show

_LOG = logging.getLogger(__name__)
#: Milliseconds of rest before slow updates.
SETTLED = 300
_FAULT = "This cannot be shown, because of a fault of the explorer. Everything is as it was before."
_UNDO_STEPS = 100
#: Accessible names of widgets, by class.
_NAMED = {"slider": "State along the path"}


@dataclass(frozen=True)
class Shown:
    """State of a page with its view and held scenes."""

    state: State
    view: View
    held: list[Held]

    @property
    def plots(self) -> list[Plot]:
        """Visible plots."""
        seen = (*NAMED, *self.state.tiles)
        return [plot for name, plot in PLOTS.items() if name in seen and plot.there(self.view)]


def _opened(query: str) -> State:
    """State of a link, with the plots that exist."""
    state = link.read(query)
    return state.replace(tiles=tuple(name for name in TILES if name in state.tiles))


class Page:
    """The page of one session."""

    def __init__(self, query: str = ""):
        self.document, self.past, self.future, self._drag = pn.state.curdoc, [], [], None
        self.solved: dict[Any, Course] = {}
        self._waiting, self._ready, self.shown, self._courses_changed = None, False, None, False
        self.state = preset_state()
        self.resting = Resting(self._show_result)
        self.choices = Choices(self.apply, lambda: self.state)
        self.board = Board(self.choices, self._toggle_tile)
        self.controls = Controls(self.choices, self.apply_or_raise)
        self.fitting = Fitting(self.choices, self.apply_or_raise, self.apply)
        self.share = Share(lambda: self.shown)
        self.guide = Guide(self.apply, lambda: self.shown.view.course)
        self.table = Table(self.apply)
        self._layout()
        self._show_history()
        self._watch()
        try:
            self.draw(_opened(query))
        except Exception as error:
            self.draw(self.state)
            self.notify(f"The link was not opened: {self._refusal(error)}")

    def _layout(self):
        parts = {"explore": self.controls.view, "fit": self.fitting.view}
        parts |= {"held": self.table.view, "share": self.share.view}
        row = self.choices.row
        self.frame = Frame(row("preset"), self.guide.view, parts)
        self.address, self.theme = ColumnDataSource(name="address"), ColumnDataSource(name="theme")
        self.view = self.frame.framed(self.board)

    def _watch(self):
        frame, apply = self.frame, self.apply
        frame.undo.on_click(lambda event: self._step(self.past, self.future))
        frame.redo.on_click(lambda event: self._step(self.future, self.past))
        frame.reset.on_click(lambda event: apply(changes.reset))
        self.controls.again.on_click(
            lambda event: apply(lambda now: changes.hit_again(now, self.shown.view.course.hit))
        )
        on_upload(
            self.controls.tip,
            lambda data: apply(lambda now: changes.take_tip(now, *read_tip(decoded(data)))),
        )
        frame.hold.param.watch(self._hold_toggled, "value")
        for name in ("share", "numbers"):
            frame.tabs[name].param.watch(lambda event: self._show_part(), "value")
        for name, each in (("dark", frame.dark), ("keep", self.board.keep)):
            each.param.watch(
                lambda event, name=name: apply(lambda now: now.replace(**{name: event.new})), "value"
            )
        player = self.board.player
        player.state.on_change("value_throttled", self._state_chosen)
        player.state.on_change("value", self._slider_moved)
        player.play.on_change("active", lambda attr, old, new: new and self._send())
        player.hand.on_change("tags", self._dragged)
        for source in (self.theme, self.address):
            source.js_on_change("tags", CustomJS(args={}, code=JS["tell"]))
        if self.document is not None:
            self._connect()

    def _connect(self):
        """Connect events of the browser and of the session."""
        for source in (self.theme, self.address):
            self.document.add_root(source)
        self.document.on_event(DocumentReady, self._browser_ready)
        ready = CustomJS(args={"named": _NAMED, "theme": self.theme}, code=JS["ready"])
        self.document.js_on_event(DocumentReady, ready)
        # The address restores the page when its session is lost.
        self.document.js_on_event(ConnectionLost, CustomJS(code=JS["again"]))

    # Changes and refusals.

    @pn.io.hold()
    def apply_or_raise(self, change: Any, mark: str | None = None) -> None:
        """Apply a change and show it; on failure restore the page and raise ValueError with a message.

        Changes with the same mark, as of one drag, are one step of undo.
        """
        before = after = self.state
        try:
            after = change(before)
            if after == before:
                return
            self.draw(after)
        except Exception as error:
            message = self._refusal(error, after)
            if self.shown is not None and self.state is not before:
                self.draw(before)
            raise ValueError(message) from None
        if after.scene_values != before.scene_values:
            if mark is None or mark != self._drag:
                self.past = [*self.past[1 - _UNDO_STEPS :], before]
            self.future, self._drag = [], mark
            self._show_history()

    def apply(self, change: Any, refused: Any = None, mark: str | None = None) -> None:
        """Apply a change; show a refusal as a notice, or by `refused`."""
        try:
            self.apply_or_raise(change, mark)
        except ValueError as error:
            (refused or self.notify)(str(error))
            self._show_panels()

    def _step(self, source, target):
        """Undo or redo; the view stays."""
        if source:
            now, past, future = self.state, self.past, self.future
            self.apply(lambda state: source[-1].replace(**{name: now[name] for name in VIEW}))
            if self.past is not past:
                self.past, self.future, self._drag = past, future, None
                source.pop()
                target.append(now)
                self._show_history()

    def _show_history(self):
        show(self.frame.undo, disabled=not self.past)
        show(self.frame.redo, disabled=not self.future)

    def _toggle_tile(self, name, on):
        def change(state):
            if on == (name in state.tiles) or name not in TILES:
                return state
            kept = state.tiles if state.keep or not on else ()
            return state.replace(tiles=tuple(t for t in TILES if t in {*kept, name} and (on or t != name)))

        self.apply(change)

    def _hold_toggled(self, event):
        if event.new != is_held(self.state):
            self.apply(toggle_hold)
        show(self.frame.hold, value=is_held(self.state))

    def notify(self, text: str) -> None:
        """Show a notice; its text may contain user input."""
        if pn.state.notifications is not None:
            pn.state.notifications.error(escape(text), duration=7000)

    def _refusal(self, error, state=None):
        """Message for an error; a fault is logged with its scene."""
        if isinstance(error, ValueError):
            return plain(str(error))
        _LOG.error("a change could not be shown, scene %s", described(state or self.state), exc_info=error)
        return _FAULT

    # Drawing.

    @pn.io.hold()
    def draw(self, state: State) -> None:
        """Show a state; everything is computed before anything is changed."""
        course = follow(state, self.solved)
        held = self._held_scenes(state)
        found = self.resting.found((PLOTS[name] for name in state.tiles), state, course)
        view = View(course, [each.course for each in held], found, Curve.of(state))
        columns = self.board.columns(view, state.tiles, state.dark)
        self.state, self.shown = state, Shown(state, view, held)
        self.readings = readouts.readings(course)
        self.board.show(columns, view, state)
        self.board.player.show(view, self.readings)
        if self.board.player.play.active:
            self._send()
        self._show_panels()

    def _held_scenes(self, state):
        """Held scenes, solved once each."""
        if self.shown is not None and self.shown.state.hold == state.hold and not self._courses_changed:
            return self.shown.held
        self._courses_changed = False
        return [held_scene(query, self.solved) for query in state.hold]

    def _show_panels(self):
        """Update everything beside the plots."""
        state, course = self.state, self.shown.view.course
        self.choices.show(state)
        self.board.show_tabs(self.shown.view, state)
        self.controls.show(state)
        self.fitting.show(state)
        self.table.show(course, self.shown.held)
        self.guide.show(course)
        # Changed texts cause a new layout, so they wait while a slider moves.
        if not self._ready:
            self._show_texts()
        show(self.frame.hold, value=bool(state.hold) and is_held(state))
        show(self.frame.tabs["held"], visible=bool(state.hold))
        if self.frame.shown == "held" and not state.hold:
            self.frame.show("explore")
        show(self.frame.dark, value=state.dark)
        if self.theme.tags != [state.dark]:
            self.theme.tags = [state.dark]
        self._show_part()
        self._schedule()

    def _show_texts(self):
        state, course = self.state, self.shown.view.course
        show(self.frame.warnings, object=readouts.warnings(course, state))
        self.controls.show_texts(state, course)

    def _show_part(self):
        """Update the part of the side that is shown."""
        course = self.shown.view.course
        if self.frame.shown == "share":
            self.share.show()
        elif self.frame.shown == "numbers":
            show(self.frame.numbers, object=readouts.table(course, self.readings, course.now))

    # Player and dragging.

    def _slider_moved(self, attr, old, new):
        if int(new) != self.shown.view.course.now:
            self._send()

    def _send(self):
        self.board.player.send(self.shown.view, self.readings, self.board.pictures())

    @pn.io.hold()
    def _state_chosen(self, attr, old, new):
        """Accept the state chosen with the player, which the browser has drawn if it has frames."""
        view = self.shown.view
        now = min(int(new), len(view.course) - 1)
        if now == view.course.now:
            return
        if not self.board.player.frames.tags:
            self.draw(self.state.replace(progress=float(view.course.progress[now])))
            return
        view.course = course = replace(view.course, now=now)
        self.state = self.state.replace(progress=float(course.progress[now]))
        self.shown = replace(self.shown, state=self.state)
        if any(plot.of_state for plot in self.shown.plots):
            self.draw(self.state)
            return
        self._show_panels()

    def _dragged(self, attr, old, new):
        """Press to a depth given in the height unit of the springs plot."""
        if new and isinstance(new[0], int | float):
            depth = new[0] * self.shown.view.axis("z").factor
            self.apply(lambda state: changes.press_to(state, depth), mark="hand")
            self.board.player.hand.tags = []

    # Updates when the input rests.

    def _browser_ready(self, event):
        self._ready = True
        self._schedule()

    def _schedule(self):
        """Schedule the slow updates."""
        if not (is_served(self.document) and self._ready):
            return
        if self._waiting is not None:
            self.document.remove_timeout_callback(self._waiting)
        self._waiting = self.document.add_timeout_callback(self._input_rests, SETTLED)

    def _input_rests(self):
        self._waiting = None
        self._show_texts()
        query, _ = self.share.query()
        if self.address.tags != [f"?{query}"]:
            self.address.tags = [f"?{query}"]
        view = self.shown.view
        self.board.describe(view, readouts.summary(self.state))
        courses = [view.course, *(each.course for each in self.shown.held)]
        self.resting.begin(courses, self.shown.plots, self.state)

    @pn.io.hold()
    def _show_result(self, name, found):
        """Draw a result computed at rest; on failure go on without it."""
        solved = self.solved
        try:
            if isinstance(found, str):
                self.notify(plain(found))
            else:
                if isinstance(found, Course):
                    self.solved, self._courses_changed = (
                        dict([*solved.items(), (found.scene, found)][-4:]),
                        True,
                    )
                self.draw(self.state)
        except Exception as error:
            self.solved = solved
            self.resting.give_up(name)
            self.notify(self._refusal(error))
            self.draw(self.state)
