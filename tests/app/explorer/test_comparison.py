"""Compared scenes: names, rows, the table of numbers, the link and their limit."""

import re

import numpy as np
import pytest
from markupsafe import Markup

from app.explorer import changes, link
from app.explorer.changes import set_value
from app.explorer.drives import follow
from app.explorer.extras.comparison import (
    DASHES,
    computed,
    difference,
    held_scene,
    is_held,
    numbers,
    toggle_hold,
)
from app.explorer.figures import Picture, drawn, legend
from app.explorer.page import Page
from app.explorer.plot import rows_of
from app.explorer.plots import PLOTS, D, F, X, Z
from app.explorer.state import PRESETS, medium, preset_state
from mdr_core.show.units import format_quantity

from ...approx import approx
from ..conftest import DROP, GOLD, Explorer
from ..states import linked_state, press, state_with, view_of


def depths(state):
    """Largest depths of the scenes that are held."""
    return [held_scene(query).course.turning_point.depth for query in state["held.scenes"]]


def holding(*depths):
    """A state that has held itself at some depths."""
    state = preset_state()
    for depth in depths:
        state = toggle_hold(state.replace(max_depth=depth))
    return state


def test_one_gesture_holds_a_scene_and_lets_it_go():
    state = holding(6e-9, 9e-9)
    assert depths(state) == [6e-9, 9e-9]
    assert is_held(state.replace(at=0.4))
    assert all(len(query) < 100 for query in state["held.scenes"])
    state = toggle_hold(state)
    assert depths(state) == [6e-9]
    assert not is_held(state)


def test_a_fifth_is_refused():
    state = holding(1e-9, 2e-9, 3e-9, 4e-9)
    assert len(state["held.scenes"]) == len(DASHES) == 4
    with pytest.raises(ValueError, match="remove one"):
        toggle_hold(state.replace(max_depth=5e-9))
    with pytest.raises(ValueError, match="more than 4"):
        linked_state(state.replace(**{"held.scenes": (*state["held.scenes"], state["held.scenes"][0])}))


def test_the_numbers_are_those_of_the_deepest_state_and_of_the_impact():
    course = follow(preset_state(DROP).replace(at=0.3))
    found = numbers(course)
    assert found["e"] == format_quantity(float(course.hit.restitution), "number", 3)
    assert found["d"] == format_quantity(float(course.hit.max_depth), "length", 3)
    assert "e" not in numbers(follow(preset_state()))


def test_each_has_its_own_row_and_colour_in_every_plot_on_common_axes():
    """The legend has the names of scenes; nothing of them is beyond the axes."""
    states = [preset_state().replace(max_depth=depth) for depth in (9e-9, 3e-9, 6e-9, 12e-9)]
    view = view_of(states[0], 1.0, *states)
    for along, of_state in ((X, "contact_radius"), (D, "depth"), (F, "force")):
        largest = max(float(np.max(getattr(follow(state).states, of_state))) for state in states)
        assert view.end(along) >= largest > view_of(states[1]).end(along)
    assert -view.axis(Z).start >= 12e-9
    rows = view.places(PLOTS["force"], 0)
    for k, held in enumerate(view.computed["held"], 1):
        np.testing.assert_array_equal(rows[f"held {k}"][1], held.course.states.force)
        for name in ("pressure", "springs"):
            assert np.isfinite(view.places(PLOTS[name], view.course.now)[f"held {k}"][1]).all()
        for name in ("force", "pressure", "springs"):
            assert "beyond" not in view.places(PLOTS[name], view.course.now)[f"held {k}"][-1]
        # The springs under the tip are as deep as it.
        low = np.min(view.places(PLOTS["springs"], view.course.now)[f"held {k}"][1])
        assert low == approx(-float(held.course.state.depth), rel=1e-6)
    looks = {(row.role, row.look["line_dash"]) for row in rows_of(PLOTS["force"]) if "held" in row.role}
    assert len({role for role, _ in looks}) == len({dash for _, dash in looks}) == len(states)
    names = drawn(view, PLOTS["force"])
    text = legend(PLOTS["force"], names).replace(Markup("<i>d</i><sub>max</sub>"), "d_max")
    shown = re.findall(r">([^<]+)</span>", text)
    # The first one is the present scene, which has no difference from itself.
    expected = [f"d_max = {depth} nm" for depth in (9, 3, 6, 12)]
    assert [text for text in shown if "d_max" in text] == expected
    layer = next(each for each in Picture(PLOTS["force"]).layers if each.name == "lines")
    told = layer.columns(rows, PLOTS["force"].axes_of(view), False)["row"]
    assert [text.replace("dₘₐₓ", "d_max") for text in told if "dₘₐₓ" in text] == expected


