"""Random changes of the core: which of them does no test notice?

Run as ``python -m tests.benchmarks.mutations --seed 1 --count 150``; it needs the package coverage. The
tests run once under coverage, which notes the tests of each line. Each change then runs the tests of its
line, the shortest first, until one fails: with --quick, then without it, then with --full. Changes that
the default suite does not notice are printed: a line with an effect lacks a test, a line without one is
not needed, unless it makes the code faster.

Texts, plots and checks of types are left out.
"""

import argparse
import ast
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
#: Files of texts and plots.
LEFT_OUT = ("figures", "springs", "report", "progress", "quantities", "_errors", "__init__")
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
    texts = {id(part) for node in formatted for part in ast.walk(node)}
    for node in ast.walk(tree):
        after = None if id(node) in texts else changed(node)
        if after is None:
            continue
        first = starts[node.lineno - 1] + node.col_offset
        last = starts[node.end_lineno - 1] + node.end_col_offset
        text = f"({ast.unparse(ast.fix_missing_locations(after))})"
        code = source.encode()
        before = code[first:last].decode()
        yield Change(path, node.lineno, before, text, (code[:first] + text.encode() + code[last:]).decode())


def run_tests(tree, longest, *arguments):
    """Whether the core's tests, or those named, pass in a copy of the tree within a time (s)."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
    try:
        code = subprocess.run(command, cwd=tree, capture_output=True, timeout=longest).returncode
    except subprocess.TimeoutExpired:
        return False
    # 5 where --quick leaves all of them out.
    return code in (0, 5)


def tests_of_lines(tree):
    """Names of the tests that run each line, the shortest first, by file and line."""
    settings = tree / "coverage.ini"
    settings.write_text("[run]\nsource = mdr_core\ndynamic_context = test_function\n", encoding="utf-8")
    command = [sys.executable, "-m", "coverage", "run", f"--rcfile={settings}", "-m", "pytest", "-q"]
    command += ["-p", "no:cacheprovider", "--ignore=tests/app", "--junitxml=times.xml"]
    subprocess.run(command, cwd=tree, check=False, capture_output=True)
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


def noticed_by(tree, tests):
    """The smallest extent of the suite in which one of the tests fails, None if none does."""
    for extent, (option, longest) in EXTENTS.items():
        if not run_tests(tree, longest, "-x", *option, *tests):
            return extent
    return None


def main():
    """Make changes, and print those that the default suite does not notice."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=150)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(".git", "__pycache__"))
        known = tests_of_lines(tree)
        files = [path for path in sorted((tree / "mdr_core").rglob("*.py")) if path.stem not in LEFT_OUT]
        pool = [change for path in files for change in changes(path)]
        chosen = random.Random(options.seed).sample(pool, options.count)
        noticed = []
        for change in chosen:
            contexts = known.get((str(change.path), change.line)) or known.get((str(change.path), None), [])
            tests = [node_id(tree, context) for context in contexts]
            original = change.path.read_text(encoding="utf-8")
            change.path.write_text(change.source, encoding="utf-8")
            extent = noticed_by(tree, tests) if tests else None
            change.path.write_text(original, encoding="utf-8")
            noticed.append(extent)
            if extent not in ("quick", "default"):
                where = f"{change.path.relative_to(tree)}:{change.line}"
                remark = "noticed by --full" if extent else "" if tests else "no test runs this line"
                print(f"{where}  {change.before} → {change.after}  {remark}".rstrip(), flush=True)
        count = 0
        for extent in EXTENTS:
            count += noticed.count(extent)
            print(f"{count} of {options.count} changes are noticed by the suite: {extent}")


if __name__ == "__main__":
    main()
