"""The page of one session, a function of one state.

Four things differ from Panel's usual way:

- `Parts` draws form, header and heads of cards: 45 widgets would open the page 1.3 to 1.5 times as slowly.
- Sources get whole columns in one hold, and send none back: a drag draws 25 pictures a second.
- The browser plays all states from frames that arrive once: 38 pictures a second.
- The state is frozen, a change is a function of it: undo keeps 100 states, a failed change leaves no trace.
"""

import logging
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import panel as pn
from bokeh.document import Document
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import CustomJS
from panel.io.location import Location

from mdr_core.show.figures import Axis

from ..common.errors import error_text
from ..common.host import Host, host_of
from ..common.ui import Messages, call, landmarks, notice
from . import changes, link
from .drives import follow
from .extra import EXTRAS
from .layout import LANDMARKS, Layout, frames_in_steps
from .plot import AxisSpec, View
from .plots import NAMED, PLOTS
from .state import VIEW, State, preset_state, rounded_to_display
from .widgets import Field, Part, choice

_LOG = logging.getLogger(__name__)
Change = Callable[[State], State]
Tell = Callable[[str], None]
#: Milliseconds of rest before slow updates.
SETTLED = 300
_FAULT = "A fault of the explorer prevents this change. Nothing was changed."
_UNDO_STEPS = 100


class Address(Location):
    """Address of a page without arguments: Panel fails to read an argument of 5,000 digits, or "²"."""

    @property
    def query_params(self):
        return {}


@dataclass(frozen=True)
class History:
    """States that the user has set, the index of the present state, and the mark of the last change."""

    states: tuple[State, ...]
    at: int = 0
    mark: str = ""

    def after(self, state: State, mark: str) -> "History":
        """Return the history with a changed state; changes with the same mark are one step."""
        if state.scene_values == self.states[self.at].scene_values:
            return self
        first = not mark or mark != self.mark
        kept = self.states[: self.at + first][-_UNDO_STEPS:]
        return History((*kept, state), len(kept), mark)


