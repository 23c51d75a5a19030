"""One scene solved by every model that can: time and error of each, the chain with ever more elements."""

import base64
import logging
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from html import escape
from math import ceil, floor, log10
from time import perf_counter

import panel as pn

import mdr_core as mdr
from mdr_core.results import CHAIN

from .controls import WIDE, html
from .plots import PLOTS
from .presets import ASSETS
from .units import digits, written

_LOG = logging.getLogger(__name__)
_ALT = "Time against relative error of every method; lower left is better"
#: What an exact result is drawn at.
EXACT = 1e-16

#: Elements of the chains, and the time (s) after which none with more elements is begun.
ELEMENTS = tuple(2**k for k in range(5, 13))
CAP = 1.5
#: Solutions of which the shortest counts, of every model alike: the first may find caches cold.
REPEATS = 3


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
            seconds, value = _timed(lambda m=model: _value(scene.solve(m)))
            error = None if model == scene.models[0] else abs(value - exact) / scale
            yield Row(str(model), None, seconds, error)
    last = 0.0
    for n in ELEMENTS if CHAIN in scene.models else ():
        # Twice the elements take at most about twice the time.
        if stopped() or perf_counter() - begin + 2 * REPEATS * last > cap:
            return
        last, value = _timed(lambda n=n: float(_chain(scene, result, n)))
        yield Row(str(CHAIN), n, last, abs(value - exact) / scale)


def _timed(solve):
    """The shortest time (s) of some solutions, and what they give."""
    times = []
    for _ in range(REPEATS):
        begin = perf_counter()
        value = solve()
        times.append(perf_counter() - begin)
    return min(times), value


def _value(result):
    return float(result.restitution if hasattr(result, "restitution") else result.force)


def _chain(scene, result, n):
    drive = scene.drive
    if isinstance(drive, mdr.FreeImpact):
        return mdr.chain_impact(scene.profile, scene.medium, drive.mass, drive.speed, n=n).restitution
    # Wider than the contact, as a row is of which the answer is not known yet.
    half = min(1.25 * float(result.contact_radius), scene.profile.known_radius)
    row = mdr.Foundation(scene.profile, scene.medium, n, half)
    return row.advance(float(result.depth)).force


class Comparing:
    """The comparison of one session: the latest only, in a thread that all sessions share."""

    def __init__(self, document):
        self._document, self._figure, self._key = document, None, None
        self._stop, self.running, self._scene = threading.Event(), None, None
        self.words, self.table = html("", css_classes=["note"]), html("", css_classes=["table"])
        report = base64.b64encode((ASSETS / "speed_against_error.svg").read_bytes()).decode()
        image = f'<img alt="{_ALT}" src="data:image/svg+xml;base64,{report}">'
        title = "Measured on problems of all kinds, beside other programs"
        measured = f"<details><summary>{title}</summary>{image}</details>"
        self.view = pn.Column(self.words, self.table, html(measured), css_classes=["compared"], **WIDE)

    def shown_in(self, figure, key):
        """Draw in a figure with a legend; gives what stands below it."""
        self._figure, self._key = figure, key
        return self.view

    def cancel(self):
        """Begin no further solution of the comparison under way."""
        self._stop.set()
        self._scene = None

    def follow(self, scene):
        """Compare the models of a scene, unless that is under way or done; None: of no scene."""
        if scene is None or scene == self._scene:
            if scene is None:
                self.cancel()
            return
        self.cancel()
        self._stop, self._scene = threading.Event(), scene
        thread = pn.state.as_cached("comparisons", ThreadPoolExecutor, max_workers=1)
        self.running = thread.submit(self._run, scene, self._stop, _inside(pn.state.curdoc))

    def _run(self, scene, stop, inside):
        if stop.is_set():
            return
        rows, failed, result = [], False, None
        try:
            result = scene.solve()
            for row in compare(scene, result, stop.is_set):
                rows.append(row)
                inside(
                    lambda rows=tuple(rows): stop.is_set() or self.show(scene, result, rows, "measuring …")
                )
        except Exception:
            _LOG.exception("models could not be compared, scene %s", scene.to_json())
            failed = True
        largest = max((row.n for row in rows if row.n), default=0)
        end = "n elements in the chain"
        if largest < ELEMENTS[-1]:
            end = f"chains beyond n = {largest} would take more than {CAP} s in all"
        end = "the models could not be compared" if failed else end
        inside(lambda: stop.is_set() or self.show(scene, result, tuple(rows), end))

    def show(self, scene, result, rows, end):
        """Draw what is known so far."""
        if result is None or not rows:
            self.words.object = f"{end[0].upper()}{end[1:]}."
            return
        used, impact = str(result.model), isinstance(scene.drive, mdr.FreeImpact)
        what = "Error of e" if impact else "Relative error of F at the largest depth"
        text = f"Used on this page: {used}, the cheapest exact one: {result.model.reason}."
        text += f" {what} against it; {end}."
        times = f"Every time is the shortest of {REPEATS}."
        with pn.io.hold(self._document):
            self.words.object = escape(f"{text} {times}")
            self.table.object = _tabulated(rows, used)
            figure = self._figure
            _draw(figure, self._key, rows, used)
            figure.below[0].axis_label = "time to solve (s)"
            figure.left[0].axis_label = "error of e" if impact else "relative error of F"


