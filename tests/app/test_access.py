"""The pages without a mouse and without sight: keys, focus and its ring, landmarks, names, axe."""

import importlib.resources
from functools import cache

import pytest

from .colours import DARK, LIGHT, contrast, hexadecimal
from .conftest import DROP, FOCUSED, READY, Explorer

DESK, PHONE = (1280, 720), (390, 844)


def more(explorer):
    explorer.press("More about the medium")
    explorer.field("ρ").wait_for()


def guide(explorer):
    explorer.press("Guide")
    explorer.page.get_by_label("Guided scene").wait_for()


def share(explorer):
    explorer.press("Share")
    explorer.page.get_by_label("Link to this page").wait_for()


def silica(explorer):
    explorer.press("Sample: fused silica")
    explorer.page.locator(".big output").wait_for()
    for name in ("force", "residual"):
        explorer.page.locator(f".of-{name} canvas").first.wait_for()


def few_formulas(explorer):
    """Leave twenty of the formulas, which are alike and take a quarter of a minute."""
    formulas = "explorer.all().filter((each) => each.localName === 'math')"
    assert explorer.page.evaluate(f"{formulas}.slice(20).map((each) => each.remove()).length") > 100


#: Pages in their states: the query, what is done there, and how large the window is.
STATES = {
    "medium": ("", more, DESK),
    "impact, dark": (f"?preset={DROP}&tiles=energy&dark=1", None, DESK),
    "guide": ("", guide, DESK),
    "share": ("", share, DESK),
    "phone": ("", None, PHONE),
    "fit": ("?fit", None, DESK),
    "silica": ("?fit", silica, DESK),
    "theory": ("?theory", few_formulas, DESK),
}
#: Pages beside the explorer, and when they are there.
OTHERS = {"?fit": READY, "?theory": "document.querySelector('math')"}
MAIN = "main, [role=main]"


@pytest.fixture(scope="module", params=STATES)
def state(request, server, context):
    """A page that several tests look at, and none of them changes."""
    query, act, window = STATES[request.param]
    ready = OTHERS.get(query, "explorer.idle()")
    explorer = Explorer(context.new_page(), server.url + query, ready, window)
    explorer.page.locator(MAIN).wait_for(state="attached")
    # Each component links the sheets itself, and shows before they are there.
    explorer.wait("explorer.all().every((each) => !each.matches('link[rel=stylesheet]') || each.sheet)")
    if act:
        act(explorer)
    yield explorer
    assert explorer.problems == []
    # The theme, which all pages would have.
    explorer.page.evaluate("localStorage.clear()")
    explorer.page.close()


AXE = importlib.resources.files("axe_playwright_python").joinpath("axe.min.js").read_text(encoding="utf-8")


@cache
def findings(page):
    """What axe finds on a page when it is first asked: its impact, its rule, and the elements."""
    page.evaluate(AXE)
    # Sheets are fetched anew for one rule alone, of the orientation of a phone.
    options = "{ resultTypes: ['violations'], preload: false }"
    found = page.evaluate(f"axe.run(document, {options})")["violations"]
    return [(each["impact"], each["id"], [node["target"] for node in each["nodes"]]) for each in found]


#: What axe finds of these impacts keeps somebody from using the page.
GRAVE = ("serious", "critical")


def test_axe_finds_nothing_grave_and_all_is_within_landmarks_under_one_heading(state):
    page = state.page
    assert [each for each in findings(page) if each[0] in GRAVE] == []
    assert page.locator("h1").count() == 1
    assert page.locator(MAIN).count() == 1
    names = [rule for _, rule, _ in findings(page)]
    assert not {"region", "landmark-one-main", "landmark-unique", "page-has-heading-one"} & {*names}


def walk(explorer, most=120):
    """What takes the focus with the tab key, from the beginning of the page to its end."""
    explorer.page.evaluate("document.activeElement.blur(); getSelection().removeAllRanges()")
    explorer.page.evaluate("() => { document.body.tabIndex = -1; document.body.focus() }")
    found = []
    for _ in range(most):
        explorer.page.keyboard.press("Tab")
        now = explorer.page.evaluate(FOCUSED)
        if now is None:
            return found
        found.append(now)
    raise AssertionError("the focus does not leave the page")


