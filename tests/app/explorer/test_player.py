"""The player: frames, marks, speed, keys, and moves of the mouse."""

import time

import pytest

from app.explorer import changes
from app.explorer.extras.pointer import Pointer
from app.explorer.layout import marked_states
from app.explorer.state import PRESETS, preset_state
from mdr_core.show.units import format_quantity

from ...approx import approx
from ..conftest import DROP, GOLD
from ..states import assert_draws, now, put, rested, state_with, view_of


def test_the_player_marks_the_largest_depth_and_the_loss_of_contact():
    for state in (preset_state(), preset_state(DROP)):
        course = view_of(state).course
        marks = marked_states(course)
        assert course.progress[marks["largest depth"]] == 1
        lost = marks["loss of contact"]
        assert course.states.contact_radius[lost - 1] > 0
        assert course.states.contact_radius[lost] == 0
    # A prescribed path may lose contact many times.
    assert set(marked_states(view_of(state_with(GOLD, "path")).course)) == {"largest depth"}


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


def test_it_plays_by_the_space_bar_also_while_the_scene_changes(explorer):
    """From the end of the path it begins anew; where it pauses is the state of the page and its link."""
    page = explorer.page
    slider, play = page.get_by_label("State along the path"), page.locator(".player button")
    # The state of the largest depth is marked, below the middle of the thumb, which is 14 px wide.
    box = slider.bounding_box()
    thumb = (
        box["x"] + 7 + (box["width"] - 14) * int(slider.input_value()) / int(slider.get_attribute("max"))
    )
    mark = page.locator(".player .marks i").first.bounding_box()
    assert abs(mark["x"] + mark["width"] / 2 - thumb) < 1
    assert slider.locator("xpath=..").locator(".marks span").count() == 2
    plot = "Bokeh.index.find_one(explorer.model('force')).el"
    explorer.wait(f"{plot}.ariaDescription?.includes('depth 8.978 nm')")
    assert slider.get_attribute("aria-valuetext") == "force 4.514 µN, depth 8.978 nm"
    slider.press("End")
    explorer.wait("explorer.played() && explorer.idle()")
    slider.press("Space")
    assert play.inner_text() == "❚❚ Pause"
    explorer.wait("explorer.row('force', 'now')[1][0] > 0")
    explorer.slider("q_c").press("PageUp")
    explorer.wait("explorer.played() && explorer.idle()")
    assert play.inner_text() == "❚❚ Pause"
    seen = now(explorer)
    explorer.wait("(depth) => Math.abs(explorer.row('force', 'now')[0][0] - depth) > 0.5", seen[0] * 1e9)
    # Long before the end, which is the state that the link has.
    explorer.wait("player.value > 5 && player.value < 40")
    explorer.change(play.click)
    assert play.inner_text() == "▶ Play"
    stopped, words = slider.input_value(), slider.get_attribute("aria-valuetext")
    drawn, text = now(explorer), explorer.readout("depth")
    assert words.endswith(f"depth {text}")
    explorer.goto(page.url)
    assert slider.input_value() == stopped
    assert now(explorer) == drawn
    assert explorer.readout("depth") == text


