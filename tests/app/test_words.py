"""Texts of errors and of HTML on the page."""

import ast
import re

import pytest

import mdr_core as mdr
from app.common import ui
from app.common.errors import error_text, text_and_remedy, without_folders

from .conftest import ROOT
from .states import HOSTILE


def test_a_message_of_the_core_has_symbols_and_the_units_that_fit():
    """Instead of names of Python and SI; a message without them stays as it is."""
    with pytest.raises(ValueError, match="E_star") as refused:
        mdr.Medium(E_star=-2e9, q_c=1.0)
    said = error_text(refused.value)
    assert said.startswith("E*")
    assert "−2.000 GPa" in said
    with pytest.raises(ValueError, match=r"4\.39823e-05 N") as refused:
        mdr.indent_to_force(mdr.FlatPunch(1e-6), mdr.Medium(E_star=1e9, q_c=14.0), 45.14e-6)
    said = error_text(refused.value)
    assert "45.14 µN" in said
    assert "43.98 µN" in said
    assert "e-0" not in said
    assert error_text(ValueError("no contact")) == "no contact"


def test_messages_have_no_folder_of_the_server():
    for text, said in (
        ("no such file: '/tmp/mdr-explorer-x/abc/file 1.jpk-force'", "no such file: 'file 1.jpk-force'"),
        ("C:\\Users\\me\\AppData\\file 1.csv is damaged", "file 1.csv is damaged"),
        ("/usr/lib/python3/site-packages/afm/read.py failed", "read.py failed"),
        ("h/d_max, 5 nm/s and N/m² of W/(m K)", "h/d_max, 5 nm/s and N/m² of W/(m K)"),
    ):
        assert without_folders(text) == said


def test_a_message_that_quotes_a_file_has_a_bound():
    assert len(text_and_remedy(ValueError("1" * 10_000))[0]) == 2000


def test_a_text_is_shown_as_it_is_and_never_taken_for_html():
    makers = (
        ui.as_html,
        ui.html_subscripts,
        ui.symbol,
        ui.linked,
        ui.notice,
        lambda text: ui.html(text).object,
    )
    for text in HOSTILE:
        for make in makers:
            assert "<" not in re.sub(r"</?(i|sub)>", "", make(text))
        # In an attribute, too.
        assert not {'"', "'"} & {*ui.as_html(text)}


def test_html_is_made_of_literals_of_the_page_alone():
    """A text of somebody can only be formatted into HTML, which escapes it; `ui` reads own files."""
    made = 0
    for path in sorted((ROOT / "app").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            called = isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1]
            if called in ("Markup", "HTML"):
                literal = all(isinstance(each, ast.Constant) for each in node.args)
                assert literal or path.name == "ui.py", (path.name, node.lineno)
                made += 1
            # What is shown goes through `show`, which escapes.
            if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
                assert node.attr != "object", (path.name, node.lineno)
    assert made > 30
