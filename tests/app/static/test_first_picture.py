"""The first picture of the page without a server: a drawing of the preset, until Python has started."""

from pathlib import Path

import pytest

from app.explorer import readouts
from app.explorer.page import Page
from app.explorer.state import PRESETS
from mdr_explorer import static

from ..conftest import DROP, ELASTIC, GOLD, PUNCH
from .conftest import host_of


@pytest.fixture(scope="module")
def started(browser, written):
    """Opens a link to the page, without Python: the drawings that it asks for, and the page itself."""
    with (
        host_of(written[0]) as address,
        browser.new_context(viewport={"width": 1280, "height": 720}) as context,
    ):
        # Not answered: the page waits.
        context.route(f"{static.PUBLISHED}**", lambda route: None)

        def start(query):
            page, asked = context.new_page(), []
            page.on("request", lambda request: asked.append(request.url))
            page.goto(address + query)
            page.frame_locator("#start iframe").locator("#player input").wait_for()
            return [Path(url).stem for url in asked if "/drawings/" in url], page

        yield start
        context.unroute_all(behavior="ignoreErrors")


#: Links to a preset as it is, and what follows on its name: nothing, a theme, what other sites append.
AS_IT_IS = {
    "": GOLD, f"?preset={DROP}&dark=1": DROP, f"?utm_source=course&preset={ELASTIC}&fbclid=I": ELASTIC,
}  # fmt: skip
#: Links to other scenes, and some that the page will refuse.
OTHERS = (
    f"?preset={PUNCH}&max_depth=5e-5", "?tiles=hardness", "?preset=none", "?preset=../theory",
    f"?preset={PUNCH}&preset={DROP}",
)  # fmt: skip


@pytest.mark.parametrize("query", AS_IT_IS)
def test_a_preset_is_drawn_at_once_and_plays(query, started):
    """And no drawing of another one is loaded."""
    preset = AS_IT_IS[query]
    asked, page = started(query)
    assert asked == [preset]
    drawing = page.frame_locator("#start iframe")
    assert drawing.locator("h1").inner_text() == PRESETS[preset].label
    view = Page(f"preset={preset}").view
    numbers = readouts.line(view.course)
    each = next(iter(numbers))
    expected = readouts.text(each, numbers[each], view.course.now)
    readout = drawing.locator(f'output[data-name="{each.name}"]')
    assert readout.inner_text() == expected
    drawing.locator("#player input").press("Home")
    assert readout.inner_text() != expected
    assert page.locator("#start .follows").count() == 0
    dark = "document.documentElement.classList.contains('dark')"
    assert page.evaluate(dark) == page.frames[1].evaluate(dark) == ("dark=1" in query)
    page.close()


@pytest.mark.parametrize("query", OTHERS)
def test_another_scene_is_announced_over_the_opening_one(query, started):
    """That one is dimmed, and neither played nor read aloud: its numbers are not those of the link."""
    asked, page = started(query)
    assert asked == [GOLD]
    assert page.get_by_text("Your scene follows").is_visible()
    drawing = page.locator("#start iframe")
    assert float(drawing.evaluate("(each) => getComputedStyle(each).opacity")) < 0.5
    box = drawing.bounding_box()
    page.mouse.click(box["x"] + 60, box["y"] + 100)
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.localName") != "iframe"
    page.close()


def test_what_does_not_start_announces_no_scene(started):
    _, page = started(OTHERS[0])
    page.route(f"{static.PUBLISHED}**", lambda route: route.abort())
    page.reload()
    page.get_by_role("alert").filter(has_text="could not be started").wait_for()
    assert page.get_by_text("Your scene follows").count() == 0
    page.close()
