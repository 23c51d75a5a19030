"""Processes that read and fit, so that nobody else waits and each can be stopped.

Run as a program this answers the jobs that come on its input. What a file does to it, as a zip that needs
all of the memory, ends this process alone.
"""

import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any

from . import folders
from .refusals import Message, refusal


def _given(name: str, default: int) -> int:
    """A bound as it is given in the environment."""
    text = os.environ.get(name, str(default))
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ValueError(f"{name}={text} must be a whole number of 1 or more")
    return int(text)


#: Most processes of a server, most memory of each (bytes), most seconds of processor time of a job, or of
#: one curve of a job with many.
PROCESSES = _given("MDR_EXPLORER_PROCESSES", 4)
_MEMORY = _given("MDR_EXPLORER_GIGABYTES", 4) * 10**9
_SECONDS = _given("MDR_EXPLORER_SECONDS", 120)
#: Seconds without a job after which a process ends; its niceness.
_REST, _NICE = 300.0, 5
_APP = Path(__file__).parents[1]
#: The program of a process. The package is made bare, of this folder: its own file loads the explorer, with
#: which a start takes 2.5 s of computing and 125 MB instead of 1.1 s and 83 MB.
_PROGRAM = """import sys, types
app = sys.modules["app"] = types.ModuleType("app")
app.__path__ = [sys.argv[1]]
from app.fit.worker import main
main()
"""
#: What is said when a process has gone.
ENDED = Message(
    "The process that reads and fits has ended, because of a damaged file or too little memory; "
    "nothing else is lost. Try another file, or fewer samples"
)
LATE = Message(
    f"This takes more than {_SECONDS} s of computing, and was stopped; nothing else is lost. "
    "Try fewer samples, or hold more parameters"
)
NONE = Message("The server has no room for a process that reads and fits. Try again later")
#: Called with the kind of an answer, "waiting", "part", "done", "refused" or "ended", and the answer.
Tell = Callable[[str, Any], None]


class Turns:
    """The bound of all sessions of a server: who has a process, and who waits for one.

    A process at rest gives way before anybody waits.
    """

    def __init__(self, most: int):
        self.most = most
        self.lock = threading.RLock()
        self.having: list[Worker] = []
        self.waiting: list[Worker] = []

    def next(self) -> list[Callable[[], None]]:
        """Let those begin who can, and return what tells those who wait how many are before."""
        told = []
        while self.waiting and self._room():
            first = self.waiting.pop(0)
            told += first.waits(None) + first.begin()
        for before, each in enumerate(self.waiting):
            told += each.waits(before)
        return told

    def _room(self) -> bool:
        if len(self.having) < self.most:
            return True
        resting = next((each for each in self.having if not each.busy), None)
        if resting is not None:
            resting.give_way()
        return resting is not None


TURNS = Turns(PROCESSES)