def test_the_classes_of_hardness_are_compared_over_the_contact_radius():
    """Mean pressure and hardness of each: σ_c = H, q_c/a, f_c/a², equal at the largest contact radius."""
    b = preset_state().replace(tiles=("hardness",))
    a, c = (changes.choose(b, "plasticity", name) for name in ("constant", "line"))
    view = view_of(b, 1.0, a, c)
    rows = view.places(PLOTS["hardness"], view.course.now)
    for k, state, power in ((1, a, 0), (2, c, -2)):
        states = follow(state).states
        radius, pressure, *_ = rows[f"held {k}"]
        in_contact = states.contact_radius > 0
        np.testing.assert_array_equal(radius[in_contact], states.contact_radius[in_contact])
        expected = states.force[in_contact] / (np.pi * states.contact_radius[in_contact] ** 2)
        np.testing.assert_allclose(pressure[in_contact], expected, rtol=1e-12)
        r, hardness, *_ = rows[f"held {k} hardness"]
        np.testing.assert_allclose(hardness, hardness[-1] * (r / r[-1]) ** power, rtol=1e-12)
        present = float(medium(b).hardness_at(r[-1]))
        # The constants that are found have the five digits of their fields.
        assert float(hardness[-1]) == approx(present, rel=1e-4)


def test_a_held_scene_is_named_by_what_differs_from_the_present_one():
    gold, drop = preset_state().replace(max_depth=4e-9), preset_state(DROP)
    assert difference(gold) == "d_max = 4 nm"
    soft = gold.replace(q_c=90.0)
    assert difference(gold, soft) == "q_c = 100 N/m"
    assert difference(soft, gold) == "q_c = 90 N/m"
    # Of another preset, that is named, too; of itself, what differs from the preset.
    assert difference(gold, drop) == f"{PRESETS[GOLD].label}, d_max = 4 nm"
    assert difference(drop, gold) == PRESETS[DROP].label
    assert difference(gold, gold) == "d_max = 4 nm"
    # A shape has its name and its numbers.
    assert difference(state_with(DROP, shape="cone").replace(cone_slope=0.2)) == "Cone, s = 0.2"
    # As the present scene changes, so do the names.
    later = drop.replace(**{"held.scenes": (link.write(gold),)})
    view = view_of(soft, 1.0, gold)
    assert [each.name for each in view.computed["held"]] == ["q_c = 100 N/m"]
    assert [each.name for each in computed(later, view)] == [difference(gold, drop)]


def test_a_scene_of_another_scale_is_said_to_be_too_small():
    """Gold at nanometres is a point on the axes of a drop weight; those of gold hold both."""
    gold, drop = preset_state(), preset_state(DROP)
    view = view_of(drop, 1.0, gold)
    named = view.places(PLOTS["force"], view.course.now)["held 1"][2]
    assert named.endswith(")")
    view = view_of(gold, 1.0, drop)
    assert view.axis(D) == view_of(drop).axis(D)
    assert not view.places(PLOTS["force"], view.course.now)["held 1"][2].endswith(")")


