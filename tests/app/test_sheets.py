"""Style sheets are read by people: one place for each thing, short lines, and one set of tokens."""

import re
from pathlib import Path

import pytest

import app

APP = Path(app.__file__).parent
SHEETS = sorted(APP.rglob("*.css"))


def selectors(css):
    """Selectors of the rules outside of media rules, each of a list of them."""
    css = re.sub(r"/\*.*?\*/", "", css, flags=re.DOTALL)
    depth, start, found, within = 0, 0, [], False
    for k, letter in enumerate(css):
        if letter == "{":
            head = css[start:k].strip()
            within = within or (depth == 0 and head.startswith("@"))
            if depth == 0 and not within:
                found += [each.strip() for each in re.split(r",(?![^(]*\))", head)]
            depth += 1
        elif letter == "}":
            depth -= 1
            within = within and depth > 0
        if letter in "{};":
            start = k + 1
    return found


@pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.name)
def test_a_selector_is_defined_once_outside_media_rules(path):
    found = selectors(path.read_text(encoding="utf-8"))
    assert found
    assert sorted({each for each in found if found.count(each) > 1}) == []


@pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.name)
def test_lines_are_short_and_places_are_said(path):
    css = path.read_text(encoding="utf-8")
    assert [line for line in css.splitlines() if len(line) > 132] == []
    # What stands before all else says so in the document, not by a number below zero.
    assert re.findall(r"order: -\d", css) == []


def test_dark_is_the_same_design():
    """The same tokens, of which the dark theme has other colours and shadows."""
    css = (APP / "static" / "style.css").read_text(encoding="utf-8")
    blocks = {
        name: re.search(rf"^{re.escape(name)} \{{(.*?)^\}}", css, re.DOTALL | re.MULTILINE)[1]
        for name in (":root", ":root.dark")
    }
    light, dark = (dict(re.findall(r"--([\w-]+): ([^;]+);", block)) for block in blocks.values())
    assert dark.keys() <= light.keys()
    assert [name for name, value in light.items() if value.startswith("#") and name not in dark] == []
    # No rule outside of them names a colour of its own.
    rest = css.replace(blocks[":root"], "").replace(blocks[":root.dark"], "")
    assert re.findall(r"#[0-9a-f]{3,6}\b", rest) == []
