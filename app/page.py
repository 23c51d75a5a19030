"""The page of one session, a function of one state."""

import logging
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from html import escape
from typing import Any

import panel as pn
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import CustomJS
from panel.io.location import Location

from . import changes, link
from .board import Board
from .drives import follow, scene_of
from .extra import EXTRAS, SERVICES
from .fields import Field
from .frame import Frame
from .parts import Part, choice
from .player import frames
from .plot import View
from .plots import visible
from .quantities import in_words
from .state import VIEW, State, preset_state
from .ui import JS, Messages, is_served

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


@dataclass(frozen=True)
class History:
    """States that can be undone and redone, the latest last; and the mark of the last change."""

    past: tuple[State, ...] = ()
    future: tuple[State, ...] = ()
    mark: str | None = None

    def after(self, state: State, mark: str | None) -> "History":
        """The history once a state has been changed; changes with the same mark are one step."""
        if mark is not None and mark == self.mark:
            return History(self.past, (), mark)
        return History((*self.past[1 - _UNDO_STEPS :], state), (), mark)


class Page:
    """The page of one session."""

    def __init__(self, query: str = ""):
        self.document, self.state, self.history = pn.state.curdoc, preset_state(), History()
        self._waiting, self._ready, self.shown = None, False, None
        # Whether the player moves, which needs frames of each scene that is shown.
        self._moving = False
        # Notices until the browser is ready, and whether the address holds a link that was not opened.
        self._notices, self._refused = [], False
        self._fields: dict[str, Field] = {}
        self.messages = Messages(name="messages")
        self.board = Board(self)
        self.frame = Frame(self)
        self.services = [make(self) for make in SERVICES]
        self.view = self.frame.view
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
        if self.document is None:
            return
        self.messages.on_change("dark", self._theme_chosen)
        told = CustomJS(code=JS["tell"])
        self.messages.js_on_change("address", told)
        self.messages.js_on_change("dark", told)
        self.document.add_root(self.messages)
        self.document.on_event(DocumentReady, self._browser_ready)
        ready = CustomJS(args={"messages": self.messages}, code=JS["ready"])
        self.document.js_on_event(DocumentReady, ready)
        # The address restores the page when its session is lost.
        self.document.js_on_event(ConnectionLost, CustomJS(code=JS["again"]))

    def _theme_chosen(self, attr, old, new):
        """Take the theme of the system."""
        self.apply(lambda state: state.replace(dark=new))

    def query(self) -> tuple[str, str]:
        """The page as a query, or why it has none."""
        try:
            return link.write(self.shown.state), ""
        except ValueError as error:
            return "", f"No link: {error}."

    # What is set on the page.

    def number(self, name: str, like: float = 0.0) -> Part:
        """The field of a number; zero is shown in the unit that fits the value `like`."""
        if name not in self._fields:
            self._fields[name] = Field(name, self)
        return self._fields[name].part(self.state, like)

    def choice(self, name: str) -> Part:
        """A choice."""
        return choice(name, self.state, partial(self.choose, name))

    def choose(self, name: str, option: str) -> None:
        """Take another option of a choice."""
        self.apply(lambda state: changes.choose(state, name, option))

    # Changes and refusals.

    @pn.io.hold()
    def apply_or_raise(self, change: Any, mark: str | None = None) -> None:
        """Apply a change and show it; on failure restore the page and raise ValueError with a message.

        Changes with the same mark, as of one drag, are one step of undo.
        """
        before, history = self.state, self.history
        after = before
        try:
            after = change(before)
            if after == before:
                return
            if after.scene_values != before.scene_values:
                self.history = history.after(before, mark)
            self.draw(after)
        except Exception as error:
            message, self.history = self.refusal(error, after), history
            if self.shown is not None and self.state is not before:
                self.draw(before)
            raise ValueError(message) from None
        self._refused = self._refused and self.history is history

    def apply(self, change: Any, refused: Any = None, mark: str | None = None) -> None:
        """Apply a change; show a refusal as a notice, or by `refused`.

        Fields forget what was refused in them: the scene is changed elsewhere.
        """
        for each in self._fields.values():
            each.refused = ""
        try:
            self.apply_or_raise(change, mark)
        except ValueError as error:
            (refused or self.notify)(str(error))
            self.refresh()

    def undo(self) -> None:
        if past := self.history.past:
            self._return(past[-1], History(past[:-1], (*self.history.future, self.state)))

    def redo(self) -> None:
        if future := self.history.future:
            self._return(future[-1], History((*self.history.past, self.state), future[:-1]))

    def _return(self, state, history):
        """Go to a state of the history; the view stays."""
        self.apply(lambda now: state.replace(**{name: now[name] for name in VIEW}))
        # Else it was refused.
        if self.state.scene_values == state.scene_values:
            self.history = history
            self.refresh()

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
    def draw(self, state: State, now: int | None = None) -> None:
        """Show a state; everything is computed before anything is changed.

        `now`: the course is the same, and this the index of its present state.
        """
        course = follow(state) if now is None else replace(self.shown.course, now=now)
        computed = {name: each.compute(state, self.shown) for name, each in EXTRAS.items()}
        for service in self.services:
            computed |= service.compute(state, course)
        view = View(state, course, computed)
        # Plots that this course has not are no longer asked for.
        shown = [plot.name for plot in visible(view) if plot.tab]
        view.state = state = state.replace(tiles=tuple(shown))
        columns = self.board.columns(view)
        self.state, self.shown = state, view
        self.board.show(columns, view)
        if now is None:
            self._send_frames()
        if not self._ready:
            self.frame.rest(view)
        self.messages.dark = state.dark
        self.refresh()
        self._schedule()

    @pn.io.hold()
    def refresh(self) -> None:
        """Show what is beside the plots of the present view."""
        for service in self.services:
            service.show(self.shown)
        self.board.show_parts(self.shown)
        self.frame.show(self.shown)

    # The player.

    def _send_frames(self):
        """Send all states of the course while the player moves, else drop those of another."""
        # Numbers as one text: Bokeh would look at each.
        self.messages.frames = [*frames(self.shown, self.board.pictures())] if self._moving else []

    def move(self, message: Any) -> None:
        """Send frames when the player begins to move (None); accept the state in which it ends."""
        course = self.shown.course
        self._moving = message is None
        if self._moving and not self.messages.frames:
            self._send_frames()
        elif isinstance(message, int) and message in range(len(course)) and message != course.now:
            self.draw(self.state.replace(progress=float(course.progress[message])), message)

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
        self.frame.rest(self.shown)
        query, _ = self.query()
        # The empty address leaves the present one, of a link that was not opened.
        self.messages.address = "" if self._refused else f"?{query}"
        view = self.shown
        for each in self.services:
            each.rest(view)
        self.refresh()
