"""Keys: undo, focus, and a way to every control."""

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
