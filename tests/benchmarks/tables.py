"""The report in words and tables."""

import math
from itertools import groupby

_COMMAND = "python -m tests.benchmarks.report"
_NOTE = """Median times of one process in which all methods of a problem take turns; the last column counts
in `np.power` of a million doubles. Errors are relative root mean squares against 50 digits (mpmath). Loops
are measured for a few items and scaled to all.

tamaas and ContactMechanics solve what this project does not: the contact of any rough surface, tamaas with
friction, adhesion and plasticity besides. Here they are given a cone and a paraboloid, elastic and
non-periodic, set up and warm before the clock starts. PyAbel transforms whole images, fast once it is warm;
cold is the first transform of a size, without a basis on disk."""


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
    lines += ["![Time against error](speed_against_error.svg)", "", "## Bars", "", *_bars(results["bars"])]
    unit = 1e6 * results["floors"]["np.power"]
    for (question, case, title), group in groupby(
        results["records"], key=lambda r: (r["question"], r["case"], r["title"])
    ):
        rows = [
            _row(
                r["family"],
                r["setting"],
                f"{r['error']:.0e}",
                time(r["seconds"]),
                f"{r['seconds'] / unit:.2g}",
            )
            for r in group
        ]
        items = next(
            r["items"] for r in results["records"] if r["title"] == title and r["question"] == question
        )
        count = f" ({items} of them)" if items > 1 else ""
        lines += [f"## {question.capitalize()}, {case}: {title}{count}", ""]
        lines += _table(("method", "setting", "error", "time", "np.power"), rows)
    lines += ["## Growth, memory, and the distance to the floors", "", *_growth(results)]
    return "\n".join(lines)


def _made(results):
    versions = ", ".join(f"{name} {version}" for name, version in results["versions"].items())
    peers = ", ".join(f"{name} {version}" for name, version in results["peers"].items())
    machine = f"{results['processors']} processors"
    return f"Made by `{_COMMAND}` on {results['date']}, on {machine}, with {versions}; beside them {peers}."


def _bars(bars):
    rows = [
        _row(
            b["what"],
            _factor(b["wanted"]),
            _factor(b["measured"]),
            "yes" if b["met"] else "no",
            b["against"],
        )
        for b in bars
    ]
    return _table(("bar", "wanted", "measured", "met", "against"), rows)


def _factor(value):
    return "–" if value is None else _two_digits(value)


def _growth(results):
    floors = "; ".join(f"{name} {time(each)}" for name, each in results["floors"].items())
    rows = [
        _row(
            g["what"],
            f"{g['sizes'][-1]:g}",
            time(g["seconds"][-1] / g["sizes"][-1]),
            f"{g['exponent']:.2f}",
            f"{g['bytes_each']:.0f} B",
            f"{g['floors']:.2g} × {g['floor']}",
        )
        for g in results["growth"]
    ]
    head = "what is counted", "up to", "time each", "exponent", "peak memory each", "distance"
    return [f"Floors, for one double: {floors}.", "", *_table(head, rows)]


def summary(results):
    """The README's table: the best of the project beside the best of the others, by problem."""
    rows = []
    for title, setting, what in (
        ("elastic cone, field on a grid", "128²", "pressure of a cone on 128² points"),
        ("cone, 10⁸ critical depths deep", "", "pressure, 10⁸ critical depths deep, 1000 radii"),
        ("yielded cone, kink between samples", "N = 1001", "transform of 1001 samples with a kink, cold"),
        ("fourth power, smooth load", "N = 1001", "transform of 1001 smooth samples, cold"),
        ("sphere, 10⁸ critical depths deep", "", "force of a sphere, 1000 depths"),
    ):
        rows += _compared(results["records"], title, setting, what)
    for quantity in ("restitution", "contact time"):
        chosen = [r for r in results["records"] if r["question"] == quantity and r["case"] == "hard"]
        rows += _compared(chosen, chosen[0]["title"], "", f"{quantity}, 1000 fast impacts")
    head = "problem", "mdr_core", "error", "fastest of the others", "time", "error", "times faster"
    return "\n".join(_table(head, rows))


def _compared(records, title, setting, what):
    """Own best method and the fastest of the others, if both were measured."""
    chosen = [r for r in records if r["title"] == title and r["setting"].startswith(setting)]
    chosen = [r for r in chosen if not r["setting"].endswith("warm")]
    own = [
        r
        for r in chosen
        if r["family"].startswith("mdr_core") and not r["family"].endswith("profile known")
    ]
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
