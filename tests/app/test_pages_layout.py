"""How the app is laid out: small, imports point down on few floors, scripts in files of their own."""

import ast
import io
import re
import tokenize
from functools import cache
from pathlib import Path

import app

APP = Path(app.__file__).parent
#: What no documentation of Bokeh, Panel or HoloViews has.
PRIVATE = re.compile(
    r"\b(_actual_paint|is_forcing_paint|map_data|mark_finished|canvas_view|plot_view|renderer_views|repainted"
    r"|_send_msg|_handle_msg|_models|_debounce|get_serialized_svg|embed_items|events_el|v_compute|pixel_ratio"
    r"|source_range|getContext|silent)\b"
)


SCRIPTS = list(APP.rglob("*.js"))
#: Of the explorer, without the other pages and the table of all.
SMALL = [path for path in APP.glob("*.py") if path.name not in ("main.py", "theory.py")]
EXTRAS = list((APP / "extras").rglob("*.py"))


def lines(paths):
    return [len(path.read_text(encoding="utf-8").splitlines()) for path in paths]


def code(path):
    """Lines with code: no blank ones, comments or docstrings."""
    found, fresh = set(), True
    for token in tokenize.generate_tokens(io.StringIO(path.read_text(encoding="utf-8")).readline):
        if token.type in (tokenize.COMMENT, tokenize.NL):
            continue
        if token.type in (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER):
            fresh = True
            continue
        if not (token.type == tokenize.STRING and fresh):
            found.update(range(token.start[0], token.end[0] + 1))
        fresh = False
    return len(found)


def test_the_page_stays_small():
    assert sum(map(code, SMALL)) <= 1500
    assert max(lines(SMALL)) <= 350
    assert max(lines(EXTRAS)) <= 350
    assert max(sum(lines((APP / "extras").glob(f"{path.stem}.*"))) for path in EXTRAS) <= 350
    assert sum(lines(SCRIPTS)) <= 385
    sheets = [path for path in (APP / "static").glob("*.css") if path.name != "fit.css"]
    assert sum(lines(sheets)) <= 206


def test_nothing_private_of_the_toolkit_is_used():
    for path in [*APP.rglob("*.py"), *SCRIPTS]:
        text = path.read_text(encoding="utf-8")
        assert PRIVATE.findall(text) == [], path.name
        if path.suffix == ".js":
            assert re.findall(r"\.(_\w+)", text) == [], path.name


@cache
def imports(path):
    """Modules of the app that one of them imports when it runs; the seam names others in annotations."""
    found, package = set(), path.parent
    tree = ast.parse(path.read_text(encoding="utf-8"))
    tree.body = [node for node in tree.body if not isinstance(node, ast.If)]
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package if node.level == 1 else package.parents[node.level - 2]
            base = base / (node.module or "").replace(".", "/")
            for name in [alias.name for alias in node.names]:
                for each in (
                    base / f"{name}.py",
                    base / name / "__init__.py",
                    base.with_suffix(".py"),
                    base / "__init__.py",
                ):
                    if each.is_file():
                        found.add(each)
                        break
    return found - {path, APP / "__init__.py"}


def floor(path, below=()):
    assert path not in below, f"a cycle of imports at {path}"
    return 1 + max((floor(each, (*below, path)) for each in imports(path)), default=0)


def test_imports_point_down_on_few_floors():
    floors = {path: floor(path) for path in APP.rglob("*.py")}
    assert max(floors.values()) <= 10, {str(path.relative_to(APP)): n for path, n in floors.items()}


def test_scripts_stand_in_files_of_their_own():
    for path in APP.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r'code="[^"]*[;=(]', text), path.name
