"""One scene solved by every model that can: time and error of each, the chain with ever more elements."""

import logging
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import perf_counter

import panel as pn

import mdr_core as mdr
from mdr_core.results import CHAIN

_LOG = logging.getLogger(__name__)

#: Elements of the chains, and the time (s) after which none with more elements is begun.
ELEMENTS = tuple(2**k for k in range(5, 13))
CAP = 1.5


@dataclass(frozen=True)
class Row:
    """One solution: its model, its elements if they are a fixed number, its time (s) and its error.

    The error is that of the force relative to the force at the largest depth, or that of the restitution
    coefficient; None for the model that the others are measured against.
    """

    model: str
    n: int | None
    seconds: float
    error: float | None


def compare(scene, result, stopped=lambda: False, cap=CAP):
    """Yield a `Row` for each model of a scene, the cheapest exact one first, then chains of growing n.

    Parameters
    ----------
    scene : mdr.Scene
        Pressed once, or hit once.
    result : mdr.Indentation or mdr.Impact
        What `scene.solve()` gives.
    stopped : callable
        Asked before every solution; none is begun once it is true.
    cap : float
        Time (s) in all beyond which none is expected to end.
    """
    begin, exact = perf_counter(), _value(result)
    scale = 1.0 if isinstance(scene.drive, mdr.FreeImpact) else abs(exact) or 1.0
    for model in scene.models:
        if model != CHAIN and not stopped():
            # The shortest of three: the first one may find caches cold.
            times, value = zip(*(_timed(lambda m=model: scene.solve(m)) for _ in range(3)), strict=True)
            error = None if model == scene.models[0] else abs(value[0] - exact) / scale
            yield Row(str(model), None, min(times), error)
    last = 0.0
    for n in ELEMENTS if CHAIN in scene.models else ():
        # Twice the elements take at most about twice the time.
        if stopped() or perf_counter() - begin + 2 * last > cap:
            return
        last, value = _timed(lambda n=n: _chain(scene, result, n))
        yield Row(str(CHAIN), n, last, abs(value - exact) / scale)


def _timed(solve):
    begin = perf_counter()
    value = _value(solve())
    return perf_counter() - begin, value


def _value(result):
    return float(result.restitution if hasattr(result, "restitution") else result.force)


def _chain(scene, result, n):
    drive = scene.drive
    if isinstance(drive, mdr.FreeImpact):
        return mdr.chain_impact(scene.profile, scene.medium, drive.mass, drive.speed, n=n)
    # Wider than the contact, as a row is of which the answer is not known yet.
    half = min(1.25 * float(result.contact_radius), scene.profile.known_radius)
    row = mdr.Foundation(scene.profile, scene.medium, n, half)
    return row.advance(float(result.depth))


class Comparing:
    """Comparisons of one session: the latest only, in the one thread that all sessions share for them.

    Parameters
    ----------
    send : callable
        Takes every message, in the session's own thread.
    """

    def __init__(self, send: Callable[[dict], None]):
        self._send, self._stop, self.running = send, threading.Event(), None

    def cancel(self):
        """Begin no further solution of the comparison under way."""
        self._stop.set()

    def start(self, scene, sequence):
        """Compare the models of a scene, and send what is known after each."""
        self.cancel()
        self._stop = stop = threading.Event()
        thread = pn.state.as_cached("comparisons", ThreadPoolExecutor, max_workers=1)
        self.running = thread.submit(self._run, scene, sequence, stop, _inside(pn.state.curdoc))

    def _run(self, scene, sequence, stop, inside):
        if stop.is_set():
            return
        rows, impact = [], isinstance(scene.drive, mdr.FreeImpact)
        message = {"compared": sequence, "impact": impact, "cap": CAP, "failed": False, "done": False}
        try:
            result = scene.solve()
            message |= {"used": str(result.model), "reason": result.model.reason}
            for row in compare(scene, result, stop.is_set):
                rows.append([row.model, row.n, row.seconds, row.error])
                inside(self._send, message | {"rows": list(rows)})
        except Exception:
            _LOG.exception("models could not be compared, scene %s", scene.to_json())
            message["failed"] = True
        if not stop.is_set():
            inside(self._send, message | {"rows": rows, "done": True})


def _inside(document):
    """How to call a function with the lock of a session; without a server, directly."""
    if document is None or document.session_context is None:
        return lambda act, message: act(message)
    return lambda act, message: document.add_next_tick_callback(lambda: act(message))
