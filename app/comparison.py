"""One scene solved by every model that can: time and error of each, the chain with ever more elements."""

import base64
from dataclasses import dataclass, replace
from html import escape
from math import ceil, floor, log10
from time import perf_counter

import numpy as np

import mdr_core as mdr
from mdr_core.results.base import CHAIN
from mdr_core.results.figures import Axis

from .quantities import ASSETS
from .resting import Found
from .units import digits, written

_ALT = "Time against relative error of every method; lower left is better"
_TITLE = "Measured on problems of all kinds, beside other programs"
_REPORT = base64.b64encode((ASSETS / "speed_against_error.svg").read_bytes()).decode()
_IMAGE = f'<img alt="{_ALT}" src="data:image/svg+xml;base64,{_REPORT}">'
MEASURED = f"<details><summary>{_TITLE}</summary>{_IMAGE}</details>"
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


def compare(scene, result, cap=CAP):
    """Yield a `Row` for each model of a scene, the cheapest exact one first, then chains of growing n.

    `result` is what `scene.solve()` gives. No solution is begun that is expected to end more than `cap`
    seconds after the first was begun.
    """
    begin, exact, models = perf_counter(), _value(result), scene.models
    scale = 1.0 if isinstance(scene.drive, mdr.FreeImpact) else abs(exact) or 1.0
    for model in models:
        if model != CHAIN:
            seconds, value = _timed(lambda m=model: _value(scene.solve(m)))
            yield Row(str(model), None, seconds, abs(value - exact) / scale if model != models[0] else None)
    last = 0.0
    for n in ELEMENTS if CHAIN in models else ():
        # Twice the elements take at most about twice the time.
        if perf_counter() - begin + 2 * REPEATS * last > cap:
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


def found(way):
    """What is found of the models of a scene, while they are timed."""
    scene, rows = way.scene, []
    if way.turns:
        # Its deepest state, infinitely slowly.
        scene = replace(scene, drive=mdr.DepthPath(float(way.deepest.depth)))
    if way.oblique is not None:
        # Friction has one model only: its normal motion.
        scene = replace(scene, drive=mdr.FreeImpact(scene.drive.mass, scene.drive.speed))
    result = scene.solve()
    for row in compare(scene, result):
        rows.append(row)
        if row.n is None:
            yield _found(scene, result, rows, "measuring …")
    largest = rows[-1].n or 0
    beyond = f"chains beyond n = {largest} would take more than {CAP} s in all"
    yield _found(scene, result, rows, beyond if largest < ELEMENTS[-1] else "n elements in the chain")


def _found(scene, result, rows, end):
    used, impact = str(result.model), isinstance(scene.drive, mdr.FreeImpact)
    what = "Error of e" if impact else "Relative error of F at the largest depth"
    text = f"Used on this page: {used}, the cheapest exact one: {result.model.reason}."
    text += f" {what} against it; {end}. Every time is the shortest of {REPEATS}."
    times = [row.seconds for row in rows]
    start, last = 10 ** floor(log10(min(times)) - 0.3), 10 ** ceil(log10(max(times)) + 0.3)
    axes = [
        Axis("time", "time to solve", "s", 1.0, start, last),
        Axis("error", "error of e" if impact else "relative error of F", "", 1.0, EXACT / 30, 1.0),
    ]
    return Found(points(rows, used), axes, escape(text) + _tabulated(rows, used))


def _tabulated(rows, used):
    def error(value):
        return "exact" if value is None else "< 10⁻¹⁶" if value < EXACT else digits(value, 2)

    lines = {
        "model": lambda row: row.model,
        "n": lambda row: row.n or "–",
        "time": lambda row: written(row.seconds, "time", 2),
        "error": lambda row: error(row.error),
    }
    body = ""
    for head, text in lines.items():
        cells = (f"<td{' class=used' * (row.model == used)}>{text(row)}</td>" for row in rows)
        body += f'<tr><th scope="row">{head}</th>{"".join(cells)}</tr>'
    return f'<table aria-label="Time and error of each model">{body}</table>'


def points(rows, used):
    """Times and errors of the marks by their names, from left to right."""

    def place(some):
        some = sorted((row.seconds, max(row.error or EXACT, EXACT)) for row in some)
        return tuple(np.array(some).reshape(-1, 2).T)

    models = ("chain", "closed form", "scalar ODE")
    marks = {name: place(row for row in rows if row.model == name) for name in models}
    marks["used on this page"] = place(row for row in rows if row.model == used and row.n is None)
    return marks | {"chains": marks["chain"]}
