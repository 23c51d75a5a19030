"""Speed against error, measured and written down: tables, figure and the README's section.

    python -m tests.benchmarks.report

writes assets/benchmarks.json, assets/benchmarks.md, assets/speed_against_error.svg and the tables in
README.md and the statement of need; with --quick it measures a few small sizes in a minute and only
prints. `beside_lammps` and `in_browser` write their sections by themselves, and these stay.
"""

import argparse
import json
import os
import platform
import re
import tomllib
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

from ..shapes import SHAPES
from . import peers, speed, streams
from .chart import figure
from .harness import measure
from .problems import problems
from .tables import document, need, summary

ROOT = Path(__file__).parents[2]
ASSETS = ROOT / "assets"
#: Where the sections begin that are measured by themselves, in their order.
BESIDE_LAMMPS, IN_BROWSER = SECTIONS = "<!-- beside LAMMPS -->\n", "<!-- in a browser -->\n"
#: Pages with a table between two marks, and what makes it of the results.
TABLES = {ROOT / "README.md": summary, ASSETS / "docs" / "statement_of_need.md": need}
_BEGIN, _END = "<!-- benchmarks: begin -->\n", "<!-- benchmarks: end -->"


def collect(quick=False, say=lambda line: None):
    """Everything measured, as plain lists and dicts."""
    records = []
    for problem in problems(quick):
        say(f"{problem.question}: {problem.title}")
        records += measure(problem, rounds=1 if quick else 5)
    say("many at once")
    return {
        "date": datetime.now(UTC).date().isoformat(),
        "processors": os.cpu_count(),
        "versions": _versions(),
        "peers": peers.versions(),
        "records": records,
        "ratios": list(speed.rows(100, SHAPES[:3]) if quick else speed.rows()),
        "streams": [] if quick else list(streams.rows()),
    }


def _versions():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found = {"mdr_core": project["version"], "python": platform.python_version()}
    return found | {name: metadata.version(name) for name in ("numpy", "scipy", "mpmath")}


def stored():
    """What was measured last, from assets/benchmarks.json."""
    return json.loads((ASSETS / "benchmarks.json").read_text(encoding="utf-8"))


def sections():
    """The parts of assets/benchmarks.md by the marks before them; the first has none."""
    text = (ASSETS / "benchmarks.md").read_text(encoding="utf-8")
    first, *others = re.split("(" + "|".join(SECTIONS) + ")", text)
    return {"": first} | dict(zip(others[::2], others[1::2], strict=True))


def table(page):
    """The table on a page."""
    return page.read_text(encoding="utf-8").split(_BEGIN)[1].split(_END)[0]


def write_results(results):
    """Put results beside those that are stored, in the place of earlier ones of the same name."""
    text = json.dumps(stored() | results, indent=1, ensure_ascii=False)
    (ASSETS / "benchmarks.json").write_text(text + "\n", encoding="utf-8")


def write_section(mark, text):
    """Put a section into its place in assets/benchmarks.md."""
    found = sections() | {mark: text}
    text = "".join(each + found[each] for each in ("", *SECTIONS) if each in found)
    (ASSETS / "benchmarks.md").write_text(text, encoding="utf-8")


def write_tables():
    """Put the tables of what is stored on their pages."""
    for page, make in TABLES.items():
        head, rest = page.read_text(encoding="utf-8").split(_BEGIN)
        text = head + _BEGIN + make(stored()) + _END + rest.split(_END)[1]
        page.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="small sizes, nothing is written")
    quick = parser.parse_args().quick
    results = collect(quick, say=lambda line: print(line, flush=True))
    print(document(results))
    if not quick:
        write_results(results)
        write_section("", document(results))
        (ASSETS / "speed_against_error.svg").write_text(figure(results), encoding="utf-8")
        write_tables()


if __name__ == "__main__":
    main()
