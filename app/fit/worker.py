"""The process that reads and fits for one person, so that nobody else waits and it can be stopped.

Run as a program it answers the jobs that come on its input. What a file does to it, as a zip that needs all
of the memory, ends this process alone.
"""

import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

#: Seconds without a job after which the process ends; most of its memory (bytes); its niceness.
_REST, _MEMORY, _NICE = 300.0, 4 * 2**30, 5
_ROOT = Path(__file__).parents[2]
#: Called with the kind of an answer, "part", "done", "refused" or "ended", and the answer.
Tell = Callable[[str, Any], None]


class Worker:
    """One process, started at the first job; a job that is asked while another runs replaces that."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()
        self._job = 0
        self._busy = False
        self._tell: Tell = lambda kind, answer: None
        self._timer: threading.Timer | None = None

    def start(self) -> None:
        """Start the process, which takes half a second, before there is a job."""
        with self._lock:
            self._started()
            self._rest()

    def ask(self, name: str, *arguments: Any, tell: Tell) -> None:
        """Do a job of `measurement.JOBS`; `tell` is called in another thread, unless it is stopped."""
        with self._lock:
            if self._busy:
                self._kill()
            process = self._started()
            self._job += 1
            self._busy, self._tell = True, tell
            self._rest(None)
            with suppress(BrokenPipeError):
                pickle.dump((self._job, name, arguments), process.stdin)
                process.stdin.flush()

    def stop(self) -> None:
        """End the process and what it does."""
        with self._lock:
            self._rest(None)
            self._kill()

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()
            with suppress(OSError):
                self._process.stdin.close()
        self._process, self._busy = None, False
        # Its answers are nobody's.
        self._job += 1

    def _rest(self, seconds: float | None = _REST) -> None:
        """End the process after a rest, or not."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None
        if seconds is not None:
            self._timer = threading.Timer(seconds, self.stop)
            self._timer.daemon = True
            self._timer.start()

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None or self._process.poll() is not None:
            # One thread of the linear algebra: the other core is for those who look at the explorer.
            own = {"PYTHONPATH": os.pathsep.join([str(_ROOT), *filter(None, sys.path)])}
            own |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
            pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
            command = [sys.executable, "-m", "app.fit.worker"]
            self._process = subprocess.Popen(command, env=os.environ | own, **pipes)
            threading.Thread(target=self._listen, args=(self._process,), daemon=True).start()
        return self._process

    def _listen(self, process: subprocess.Popen[bytes]) -> None:
        """Hear the answers of a process until it ends."""
        try:
            while True:
                job, kind, answer = pickle.load(process.stdout)
                self._heard(job, kind, answer)
        except (EOFError, pickle.UnpicklingError, OSError, ValueError):
            pass
        process.wait()
        process.stdout.close()
        with suppress(OSError):
            process.stdin.close()
        with self._lock:
            alive, job = process is self._process and self._busy, self._job
        if alive:
            self._heard(job, "ended", "")

    def _heard(self, job: int, kind: str, answer: Any) -> None:
        with self._lock:
            if job != self._job:
                return
            if kind != "part":
                self._busy = False
                self._rest()
            tell = self._tell
        tell(kind, answer)


class Here:
    """Jobs done at once, without a process, as tests do them."""

    def start(self) -> None:
        """There is nothing to start."""

    def stop(self) -> None:
        """There is nothing to stop."""

    def ask(self, name: str, *arguments: Any, tell: Tell) -> None:
        """Do a job."""
        for kind, answer in answers(name, arguments):
            tell(kind, answer)


def answers(name: str, arguments: tuple[Any, ...]) -> Iterator[tuple[str, Any]]:
    """Kinds and answers of a job, one after the other."""
    from ..quantities import in_words
    from .measurement import JOBS

    try:
        found = JOBS[name](*arguments)
        if isinstance(found, Iterator):
            yield from (("part", each) for each in found)
            found = None
        yield "done", found
    except ValueError as error:
        yield "refused", in_words(error)
    except ImportError as error:
        yield "refused", str(error)
    except MemoryError:
        yield "refused", "this needs more memory than a measurement may have"


def main() -> None:
    """Answer jobs until the input ends."""
    from .measurement import quiet

    quiet()
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    with suppress(AttributeError, OSError):
        os.nice(_NICE)
    # What a package prints is no answer.
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    with suppress(EOFError):
        while True:
            job, name, arguments = pickle.load(sys.stdin.buffer)
            for kind, answer in answers(name, arguments):
                pickle.dump((job, kind, answer), output)
                output.flush()


if __name__ == "__main__":
    main()
