"""The report in words and tables."""

import math
from itertools import groupby

_COMMAND = "python -m tests.benchmarks.report"
_NOTE = """Median times of one process in which all methods of a problem take turns. Errors are relative
root mean squares against 50 digits (mpmath). Loops are measured for a few items and scaled to all.

tamaas and ContactMechanics solve what this project does not: the contact of any rough surface, tamaas
with friction, adhesion and plasticity besides. Here they are given an elastic cone, non-periodic, set
up and warm before the clock starts."""

_STREAMS = """`assets/erosion.py`: restitution and damaged area of particles with random radii and speeds,
with the drawing of random numbers, sums and histograms. Memory is the sum of
the largest of every process."""


def time(seconds):
    """A time with two digits and its unit."""
    for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if seconds >= scale:
            return f"{_two_digits(seconds / scale)} {unit}"
    return f"{_two_digits(seconds * 1e9)} ns"


def _two_digits(value):
    return f"{float(f'{value:.2g}'):g}" if value < 1e4 else f"{value:.1e}"


def _row(*cells):
    return "| " + " | ".join(cells) + " |"


def _table(head, rows):
    return [_row(*head), "|" + "---|" * len(head), *rows, ""]


def document(results):
    """The whole report as Markdown."""
    lines = ["# Speed against error", "", _made(results), "", _NOTE, ""]
    lines += ["![Time against error](speed_against_error.svg)", ""]
    for (question, title), group in groupby(results["records"], key=lambda r: (r["question"], r["title"])):
        group = list(group)
        rows = [_row(r["family"], r["setting"], f"{r['error']:.0e}", time(r["seconds"])) for r in group]
        count = f" ({group[0]['items']} of them)" if group[0]["items"] > 1 else ""
        lines += [f"## {question.capitalize()}: {title}{count}", ""]
        lines += _table(("method", "setting", "error", "time"), rows)
    lines += ["## Many at once", ""]
    lines += _table(("what", "time", "against"), (_row(*each) for each in results["ratios"]))
    lines += ["## A stream of particles", "", _STREAMS, ""]
    lines += _table(("what", "time", "each, and memory"), (_row(*each) for each in results["streams"]))
    return "\n".join(lines)


def _made(results):
    versions = ", ".join(f"{name} {version}" for name, version in results["versions"].items())
    peers = ", ".join(f"{name} {version}" for name, version in results["peers"].items())
    machine = f"{results['processors']} processors"
    return f"Made by `{_COMMAND}` on {results['date']}, on {machine}, with {versions}; beside them {peers}."


def summary(results):
    """The README's table: the best of the project beside the best of the others, by problem."""
    rows = []
    for title, setting, what in (
        ("elastic cone, field on a grid", "128²", "pressure of a cone on 128² points"),
        ("cone, 10⁸ critical depths deep", "", "pressure, 10⁸ critical depths deep, 1000 radii"),
    ):
        rows += _compared(results["records"], title, setting, what)
    for title, kind in (
        ("cone, 10⁶ critical depths deep", "fast"),
        ("viscous medium, 100 critical depths deep", "viscous"),
    ):
        chosen = [r for r in results["records"] if r["question"] == "contact time"]
        rows += _compared(chosen, title, "", f"contact time, 1000 {kind} impacts")
    head = "problem", "mdr_core", "error", "fastest of the others", "time", "error", "times faster"
    return "\n".join(_table(head, rows))


def _compared(records, title, setting, what):
    """Own best method and the fastest of the others, if both were measured."""
    chosen = [r for r in records if r["title"] == title and r["setting"].startswith(setting)]
    own = [r for r in chosen if r["family"].startswith("mdr_core")]
    others = [r for r in chosen if not r["family"].startswith(("mdr_core", "chain", "difference"))]
    if not own or not others:
        return
    best = min(own, key=lambda r: (round(math.log10(r["error"] + 1e-17) / 2), r["seconds"]))
    peer = min(others, key=lambda r: r["seconds"])
    yield _row(
        what,
        time(best["seconds"]),
        f"{best['error']:.0e}",
        f"{peer['family']}, {peer['setting']}",
        time(peer["seconds"]),
        f"{peer['error']:.0e}",
        _two_digits(peer["seconds"] / best["seconds"]),
    )