def test_keys_player_and_hand_move_every_plot(explorer):
    """Playing needs no server; the indenter and the mark are dragged."""
    page = explorer.page
    for symbol in ("s", "q_c", "d_max"):
        before, text = now(explorer), explorer.field(symbol).input_value()
        explorer.slider(symbol).focus()
        explorer.change(page.keyboard.press, "PageUp")
        assert explorer.field(symbol).input_value() != text
        assert now(explorer) != before
    explorer.choose("Preset", PRESETS[GOLD].label)
    assert_draws(explorer, preset_state())
    # The indenter is taken by the hand: deeper, and one change to undo.
    explorer.drag("springs", (0, 0.2))
    explorer.wait("explorer.row('force', 'now')[0][0] > 9.5 && explorer.model('dragging').depth === null")
    explorer.wait("explorer.idle()")
    explorer.link("max_depth=")
    assert explorer.slider("d_max").input_value() != "200"
    explorer.change(explorer.press, "Undo")
    assert_draws(explorer, preset_state())
    page.get_by_label("State along the path").press("End")
    explorer.wait("explorer.played() && explorer.row('force', 'now')[1][0] === 0")
    assert explorer.readout("contact_radius") == "0"
    explorer.link("at=2.2")
    # A frame is the picture that the server draws of its state.
    page.evaluate("player.go(70)")
    explorer.wait("explorer.row('force', 'now')[1][0] > 0 && explorer.idle()")
    canvases = [page.locator(f".card.{name} canvas").first for name in ("springs", "pressure")]
    frame = [canvas.screenshot() for canvas in canvases]
    page.evaluate("player.rest()")
    assert explorer.link("at=0.")["at"] != "2.2"
    assert frame == [canvas.screenshot() for canvas in canvases]
    page.mouse.move(0, 0)
    explorer.sent.clear()
    before = explorer.row("force", "now")
    explorer.drag("force", (-0.15, 0.1))
    explorer.wait("(old) => explorer.row('force', 'now')[0][0] !== old", before[0][0])
    # Where it ends is all that the server hears.
    assert len(explorer.sent) <= 6
    page.locator("h1").click()
    page.keyboard.press(" ")
    first = explorer.row("force", "now")[0][0]
    explorer.wait("(old) => Math.abs(explorer.row('force', 'now')[0][0] - old) > 0.01", first)
    page.keyboard.press(" ")
    page.get_by_role("button", name="▶ Play").wait_for()
    assert 0 <= float(explorer.link("at=")["at"]) <= 2.2


@pytest.mark.slow
def test_a_slider_that_is_moved_while_the_player_runs_is_as_quick_as_at_rest(explorer):
    """No frames arrive between its moves, the readouts are those of the scene, and then it plays on.

    It has a speed once it is played.
    """
    page, chosen = explorer.page, explorer.page.get_by_label("Speed of the player")
    assert not chosen.is_visible()
    explorer.press("▶ Play")
    explorer.wait("explorer.played()")
    chosen.select_option(label="¼×")
    page.evaluate("window.player.go(0)")
    explorer.press("▶ Play")
    begun = time.perf_counter()
    explorer.wait("window.player.value > 10")
    # An eighth of the states takes 1.5 s, not 0.4 s; a busy machine needs more.
    assert time.perf_counter() - begun > 0.75
    page.evaluate("""() => {
      const messages = explorer.model("messages")
      window.heard = []
      messages.properties.frames.change.connect(() => heard.push(["frames", messages.frames.length]))
      messages.properties.words.change.connect(() => {
        if (!messages.frames.length) heard.push(["depth", messages.words.match(/"depth">([^<]*)/)[1]])
      })
    }""")
    before = float(preset_state().max_depth)
    explorer.slider("d_max").focus()
    for _ in range(4):
        page.keyboard.press("PageUp")
    explorer.wait("explorer.played() && heard.length > 2")
    heard = page.evaluate("heard")
    frames = [count for kind, count in heard if kind == "frames"]
    # Taken back at a move, and sent at rest: once, unless the input rests between keys on a slow machine.
    assert frames == len(frames) // 2 * [0, 4]
    explorer.link("max_depth=")
    depth = float(explorer.link("max_depth=")["max_depth"])
    assert depth > before
    # What is told before the new frames is of the scenes that are set, at their largest depth.
    told = [text for kind, text in heard if kind == "depth"]
    assert told[-1] == format_quantity(depth, "length")
    value = page.evaluate("player.value")
    explorer.wait("(old) => player.value !== old", value)
    explorer.press("❚❚ Pause")


def test_the_indenter_is_dragged_to_a_depth_under_a_given_force_too(page):
    page.apply(lambda state: changes.choose(state, "drive", "force"))
    (dragging,) = (each for each in page.services if isinstance(each, Pointer))
    dragging.drag.depth = 5.0
    # A force that is found has the five digits that its field shows.
    assert float(page.view.course.turning_point.depth) == approx(5e-9, rel=5e-5)
    dragging.drag.depth = "<b>"
    assert page.notices == []
