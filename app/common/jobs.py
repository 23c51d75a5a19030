"""Program of a worker process, which answers the jobs on its input.

A job is the name of a function in this package, such as "measurement.analysis.read". Its first call loads
it. The program loads nothing of the page, and no asyncio, which takes 0.1 s.
"""

import os
import pickle
import sys
from collections.abc import Iterator
from contextlib import suppress
from importlib import import_module
from math import ceil
from typing import Any

from .errors import text_and_remedy


def setting(name: str, default: int) -> int:
    """Return a bound from an environment variable."""
    text = os.environ.get(name, str(default))
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ValueError(f"{name}={text} must be a whole number of at least 1")
    return int(text)


#: Largest memory of a process (bytes), and longest computing time (s) of a job, or of each of many curves.
_MEMORY = setting("MDR_EXPLORER_GIGABYTES", 4) * 10**9
SECONDS = setting("MDR_EXPLORER_SECONDS", 120)
#: Niceness of a process.
_NICE = 5


def packed(message: Any) -> bytes:
    """Pack a message into bytes, with its length first."""
    data = pickle.dumps(message)
    return len(data).to_bytes(8, "big") + data


def answers(job: str, arguments: tuple[Any, ...]) -> Iterator[tuple[str, Any]]:
    """Yield the answers of a job with their kinds: "part", and at the end "done" or "refused"."""
    module, _, name = job.rpartition(".")
    try:
        found = getattr(import_module(f"..{module}", __package__), name)(*arguments)
        if isinstance(found, Iterator):
            yield from (("part", each) for each in found)
            found = None
        yield "done", found
    except (ValueError, ImportError) as error:
        yield "refused", text_and_remedy(error)
    except MemoryError:
        yield "refused", ("this needs more memory than a measurement may use: try a smaller file",)


def main() -> None:
    """Answer jobs until the input ends, within bounds of memory and time if the system supports them."""
    import logging
    import warnings

    # No user would see the warnings of readers.
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore")
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
        # No core dump, which would contain the user's file.
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with suppress(AttributeError, OSError):
        os.nice(_NICE)
    # Text that a package prints must not mix with the answers.
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    while head := sys.stdin.buffer.read(8):
        job, arguments = pickle.loads(sys.stdin.buffer.read(int.from_bytes(head, "big")))
        _limit_time()
        for answer in answers(job, arguments):
            output.write(packed(answer))
            output.flush()
            _limit_time()


def _limit_time() -> None:
    """Limit the processor time from now; beyond the limit the system ends the process."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        used = resource.getrusage(resource.RUSAGE_SELF)
        _, most = resource.getrlimit(resource.RLIMIT_CPU)
        resource.setrlimit(resource.RLIMIT_CPU, (ceil(used.ru_utime + used.ru_stime) + SECONDS, most))