def test_each_tab_stop_has_a_name_and_a_ring_that_is_seen_whole(state):
    """The ring has a contrast of 3 to both grounds (WCAG 2.2, 1.4.11)."""
    stops = walk(state)
    dark = state.page.evaluate("document.documentElement.classList.contains('dark')")
    colours = DARK if dark else LIGHT
    for stop in stops:
        assert stop["name"], stop
        assert stop["wide"] >= 1, stop
        # Less than a pixel is the rounding of places.
        assert stop["cut"] <= 1, stop
        # A canvas does nothing with keys.
        assert "bk-" not in stop["name"]
        for ground in ("paper", "ground"):
            assert contrast(hexadecimal(stop["colour"]), colours[ground]) >= 3, stop


def test_every_control_is_reached_by_keys(explorer):
    names = " ".join(stop["name"] for stop in walk(explorer))
    for control in (
        "Preset", "What is q_c, yield cons", "q_c, yield constant, slider", "Shape", "Share", "Guide",
        "Dark", "Compare", "▶ Play", "State along the path", "Large", "Fourth plot", "Hardness",
    ):  # fmt: skip
        assert control in names, control


def test_what_is_drawn_has_a_name_and_axe_would_find_a_field_without(explorer):
    """A fourth plot, too; a field that loses its name is found, also where it is inside of components."""
    explorer.open("Hardness", "hardness", "hardness")
    for name in ("springs", "pressure", "force", "hardness"):
        figure = explorer.page.locator(f".card.{name} [role=figure]").first
        assert ", over " in figure.get_attribute("aria-label"), name
    explorer.field("d_max").evaluate("(field) => { field.ariaLabel = null; field.id = 'other' }")
    assert ("critical", "label") in [each[:2] for each in findings(explorer.page)]


def test_both_ends_of_the_range_have_names(server, context):
    explorer = Explorer(context.new_page(), f"{server.url}?fit", READY)
    silica(explorer)
    for name in ("First sample of the fit", "Last sample of the fit"):
        explorer.page.get_by_role("slider", name=name).wait_for()
    # Also of another curve.
    explorer.press("Sample: gel by AFM")
    explorer.page.locator(".big output", has_text="kPa").wait_for()
    assert explorer.page.get_by_role("slider", name="Last sample of the fit").count() == 1
    assert explorer.problems == []
    explorer.page.close()


def test_the_first_tab_stop_leads_to_the_plots(explorer):
    page = explorer.page
    page.keyboard.press("Tab")
    link = page.get_by_role("link", name="Skip to the plots")
    assert link.bounding_box()["y"] >= 0
    page.keyboard.press("Enter")
    # The next one is the first button of a plot, in a page and not in the header.
    page.keyboard.press("Tab")
    assert page.evaluate(FOCUSED)["name"].endswith("Large")
    assert link.bounding_box()["y"] < 0


HAS_FOCUS = "(name) => explorer.all().some((each) => each.name === name && each.matches(':focus'))"


def test_undo_and_redo_have_their_keys_and_leave_the_focus_where_it_is(explorer):
    """*Redo* in the place of *Undo* would take the next Space. A button that disappears hands its focus on.

    A plot that becomes large is laid out anew.
    """
    page, now = explorer.page, explorer.page.keyboard.press
    depth = "explorer.row('force', 'now')[0][0]"
    explorer.change(explorer.type, "d_max", "5 nm")
    explorer.change(explorer.type, "d_max", "7 nm")
    explorer.slider("d_max").focus()
    for keys, expected in (
        ("Control+z", 5), ("Control+z", 8.978), ("Control+Shift+z", 5), ("Control+y", 7), ("z", 5),
    ):  # fmt: skip
        explorer.change(now, keys)
        # As it is shown, to three decimals.
        assert abs(page.evaluate(depth) - expected) < 1e-3, keys
        assert "d_max" in page.evaluate(FOCUSED)["name"]
    # In a field they are its own: it has again what stood there, and the scene stays.
    field = explorer.field("q_c")
    field.press_sequentially("6")
    field.press("Control+z")
    assert field.input_value() == "100 N/m"
    assert page.evaluate(depth) == 5
    explorer.change(page.locator(".act[name=Undo]").press, "Enter")
    explorer.wait(HAS_FOCUS, "Redo")
    page.locator(".card.force .act[name=Large]").press("Enter")
    for label in ("Small", "Large"):
        explorer.wait(HAS_FOCUS, label)
        now("Escape")
