"""Themes: who chooses them, contrast in both (WCAG 2.2, 1.4.3 and 1.4.11), and the style sheets."""

import re
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

import app
from app.explorer.page import Page
from mdr_core.show.figures import ROLES

from ..approx import approx
from .colours import CSS, DARK, LIGHT, contrast, hexadecimal, luminance
from .conftest import Explorer

themes = pytest.mark.parametrize("colours", [LIGHT, DARK], ids=["light", "dark"])


@themes
def test_text_stands_out(colours):
    """Every colour that the sheet writes in, on both grounds, and what is written on a pressed button."""
    written = set(re.findall(r"(?<![-\w])color: var\(--(\w+)\)", CSS)) - {"paper"}
    # The colours of swatches in legends and of what is disabled are not those of text.
    written -= set(re.findall(r"\bi \{ color: var\(--(\w+)\)", CSS)) - {"ink", "elastic"}
    written -= set(re.findall(r"\[disabled\] \{ color: var\(--(\w+)\)", CSS))
    written -= set(re.findall(r'content: "[^"]+"; color: var\(--(\w+)\)', CSS))
    assert {"ink", "soft", "elastic", "warn"} <= written
    for name in written:
        for ground in ("paper", "ground"):
            assert contrast(colours[name], colours[ground]) >= 4.5, (name, ground)
    assert contrast(colours["paper"], colours["elastic"]) >= 4.5


@themes
def test_graphics_stand_out(colours):
    """Curves, marks, axes, edges of fields and signs; a body is seen by its edge, which is ink."""
    for name in ("free", "elastic", "yielded", "held", "speed", "loss", "ink", "tick", "edge", "good"):
        assert contrast(colours[name], colours["paper"]) >= 3, name
    for name in ("good", "yielded", "edge"):
        assert contrast(colours[name], colours["ground"]) >= 3, name


def test_plots_have_the_colours_of_the_sheet():
    for role in ROLES.keys() & LIGHT:
        sheet = luminance(LIGHT[role]), luminance(DARK[role])
        assert tuple(map(luminance, ROLES[role])) == approx(sheet), role


# Every text that is seen, with its colour and that of its ground.
TEXTS = """() => {
  const ground = (on) => {
    for (; on; on = on.parentElement ?? on.getRootNode().host) {
      const { backgroundColor } = getComputedStyle(on)
      if (!/, 0\\)$|transparent/.test(backgroundColor)) return backgroundColor
    }
    return "rgb(255, 255, 255)"
  }
  const own = (on) => [...on.childNodes].map((n) => n.nodeType === 3 && n.data.trim()).find(Boolean)
  const texts = explorer.all().filter((on) => on.matches(":not(style, script, option, [disabled])"))
  return texts.filter((on) => own(on) && on.checkVisibility())
    .map((on) => [own(on), getComputedStyle(on).color, ground(on)])
}"""


def test_every_text_of_the_page_is_read_in_the_dark(explorer):
    """In each part of the side, within a theme that is changed by its key.

    The button that plays is the one that is filled; those of the header have neither ground nor frame.
    Areas end in an edge that stands out: where what is stored ends below the present state. The ribbon of
    the plastic zone has its name on it.
    """
    page = explorer.page
    look = """(on) => {
      const { fontWeight, backgroundColor, borderColor } = getComputedStyle(on)
      return [fontWeight, backgroundColor, borderColor]
    }"""
    play, *others = (
        page.get_by_role("button", name=name, exact=True).evaluate(look)
        for name in ("▶ Play", "Guide", "Share")
    )
    nothing = "rgba(0, 0, 0, 0)"
    assert play[:2] == ["600", "rgb(0, 114, 178)"]
    assert others == 2 * [["400", nothing, nothing]]
    explorer.press("Dark")
    explorer.wait("document.documentElement.classList.contains('dark')")

    def pixels(clip):
        with Image.open(BytesIO(page.screenshot(clip=clip))) as seen:
            return {hexadecimal(str(pixel)) for _, pixel in seen.convert("RGB").getcolors()}

    x, y = explorer.place("force", "now", 0)
    below = pixels({"x": x - 3, "y": y + 100, "width": 6, "height": 1})
    assert max(contrast(pixel, DARK["paper"]) for pixel in below) >= 3, below
    x, y = explorer.place("force", "plastic zone, on loading", 0)
    (ribbon,) = pixels({"x": x + 6, "y": y, "width": 2, "height": 2})
    assert ribbon != DARK["paper"]
    assert contrast(ROLES["yielded-text"][1], ribbon) >= 4.5
    for part in ("Guide", "Share"):
        explorer.press(part)
        for text, *pair in page.evaluate(TEXTS):
            colours = list(map(hexadecimal, pair))
            assert contrast(*colours) >= 4.5, (part, text, colours)


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
def test_lines_are_short(path):
    css = path.read_text(encoding="utf-8")
    assert [line for line in css.splitlines() if len(line) > 132] == []


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


#: Themes of a page since before its document is parsed.
THEMES = """
  window.themes = []
  new MutationObserver(() => {
    if (document.body) themes.push(document.documentElement.classList.contains("dark"))
  }).observe(document, { childList: true, subtree: true })
"""
IS_DARK = "document.documentElement.classList.contains('dark')"


def test_the_theme_is_that_of_the_system_until_another_one_is_chosen_or_asked_for(server, browser):
    """The browser keeps what is chosen; a link has it only if it was opened with it."""
    window = {"width": 1280, "height": 720}
    with browser.new_context(viewport=window, color_scheme="dark") as context:
        page = context.new_page()
        page.add_init_script(THEMES)
        explorer = Explorer(page, server.url)
        explorer.wait(IS_DARK)
        # Of a second visit the server draws the data so, too, and the page is dark from the beginning.
        explorer.goto(server.url)
        assert set(page.evaluate("themes")) == {True}
        cookies = "; ".join(f"{each['name']}={each['value']}" for each in context.cookies())
        assert "#e4e7eb" in page.request.get(server.url, headers={"cookie": cookies}).text()
        explorer.press("Dark")
        explorer.wait(f"!{IS_DARK}")
        explorer.change(explorer.type, "q_c", "80")
        assert explorer.link("q_c=80") == {"q_c": "80.0"}
        # A link that asks for it is followed, and stays as it is; the browser keeps its own.
        explorer.goto(f"{server.url}?dark=1")
        explorer.wait(IS_DARK)
        explorer.change(explorer.type, "q_c", "70")
        assert explorer.link("q_c=70") == {"q_c": "70.0", "dark": "1"}
        explorer.goto(server.url)
        explorer.wait(f"!{IS_DARK}")
        assert explorer.problems == []


def test_a_page_opens_in_the_theme_that_the_browser_has_told():
    dark = Page("", True)
    assert dark.state.dark
    ink = dark.layout.cards["force"].picture.layers[-1].source.data["text_color"][0]
    assert ink == "#e4e7eb"
    # A link that asks for a theme is right; the address then has it.
    assert not Page("dark=0", True).state.dark
    assert dark.query()[0] == ""
