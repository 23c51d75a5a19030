"""The page of one session: a function of one state, which every change gives anew."""

import logging
from dataclasses import dataclass, replace
from html import escape
from typing import Any

import panel as pn
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import ColumnDataSource, CustomJS

from . import changes
from .drives import Course
from .panels import Frame, readouts
from .panels.board import Board
from .panels.controls import Choices, Controls
from .panels.fitting import Fitting
from .panels.guide import Guide
from .panels.held import Held, Table, is_held, opened, toggled
from .panels.share import Share
from .plots import NAMED, PLOTS, TILES
from .plots.plot import Plot, View
from .solve import DRIVES, Resting, described, follow, in_time
from .state import VIEW, State, link
from .state import opened as preset_opened
from .state.files import Curve, decoded, read_tip
from .ui import JS, brought, plain, show

_LOG = logging.getLogger(__name__)
#: Milliseconds without a change after which the address follows.
SETTLED = 300
_FAULT = "This cannot be shown, because of a fault of the explorer. Everything is as it was before."
_MOST_UNDO = 100
#: Names of widgets that have none of their own, by their classes.
_NAMED = {"slider": "State along the path", "tour": "Guided scene"}
_NAMED |= {"tip": "CSV file of a measured tip: r, z", "curve": "CSV file of a measured curve: depth, force"}


@dataclass(frozen=True)
class Shown:
    """What a page shows: a state, its view, the plots that are seen, and what is held."""

    state: State
    view: View
    held: list[Held]

    @property
    def plots(self) -> list[Plot]:
        """The plots that are seen."""
        seen = (*NAMED, *self.state.tiles)
        return [plot for name, plot in PLOTS.items() if name in seen and plot.there(self.view)]


