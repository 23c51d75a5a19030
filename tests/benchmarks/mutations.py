"""Random changes of the core or the page: which of them does no test notice?

Run as ``python -m tests.benchmarks.mutations --of core --seed 1 --count 150`` with the group bench. The
tests run once under coverage, which notes the tests of each line. Each change then runs the tests of its
line, the shortest first, until one fails: with --quick, then without it, then with --full. Each change is
printed with the first of these that notices it. Where the default suite does not, a line with an effect
lacks a test, and a line without one is not needed, unless it makes the code faster.

A server of the page is another process, whose lines are not noted: a change of the page runs
`BROWSER_TESTS`, too. Texts, types and plots of the core are left out. ``--extents quick default``
leaves --full out, and ``--start 12`` goes on with a run that ended after 12 changes.
"""

import argparse
import ast
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

from coverage.numbits import numbits_to_nums

ROOT = Path(__file__).parents[2]
#: Folders that are changed, and the options of pytest for their tests.
FOLDERS = {"core": ("mdr_core",), "page": ("app", "mdr_explorer")}
TESTS = {"core": ["--ignore=tests/app"], "page": ["tests/app"]}
#: Files of the core that have texts and plots.
LEFT_OUT = ("figures", "springs", "report", "progress", "quantities", "_errors", "__init__")
#: Tests in a browser of what the page draws and says, of each change of the page.
BROWSER_TESTS = tuple(f"tests/app/explorer/test_{name}.py" for name in ("form", "player", "screen"))
#: Largest number of tests for one change.
_MOST_TESTS = 150
#: Extents of the suite: options of pytest, and the time (s) after which a change is taken to make it hang.
#: The tests of each are among those of the next.
EXTENTS = {"quick": (["--quick"], 240), "default": ([], 600), "full": (["--full"], 1800)}
OPERATORS = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
    ast.Lt: ast.GtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.And: ast.Or,
    ast.Or: ast.And,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}
CALLS = {"minimum": "maximum", "maximum": "minimum", "min": "max", "max": "min", "any": "all", "all": "any"}


@dataclass(frozen=True)
class Change:
    """A change of one expression: its file and line, the text before and after, and the changed source."""

    path: Path
    line: int
    before: str
    after: str
    source: str


def changed(node):
    """The node after a change, None if it has none."""
    match node:
        case ast.BinOp(left, operator, right) if type(operator) in OPERATORS:
            return ast.BinOp(left, OPERATORS[type(operator)](), right)
        case ast.BoolOp(operator, values):
            return ast.BoolOp(OPERATORS[type(operator)](), values)
        case ast.Compare(left, [operator], right) if type(operator) in OPERATORS:
            return ast.Compare(left, [OPERATORS[type(operator)]()], right)
        case ast.UnaryOp(ast.USub() | ast.Not() | ast.Invert(), operand):
            return operand
        case ast.Constant(bool() as value):
            return ast.Constant(not value)
        case ast.Constant(int() as value):
            return ast.Constant(value + 1)
        case ast.Constant(float() as value):
            return ast.Constant(1.1 * value if value else 1.0)
        case ast.Call(ast.Attribute(value, name), arguments, keywords) if name in CALLS:
            return ast.Call(ast.Attribute(value, CALLS[name]), arguments, keywords)
        case ast.Call(ast.Name(name), arguments, keywords) if name in CALLS:
            return ast.Call(ast.Name(CALLS[name]), arguments, keywords)
    return None


def changes(path):
    """All `Change`s of a file."""
    source = path.read_text(encoding="utf-8")
    rows = source.encode().splitlines(keepends=True)
    starts = [0]
    for row in rows:
        starts.append(starts[-1] + len(row))
    tree = ast.parse(source)
    formatted = [node for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)]
    # Of arguments, values that are returned, and variables.
    types = [getattr(node, name, None) for node in ast.walk(tree) for name in ("annotation", "returns")]
    left_out = {id(part) for node in (*formatted, *filter(None, types)) for part in ast.walk(node)}
    for node in ast.walk(tree):
        after = None if id(node) in left_out else changed(node)
        if after is None:
            continue
        first = starts[node.lineno - 1] + node.col_offset
        last = starts[node.end_lineno - 1] + node.end_col_offset
        text = f"({ast.unparse(ast.fix_missing_locations(after))})"
        code = source.encode()
        before = code[first:last].decode()
        yield Change(path, node.lineno, before, text, (code[:first] + text.encode() + code[last:]).decode())


