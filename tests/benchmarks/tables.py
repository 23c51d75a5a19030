"""The report in words and tables."""

import math
import re
from itertools import groupby

_COMMAND = "python -m tests.benchmarks.report"
_NOTE = """Median times of one process in which all methods of a problem take turns. Errors are relative
root mean squares against 50 digits (mpmath). Loops are measured for a few items and scaled to all.

tamaas and ContactMechanics solve other problems: the contact of any rough surface, tamaas also with
friction, adhesion and plasticity. Here they solve an elastic cone, non-periodic, set up and warm
before the clock starts."""

_LAMMPS = """A ball of aluminium oxide (E = 380 GPa, ν = 0.23, radius 2.5 mm, μ = 0.092) hits a
plane of the same material at 3.9 m/s, at an angle to the normal. It is test 4 of Chung and Ooi
(Granular Matter 13, 2011) without damping. `oblique_impact` and a brute-force chain of {cells}
cells share no solver; they differ by {differ} at most, and the sum of their stated errors is
{bound}. LAMMPS takes {steps} steps in the contact time; with half as many no speed changes by more
than {change}. Its columns are its tangential options, with "…" for `mindlin`, and with stiffnesses
from the material (`NULL`). Speeds are those of the centre."""

_DAMPINGS = """The same ball hits the plane along the normal under `hertz/material`, with the damping named
above each column. Columns "limited" have `limit_damping`: the contact force never attracts. SciPy's
`solve_ivp` of the same equation of motion differs by {scipy} at most."""

_VISCOUS = """The same ball on an incompressible medium of η = 10⁵ Pa·s: the coefficient of restitution by
`impact`, and by LAMMPS with `damping viscoelastic` of the prefactor 8 η/m:"""

#: Problems of the statement of need: title, setting, question, and what they are called there.
_NEEDED = (
    ("elastic cone, field on a grid", "128²", "pressure", "pressure of an elastic cone, 128² points"),
    ("viscous medium, 100 critical depths deep", "", "restitution", "restitution, 1000 viscous impacts"),
)

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


def beside_lammps(found):
    """The section on LAMMPS as Markdown, from what `beside_lammps.collect` gives."""
    values = {(row["angle"], row["method"]): row for row in found["impacts"]}
    angles, options = (list(dict.fromkeys(each)) for each in zip(*values, strict=True))
    differ = max(off(found, "chain").values())
    made = f"Made by `python -m tests.benchmarks.beside_lammps` on {found['date']}, with mdr_core "
    lines = ["## Beside LAMMPS", "", f"{made}{found['mdr_core']} and lammps {found['version']}.", ""]
    numbers = {name: f"{found[name]:.0e}" for name in ("bound", "change")} | {"differ": f"{differ:.0e}"}
    lines += [_LAMMPS.format(cells=found["cells"], steps=found["steps"], **numbers), ""]
    for title, name in (
        ("speed along the surface, after over before", "speed"),
        ("speed of the surface by the spin after, over the speed before", "spin"),
        ("energy of the motion along the surface with that of the spin, after over before", "energy"),
    ):
        rows = [_row(f"{a}°", *(f"{values[a, each][name]:.4f}" for each in options)) for a in angles]
        head = (re.sub("^mindlin(?=.)", "…", each) for each in options)
        lines += [f"The {title}:", "", *_table(("angle", *head), rows)]
    dampings = {(row["asked"], row["damping"], row["limited"]): row for row in found["dampings"]}
    columns = list(dict.fromkeys(key[1:] for key in dampings))
    scipy = max(abs(row["lammps"] - row["scipy"]) for row in found["dampings"])
    rows = [
        _row(f"{asked:g}", *(f"{dampings[asked, *each]['lammps']:.4f}" for each in columns))
        for asked in dict.fromkeys(key[0] for key in dampings)
    ]
    head = (f"`{damping}`" + ", limited" * limited for damping, limited in columns)
    lines += ["### Requested restitution", "", _DAMPINGS.format(scipy=f"{scipy:.0e}"), ""]
    lines += [*_table(("requested", *head), rows), _VISCOUS, ""]
    names = "impact", "attracting", "limited"
    rows = [_row(f"{r['speed']:g} m/s", *(f"{r[name]:.4f}" for name in names)) for r in found["viscous"]]
    return "\n".join([*lines, *_table(("speed", "`impact`", "LAMMPS", "limited"), rows)])


def off(found, method):
    """Deviation of the speed along the surface from that of `oblique_impact`, by the angle."""
    own, other = (
        {row["angle"]: row["speed"] for row in found["impacts"] if row["method"] == each}
        for each in ("oblique_impact", method)
    )
    return {angle: abs(other[angle] - own[angle]) for angle in own}


def need(results):
    """The table of the statement of need: the same problems by this package and by others."""
    rows = []
    for title, setting, question, what in _NEEDED:
        named = title, question
        chosen = [r for r in results["records"] if (r["title"], r["question"]) == named]
        chosen = [r for r in chosen if r["setting"].startswith(setting)]
        (own,) = (_time_and_error(r) for r in chosen if r["family"] == "mdr_core")
        for family in ("tamaas", "ContactMechanics", "solve_ivp RK45"):
            others = [r for r in chosen if r["family"] == family]
            if others:
                fastest = min(others, key=lambda r: r["seconds"])
                rows.append(_row(what, own, family, _time_and_error(fastest)))
    own = f"{results['lammps']['bound']:.0e}"
    for option in ("mindlin", "mindlin_rescale/force"):
        worst = f"{max(off(results['lammps'], option).values()):.2g}"
        rows.append(_row("rebound of an elastic ball, 2° to 60°", own, f"LAMMPS, `{option}`", worst))
    head = "problem", "mdr_core: time, error", "other", "its time, error"
    return "\n".join(_table(head, rows))


def _time_and_error(record):
    return f"{time(record['seconds'])}, {record['error']:.0e}"


def _made(results):
    versions = ", ".join(f"{name} {version}" for name, version in results["versions"].items())
    peers = ", ".join(f"{name} {version}" for name, version in results["peers"].items())
    machine = f"{results['processors']} processors"
    made = f"Made by `{_COMMAND}` on {results['date']}, on {machine}, with {versions}."
    return f"{made} Other packages: {peers}."


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
