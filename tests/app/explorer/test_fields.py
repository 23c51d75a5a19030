"""Number fields: typed numbers, units, refusals and sliders."""

import json
from math import pi, radians, tan
from types import SimpleNamespace
from urllib.parse import parse_qsl

import numpy as np
import pytest

from app.common.quantities import QUANTITIES
from app.common.units import entry, read
from app.explorer import changes, link
from app.explorer.extras.pointer import Pointer
from app.explorer.page import Page
from app.explorer.state import preset_state
from app.explorer.widgets import Field
from mdr_core.show.units import UNITS, fitting

from ...approx import approx
from ..conftest import DROP, GOLD, Explorer
from ..states import SIZES, assert_draws, now, part

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
    drop.number("v_0").locator("p.said", has_text="1500 mm/s").filter(has_text="1.500 mm/s").wait_for()
    drop.change(drop.type, "v_0", "1,5 m/s")
    shows(drop, "v_0", "1.5 m/s")
    # The field stays in use after Enter: a letter is typed into it, and is no command.
    page.keyboard.press("r")
    assert field.input_value() == "r"
    page.keyboard.press("Escape")
    shows(drop, "v_0", "1.5 m/s")
    assert drop.link("speed=1.5")["mass"] == "0.7"


def test_a_slider_reaches_both_ends_and_returns_to_its_middle(server, context):
    """Steps have three digits; the ends are a thirtieth and 30 times the speed of the preset, or bounds."""
    explorer = Explorer(context.new_page(), f"{server.url}?preset={DROP}")
    slider, press = explorer.slider("v_0"), explorer.page.keyboard.press
    assert slider.input_value() == "200"
    slider.focus()
    for key, text in (("End", "30 m/s"), ("ArrowLeft", "29.5 m/s"), ("Home", "0.033333 m/s")):
        explorer.change(press, key)
        shows(explorer, "v_0", text)
    assert slider.input_value() == "0"
    explorer.change(slider.dblclick, position={"x": 3, "y": 2})
    shows(explorer, "v_0", "1 m/s")
    assert slider.input_value() == "200"
    # The drag is one step, and what resets it another.
    explorer.change(explorer.press, "Undo")
    explorer.change(explorer.press, "Undo")
    shows(explorer, "v_0", "1 m/s")
    assert explorer.page.get_by_role("button", name="Undo", exact=True).count() == 0
    explorer.pick("oblique")
    for key, bound in zip(("Home", "End"), QUANTITIES["oblique.attack"].bounds, strict=True):
        explorer.slider("α").focus()
        explorer.change(press, key)
        # As it is typed: fifteen digits.
        assert float(explorer.link("attack=")["oblique.attack"]) == approx(bound, rel=1e-14)
    shows(explorer, "α", "90°")
    assert explorer.problems == []
    explorer.page.close()


def seen(page, name):
    """What a field shows: its text and refusal. Without a browser."""
    look = part(page, name).look
    return look["text"], look["refused"]


def sent(page, name, text):
    """What a field shows after a text was typed."""
    part(page, name).act({"text": text})
    return seen(page, name)


def test_a_field_shows_the_unit_of_a_bare_number_also_where_the_number_stays():
    page = Page()
    assert sent(page, "max_depth", "20 nm") == ("20 nm", "")
    assert sent(page, "max_depth", "0.02 µm") == ("0.02 µm", "")
    assert sent(page, "max_depth", "0.03") == ("0.03 µm", "")
    assert page.state.max_depth == 3e-8
    # A refused unit is not that of the next number.
    assert sent(page, "max_depth", "1e9 mm")[0] == "0.03 µm"
    assert sent(page, "max_depth", "0.04") == ("0.04 µm", "")


def test_a_refusal_stays_while_an_earlier_number_is_solved_and_another_is_typed():
    page = Page(f"preset={DROP}")
    sent(page, "speed", "6 m/s")
    text, refused = sent(page, "E_star", "abc")
    assert "“abc”" in refused
    # A result that is found at rest is drawn.
    page.draw(page.state)
    assert seen(page, "E_star") == (text, refused)
    assert "“abc”" in sent(page, "speed", "abc")[1]
    page.draw(page.state)
    assert "“abc”" in seen(page, "speed")[1]
    assert sent(page, "speed", "4.5") == ("4.5 m/s", "")
    assert seen(page, "E_star")[1] == refused
    # The present number is typed instead.
    assert sent(page, "E_star", text) == (text, "")


@pytest.mark.parametrize("shown", UNITS["length"])
def test_an_angstrom_is_shown_as_such_in_any_field(shown):
    page = Page()
    sent(page, "max_depth", f"{preset_state().max_depth / shown.factor!r} {shown.name}")
    assert sent(page, "max_depth", "9 Å") == ("9 Å", "")
    assert page.state.max_depth == 9e-10
    assert sent(page, "max_depth", "12") == ("12 Å", "")
    assert read("3 um", "length", shown)[1].name == "µm"