def run_tests(tree, longest, *arguments):
    """Whether the tests that are named pass in a copy of the tree within a time (s)."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
    try:
        code = subprocess.run(command, cwd=tree, capture_output=True, timeout=longest).returncode
    except subprocess.TimeoutExpired:
        return False
    # 5 where --quick leaves all of them out.
    return code in (0, 5)


def tests_of_lines(tree, of):
    """Names of the tests that run each line, the shortest first, by file and line."""
    settings = tree / "coverage.ini"
    sources = f"[run]\nsource = {','.join(FOLDERS[of])}\ndynamic_context = test_function\n"
    settings.write_text(sources, encoding="utf-8")
    command = [sys.executable, "-m", "coverage", "run", f"--rcfile={settings}", "-m", "pytest", "-q"]
    command += ["-p", "no:cacheprovider", "--junitxml=times.xml", *TESTS[of]]
    # Without a browser its tests are skipped.
    environment = os.environ | {"CHROMIUM": "none"}
    subprocess.run(command, cwd=tree, check=False, capture_output=True, env=environment)
    times, failing = {}, set()
    for case in ElementTree.parse(tree / "times.xml").iter("testcase"):
        name = f"{case.get('classname')}.{case.get('name').partition('[')[0]}"
        times[name] = times.get(name, 0.0) + float(case.get("time"))
        if case.find("failure") is not None or case.find("error") is not None:
            failing.add(name)
    for name in failing:
        print(f"left out, since it fails without a change: {name}", flush=True)
        del times[name]
    contexts = {}
    with sqlite3.connect(tree / ".coverage") as data:
        query = "SELECT path, context, numbits FROM line_bits JOIN file ON file_id = file.id "
        for path, context, bits in data.execute(f"{query} JOIN context ON context_id = context.id"):
            if context in times:
                # Under no line all tests of the file: of a constant of the module.
                for line in [None, *numbits_to_nums(bits)]:
                    contexts.setdefault((path, line), []).append(context)
    return {place: sorted(tests, key=times.get)[:_MOST_TESTS] for place, tests in contexts.items()}


def node_id(tree, context):
    """The name of a test, tests.test_cone.TestCone.test_force, as pytest takes it."""
    parts = context.split(".")
    for count in range(len(parts), 0, -1):
        path = Path(*parts[:count]).with_suffix(".py")
        if (tree / path).is_file():
            return "::".join([str(path), *parts[count:]])
    raise ValueError(f"no test {context}")


def noticed_by(tree, tests, extents):
    """The smallest extent of the suite in which one of the tests fails, None if none does."""
    for extent in extents:
        option, longest = EXTENTS[extent]
        if not run_tests(tree, longest, "-x", *option, *tests):
            return extent
    return None


def files_of(tree, of):
    """Files in which changes are made."""
    files = [path for folder in FOLDERS[of] for path in sorted((tree / folder).rglob("*.py"))]
    return [path for path in files if of == "page" or path.stem not in LEFT_OUT]


def judged(tree, change, known, options):
    """The smallest extent that notices a change, or in words that no test can or does."""
    contexts = known.get((str(change.path), change.line)) or known.get((str(change.path), None), [])
    tests = [node_id(tree, context) for context in contexts]
    if options.of == "page":
        tests += BROWSER_TESTS
    if not tests:
        return "no test runs this line"
    original = change.path.read_text(encoding="utf-8")
    change.path.write_text(change.source, encoding="utf-8")
    extent = noticed_by(tree, tests, options.extents)
    change.path.write_text(original, encoding="utf-8")
    return extent or "not noticed"


def main():
    """Make changes, and print which tests notice each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--of", choices=FOLDERS, default="core")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--start", type=int, default=0, help="so many of the changes are left out")
    parser.add_argument("--extents", nargs="+", choices=EXTENTS, default=list(EXTENTS))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(".git", ".venv*", "__pycache__"))
        known = tests_of_lines(tree, options.of)
        pool = [change for path in files_of(tree, options.of) for change in changes(path)]
        chosen = random.Random(options.seed).sample(pool, options.count)
        found = []
        for number, change in enumerate(chosen[options.start :], options.start + 1):
            found.append(judged(tree, change, known, options))
            where = f"{change.path.relative_to(tree)}:{change.line}"
            print(f"{number}  {found[-1]}:  {where}  {change.before} → {change.after}", flush=True)
        count = 0
        for extent in options.extents:
            count += found.count(extent)
            print(f"{count} of {len(found)} changes are noticed by the suite: {extent}")


if __name__ == "__main__":
    main()