class Page:
    """Page of one session; by default its document determines the host."""

    def __init__(self, query: str = "", dark: bool = False, host: Host | None = None):
        self.document = pn.state.curdoc or Document()
        self.host = host or host_of(self.document)
        self.state = preset_state(dark=dark)
        self.history = History((self.state,))
        self.view: View | None = None
        # Cancels the updates that wait until the input rests; None if no updates wait.
        self._waiting: Callable[[], None] | None = None
        # Whether the player moves; it needs the frames of each scene.
        self._moving = False
        # Unfinished frames; None if there are none.
        self._making: Iterator[list[Any]] | None = None
        # Theme of the link: dark (True) or light; None if the link sets no theme.
        self._asked_dark: bool | None = None
        # Whether the address has a link that the page could not open.
        self._refused = False
        self._fields: dict[str, Field] = {}
        self.messages = Messages(name="messages")
        self._kept = False
        self.layout = Layout(self)
        makers = dict.fromkeys(extra.service for extra in EXTRAS.values() if extra.service)
        self.services = [make(self) for make in makers]
        self.root = self.layout.view
        self._watch()
        self._open(query)
        self.history = History((self.state,))

    def __panel__(self) -> Any:
        """Return the root, so that `pn.panel(page)` and layouts accept a page."""
        return self.root

    def _open(self, query: str) -> None:
        """Show the state of a link; for an invalid link show a notice and the opening scene."""
        try:
            asked = link.read(query)
            if link.asks_for_theme(query):
                self._asked_dark = asked.dark
            else:
                asked = asked.replace(dark=self.state.dark)
            self.draw(asked)
            if names := link.unknown(query):
                self.notify(f"Unknown names in this link are ignored: {', '.join(names):.200}")
        except Exception as error:
            self.draw(preset_state(dark=self.state.dark))
            self._refused = True
            self.notify(f"The link was not opened: {self.refusal(error)}")

    def _watch(self):
        self.messages.on_change("dark", self._theme_found)
        self.document.add_root(self.messages)
        self.messages.on_change("dragged", self._released)
        self.messages.on_change("wide", lambda attr, old, new: self.refresh())
        self.document.on_event(DocumentReady, lambda event: self._input_rests())
        for name in ("start", "watch"):
            script = CustomJS(args={"messages": self.messages}, code=call(name, "messages"))
            self.document.js_on_event(DocumentReady, script)
        landmarks(self.document, LANDMARKS, "springs", "Skip to the plots")
        # The address restores the page after a lost session.
        self.document.js_on_event(ConnectionLost, CustomJS(code=call("again")))

    def _theme_found(self, attr, old, new):
        """Take the theme of the browser or the system."""
        self.apply(lambda state: state.replace(dark=new))

    def _released(self, attr, old, new):
        if not new and self._kept:
            self.draw(self.state)

    def _kept_axes(self, state: State) -> dict[AxisSpec, Axis]:
        """Return the fixed axes of the three plots during a drag, unless drive or preset changes."""
        if not self._kept or any(state[name] != self.state[name] for name in ("preset", "drive")):
            return {}
        return {along: self.view.axis(along) for name in NAMED for along in PLOTS[name].axes}

    def query(self) -> tuple[str, str]:
        """Return the page as a query, or an empty query and the reason."""
        try:
            query, dark = link.write(rounded_to_display(self.view.state)), self.view.state.dark
            theme = [f"dark={int(dark)}"] * (dark == self._asked_dark)
            return "&".join(filter(None, [query, *theme])), ""
        except ValueError as error:
            return "", f"No link: {error}."

    # Inputs of the page.

    def number(self, name: str, like: float = 0.0) -> Part:
        """Return the field of a number; zero has the unit that fits the value `like`."""
        if name not in self._fields:
            self._fields[name] = Field(name, self)
        return self._fields[name].part(self.state, like)

    def choice(self, name: str) -> Part:
        """Return the part of a choice."""
        return choice(name, self.state, partial(self.choose, name))

    def notes(self, view: View) -> list[dict[str, Any]]:
        """Return the notes of all extras, by their places."""
        return [extra.notes(view) for extra in EXTRAS.values()]

    def choose(self, name: str, option: str) -> None:
        """Change the option of a choice."""
        self.apply(lambda state: changes.choose(state, name, option))

    # Changes and their errors.

    def apply(self, change: Change, refused: Tell | None = None, mark: str = "", at: int = -1) -> None:
        """Apply a change and show it; a failed change leaves the page unchanged.

        The error is a notice, or the argument of `refused`. Changes with the same mark, for example of one
        drag, are one step of undo. `at` is the index of a state to which undo goes.
        """
        before = after = self.state
        old = self.history
        try:
            after = change(before)
            self.history = old.after(after, mark) if at < 0 else replace(old, at=at, mark="")
            if after != before or self.history is not old:
                self.draw(after)
            else:
                self.refresh()
        except Exception as error:
            message = self.refusal(error, after)
            self.history = old
            if self.state is not before:
                self.draw(before)
            (refused or self.notify)(message)
            self.refresh()
        self._refused = self._refused and self.history is old

    def undo(self) -> None:
        self._go(self.history.at - 1)

    def redo(self) -> None:
        self._go(self.history.at + 1)

    def _go(self, at: int) -> None:
        """Go to another state of the history; keep the view."""
        if 0 <= at < len(self.history.states):
            view = {name: self.state[name] for name in VIEW}
            self.apply(lambda now: self.history.states[at].replace(**view), at=at)

    def notify(self, text: str) -> None:
        """Show a notice, once the browser is ready; its text may contain user input."""
        if pn.state.notifications is not None:
            tell = partial(pn.state.notifications.error, notice(text), duration=7000)
            self.host.on_load(tell)

    def refusal(self, error: Exception, state: State | None = None) -> str:
        """Return the message for an error; log an internal error with its state."""
        if isinstance(error, ValueError):
            return error_text(error)
        _LOG.error("a change could not be shown, %s", state or self.state, exc_info=error)
        return _FAULT

    # Drawing.

    @pn.io.hold()
    def draw(self, state: State, now: int | None = None) -> None:
        """Show a state; compute everything before anything changes.

        With `now`, the course stays, and `now` is the index of its present state.
        """
        course = follow(state) if now is None else replace(self.view.course, now=now)
        computed: dict[Any, Any] = {}
        for service in self.services:
            computed |= service.compute(state, course)
        self._kept = self.view is not None and self.messages.dragged
        view = View(state, course, computed, self._kept_axes(state))
        columns = self.layout.columns(view)
        self.state, self.view = state, view
        if now is None:
            # Remove the frames of the last course before drawing. New frames wait until the input rests:
            # they are megabytes, and cost the process of all sessions half a second.
            self.messages.frames = []
            self._making = None
        self.layout.draw(columns, view)
        self.messages.dark = state.dark
        self._schedule()
        self.refresh()

    @pn.io.hold()
    def refresh(self) -> None:
        """Show the parts around the plots of the present view."""
        for service in self.services:
            service.show(self.view)
        self.layout.show(self.view)

    # The player.

    def _send_frames(self):
        """Send all states of the course if the player moves without frames."""
        if self._moving and not self.messages.frames and not self._making:
            pictures = [card.picture for card in self.layout.seen()]
            making = self._making = frames_in_steps(self.view, pictures)
            # Other sessions are served meanwhile; another scene needs other frames.
            self.host.make(making, lambda: making is self._making, self._have_frames)

    def _have_frames(self, frames: list[Any]) -> None:
        self.messages.frames = frames
        self._making = None

    def move(self, message: int | None) -> None:
        """Send frames when the player begins to move (None); accept the state in which it ends.

        While other input arrives, the frames wait until it rests.
        """
        course = self.view.course
        self._moving = message is None
        if self._moving and self._waiting is None:
            self._send_frames()
        elif isinstance(message, int) and message in range(len(course)) and message != course.now:
            self.draw(self.state.replace(at=float(course.progress[message])), message)

    # Updates when the input rests.

    def _schedule(self):
        """Schedule the slow updates; notes need not wait before a browser shows the page."""
        if not self.host.shows():
            self.layout.rest(self.view)
            return
        if self._waiting is not None:
            self._waiting()
        self._waiting = self.host.call_later(self._input_rests, SETTLED)

    def _input_rests(self):
        self._waiting = None
        self.layout.rest(self.view)
        query, why = self.query()
        # An empty address keeps the present address: a link was not opened, or the page has no link.
        self.messages.address = "" if self._refused or why else f"?{query}"
        view = self.view
        for each in self.services:
            each.rest(view)
        self.refresh()
        self._send_frames()
