"""Actions of a page that wait for a process, and what they refuse."""

from collections.abc import Callable, Coroutine
from contextlib import contextmanager
from functools import partial
from typing import Any

import panel as pn
from bokeh.document import Document

from ..common.errors import Refused, text_and_remedy
from ..common.host import host_of
from ..common.process import Here, Replaced, Worker, queue_text

Act = Callable[..., Coroutine[Any, Any, None]]


class Actions(pn.viewable.Viewer):
    """A page whose actions are coroutines. A new job ends the action that waits for the last one."""

    def __init__(self, worker: Worker | Here | None):
        super().__init__()
        self.document = pn.state.curdoc or Document()
        self.host = host_of(self.document)
        self.worker = Worker() if worker is None else worker
        #: What runs, and why something could not be done.
        self.busy = ""
        self.problem: Refused | None = None
        self._quiet = False

    def show(self) -> None:
        """Show everything as it is."""

    def message(self, text: str, remedy: tuple[Any, ...] = ()) -> Refused:
        """Return a text to be shown."""
        return Refused(text, remedy)

    def do(self, act: Act, *arguments: Any) -> None:
        """Begin an action; what it refuses is shown."""
        self.host.run(partial(self._act, act, *arguments))

    async def _act(self, act: Act, *arguments: Any) -> None:
        try:
            await act(*arguments)
        except Replaced:
            pass
        except (Refused, ValueError) as error:
            self.problem = self.message(*text_and_remedy(error))
            self.show()

    def when_changed(self, act: Act) -> Callable[[Any], None]:
        """Return what a widget calls: an action if the user has changed the widget, not the page."""
        return lambda event: None if self._quiet else self.do(act)

    @contextmanager
    def setting(self):
        """Set widgets without beginning actions."""
        before, self._quiet = self._quiet, True
        try:
            with pn.io.hold():
                yield
        finally:
            self._quiet = before

    async def run(self, text: str, job: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """Return what a job returns; `text` says what runs, and is shown with what is known by then."""
        # By its name in this package, as a process knows it.
        name = f"{job.__module__.partition('.')[2]}.{job.__name__}"

        def waits(before: int) -> None:
            self.busy = queue_text(before)
            self.show()

        self.problem, self.busy = None, text
        self.show()
        try:
            answer = await self.worker.run(name, *arguments, waits=waits, **options)
        except Refused:
            self.busy = ""
            raise
        self.busy = ""
        return answer

    def stop(self) -> None:
        """Stop what runs."""
        self.worker.stop()
        self.busy = ""

    def refuse(self, text: str) -> None:
        """Show why something was not taken."""
        self.problem = Refused(text)
        self.show()
