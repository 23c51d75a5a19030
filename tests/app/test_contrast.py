"""Text and graphics stand out from their ground in both themes, as WCAG 2.2 AA asks (1.4.3, 1.4.11)."""

import re
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

import app
from mdr_core.show.figures import ROLES

from ..approx import approx

CSS = (Path(app.__file__).parent / "static" / "style.css").read_text(encoding="utf-8")


def variables(selector):
    block = re.search(rf"^{re.escape(selector)} \{{(.*?)^\}}", CSS, re.DOTALL | re.MULTILINE)[1]
    return dict(re.findall(r"--([\w-]+): (#\w+)", block))


LIGHT, DARK = variables(":root"), variables(":root.dark")
themes = pytest.mark.parametrize("colours", [LIGHT, DARK], ids=["light", "dark"])


def luminance(colour):
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    parts = [int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one, other):
    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)


def hexadecimal(colour):
    """A colour that a browser has computed."""
    return "#" + "".join(f"{int(part):02x}" for part in re.findall(r"\d+", colour)[:3])


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

    Areas end in an edge that stands out: where what is stored ends below the present state. The ribbon of
    the plastic zone has its name on it.
    """
    page = explorer.page
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


def test_play_is_loud_and_buttons_of_the_header_are_of_one_kind(explorer):
    """One filled button; the others have neither ground nor frame."""
    look = """(on) => {
      const { fontWeight, color, backgroundColor, borderColor } = getComputedStyle(on)
      return [fontWeight, color, backgroundColor, borderColor]
    }"""
    explorer.change(explorer.type, "d_max", "5 nm")
    names = ("▶ Play", "Guide", "Share", "Undo")
    play, guide, share, undo = (
        explorer.page.get_by_role("button", name=name, exact=True).evaluate(look) for name in names
    )
    accent, nothing = "rgb(0, 114, 178)", "rgba(0, 0, 0, 0)"
    assert play[:3] == ["600", "rgb(255, 255, 255)", accent]
    assert guide == share == undo == ["400", "rgb(34, 39, 46)", nothing, nothing]
