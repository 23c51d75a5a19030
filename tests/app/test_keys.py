"""Keys: undo, focus, and a way to every control."""

from .colours import LIGHT, contrast, hexadecimal
from .conftest import FOCUSED


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


def test_undo_and_redo_have_their_keys(explorer):
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
    # In a field they are its own: it has again what stood there, and the scene stays.
    field = explorer.field("q_c")
    field.press_sequentially("6")
    field.press("Control+z")
    assert field.input_value() == "100 N/m"
    assert page.evaluate(depth) == 5


HAS_FOCUS = "(name) => explorer.all().some((each) => each.name === name && each.matches(':focus'))"


def test_a_button_that_changes_the_page_leaves_the_focus_where_it_was(explorer):
    """A plot that becomes large is laid out anew, and the button to undo is gone after the last step."""
    page = explorer.page
    page.locator(".card.force .act[name=Large]").press("Enter")
    for label in ("Small", "Large"):
        explorer.wait(HAS_FOCUS, label)
        page.keyboard.press("Escape")
    explorer.change(explorer.slider("q_c").press, "PageUp")
    page.locator(".act[name=Undo]").press("Enter")
    explorer.wait(HAS_FOCUS, "Redo")


def test_escape_in_the_link_closes_what_it_is_in(explorer):
    """Before a large plot that lies below."""
    page = explorer.page
    page.locator(".card.force .act[name=Large]").click()
    explorer.press("Share")
    page.get_by_label("Link to this page").click()
    page.keyboard.press("Escape")
    page.get_by_label("Link to this page").wait_for(state="hidden")
    assert page.locator(".card.force .act[name=Small]").is_visible()
    page.keyboard.press("Escape")
    page.locator(".card.force .act[name=Large]").wait_for()


NAME = """() => {
  let on = document.activeElement
  while (on?.shadowRoot?.activeElement) on = on.shadowRoot.activeElement
  return on?.ariaLabel ?? on?.textContent ?? ""
}"""


def test_a_key_that_undoes_leaves_the_focus_where_it_is(explorer):
    """*Undo*, which Ctrl+Z acts on, disappears; *Redo* in its place would have taken the next Space."""
    page = explorer.page
    explorer.change(explorer.type, "d_max", "5 nm")
    explorer.slider("d_max").focus()
    explorer.change(page.keyboard.press, "Control+z")
    assert page.get_by_role("button", name="Undo").count() == 0
    assert page.evaluate(NAME) == "d_max, largest depth, slider"
    assert explorer.readout("depth") == "8.978 nm"
    # A button that is pressed and disappears hands its focus on, as ever.
    explorer.change(explorer.type, "d_max", "5 nm")
    page.get_by_role("button", name="Undo").focus()
    explorer.change(page.keyboard.press, "Enter")
    assert page.evaluate(NAME) == "Redo"


def test_everything_is_reached_by_keys_and_an_equation_leads_to_the_theory(explorer, context):
    """From one stop of the Tab key to the next, every control and explanation comes by, and is outlined.

    The outline has a contrast of 3 to both grounds (WCAG 2.2, 1.4.11).
    """
    page = explorer.page
    page.locator("h1").click()
    stops = set()
    active = """() => {
        let on = document.activeElement
        while (on?.shadowRoot?.activeElement) on = on.shadowRoot.activeElement
        if (on === document.body) return ["", "", "rgb(0, 0, 0)"]
        return [on.ariaLabel || on.labels?.[0]?.textContent.trim() || on.textContent.trim(),
                getComputedStyle(on).outlineStyle, getComputedStyle(on).outlineColor]
    }"""
    for _ in range(80):
        page.keyboard.press("Tab")
        name, outline, colour = page.evaluate(active)
        stops.add(name)
        assert outline != "none", name
        for ground in ("paper", "ground"):
            assert contrast(hexadecimal(colour), LIGHT[ground]) >= 3, name
    expected = {
        "Preset", "What is q_c, yield constant?", "q_c, yield constant", "q_c, yield constant, slider",
        "Shape", "Share", "Guide", "Dark", "Compare", "▶ Play", "State along the path",
        "Large", "Fourth plot", "Hardness",
    }  # fmt: skip
    assert expected <= stops
    with context.expect_page() as opened:
        page.get_by_text("Numbers, equations, assumptions").click()
        page.locator("dd", has_text="∫ a(s) ds").last.get_by_role("link", name="(22)").click()
    page = opened.value
    # The formulas are set, and the page stands where the equation is.
    page.locator("math").first.wait_for()
    page.wait_for_function("scrollY > 500")
    assert page.locator("#eq-22").bounding_box()["y"] < 100
    page.close()
