"""The page of one session, a function of one state."""

import logging
from contextlib import suppress
from html import escape
from typing import Any

import panel as pn
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import CustomJS
from panel.io.location import Location

from . import changes, link
from .board import Board
from .courses import Course
from .drives import follow, scene_of
from .extra import EXTRAS, SERVICES
from .fields import Choices, Form, Numbers
from .frame import Frame
from .plot import View
from .plots import Z, visible
from .quantities import in_words
from .state import VIEW, State, preset_state
from .ui import JS, Messages, is_served, show

_LOG = logging.getLogger(__name__)
#: Milliseconds of rest before slow updates.
SETTLED = 300
_FAULT = "This cannot be shown, because of a fault of the explorer. Everything is as it was before."
_UNDO_STEPS = 100


class Address(Location):
    """The address of a page, without arguments: Panel fails to read one of 5,000 digits, or "²"."""

    @property
    def query_params(self):
        return {}


class Page:
    """The page of one session."""

    def __init__(self, query: str = ""):
        self.document, self.past, self.future, self._drag = pn.state.curdoc, [], [], None
        self.solved: dict[Any, Course] = {}
        self._waiting, self._ready, self.shown = None, False, None
        # Notices until the browser is ready, and whether the address holds a link that was not opened.
        self._notices, self._refused = [], False
        self._numbers: list[Numbers] = []
        self.state = preset_state()
        self.services = [make(self) for make in SERVICES]
        self.choices = Choices(self.apply, lambda: self.state)
        self.messages = Messages(name="messages")
        self.board = Board(self.choices, self.apply, self.messages)
        self.form = Form(self)
        self.frame = Frame(self)
        self.view = self.frame.view
        self._show_history()
        self._watch()
        try:
            self.draw(link.read(query))
            if names := link.unknown(query):
                self.notify(f"Unknown names in this link are ignored: {', '.join(names):.200}")
        except Exception as error:
            self.draw(self.state)
            self._refused = True
            self.notify(f"The link was not opened: {self.refusal(error)}")

    def _watch(self):
        player = self.board.player
        player.state.on_change("value_throttled", self._state_chosen)
        player.state.on_change("value", self._slider_moved)
        player.play.on_change("active", lambda attr, old, new: new and self._send())
        self.messages.on_change("hand", self._dragged)
        if self.document is None:
            return
        self.messages.on_change("dark", self._theme_chosen)
        told = CustomJS(code=JS["tell"])
        self.messages.js_on_change("address", told)
        self.messages.js_on_change("dark", told)
        self.document.add_root(self.messages)
        self.document.on_event(DocumentReady, self._browser_ready)
        told = {"messages": self.messages, "figures": self.board.dragged}
        for name in ("ready", "touch"):
            self.document.js_on_event(DocumentReady, CustomJS(args=told, code=JS[name]))
        # The address restores the page when its session is lost.
        self.document.js_on_event(ConnectionLost, CustomJS(code=JS["again"]))

    def _theme_chosen(self, attr, old, new):
        """Take the theme of the system."""
        self.apply(lambda state: state.replace(dark=new))

    def numbers(self) -> Numbers:
        """A new column of number fields of this page."""
        self._numbers.append(Numbers(self.apply_or_raise))
        return self._numbers[-1]

    def query(self) -> tuple[str, str]:
        """The page as a query, or why it has none."""
        try:
            return link.write(self.shown.state), ""
        except ValueError as error:
            return "", f"No link: {error}."

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
            message = self.refusal(error, after)
            if self.shown is not None and self.state is not before:
                self.draw(before)
            raise ValueError(message) from None
        if after.scene_values != before.scene_values:
            if mark is None or mark != self._drag:
                self.past = [*self.past[1 - _UNDO_STEPS :], before]
            self.future, self._drag, self._refused = [], mark, False
            self._show_history()

    def apply(self, change: Any, refused: Any = None, mark: str | None = None) -> None:
        """Apply a change; show a refusal as a notice, or by `refused`.

        Fields forget what was refused in them when the scene is changed elsewhere than in a field.
        """
        before = self.state
        try:
            self.apply_or_raise(change, mark)
            if self.state.scene_values != before.scene_values:
                for numbers in self._numbers:
                    numbers.forget()
        except ValueError as error:
            (refused or self.notify)(str(error))
            self._show_panels()

    def undo(self) -> None:
        self._step(self.past, self.future)

    def redo(self) -> None:
        self._step(self.future, self.past)

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
        self.frame.undo.show(disabled=not self.past)
        self.frame.redo.show(disabled=not self.future)

    def notify(self, text: str) -> None:
        """Show a notice, once the browser is ready; its text may contain user input."""
        if is_served(self.document) and not self._ready:
            self._notices.append(text)
        elif pn.state.notifications is not None:
            # Screen readers are told the text itself, in which quotation marks need no escape.
            pn.state.notifications.error(escape(text, quote=False), duration=7000)

    def refusal(self, error, state=None):
        """Message for an error; a fault is logged with its scene."""
        if isinstance(error, ValueError):
            return in_words(error)
        scene = state or self.state
        with suppress(Exception):
            scene = scene_of(scene).to_json()
        _LOG.error("a change could not be shown, scene %s", scene, exc_info=error)
        return _FAULT

    # Drawing.

    @pn.io.hold()
    def draw(self, state: State, again: bool = False, moved: bool = False) -> None:
        """Show a state; everything is computed before anything is changed.

        `again`: exact courses have been found; `moved`: only the present state has changed.
        """
        course = follow(state, self.solved)
        before = None if again else self.shown
        computed = {name: each.compute(state, before, self.solved) for name, each in EXTRAS.items()}
        for service in self.services:
            computed |= service.compute(state, course)
        view = View(state, course, computed)
        # Plots that this course has not are no longer asked for.
        shown = [plot.name for plot in visible(view) if plot.tab]
        view.state = state = state.replace(tiles=tuple(shown))
        columns = self.board.columns(view)
        self.state, self.shown = state, view
        self.board.show(columns, view)
        self.board.player.show(view, moved)
        if self.board.player.play.active:
            self._send()
        self._show_panels()

    def _show_panels(self):
        """Update everything beside the plots."""
        self.choices.show(self.state)
        self.board.show_tabs(self.shown)
        self.frame.show(self.shown)
        # Changed texts cause a new layout, so they wait while a slider moves.
        if not self._ready:
            self._show_texts()
        self.messages.dark = self.state.dark
        self._schedule()

    def _show_texts(self):
        show(self.frame.below, object="".join(each.below(self.shown) for each in EXTRAS.values()))
        self.form.show_texts(self.state, self.shown.course)

    # Player and dragging.

    def _slider_moved(self, attr, old, new):
        if int(new) != self.shown.course.now:
            self._send()

    def _send(self):
        self.board.player.send(self.shown, self.board.pictures())

    @pn.io.hold()
    def _state_chosen(self, attr, old, new):
        """Accept the state chosen with the player; frames that the browser has stay."""
        course = self.shown.course
        now = min(int(new), len(course) - 1)
        if now != course.now:
            self.draw(self.state.replace(progress=float(course.progress[now])), moved=True)

    def _dragged(self, attr, old, new):
        """Press to a depth given in the height unit of the springs plot."""
        if isinstance(new, int | float):
            depth = new * self.shown.axis(Z).factor
            self.apply(lambda state: changes.press_to(state, depth), mark="hand")
            self.messages.hand = None

    # Updates when the input rests.

    def _browser_ready(self, event):
        self._ready = True
        for text in self._notices:
            self.notify(text)
        self._input_rests()

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
        query, _ = self.query()
        # The empty address leaves the present one, of a link that was not opened.
        self.messages.address = "" if self._refused else f"?{query}"
        view = self.shown
        for each in self.services:
            each.rest(view)
