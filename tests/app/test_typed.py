"""Numbers typed into the form: none is lost, and each has the unit that a person saw or wrote."""

import pytest

from .conftest import DROP, Explorer

# Answers of the server can be held up on their way, as when it is still solving.
HELD = """
const { get, set } = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage")
Object.defineProperty(WebSocket.prototype, "onmessage", {
  get,
  set(heard) { set.call(this, (event) => (window.held ? held.push(() => heard(event)) : heard(event))) },
})
window.release = () => { for (const each of held) each(); window.held = null }
"""


@pytest.fixture(scope="module")
def drop(server, context):
    """An impact, on a page that can be cut off from the answers of the server."""
    page = context.new_page()
    page.add_init_script(HELD)
    explorer = Explorer(page, f"{server.url}?preset={DROP}")
    yield explorer
    assert explorer.problems == []
    page.close()


def shows(explorer, symbol, text):
    """Wait until a field has a text."""
    explorer.wait("([on, text]) => on.value === text", [explorer.field(symbol).element_handle(), text])


def test_a_number_typed_while_an_earlier_one_is_solved_is_kept(drop):
    page, field = drop.page, drop.field("v_0")
    page.evaluate("window.held = []")
    drop.type("v_0", "1.285")
    drop.wait("held.length > 0")
    # The answer comes while the next number is being typed.
    field.fill("12.84")
    drop.change(page.evaluate, "release()")
    assert field.input_value() == "12.84"
    page.keyboard.type("6")
    page.evaluate("window.held = []")
    field.press("Enter")
    # And this one while a third and a fourth are on their way, which are solved in the order of typing.
    drop.type("v_0", "9.25")
    drop.type("m", "11")
    drop.wait("held.length > 0")
    drop.change(page.evaluate, "release()")
    shows(drop, "v_0", "9.25 m/s")
    shows(drop, "m", "11 kg")
    assert drop.link("mass=11")["speed"] == "9.25"
    drop.change(drop.press, "Undo")
    drop.change(drop.press, "Undo")
    shows(drop, "v_0", "12.846 m/s")
    shows(drop, "m", "5.5 kg")


def test_a_bare_number_has_the_unit_that_was_last_seen_and_only_typing_changes_it(drop):
    page, field = drop.page, drop.field("v_0")
    drop.change(drop.type, "v_0", "0.25 m/s")
    shows(drop, "v_0", "0.25 m/s")
    drop.slider("v_0").focus()
    drop.change(page.keyboard.press, "PageUp")
    assert field.input_value().endswith(" m/s")
    # Another field's number leaves it, and so does a bare one of any size.
    drop.change(drop.type, "m", "700 g")
    drop.change(drop.type, "v_0", "0.0004")
    shows(drop, "v_0", "0.0004 m/s")
    drop.change(drop.type, "v_0", "12.5")
    assert drop.link("speed=12.5")["mass"] == "0.7"
    drop.change(drop.type, "v_0", "750 mm/s")
    drop.change(drop.type, "v_0", "900")
    shows(drop, "v_0", "900 mm/s")
    # Refused: 1500 or 1.5, which are both in bounds.
    drop.type("v_0", "1,500 mm/s")
    said = "“1,500 mm/s” can be 1500 mm/s or 1.500 mm/s: type one of these"
    drop.number("v_0").locator("#said", has_text=said).wait_for()
    drop.change(drop.type, "v_0", "1,5 m/s")
    shows(drop, "v_0", "1.5 m/s")
    # The field stays in use after Enter: a letter is typed into it, and is no command.
    page.keyboard.press("r")
    assert field.input_value() == "r"
    page.keyboard.press("Escape")
    shows(drop, "v_0", "1.5 m/s")
    assert drop.link("speed=1.5")["mass"] == "0.7"