class Worker:
    """One process at a time, started at a job; a job that is asked while another runs replaces that."""

    def __init__(self, turns: Turns = TURNS) -> None:
        self._turns, self._lock = turns, turns.lock
        self._process: subprocess.Popen[bytes] | None = None
        self._job = 0
        self._asked: tuple[Any, ...] = ()
        self.busy = False
        # How many were before when it was last told, None if it does not wait.
        self._before: int | None = None
        self._tell: Tell = lambda kind, answer: None
        self._timer: threading.Timer | None = None

    def start(self) -> None:
        """Start the process, which takes a second, before there is a job, if there is room for it."""
        turns = self._turns
        with self._lock, suppress(OSError):
            if self._process is None and not turns.waiting and len(turns.having) < turns.most:
                self._start()
                self._rest()

    def ask(self, name: str, *arguments: Any, tell: Tell) -> None:
        """Do a job of `measurement.JOBS`; `tell` is called in another thread, unless it is stopped."""
        turns, told = self._turns, []
        with self._lock:
            had, waits = self._process is not None, self in turns.waiting
            if had and (self.busy or self._process.poll() is not None):
                self.give_way()
            self._job += 1
            self._asked = name, arguments
            self.busy, self._tell = True, tell
            self._before = None
            self._rest(None)
            if self._process is not None:
                told += self.begin()
            elif not waits:
                # Who replaces a job keeps the turn.
                turns.waiting.insert(0 if had else len(turns.waiting), self)
            told += turns.next()
        _call(told)

    def stop(self) -> None:
        """End the process and what it does."""
        with self._lock:
            self.busy = False
            if self in self._turns.waiting:
                self._turns.waiting.remove(self)
            self.give_way()
            told = self._turns.next()
        _call(told)

    # Called where the turns are locked.

    def begin(self) -> list[Callable[[], None]]:
        """Do what was asked, or return what tells that there is no process for it."""
        try:
            if self._process is None:
                self._start()
        except OSError:
            self.busy = False
            return [partial(self._tell, "ended", NONE)]
        # In a thread: a pipe takes 64 kB before the process reads, and it may take a second to start.
        sent = self._process, pickle.dumps((self._job, *self._asked))
        threading.Thread(target=_send, args=sent, daemon=True).start()
        return []

    def waits(self, before: int | None) -> list[Callable[[], None]]:
        """What tells how many wait before this one, None once it is its turn, if it is not known yet."""
        tell, known = self._tell, self._before
        self._before = before
        return [] if before == known else [partial(tell, "waiting", before)]

    def give_way(self) -> None:
        """End the process."""
        self._rest(None)
        if self._process is not None:
            self._process.kill()
            with suppress(OSError):
                self._process.stdin.close()
            self._turns.having.remove(self)
        self._process = None
        # Its answers are nobody's.
        self._job += 1

    def _start(self) -> None:
        # One thread of the linear algebra: the other core is for those who look at the explorer. `-P`: no
        # modules of the folder in which the server was started.
        own = {"PYTHONPATH": os.pathsep.join([str(_APP.parent), *filter(None, sys.path)])}
        own |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "TMPDIR": str(folders.own())}
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        command = [sys.executable, "-P", "-c", _PROGRAM, str(_APP)]
        self._process = subprocess.Popen(command, env=os.environ | own, **pipes)
        self._turns.having.append(self)
        threading.Thread(target=self._listen, args=(self._process,), daemon=True).start()

    def _rest(self, seconds: float | None = _REST) -> None:
        """End the process after a rest, or not."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None
        if seconds is not None:
            self._timer = threading.Timer(seconds, self._end_rest)
            self._timer.daemon = True
            self._timer.start()

    def _end_rest(self) -> None:
        with self._lock:
            if not self.busy:
                self.give_way()

    def _listen(self, process: subprocess.Popen[bytes]) -> None:
        """Hear the answers of a process until it ends."""
        try:
            while True:
                job, kind, answer = pickle.load(process.stdout)
                self._heard(job, kind, received(kind, answer))
        except (EOFError, pickle.UnpicklingError, OSError, ValueError):
            pass
        code = process.wait()
        process.stdout.close()
        with suppress(OSError):
            process.stdin.close()
        with self._lock:
            if process is not self._process:
                return
            self._turns.having.remove(self)
            self._process = None
            alive, job = self.busy, self._job
            told = self._turns.next()
        _call(told)
        if alive:
            late = code == -getattr(signal, "SIGXCPU", 0)
            self._heard(job, "ended", LATE if late else ENDED)

    def _heard(self, job: int, kind: str, answer: Any) -> None:
        with self._lock:
            if job != self._job:
                return
            told = []
            if kind != "part":
                self.busy = False
                self._rest()
                told = self._turns.next()
            tell = self._tell
        tell(kind, answer)
        _call(told)


def _send(process: subprocess.Popen[bytes], data: bytes) -> None:
    # A process that has ended reads nothing.
    with suppress(OSError, ValueError):
        process.stdin.write(data)
        process.stdin.flush()


def received(kind: str, answer: Any) -> Any:
    """An answer of the process, which has no class of the page: it has another name there."""
    return Message(*answer) if kind == "refused" else answer


def _call(told: list[Callable[[], None]]) -> None:
    for each in told:
        each()


def waiting(before: int) -> str:
    """How many people wait for a process before this one."""
    who = {0: "nobody is", 1: "one person is"}.get(before, f"{before} people are")
    return f"Waiting for a free process, {who} before you"


class Here:
    """Jobs done at once, without a process, as tests do them."""

    def start(self) -> None:
        """There is nothing to start."""

    def stop(self) -> None:
        """There is nothing to stop."""

    def ask(self, name: str, *arguments: Any, tell: Tell) -> None:
        """Do a job."""
        for kind, answer in answers(name, arguments):
            tell(kind, received(kind, answer))


def answers(name: str, arguments: tuple[Any, ...]) -> Iterator[tuple[str, Any]]:
    """Kinds and answers of a job, one after the other."""
    from .measurement import JOBS

    try:
        found = JOBS[name](*arguments)
        if isinstance(found, Iterator):
            yield from (("part", each) for each in found)
            found = None
        yield "done", found
    except (ValueError, ImportError) as error:
        yield "refused", refusal(error)
    except MemoryError:
        yield "refused", ("this needs more memory than a measurement may have",)


def _limit_time() -> None:
    """Bound the processor time from now on; beyond it the system ends the process."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        used = resource.getrusage(resource.RUSAGE_SELF)
        _, most = resource.getrlimit(resource.RLIMIT_CPU)
        resource.setrlimit(resource.RLIMIT_CPU, (ceil(used.ru_utime + used.ru_stime) + _SECONDS, most))


def main() -> None:
    """Answer jobs until the input ends."""
    from .measurement import quiet

    quiet()
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
        # A process that is ended leaves no image of its memory, in which the file would be.
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with suppress(AttributeError, OSError):
        os.nice(_NICE)
    # What a package prints is no answer.
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    with suppress(EOFError):
        while True:
            job, name, arguments = pickle.load(sys.stdin.buffer)
            _limit_time()
            for kind, answer in answers(name, arguments):
                pickle.dump((job, kind, answer), output)
                output.flush()
                _limit_time()