def test_whatever_a_field_is_sent_is_refused_or_ignored():
    page = Page()
    field = part(page, "max_depth")
    shown = field.look["text"]
    # What no field and no slider can send is ignored.
    for message in (
        None, 3, "5 nm", ["5 nm"], {}, {"text": None}, {"text": 5e-9}, {"text": ["5 nm"]}, {"value": "NaN"},
        {"value": float("nan"), "dragged": True}, {"value": 1e999, "dragged": True}, {"value": 10**400},
        {"value": None},
    ):  # fmt: skip
        field.act(message)
        assert seen(page, "max_depth") == (shown, ""), message
    for message in ({"text": "9" * 9999}, {"text": "1e999"}, {"value": 1e9, "dragged": True}):
        field.act(message)
        assert seen(page, "max_depth")[1] != "", message
        assert page.state == preset_state()
        assert page.history.at == 0


def test_a_number_that_others_change_is_in_the_unit_that_reads_best():
    """2 m/s, not 2000 mm/s, after a guided scene of centimetres a second; a typed unit stays."""
    field, state = Field("speed", None), preset_state(DROP)
    assert field.part(state.replace(speed=0.02, preset=GOLD)).look["text"] == "20 mm/s"
    assert field.part(state.replace(speed=2.0, preset=GOLD)).look["text"] == "2 m/s"
    assert field.part(state.replace(speed=0.2, preset=GOLD)).look["text"] == "0.2 m/s"
    # Two zeros after the point are the most.
    assert field.part(state.replace(speed=1.05e-3, preset=GOLD)).look["text"] == "0.00105 m/s"
    assert field.part(state.replace(speed=0.95e-3, preset=GOLD)).look["text"] == "950 µm/s"


def test_a_refused_number_stays_until_it_is_another_or_all_is_set_anew(page):
    part(page, "max_depth").act({"text": "5 nm"})
    part(page, "q_c").act({"text": "abc"})
    refused = part(page, "q_c").look["refused"]
    assert "“abc”" in refused
    assert all(unit.name in refused for unit in UNITS["yield constant"])
    page.undo()
    assert part(page, "q_c").look["refused"] == refused
    page.apply(lambda state: changes.set_value(state, "q_c", 50.0))
    assert seen(page, "q_c") == ("50 N/m", "")
    part(page, "q_c").act({"text": "abc"})
    page.choose("preset", DROP)
    assert part(page, "q_c").look["refused"] == ""


def test_a_message_that_names_no_part_is_answered_and_changes_nothing(page):
    before, form = page.state, page.layout.form.view
    for name in ("nothing", ["max_depth"], 3, None):
        form._on_message(SimpleNamespace(data=(name, {"text": "5 nm"})))
    assert page.state == before
    # Four answers; the fifth is that of a number.
    form._on_message(SimpleNamespace(data=("max_depth", {"text": "5 nm"})))
    assert page.state.max_depth == 5e-9
    assert json.loads(form.payload)[0] == 5


@pytest.mark.parametrize(
    ("query", "change"),
    [
        ("", lambda state: changes.set_value(state, "E_star", 9e13)),
        ("", lambda state: changes.set_value(state, "cone_slope", 0.0)),
        ("drive=force&max_force=1e5", lambda state: changes.choose(state, "drive", "depth")),
        ("max_depth=1e-12", lambda state: changes.choose(state, "drive", "impact")),
    ],
)
def test_a_number_that_a_change_leads_to_is_refused_beyond_its_bounds(page, query, change):
    page.apply(lambda state: link.read(query))
    before = page.state
    page.apply(change)
    (notice,) = page.notices
    assert "bounds" in notice
    assert page.state == before


def shown_in_field(state, name):
    """The number (SI) that a field shows."""
    number, _, unit = Field(name, None).part(state).look["text"].partition(" ")
    return float(number) * SIZES.get(unit, 1.0)


@pytest.mark.parametrize(
    ("query", "change", "name"),
    [
        ("elasticity=modulus&E_star=86806041176.72249", lambda state: state, "E_star"),
        ("q_c=98.76543210123", lambda state: state, "q_c"),
        ("", lambda state: changes.set_value(state, "E_star", 80e9), "E_1"),
        (
            "",
            lambda state: changes.set_value(state, "cone_slope", 1 / np.tan(np.radians(68))),
            "cone_slope",
        ),
        (f"preset={DROP}", changes.repeat_impact, "plastic_depth"),
        ("", lambda state: changes.choose(state, "plasticity", "constant"), "volume_hardness"),
        ("max_depth=1.23456789e-9", lambda state: state, "max_depth"),
    ],
)
def test_the_address_has_the_digits_of_the_field(query, change, name):
    page = Page(query)
    page.apply(change)
    written = dict(parse_qsl(page.query()[0]))[name]
    assert float(written) == approx(shown_in_field(page.state, name), rel=1e-13)
    digits = f"{float(written):.15e}".partition("e")[0].replace(".", "").rstrip("0")
    assert len(digits) <= 9
    # What is opened from it shows the same, and has the same address.
    again = Page(page.query()[0])
    assert shown_in_field(again.state, name) == approx(shown_in_field(page.state, name), rel=1e-13)
    assert again.query() == page.query()