def _tabulated(rows, used):
    def cells(head, texts):
        marks = ['<td class="used">' if row.model == used else "<td>" for row in rows]
        body = "".join(f"{mark}{text}</td>" for mark, text in zip(marks, texts, strict=True))
        return f'<tr><th scope="row">{head}</th>{body}</tr>'

    def error(value):
        return "exact" if value is None else "< 10⁻¹⁶" if value < EXACT else digits(value, 2)

    body = cells("model", [row.model for row in rows]) + cells("n", [row.n or "–" for row in rows])
    body += cells("time", [written(row.seconds, "time", 2) for row in rows])
    body += cells("error", [error(row.error) for row in rows])
    return f'<table aria-label="Time and error of each model">{body}</table>'


def points(rows, used):
    """Times and errors of the marks by their names, from left to right."""

    def place(some):
        some = sorted((row.seconds, max(row.error or EXACT, EXACT)) for row in some)
        return [x for x, _ in some], [y for _, y in some]

    marks = {
        name: place(row for row in rows if row.model == name)
        for name in ("chain", "closed form", "scalar ODE")
    }
    marks["used on this page"] = place(row for row in rows if row.model == used and row.n is None)
    return marks


def _draw(figure, key, rows, used):
    marks = points(rows, used)
    known = {row.name: row for row in PLOTS["speed"].rows}
    for renderer in figure.renderers:
        if renderer.name == "lines":
            line = {"xs": [marks["chain"][0]], "ys": [marks["chain"][1]]}
            renderer.data_source.data = dict(renderer.data_source.data) | line
        else:
            each = [
                (x, y, known[name])
                for name in known
                if name in marks
                for x, y in zip(*marks[name], strict=True)
            ]
            looks = {key: [row.look[key] for *_, row in each] for key in ("edge", "marker", "size")}
            names = {"row": [row.name for *_, row in each], "role": [row.role for *_, row in each]}
            places = {"x": [x for x, *_ in each], "y": [y for _, y, _ in each]}
            renderer.data_source.data = places | looks | names
    present = [name for name in known if marks.get(name, ([],))[0]]
    first = {name: renderer_index(present, marks, name) for name in present}
    for item in key.items:
        item.update(visible=item.name in first, index=first.get(item.name, 0))
    times = [row.seconds for row in rows]
    start, end = 10 ** floor(log10(min(times)) - 0.3), 10 ** ceil(log10(max(times)) + 0.3)
    figure.x_range.update(start=start, end=end, reset_start=start, reset_end=end)
    figure.y_range.update(start=EXACT / 30, end=1, reset_start=EXACT / 30, reset_end=1)


def renderer_index(present, marks, name):
    """Place of the first point of a name among all that are drawn."""
    return sum(len(marks[other][0]) for other in present[: present.index(name)])


def _inside(document):
    """How to call a function with the lock of a session; without a server, directly."""
    if document is None or document.session_context is None:
        return lambda act: act()
    return lambda act: document.add_next_tick_callback(act)
