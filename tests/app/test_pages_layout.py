"""How the app is laid out: small files, imports point down, scripts in files of their own."""

import ast
import re
from functools import cache
from pathlib import Path

import app

APP = Path(app.__file__).parent
#: What no documentation of Bokeh, Panel or HoloViews has.
PRIVATE = re.compile(
    r"\b(_actual_paint|is_forcing_paint|map_data|mark_finished|canvas_view|plot_view|renderer_views|repainted"
    r"|_send_msg|_handle_msg|_models|_debounce|get_serialized_svg|embed_items|events_el|v_compute|pixel_ratio"
    r"|source_range|silent)\b"
)


SCRIPTS = list(APP.rglob("*.js"))
EXPLORER = [*APP.glob("*.py"), *(APP / "explorer").rglob("*.py"), *(APP / "common").glob("*.py")]
MEASUREMENT = list((APP / "measurement").glob("*.py"))


def lines(paths):
    return [len(path.read_text(encoding="utf-8").splitlines()) for path in paths]


def test_files_can_be_read_at_once():
    assert max(lines(EXPLORER)) <= 370
    assert max(lines(MEASUREMENT)) <= 400


def test_nothing_private_of_the_toolkit_is_used():
    for path in [*APP.rglob("*.py"), *SCRIPTS]:
        text = path.read_text(encoding="utf-8")
        assert PRIVATE.findall(text) == [], path.name
        if path.suffix == ".js":
            assert re.findall(r"\.(_\w+)", text) == [], path.name


@cache
def imports(path):
    """Modules of the app that one of them imports, those for annotations included."""
    found, package = set(), path.parent
    tree = ast.parse(path.read_text(encoding="utf-8"))
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


def test_imports_point_down():
    floors = {path.relative_to(APP).as_posix(): floor(path) for path in APP.rglob("*.py")}
    # The seam is below the page, and above what extras bring.
    order = [floors[f"explorer/{name}.py"] for name in ("plot", "widgets", "page")]
    assert order == sorted(order)
    # What both pages use knows neither of them.
    for path in (APP / "common").glob("*.py"):
        assert all(each.parent == path.parent for each in imports(path))


def test_scripts_stand_in_files_of_their_own():
    for path in APP.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r'code="[^"]*[;=(]', text), path.name