class Page:
    """What one person sees and does."""

    def __init__(self, arguments: dict[str, list[bytes]] | None = None):
        self.document, self.past, self.future, self._mark = pn.state.curdoc, [], [], None
        self.solved: dict[Any, Course] = {}
        self._waiting, self._ready, self.shown, self._again = None, False, None, False
        self.state, notice = preset_opened(), ""
        self.resting = Resting(self._show_found)
        self.choices = Choices(self.tell, lambda: self.state)
        self.board = Board(self.choices, self._asked)
        self.controls = Controls(self.choices, self.act, self.tell)
        self.fitting = Fitting(self.choices, self.act, self.tell)
        self.share, self.guide = Share(lambda: self.shown), Guide(self.tell, lambda: self.shown.view.course)
        self.table = Table(self.tell)
        self._layout()
        self._bound()
        self._watch()
        try:
            self.draw(link.read(arguments) if arguments else self.state)
        except Exception as error:
            notice = f"The link was not opened: {self._refusal(error)}"
            self.draw(preset_opened())
        if notice:
            self.notify(notice)

    def _layout(self):
        """All that is on the page; what changes in the browser alone is connected here."""
        panels = {"share": self.share.view, "guide": self.guide.view, "menu": None}
        tabs = {"explore": self.controls.view, "fit": self.fitting.view, "held": self.table.view}
        self.frame = Frame(
            self.choices.row("preset"), self.choices.row("axes"), panels, tabs, self.share.show
        )
        self.address, self.theme = ColumnDataSource(name="address"), ColumnDataSource(name="theme")
        self.view = self.frame.framed(self.board)

    def _watch(self):
        frame, tell = self.frame, self.tell
        frame.undo.on_click(lambda event: self._step(self.past, self.future))
        frame.redo.on_click(lambda event: self._step(self.future, self.past))
        frame.reset.on_click(lambda event: tell(changes.reset))
        again, tip = self.controls.again, self.controls.tip
        again.on_click(lambda event: tell(lambda now: changes.hit_again(now, self.shown.view.course.hit)))
        brought(tip, lambda data: tell(lambda now: changes.take_tip(now, *read_tip(decoded(data)))))
        frame.hold.param.watch(self._held, "value")
        frame.all.param.watch(lambda event: self._say_all(), "value")
        for name, each in (("dark", frame.dark), ("keep", self.board.keep)):
            each.param.watch(
                lambda event, name=name: tell(lambda now: now.but(**{name: event.new})), "value"
            )
        player = self.board.player
        player.state.on_change("value_throttled", self._stood)
        player.state.on_change("value", self._moved)
        player.play.on_change("active", lambda attr, old, new: new and self._send())
        player.hand.on_change("tags", self._dragged)
        self.theme.js_on_change("tags", CustomJS(args={}, code=JS["tell"]))
        self.address.js_on_change("tags", CustomJS(args={}, code=JS["tell"]))
        if self.document is not None:
            self._connect()

    def _connect(self):
        """What begins and ends with the browser."""
        for source in (self.theme, self.address):
            self.document.add_root(source)
        self.document.on_event(DocumentReady, self._begin)
        self.document.js_on_event(
            DocumentReady, CustomJS(args={"named": _NAMED, "theme": self.theme}, code=JS["ready"])
        )
        # What was shown is in the address; the session behind it may be gone.
        self.document.js_on_event(ConnectionLost, CustomJS(code=JS["again"]))
        self.document.on_session_destroyed(lambda context: self.resting.end())

    # What a person does, and what is refused.

    @pn.io.hold()
    def act(self, change: Any, mark: str | None = None) -> None:
        """Make a change and show it, or leave everything as it was; changes of one mark are one to undo.

        Raises ValueError with what the person is told, if it is refused.
        """
        before = after = self.state
        try:
            after = change(before)
            if after == before:
                return
            self.draw(after)
        except Exception as error:
            said = self._refusal(error, after)
            if self.shown is not None and self.state is not before:
                self.draw(before)
            raise ValueError(said) from None
        if after.scene_values != before.scene_values:
            if mark is None or mark != self._mark:
                self.past = [*self.past[1 - _MOST_UNDO :], before]
            self.future, self._mark = [], mark
            self._bound()

    def tell(self, change: Any, refused: Any = None) -> None:
        """Make a change; a refusal is a notice, or told where it was made."""
        try:
            self.act(change)
            self.controls.forget()
            self.fitting.forget()
        except ValueError as error:
            (refused or self.notify)(str(error))
            self._around()

    def _step(self, source, target):
        """Undo, or do again: what the view is like stays."""
        if source:
            now, past, future = self.state, self.past, self.future
            self.tell(lambda state: source[-1].but(**{name: now[name] for name in VIEW}))
            if self.past is not past:
                self.past, self.future, self._mark = past, future, None
                source.pop()
                target.append(now)
                self._bound()

    def _bound(self):
        show(self.frame.undo, disabled=not self.past)
        show(self.frame.redo, disabled=not self.future)

    def _asked(self, name, on):
        def act(state):
            if on == (name in state.tiles) or name not in TILES:
                return state
            kept = state.tiles if state.keep or not on else ()
            return state.but(tiles=tuple(t for t in TILES if t in {*kept, name} and (on or t != name)))

        self.tell(act)

    def _held(self, event):
        if event.new != is_held(self.state):
            self.tell(toggled)
        show(self.frame.hold, value=is_held(self.state))

    def notify(self, text: str) -> None:
        """Tell the person, who may have written some of it."""
        if pn.state.notifications is not None:
            pn.state.notifications.error(escape(text), duration=7000)

    def _refusal(self, error, state=None):
        """What is said of an error; one that is not the person's is logged with what led to it."""
        if isinstance(error, ValueError):
            return plain(str(error))
        _LOG.error("a change could not be shown, scene %s", described(state or self.state), exc_info=error)
        return _FAULT

    # What is drawn.

    @pn.io.hold()
    def draw(self, state: State) -> None:
        """Show a state: all is found before anything is changed."""
        course = follow(state, self.solved)
        held = self._of_held(state)
        view = View(
            course,
            state,
            [each.course for each in held],
            self.resting.found(PLOTS, state, course),
            Curve.of(state),
        )
        columns = self.board.columns(view, state.tiles, state.dark)
        self.state, self.shown = state, Shown(state, view, held)
        self.readings = readouts.readings(course)
        self.board.show(columns, view, state)
        self.board.player.stand(view, self.readings)
        if self.board.player.play.active:
            self._send()
        self._around()

    def _of_held(self, state):
        """The scenes that are held, solved once for each link."""
        if self.shown is not None and self.shown.state.hold == state.hold and not self._again:
            return self.shown.held
        self._again = False
        return [opened(query, self.solved) for query in state.hold]

    def _around(self):
        """Everything beside the plots."""
        state, course = self.state, self.shown.view.course
        self.choices.show(state)
        self.board.show_tabs(self.shown.view, state)
        self.controls.show(state)
        self.fitting.show(state)
        self.table.show(course, self.shown.held)
        self.guide.show(course)
        # Texts that change lay the page out anew: while a slider moves they wait.
        if not self._ready:
            self._say()
        show(self.frame.hold, value=bool(state.hold) and is_held(state))
        show(self.frame.tabs["held"], visible=bool(state.hold))
        if self.frame.tab == "held" and not state.hold:
            self.frame.show("explore")
        show(self.frame.dark, value=state.dark)
        if self.theme.tags != [state.dark]:
            self.theme.tags = [state.dark]
        if self.share.view.visible:
            self.share.show()
        self._say_all()
        self._settle()

    def _say(self):
        state, course = self.state, self.shown.view.course
        show(self.frame.warnings, object=readouts.warnings(course, state))
        self.controls.say(state, course)

    def _say_all(self):
        if self.frame.all.value:
            course = self.shown.view.course
            show(self.frame.numbers, object=readouts.table(course, self.readings, course.now))

    # What the player and the hand do.

    def _moved(self, attr, old, new):
        if int(new) != self.shown.view.course.now:
            self._send()

    def _send(self):
        self.board.player.send(self.shown.view, self.readings, self.board.pictures())

    @pn.io.hold()
    def _stood(self, attr, old, new):
        """The page stands at another state; it has drawn that already, if it has the frames."""
        view = self.shown.view
        now = min(int(new), len(view.course) - 1)
        if now == view.course.now:
            return
        if not self.board.player.frames.tags:
            self.draw(self.state.but(progress=float(view.course.progress[now])))
            return
        view.course = course = replace(view.course, now=now)
        self.state = self.state.but(progress=float(course.progress[now]))
        self.shown = replace(self.shown, state=self.state)
        if any(plot.of_state for plot in self.shown.plots):
            self.draw(self.state)
            return
        self._around()

    def _dragged(self, attr, old, new):
        """The indenter is dragged to a depth, in the unit of the heights of its plot."""
        if new and isinstance(new[0], int | float):
            depth = new[0] * self.shown.view.axis("z").factor
            try:
                self.act(lambda state: changes.press_to(state, depth), "hand")
            except ValueError as error:
                self.notify(str(error))
            self.board.player.hand.tags = []

    # What comes when the input is at rest.

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
        self._say()
        try:
            query = link.write(self.state, DRIVES[self.state.drive].form)
        except ValueError:
            query = ""
        if self.address.tags != [f"?{query}"]:
            self.address.tags = [f"?{query}"]
        view = self.shown.view
        self.board.describe(view, readouts.summary(self.state))
        for k, each in enumerate([view.course, *(each.course for each in self.shown.held)]):
            self.resting.follow(f"course {k}", each.scene if each.pending else None, in_time, each)
        self.resting.look(PLOTS, {plot.name for plot in self.shown.plots}, self.state, view.course)

    @pn.io.hold()
    def _show_found(self, name, found):
        """Draw what was found while the input was at rest; if that fails, go on without it."""
        solved = self.solved
        try:
            if isinstance(found, str):
                self.notify(plain(found))
            else:
                if isinstance(found, Course):
                    self.solved, self._again = dict([*solved.items(), (found.scene, found)][-4:]), True
                self.draw(self.state)
        except Exception as error:
            self.solved = solved
            self.resting.give_up(name)
            self.notify(self._refusal(error))
            self.draw(self.state)
