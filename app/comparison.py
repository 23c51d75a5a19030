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
from .quantities import ASSETS
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

    The error is that of the restitution, or of the largest force relative to it; None of the first model.
    """

    model: str
    n: int | None
    seconds: float
    error: float | None


def compare(scene, result, stopped=lambda: False, cap=CAP):
    """Yield a `Row` for each model of a scene, the cheapest exact one first, then chains of growing n.

    `result` is what `scene.solve()` gives. No solution is begun once `stopped` gives true, nor one that is
    expected to end more than `cap` seconds after the first was begun.
    """
    begin, exact, models = perf_counter(), _value(result), scene.models
    scale = 1.0 if isinstance(scene.drive, mdr.FreeImpact) else abs(exact) or 1.0
    for model in models:
        if model != CHAIN and not stopped():
            seconds, value = _timed(lambda m=model: _value(scene.solve(m)))
            yield Row(str(model), None, seconds, abs(value - exact) / scale if model != models[0] else None)
    last = 0.0
    for n in ELEMENTS if CHAIN in models else ():
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
        self._stop, self._scene = threading.Event(), None
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

    def follow(self, scene):
        """Compare the models of a scene, unless that is under way or done; None: of no scene."""
        if scene == self._scene:
            return
        self._stop.set()
        self._stop, self._scene = threading.Event(), scene
        if scene is not None:
            thread = pn.state.as_cached("comparisons", ThreadPoolExecutor, max_workers=1)
            thread.submit(self._run, scene, self._stop, _inside(pn.state.curdoc))

    def _run(self, scene, stop, inside):
        rows, result = [], None

        def show(end):
            known = tuple(rows)
            inside(lambda: stop.is_set() or self.show(scene, result, known, end))

        if stop.is_set():
            return
        try:
            result = scene.solve()
            for row in compare(scene, result, stop.is_set):
                rows.append(row)
                show("measuring …")
        except Exception:
            _LOG.exception("models could not be compared, scene %s", scene.to_json())
            show("the models could not be compared")
            return
        largest = max((row.n for row in rows if row.n), default=0)
        beyond = f"chains beyond n = {largest} would take more than {CAP} s in all"
        show(beyond if largest < ELEMENTS[-1] else "n elements in the chain")

    def show(self, scene, result, rows, end):
        """Draw what is known so far."""
        if not rows:
            self.words.object = f"{end[0].upper()}{end[1:]}."
            return
        used, impact = str(result.model), isinstance(scene.drive, mdr.FreeImpact)
        what = "Error of e" if impact else "Relative error of F at the largest depth"
        text = f"Used on this page: {used}, the cheapest exact one: {result.model.reason}."
        text += f" {what} against it; {end}. Every time is the shortest of {REPEATS}."
        with pn.io.hold(self._document):
            self.words.object, self.table.object = escape(text), _tabulated(rows, used)
            _draw(self._figure, self._key, rows, used)
            self._figure.below[0].axis_label = "time to solve (s)"
            self._figure.left[0].axis_label = "error of e" if impact else "relative error of F"


def _tabulated(rows, used):
    def error(value):
        return "exact" if value is None else "< 10⁻¹⁶" if value < EXACT else digits(value, 2)

    marks = ['<td class="used">' if row.model == used else "<td>" for row in rows]
    lines = {
        "model": [row.model for row in rows],
        "n": [row.n or "–" for row in rows],
        "time": [written(row.seconds, "time", 2) for row in rows],
        "error": [error(row.error) for row in rows],
    }
    body = ""
    for head, texts in lines.items():
        cells = (f"{mark}{text}</td>" for mark, text in zip(marks, texts, strict=True))
        body += f'<tr><th scope="row">{head}</th>{"".join(cells)}</tr>'
    return f'<table aria-label="Time and error of each model">{body}</table>'


def points(rows, used):
    """Times and errors of the marks by their names, from left to right."""

    def place(some):
        some = sorted((row.seconds, max(row.error or EXACT, EXACT)) for row in some)
        return [x for x, _ in some], [y for _, y in some]

    models = ("chain", "closed form", "scalar ODE")
    marks = {name: place(row for row in rows if row.model == name) for name in models}
    return marks | {"used on this page": place(row for row in rows if row.model == used and row.n is None)}


def _draw(figure, key, rows, used):
    marks = points(rows, used)
    known = [row for row in PLOTS["speed"].rows if row.name in marks]
    drawn = [(x, y, row) for row in known for x, y in zip(*marks[row.name], strict=True)]
    names = [row.name for *_, row in drawn]
    columns = {"x": [x for x, *_ in drawn], "y": [y for _, y, _ in drawn], "row": names}
    columns |= {"role": [row.role for *_, row in drawn]}
    columns |= {each: [row.look[each] for *_, row in drawn] for each in ("edge", "marker", "size")}
    chain = {"xs": [marks["chain"][0]], "ys": [marks["chain"][1]]}
    for renderer in figure.renderers:
        source = renderer.data_source
        source.data = dict(source.data) | chain if renderer.name == "lines" else columns
    for item in key.items:
        shown = item.name in names
        item.update(visible=shown, index=names.index(item.name) if shown else 0)
    times = [row.seconds for row in rows]
    start, end = 10 ** floor(log10(min(times)) - 0.3), 10 ** ceil(log10(max(times)) + 0.3)
    figure.x_range.update(start=start, end=end, reset_start=start, reset_end=end)
    figure.y_range.update(start=EXACT / 30, end=1, reset_start=EXACT / 30, reset_end=1)


def _inside(document):
    """How to call a function with the lock of a session; without a server, directly."""
    if document is None or document.session_context is None:
        return lambda act: act()
    return document.add_next_tick_callback
