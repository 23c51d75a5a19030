"""The report in words and tables."""

from itertools import groupby

from .problems import YIELDING

_COMMAND = "python -m tests.benchmarks.report"
_NOTE = """Median times of one process in which all methods of a problem take turns. Errors are relative
root mean squares against 50 digits (mpmath). Loops are measured for a few items and scaled to all.

The plain formula of a force or a pressure is the difference of two elastic curves from textbooks. Its
error grows with the depth over the critical depth. For a cone F = k d_c (2d − d_c), with k = 2E*/(π s),
keeps all digits. The plain formula of an impact has a few lines for each of its three stages
(`plain_impacts` in `tests/benchmarks/problems.py`), and is as exact as `mdr_core`.

tamaas and ContactMechanics solve other problems: the contact of any rough surface, tamaas also with
friction, adhesion and plasticity. Here they solve an elastic cone, non-periodic, set up and warm before
the clock starts. They have no hardness in proportion to 1/a. SciPy's `solve_ivp` solves any equation of
motion, one impact at a time. Here it has the impact in three smooth stages."""
_SHAPES_NOTE = """All values are different. *Different particles* also differ in size, medium and mass; the
measured tip is always the same. The plate has an impedance at which the paraboloid loses energy."""

_IMPACTS, _SOLVE_IVP = "restitution and contact time", ("solve_ivp RK45", "rtol = 1e-06")
_GRID = "128²"
#: Rows of the short table: problem, d/d_c, question and title of its records, and the general solver with
#: its setting.
_ROWS = (
    *(
        (what, depth, question, f"cone, {depth} critical depths deep", solver)
        for what, question, solver in (
            ("force, one value / 10⁶ values", "force", ("", "")),
            ("e and T of 1000 impacts", _IMPACTS, _SOLVE_IVP),
        )
        for depth in YIELDING
    ),
    ("the same, viscous", "100", _IMPACTS, "viscous medium, 100 critical depths deep", _SOLVE_IVP),
    (
        "elastic pressure, 128² points", "–", "pressure", "elastic cone, field on a grid",
        ("tamaas", f"{_GRID}, tolerance 0.001"),
    ),
)  # fmt: skip


def time(seconds):
    """A time with two digits and its unit."""
    for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if seconds >= scale:
            return f"{_two_digits(seconds / scale)} {unit}"
    return f"{_two_digits(seconds * 1e9)} ns"


def _two_digits(value):
    return f"{float(f'{value:.2g}'):g}" if value < 1e4 else f"{value:.1e}"


def _error(value):
    return f"{value:.0e}" if value else "0"


def _row(*cells):
    return "| " + " | ".join(cells) + " |"


def _table(head, rows):
    return [_row(*head), "|" + "---|" * len(head), *(_row(*row) for row in rows), ""]


def document(results):
    """The whole report as Markdown."""
    lines = ["# Speed against error", "", _made(results), "", _NOTE, ""]
    lines += ["![Time against error](speed_against_error.svg)", ""]
    for (question, title, count), group in groupby(
        results["records"], key=lambda r: (r["question"], r["title"], r["items"])
    ):
        rows = [(r["family"], r["setting"], _error(r["error"]), time(r["seconds"])) for r in group]
        many = f" ({count:,} of them)" if count > 1 else ""
        lines += [f"## {question.capitalize()}: {title}{many}", ""]
        lines += _table(("method", "setting", "error", "time"), rows)
    head, *rows = results["shapes"]
    lines += ["## Times of shapes", "", _SHAPES_NOTE, "", *_table(head, rows)]
    lines += ["## Other times", "", *_table(("", "time", ""), results["others"])]
    return "\n".join(lines)


def summary(results):
    """The short table: a plain formula, this package and a general solver next to each other."""
    rows = []
    for what, depth, question, title, solver in _ROWS:
        records = [r for r in results["records"] if (r["question"], r["title"]) == (question, title)]
        own = _GRID if question == "pressure" else ""
        methods = ("plain formula", own), ("mdr_core", own), solver
        rows.append((what, depth, *(_cell(records, *method) for method in methods)))
    head = "cone", "d/d_c", "plain formula in NumPy", "mdr_core", "general solver"
    return "\n".join(_table(head, rows))


def _cell(records, family, setting):
    """Times and the largest error of a method, and the name of a general solver."""
    found = [r for r in records if (r["family"], r["setting"]) == (family, setting)]
    if not found:
        return "–"
    name = "" if family in ("plain formula", "mdr_core") else f"{family.split()[0]}: "
    times = " / ".join(time(r["seconds"]) for r in found)
    return f"{name}{times}, {_error(max(r['error'] for r in found))}"


def _made(results):
    versions = ", ".join(f"{name} {version}" for name, version in results["versions"].items())
    peers = ", ".join(f"{name} {version}" for name, version in results["peers"].items())
    machine = f"{results['processors']} processors"
    made = f"Made by `{_COMMAND}` on {results['date']}, on {machine}, with {versions}."
    return f"{made} Other packages: {peers}."
