"""Actions of a page that wait for a process, and their errors."""

from collections.abc import Callable, Coroutine
from contextlib import contextmanager
from functools import partial
from typing import Any

import panel as pn
from bokeh.document import Document

from ..common.errors import Refused, text_and_remedy
from ..common.host import host_of
from ..common.process import Replaced, SynchronousWorker, Worker, queue_text

Act = Callable[..., Coroutine[Any, Any, None]]


class Actions(pn.viewable.Viewer):
    """Page with coroutines as actions. A new job ends the action that waits for the last job."""

    def __init__(self, worker: Worker | SynchronousWorker | None):
        super().__init__()
        self.document = pn.state.curdoc or Document()
        self.host = host_of(self.document)
        self.worker = Worker() if worker is None else worker
        #: Description of the running job, and the last error.
        self.busy = ""
        self.problem: Refused | None = None
        self._quiet = False

    def show(self) -> None:
        """Show the present state of the page."""

    def message(self, text: str, remedy: tuple[Any, ...] = ()) -> Refused:
        """Return an error for the user."""
        return Refused(text, remedy)

    def do(self, act: Act, *arguments: Any) -> None:
        """Start an action, and show its error."""
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
        """Return a callback for a widget: it starts an action if the user, not the page, has changed it."""
        return lambda event: None if self._quiet else self.do(act)

    @contextmanager
    def setting(self):
        """Set widgets without starting actions."""
        before, self._quiet = self._quiet, True
        try:
            with pn.io.hold():
                yield
        finally:
            self._quiet = before

    async def run(self, text: str, job: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """Run a job and return its result; the page shows `text` meanwhile."""
        # A process finds the job by its name in this package.
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
        """Stop the running job."""
        self.worker.stop()
        self.busy = ""

    def refuse(self, text: str) -> None:
        """Show the reason why the page has rejected something."""
        self.problem = Refused(text)
        self.show()
