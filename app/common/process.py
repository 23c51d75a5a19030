"""Jobs in a process of each session: a job can be stopped, and a damaged file ends only this process."""

import asyncio
import os
import pickle
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from . import folders
from .errors import Refused
from .jobs import SECONDS, answers, packed, setting

_APP = Path(__file__).parents[1]


#: Largest number of processes of a server, and seconds without a job after which a process ends.
PROCESSES, _REST = setting("MDR_EXPLORER_PROCESSES", 4), 300.0
#: Program of a process. It makes the package from this folder, whatever the path contains.
_PROGRAM = """import sys, types
app = sys.modules["app"] = types.ModuleType("app")
app.__path__ = [sys.argv[1]]
from app.common.jobs import main
main()
"""
ENDED = (
    "The process that reads and fits has ended because of a damaged file or too little memory; "
    "nothing else is lost. Try another file or fewer samples"
)
LATE = (
    f"The server stopped this job after {SECONDS} s of computing; nothing else is lost. "
    "Try fewer samples, or hold more parameters"
)
NO_ROOM = "The server has no room for a process that reads and fits. Try again later"
NO_PROCESSES = "This server cannot start the process that reads files: use `panel serve app`"


def _ignore(message: Any) -> None:
    """Ignore a message."""


def queue_text(before: int) -> str:
    """Return the number of users who wait for a process before this user, as text."""
    who = {0: "nobody is", 1: "one person is"}.get(before, f"{before} people are")
    return f"Waiting for a free process, {who} before you"


class Replaced(Exception):
    """Error of a cancelled job, or of a job that another job has replaced."""


class Places:
    """Places for the processes of all sessions of a server: workers with a place, and waiting workers.

    An idle process loses its place if a session waits.
    """

    def __init__(self, most: int):
        self._most = most
        self.taken: list[Worker] = []
        self.waiting: list[Worker] = []
        self._changes: list[asyncio.Future[None]] = []

    def admit(self) -> None:
        """Give free places to waiting workers."""
        while self.waiting:
            if len(self.taken) >= self._most:
                resting = next((each for each in self.taken if not each.busy), None)
                if resting is None:
                    break
                resting.end()
                self.taken.remove(resting)
            self.taken.append(self.waiting.pop(0))
        changes, self._changes = self._changes, []
        for change in changes:
            if not change.done():
                change.set_result(None)

    def leave(self, worker: "Worker") -> None:
        """Give up a place, or the place in the queue."""
        for each in (self.taken, self.waiting):
            if worker in each:
                each.remove(worker)
        self.admit()

    async def change(self) -> None:
        """Wait until the queue or the places change."""
        change = asyncio.get_running_loop().create_future()
        self._changes.append(change)
        await change


PLACES = Places(PROCESSES)


class Worker:
    """Process of a session, which stays for the next job unless another session waits."""

    def __init__(self, places: Places = PLACES):
        self._places = places
        self._process: asyncio.subprocess.Process | None = None
        self._job: object | None = None
        self._rest: asyncio.TimerHandle | None = None

    @property
    def busy(self) -> bool:
        """Whether a job runs, or waits for its place."""
        return self._job is not None

    async def run(
        self,
        job: str,
        *arguments: Any,
        part: Callable[[Any], None] = _ignore,
        waits: Callable[[int], None] = _ignore,
    ) -> Any:
        """Run a job, a function by its name in this package, and return its result.

        `part` gets each part that the job yields, `waits` the number of sessions before this one. A new job
        replaces a running job. Raises `Refused` or `Replaced`.
        """
        if self.busy:
            self.end()
        mine = self._job = object()
        if self._rest is not None:
            self._rest.cancel()
        kind, answer = "part", None
        try:
            await self._enter(mine, waits)
            process = await self._started(mine)
            process.stdin.write(packed((job, arguments)))
            while kind == "part":
                size = int.from_bytes(await process.stdout.readexactly(8), "big")
                kind, answer = pickle.loads(await process.stdout.readexactly(size))
                self._check(mine)
                if kind == "part":
                    part(answer)
        except asyncio.IncompleteReadError:
            code = await process.wait()
            self._check(mine)
            raise Refused(LATE if code == -getattr(signal, "SIGXCPU", 0) else ENDED) from None
        finally:
            if self._job is mine:
                if kind == "part":
                    # Otherwise its late answers would be read as answers to the next job.
                    self.end()
                self._job = None
                self._rest = asyncio.get_running_loop().call_later(_REST, self.stop)
                self._places.admit()
        if kind == "refused":
            raise Refused(*answer)
        return answer

    def stop(self) -> None:
        """End the process and its job, and give up the place."""
        self.end()
        self._job = None
        self._places.leave(self)

    def end(self) -> None:
        """End the process; keep the place."""
        if self._rest is not None:
            self._rest.cancel()
        if self._process is not None:
            with suppress(ProcessLookupError):
                self._process.kill()
        self._process = None

    def _check(self, mine: object) -> None:
        if self._job is not mine:
            raise Replaced

    async def _enter(self, mine: object, waits: Callable[[int], None]) -> None:
        """Wait for a place."""
        places = self._places
        if self not in (*places.taken, *places.waiting):
            places.waiting.append(self)
        places.admit()
        while self in places.waiting:
            waits(places.waiting.index(self))
            await places.change()
            self._check(mine)

    async def _started(self, mine: object) -> asyncio.subprocess.Process:
        if self._process is not None and self._process.returncode is None:
            return self._process
        # One thread of linear algebra. `-P`: import no modules from the working folder of the server.
        own = {"PYTHONPATH": os.pathsep.join([str(_APP.parent), *filter(None, sys.path)])}
        own |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "TMPDIR": str(folders.own())}
        command = sys.executable, "-P", "-c", _PROGRAM, str(_APP)
        pipes = {"stdin": asyncio.subprocess.PIPE, "stdout": asyncio.subprocess.PIPE}
        try:
            process = await asyncio.create_subprocess_exec(*command, env=os.environ | own, **pipes)
        except NotImplementedError:
            # The event loop of a notebook on Windows.
            raise Refused(NO_PROCESSES) from None
        except OSError:
            raise Refused(NO_ROOM) from None
        if self._job is not mine:
            process.kill()
            raise Replaced
        self._process = process
        return process


class SynchronousWorker:
    """Worker without a process, which runs each job at once: in a browser, and in tests."""

    async def run(
        self, job: str, *arguments: Any, part: Callable[[Any], None] = _ignore, **others: Any
    ) -> Any:
        """Run a job and return its result, after its parts, without a queue. Raises `Refused`."""
        for kind, answer in answers(job, arguments):
            if kind == "refused":
                raise Refused(*answer)
            if kind == "done":
                return answer
            part(answer)
        raise AssertionError("a job must end with an answer")

    def stop(self) -> None:
        """Do nothing: a job is done at once."""
