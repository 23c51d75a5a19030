"""Measures speed and error, and writes tables, figure and the table of the README.

    python -m tests.benchmarks.report

writes assets/benchmarks.json, assets/benchmarks.md, assets/speed_against_error.svg and the tables in
README.md and the statement of need. With --quick it measures small sizes in a minute and only prints.
"""

import argparse
import json
import os
import platform
import tomllib
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

from . import peers, speed
from .chart import figure
from .harness import measure
from .problems import problems
from .tables import document, summary

ROOT = Path(__file__).parents[2]
ASSETS = ROOT / "assets"
#: Pages that have the short table, between two marks.
PAGES = ROOT / "README.md", ASSETS / "docs" / "statement_of_need.md"
_BEGIN, _END = "<!-- benchmarks: begin -->\n", "<!-- benchmarks: end -->"


def collect(quick=False, say=lambda line: None):
    """Return all results as plain lists and dicts."""
    records = []
    for problem in problems(quick):
        say(f"{problem.question}: {problem.title}")
        records += measure(problem, rounds=1 if quick else 5)
    say("times of shapes")
    return {
        "date": datetime.now(UTC).date().isoformat(),
        "processors": os.cpu_count(),
        "versions": _versions(),
        "peers": peers.versions(),
        "records": records,
        "shapes": list(speed.by_shapes(100) if quick else speed.by_shapes()),
        "others": list(speed.others(20, runs=1) if quick else speed.others()),
    }


def _versions():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found = {"mdr_core": project["version"], "python": platform.python_version()}
    return found | {name: metadata.version(name) for name in ("numpy", "scipy", "mpmath")}


def stored():
    """Return the results of the last report, from assets/benchmarks.json."""
    return json.loads((ASSETS / "benchmarks.json").read_text(encoding="utf-8"))


def table(page):
    """Return the table on a page."""
    return page.read_text(encoding="utf-8").split(_BEGIN)[1].split(_END)[0]


def write(results):
    """Write the results, the report, the figure and the tables on other pages."""
    text = json.dumps(results, indent=1, ensure_ascii=False)
    (ASSETS / "benchmarks.json").write_text(text + "\n", encoding="utf-8")
    (ASSETS / "benchmarks.md").write_text(document(results), encoding="utf-8")
    (ASSETS / "speed_against_error.svg").write_text(figure(results), encoding="utf-8")
    for page in PAGES:
        head, rest = page.read_text(encoding="utf-8").split(_BEGIN)
        text = head + _BEGIN + summary(results) + _END + rest.split(_END)[1]
        page.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="measure small sizes and write nothing")
    quick = parser.parse_args().quick
    results = collect(quick, say=lambda line: print(line, flush=True))
    print(document(results))
    if not quick:
        write(results)


if __name__ == "__main__":
    main()