def test_the_legend_of_a_saved_picture_names_held_scenes_as_the_plot_does():
    page = Page()
    page.apply(toggle_hold)
    page.apply(lambda state: state.replace(max_depth=2 * state.max_depth))
    for service in page.services:
        service.rest(page.view)
    drawn_as = page.layout.cards["force"].picture.columns(page.view, page.view.course.now)
    names = {name for columns in drawn_as.values() for name in columns["row"]}
    legends = page.view.computed["save"]
    assert "dₘₐₓ = 8.978 nm" in names
    # What a label names stands in no legend.
    assert legends["force"]["rows"] == ["dₘₐₓ = 8.978 nm"]


def test_a_held_scene_is_the_one_that_is_shown_whatever_its_digits():
    state = toggle_hold(link.read("q_c=98.76543210123"))
    assert is_held(state)


def test_compare_says_what_it_has_done_where_one_looks_and_until_something_changes():
    page = Page()
    press(page, "Compare")

    def kept():
        figure = page.layout.cards["force"].picture.figure
        (source,) = (each.data_source.data for each in figure.renderers if each.name == "labels")
        return source["text"][source["row"].index("kept")]

    assert kept()
    assert page.layout.parts["comparison"].view[-1].object
    page.apply(lambda state: set_value(state, "max_depth", 5e-9))
    assert kept() == ""


def test_the_opening_scene_is_held_by_its_link(page):
    press(page, "Compare")
    query, _ = page.query()
    assert len(Page(query).state["held.scenes"]) == 1


def test_numbers_that_differ_are_seen_while_a_slider_moves(server, context):
    """The link has a held scene that is none: it is told, and leaves the address."""
    explorer = Explorer(context.new_page(), f"{server.url}?held.scenes=garbage&q_c=50", window=(1280, 720))
    explorer.page.get_by_text("held.scenes=garbage").first.wait_for()
    explorer.wait("!location.search.includes('garbage')")
    assert explorer.link("q_c") == {"q_c": "50.0"}
    explorer.change(explorer.type, "q_c", "100")
    explorer.change(explorer.press, "Compare")
    explorer.choose("Shape", "Paraboloid")
    table = explorer.page.locator(".held table")
    assert "4.51 µN" in table.inner_text()
    assert "8.98 nm" not in table.inner_text()
    # Also beside the last slider of the form, to which one has to scroll.
    explorer.press("More about the medium")
    explorer.slider("ρ").scroll_into_view_if_needed()
    box = table.bounding_box()
    assert 0 <= box["y"] <= box["y"] + box["height"] <= 720
    # The cone is drawn in the plot of the springs, too.
    assert explorer.row("springs", "Cone")[1].min() == approx(-8.978, rel=1e-3)
    explorer.page.close()
    assert explorer.problems == []


def test_scenes_are_held_and_come_back_from_the_address_in_the_dark(explorer):
    page = explorer.page
    for depth in ("4 nm", "7 nm"):
        explorer.change(explorer.type, "d_max", depth)
        explorer.change(explorer.press, "Compare")
    for k, text in ((1, "= 4 nm"), (2, "= 7 nm")):
        page.locator(".held .key").get_by_text(text).first.wait_for()
        box = page.get_by_role("button", name=f"Remove {k}").bounding_box()
        assert box["x"] + box["width"] <= 312
    explorer.change(explorer.press, "Remove 2")
    explorer.press("Dark")
    explorer.wait("document.documentElement.classList.contains('dark')")
    explorer.change(explorer.type, "q_c", "90 N/m")
    explorer.link("q_c=90")
    # It has the name of what differs from the present scene, in the legend, too.
    name, legend = "dₘₐₓ = 4 nm, qc = 100 N/m", page.locator(".card.force .key")
    legend.get_by_text("= 4 nm").wait_for()
    assert "dmax = 4 nm, qc = 100 N/m" in legend.inner_text()
    held = explorer.row("force", name)
    page.reload()
    explorer.wait("window.explorer?.idle() && document.documentElement.classList.contains('dark')")
    np.testing.assert_allclose(explorer.row("force", name), held, rtol=1e-6)
    assert explorer.field("q_c").input_value() == "90 N/m"
    assert page.get_by_role("button", name="Undo").count() == 0
