"""What cannot be shown leaves the page as it was, and in use, wherever it fails. Without a browser."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.common.tip import read_tip
from app.explorer import changes
from app.explorer.drives import EXACT, follow
from app.explorer.extras.pointer import Pointer
from app.explorer.figures import Picture
from app.explorer.page import Page
from app.explorer.search import COMPUTING, FAULT
from app.explorer.state import PRESETS, preset_state

from ..approx import approx
from .conftest import DROP, GOLD
from .states import part, press

Q_C = PRESETS[GOLD].values["q_c"]


@pytest.fixture
def page():
    """A page that tells its notices to a list."""
    page, notices = Page(), []
    page.notify, page.notices = notices.append, notices
    return page


def failing(*arguments, **named):
    raise ArithmeticError("made to fail")


def put(page, name, value):
    page.apply(lambda state: changes.put(state, name, value))


def assert_in_use(page):
    """It said so once, and the next change is drawn."""
    (notices,) = page.notices
    assert "Nothing was changed" in notices
    put(page, "q_c", 1.5 * Q_C)
    assert page.view.course.scene.medium.q_c == page.state.q_c == 1.5 * Q_C
    page.undo()
    assert page.view.course.scene.medium.q_c == Q_C
    assert len(page.notices) == 1


def test_a_plot_or_a_held_scene_that_fails(page, monkeypatch):
    with monkeypatch.context() as failure:
        failure.setattr(page.layout, "_make", failing)
        press(page, "Surface")
    assert (page.state.tiles, part(page, "fourth plot").look["value"]) == ((), "")
    assert_in_use(page)
    page.notices.clear()
    made = page.choice

    def unless_held(name):
        return failing() if page.view.computed["held"] else made(name)

    monkeypatch.setattr(page, "choice", unless_held)
    press(page, "Compare")
    assert (page.state["held.scenes"], page.view.computed["held"]) == ((), [])
    assert_in_use(page)


def test_a_plot_that_cannot_be_drawn_for_the_first_time_leaves_no_empty_frame(page, monkeypatch):
    columns = Picture.columns

    def unless_surface(picture, view, i):
        return failing() if picture.plot.name == "surface" else columns(picture, view, i)

    with monkeypatch.context() as failure:
        failure.setattr(Picture, "columns", unless_surface)
        press(page, "Surface")
    assert [card.plot.name for card in page.layout.seen()] == ["springs", "pressure", "force"]
    assert_in_use(page)
    press(page, "Surface")
    assert page.layout.seen()[-1].plot.name == "surface"


def test_a_preset_of_which_the_last_part_fails(page, monkeypatch):
    """What is beside the plots counts as shown too: undo leads to nothing that was refused."""
    shown = page.layout.form.show
    monkeypatch.setattr(
        page.layout.form, "show", lambda now: shown(now) if now.state.preset == GOLD else failing()
    )
    page.choose("preset", DROP)
    assert page.state.preset == page.choice("preset").look["value"] == GOLD
    assert page.history.at == 0
    assert_in_use(page)


def test_a_refused_number_stays_until_it_is_another_or_all_is_set_anew(page):
    part(page, "max_depth").act({"text": "5 nm"})
    part(page, "q_c").act({"text": "abc"})
    refused = "“abc” is not a number with one of the units µN/m, mN/m, N/m, kN/m, MN/m, GN/m"
    assert part(page, "q_c").look["refused"] == refused
    page.undo()
    assert part(page, "q_c").look["refused"] == refused
    page.choose("preset", DROP)
    assert part(page, "q_c").look["refused"] == ""


def test_a_drag_is_one_change_and_undo_leaves_the_view(page):
    start = page.state.max_depth
    for value in (1.05e-8, 1.25e-8, 1.48e-8):
        part(page, "max_depth").act({"value": value, "dragged": True})
    assert page.state.max_depth > start
    page.apply(lambda state: state.replace(at=0.5))
    page.undo()
    assert (page.state.max_depth, page.state.at) == (start, 0.5)
    assert page.history.at == 0
    page.redo()
    assert page.state.max_depth > start


def drag(page, depth):
    """What the browser sends while the indenter is dragged."""
    (dragging,) = (each for each in page.services if isinstance(each, Pointer))
    dragging.drag.depth = depth


def test_the_indenter_is_dragged_to_a_depth_under_a_given_force_too(page):
    page.apply(lambda state: changes.choose(state, "drive", "force"))
    drag(page, 5.0)
    # A force that is found has the five digits that its field shows.
    assert float(page.view.course.turning_point.depth) == approx(5e-9, rel=5e-5)
    drag(page, "<b>")
    assert page.notices == []


def rested(page):
    """What is found of the section when the input is at rest."""
    page._input_rests()
    return page.view.computed.get("section")


def test_what_was_found_of_another_scene_or_state_is_not_shown(page):
    press(page, "Section")
    assert page.view.computed["section"] == COMPUTING
    first = rested(page)
    put(page, "q_c", 1.2 * Q_C)
    assert page.view.computed["section"] == replace(COMPUTING, axes=first.axes)
    page.undo()
    assert page.view.computed["section"] is first
    page.move(5)
    assert page.view.computed["section"].note == "computing …"
    assert rested(page).rows["contact radius a"][0][0] == page.view.course.state.contact_radius


def test_what_is_found_at_rest_and_cannot_be_drawn(page, monkeypatch):
    show = page.layout.draw
    press(page, "Section")

    def fails(columns, view):
        return failing() if view.computed["section"].rows else show(columns, view)

    monkeypatch.setattr(page.layout, "draw", fails)
    assert rested(page) is FAULT
    assert_in_use(page)


def test_a_link_that_cannot_be_opened_is_a_notice(monkeypatch):
    notices = []
    monkeypatch.setattr(Page, "notify", lambda page, text: notices.append(text))
    page = Page("preset=none")
    assert notices == ["The link was not opened: preset = “none” in this link is not known"]
    assert page.state == preset_state()


def test_a_drag_that_returns_to_its_start_is_undone_with_what_was_before(page):
    """The depth is as before the drag; one more step back is the mass."""
    put(page, "mass", 2.0)
    for value in (7e-9, preset_state().max_depth):
        page.apply(lambda state, value=value: changes.put(state, "max_depth", value), mark="max_depth")
    page.undo()
    page.undo()
    assert page.state.mass == preset_state().mass
    assert page.history.at == 0


def test_frames_stay_right_where_the_player_leaves_a_state_that_another_depth_has_not(page):
    """All states that the browser has are those of the server, until the scene is another."""
    page.move(10)
    put(page, "max_depth", 1.37e-8)
    count = len(page.view.course)
    page.move(60)
    assert (len(page.view.course), page.view.course.now) == (count, 60)
    assert page.state.at == page.view.course.progress[60]


def test_no_frames_leave_while_moves_arrive(page):
    """Those of another course are taken back at once; at rest one set is sent, of the present course."""

    def states():
        _, places, words, times = page.messages.frames
        return {len(words), len(times), *map(len, places)}

    page.move(None)
    assert states() == {len(page.view.course)}
    sent = page.messages.frames
    page.move(5)
    assert page.view.course.now == 5
    page.move(None)
    assert page.messages.frames is sent
    changes_of_frames = []
    page.messages.on_change("frames", lambda attr, old, new: changes_of_frames.append(new))
    for depth in (7e-9, 7.5e-9, 8e-9):
        put(page, "max_depth", depth)
        assert page.messages.frames == []
    page.apply(lambda state: changes.choose(state, "drive", "impact"))
    assert changes_of_frames == [[]]
    rested(page)
    rested(page)
    assert len(changes_of_frames) == 2
    assert states() == {len(page.view.course)}
    # The player rests, too.
    page.move(5)
    put(page, "mass", 2.0)
    rested(page)
    assert page.messages.frames == []


def test_a_state_that_the_player_has_not_changes_nothing(page):
    before = page.state
    for message in (len(page.view.course), -1, 10**400, 2.5, "5", [5], {"now": 5}):
        page.move(message)
    assert page.state == before
    assert page.messages.frames == []


@pytest.mark.parametrize(
    ("query", "name", "value"),
    [
        ("", "E_star", 9e13),
        ("drive=force&max_force=1e5", "drive", "depth"),
        ("max_depth=1e-12", "drive", "impact"),
    ],
)
def test_a_number_that_a_change_leads_to_is_refused_beyond_its_bounds(monkeypatch, query, name, value):
    notices = []
    monkeypatch.setattr(Page, "notify", lambda page, text: notices.append(text))
    page = Page(query)
    before = page.state
    take = changes.choose if name == "drive" else changes.put
    page.apply(lambda state: take(state, name, value))
    (notice,) = notices
    assert "is out of bounds" in notice
    assert page.state == before


def test_an_impact_after_pressing_is_as_deep_and_on_a_virgin_surface():
    state = changes.hit_again(preset_state("ball-steel"))
    pressed = changes.choose(state, "drive", "depth")
    hit = changes.choose(pressed, "drive", "impact")
    assert hit.plastic_depth == 0
    assert float(follow(hit).turning_point.depth) == approx(pressed.max_depth, rel=1e-4)


def test_the_viscosity_stays_where_damping_is_turned_off_and_on():
    state = changes.put(changes.choose(preset_state(DROP), "damping", "eta"), "eta", 123.0)
    assert changes.choose(state, "damping", "none").eta == 123.0


def test_a_tip_limits_the_depth_of_every_drive_that_has_one():
    state = changes.choose(preset_state(), "drive", "path")
    r = np.linspace(0, 5e-9, 20)
    taken = changes.take_tip(state, (r, r**2 / 2e-9), "a tip")
    assert taken.max_depth < 0.51 * r[-1] ** 2 / 1e-9
    assert follow(taken).turning_point.depth == approx(taken.max_depth)


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
    "query",
    [
        "E_1=1&E_2=1&nu_1=0&nu_2=0",
        "elasticity=bodies&E_1=1e14&E_2=1e14&nu_1=-0.99&nu_2=-0.99&tiles=sweep",
        "plasticity=hardness&hardness=1e14&hardness_radius=100",
    ],
)
def test_a_link_whose_bodies_or_hardness_lead_beyond_the_bounds_is_refused(monkeypatch, query):
    notices = []
    monkeypatch.setattr(Page, "notify", lambda page, text: notices.append(text))
    page = Page(query)
    assert page.state.preset == GOLD
    assert page.view is not None
    assert "is out of bounds" in notices[0]


def test_hit_again_pressed_while_the_drive_changes_is_refused(page):
    page.choose("preset", DROP)
    again = part(page, "Hit again")
    page.choose("drive", "depth")
    again.act(None)
    assert "nothing has yielded further" in page.notices[0]


@pytest.mark.parametrize("drive", ["path", "oblique"])
def test_a_sweep_of_a_drive_that_has_none_offers_numbers_with_a_value(page, drive):
    page.choose("drive", drive)
    press(page, "Sweep")
    for name in page.choice("sweep.swept").look["options"]:
        page.choose("sweep.swept", name[0])
    assert page.notices == []


@pytest.mark.parametrize("name", ["E_1", "nu_1", "E_2", "nu_2"])
def test_numbers_of_two_bodies_are_swept_on_the_page(page, name):
    page.choose("preset", DROP)
    page.choose("elasticity", "bodies")
    press(page, "Sweep")
    page.choose("sweep.swept", name)
    rested(page)
    assert (page.notices, page.view.computed["sweep"] is FAULT) == ([], False)


def test_a_plot_is_large_while_others_have_never_been_drawn(page):
    page.choose("drive", "path")
    press(page, "Sweep")
    press(page, "Sweep")
    part(page, "Large").act(None)
    press(page, "Section")
    # It comes large in the place of the plot that was.
    assert page.state.large == "section"
    press(page, "Section")
    assert page.state.large == ""
    assert page.notices == []


def test_the_opening_scene_is_held_by_its_link(page):
    press(page, "Compare")
    query, _ = page.query()
    assert len(Page(query).state["held.scenes"]) == 1


def test_a_scene_without_a_link_leaves_the_address(page):
    r = np.linspace(0, 500, 60)
    rows = "\n".join(f"{each:.6f},{each**2 / 1234.567:.6f}" for each in r)
    page.apply(lambda state: changes.take_tip(state, *read_tip(f"r (nm), z (nm)\n{rows}", "tip.csv")))
    for _ in range(3):
        press(page, "Compare")
        put(page, "max_depth", 0.9 * page.state.max_depth)
        page._input_rests()
    query, why = page.query()
    assert query == ""
    assert "No link" in why
    assert page.messages.address == ""


def test_an_exact_course_is_found_again_once_others_have_taken_its_place(page):
    page.choose("preset", "ball-glass_epoxy")
    page.choose("drive", "oblique")
    page._input_rests()
    assert not page.view.course.pending
    EXACT.clear()
    page.apply(lambda state: state.replace(dark=True))
    assert page.view.course.pending
    page._input_rests()
    assert not page.view.course.pending
