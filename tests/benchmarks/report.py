"""Speed against error, measured and written down: tables, figure and the README's section.

    python -m tests.benchmarks.report

writes assets/benchmarks.json, assets/benchmarks.md, assets/speed_against_error.svg and the table in
README.md; with --quick it measures a few small sizes in less than a minute and only prints.
"""

import argparse
import json
import os
import platform
import tomllib
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

from ..shapes import SHAPES
from . import peers, speed, streams
from .chart import figure
from .harness import measure
from .problems import problems
from .tables import document, summary

ROOT = Path(__file__).parents[2]
#: Where the section of `in_browser` begins, which is measured by itself.
IN_BROWSER = "<!-- in a browser -->\n"
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


def write_assets(results):
    """Figures and tables, from what `collect` gives."""
    assets = ROOT / "assets"
    text = json.dumps(results, indent=1, ensure_ascii=False)
    (assets / "benchmarks.json").write_text(text + "\n", encoding="utf-8")
    tables = assets / "benchmarks.md"
    kept = "".join(tables.read_text(encoding="utf-8").partition(IN_BROWSER)[1:])
    tables.write_text(document(results) + kept, encoding="utf-8")
    (assets / "speed_against_error.svg").write_text(figure(results), encoding="utf-8")


def write_readme(results):
    """The README's table."""
    readme = ROOT / "README.md"
    head, rest = readme.read_text(encoding="utf-8").split(_BEGIN)
    readme.write_text(head + _BEGIN + summary(results) + _END + rest.split(_END)[1], encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="small sizes, nothing is written")
    quick = parser.parse_args().quick
    results = collect(quick, say=lambda line: print(line, flush=True))
    print(document(results))
    if not quick:
        write_assets(results)
        write_readme(results)


if __name__ == "__main__":
    main()