def test_a_dragged_number_is_the_one_that_is_shown_and_used(page):
    """What is typed has nine digits, what is dragged five."""
    part(page, "max_depth").act({"text": "8.12345678 nm"})
    assert part(page, "max_depth").look["text"] == "8.12345678 nm"
    (dragging,) = (each for each in page.services if isinstance(each, Pointer))
    dragging.drag.depth = 10.987654321
    assert page.state.max_depth == approx(shown_in_field(page.state, "max_depth"), rel=1e-12)
    assert float(page.view.course.turning_point.depth) == page.state.max_depth
    page.choose("drive", "force")
    assert page.state.max_force == approx(shown_in_field(page.state, "max_force"), rel=1e-12)


def test_typed_numbers_are_read_as_they_say_refused_where_they_stand_and_undone(explorer):
    """What is refused stays in its field, which says why."""
    number, field = explorer.number("d_max"), explorer.field("d_max")
    assert number.locator(".ends span").all_inner_texts() == ["299 pm", "logarithmic", "269 nm"]
    explorer.change(explorer.type, "d_max", "1e3")
    assert now(explorer)[0] == approx(1e-6)
    # In the unit that the field shows, with an exponent or without.
    assert field.input_value() == "1000 nm"
    # Its slider begins anew about what it does not reach.
    assert explorer.slider("d_max").input_value() == "200"
    explorer.change(explorer.press, "Undo")
    # The bound of the depth is 10 m.
    for text, why in {"abc": "abc", "1000 m": "10.00 m", "<img src=x>": "<img src=x>"}.items():
        explorer.type("d_max", text)
        number.locator("p.said", has_text=why).wait_for()
        assert field.input_value() == text
        assert field.get_attribute("aria-invalid") == "true"
        assert number.locator("img").count() == 0
    assert_draws(explorer, preset_state())
    explorer.change(explorer.type, "d_max", "5 nm")
    assert field.get_attribute("aria-invalid") == "false"
    explorer.change(explorer.slider("d_max").dblclick, position={"x": 3, "y": 2})
    explorer.wait("explorer.row('force', 'now')[0][0].toFixed(3) === '8.978'")


TYPED = [
    ("25", "length", 25e-9), ("2,5", "length", 2.5e-9), ("1e1", "length", 1e-8), ("1e-6 m", "length", 1e-6),
    ("5 Å", "length", 5e-10),
    ("0.012 µm", "length", 12e-9), ("3e-3um", "length", 3e-9), ("10 000 nm", "length", 1e-5),
    ("10\u202f000 nm", "length", 1e-5), ("70.3°", "slope", 1 / tan(radians(70.3))), ("0.36", "slope", 0.36),
    ("90", "angle", pi / 2), ("0,125", "length", 0.125e-9), ("1234,567 nm", "length", 1234.567e-9),
]  # fmt: skip


@pytest.mark.parametrize(("text", "kind", "value"), TYPED)
def test_typed_numbers(text, kind, value):
    shown = fitting(9e-9 if kind == "length" else 0.3, kind)
    assert read(text, kind, shown)[0] == approx(value, rel=1e-14)


@pytest.mark.parametrize("text", ["1,500 nm", "-12,345", "−999,000 nm"])
def test_a_comma_that_may_separate_thousands_is_refused_with_both_readings(text):
    whole, part = (text.replace(",", instead).replace("−", "-") for instead in ("", "."))
    with pytest.raises(ValueError, match=f"“{text}” can be {whole} or {part}: type one of these"):
        read(text, "length", fitting(9e-9, "length"))


def test_a_zero_has_the_unit_of_its_column():
    """A bare 5 typed over it is 5 nm, not 5 m."""
    unit = fitting(0.0, "length", 9e-9)
    assert entry(0.0, unit) == "0 nm"
    assert read("5", "length", unit) == (5e-9, unit)


@pytest.mark.parametrize("text", ["", "abc", "1e999", "nan", "3 MPa", "1,5,2", "1.000,5", "<b>", "5°"])
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"is not a number|too large"):
        read(text, "length", fitting(9e-9, "length"))


@pytest.mark.parametrize("kind", UNITS)
def test_what_is_written_is_read_again(kind):
    for unit in UNITS[kind]:
        value = 12.345 * unit.factor
        again, found = read(entry(value, unit), kind, unit)
        assert again == approx(value, rel=1e-12)
        assert found == unit
