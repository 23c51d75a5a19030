"""What cannot be shown leaves the page as it was, and in use, wherever it fails. Without a browser."""

import time
from dataclasses import replace

import pytest

from app import link, view
from app.explorer import FROM_FILE
from app.page import Page
from app.plots import PLOTS
from app.presets import OPENING, PRESETS
from app.resting import COMPUTING, FAULT

pytestmark = pytest.mark.filterwarnings("ignore:Widget.name is deprecated:PendingDeprecationWarning")


@pytest.fixture
def page(monkeypatch):
    """A page that tells its notices to a list."""
    page, said = Page(), []
    page.notify, page.said = said.append, said
    return page


def failing(*arguments):
    raise ArithmeticError("made to fail")


def assert_in_use(page):
    """It said so once, and the next change is drawn."""
    (said,) = page.said
    assert "Everything is as it was before" in said
    page.explorer.q_c = 1.5 * PRESETS[OPENING].values["q_c"]
    assert page.drawn.way.scene.medium.q_c == page.explorer.q_c
    page.tell(page.explorer.undo)
    assert page.drawn.way.scene.medium.q_c == PRESETS[OPENING].values["q_c"]
    assert len(page.said) == 1


def test_axes(page, monkeypatch):
    monkeypatch.setattr(view, "scales", failing)
    page.controls.choices["axes"].value = "ratio"
    assert page.explorer.axes == page.controls.choices["axes"].value == "units"
    assert_in_use(page)


def test_a_plot_on_request(page, monkeypatch):
    monkeypatch.setattr(page.grid, "_make", failing)
    page.asked["map"].value = True
    assert page.explorer.plots == []
    assert not page.asked["map"].value
    assert_in_use(page)


def test_a_scene_that_is_held(page, monkeypatch):
    monkeypatch.setattr(page.table, "show", lambda way, held: failing() if held else None)
    page.hold.value = True
    assert (page.explorer.hold, page.held, page.hold.value) == ([], [], False)
    assert_in_use(page)


def test_a_preset_of_which_the_last_part_fails(page, monkeypatch):
    """What is beside the plots counts as shown too: undo leads to nothing that was refused."""
    shown = page.away.show
    monkeypatch.setattr(
        page.away, "show", lambda: shown() if page.explorer.preset == OPENING else failing()
    )
    page.explorer.progress = page.way.progress[3]
    page._around()
    page.controls.choices["preset"].value = list(PRESETS)[2]
    assert page.explorer.preset == page.controls.choices["preset"].value == OPENING
    assert page.explorer.progress == page.way.progress[3]
    assert page.undo.disabled
    assert_in_use(page)


class Typed:
    """What a field sends."""

    def __init__(self, text):
        self.data = {"text": text}


@pytest.mark.parametrize("act", ["preset", "undo", "reset"])
def test_a_refused_number_is_forgotten_where_all_is_set_anew(page, act):
    number = page.controls.number("q_c")
    page.controls.number("max_depth")._asked(Typed("5 nm"))
    number._asked(Typed("abc"))
    assert (number.refused, number.said) == (
        True,
        "“abc” is not a number with one of the units µN/m, mN/m, N/m, kN/m, MN/m, GN/m",
    )
    # It stays to be mended while other numbers are set.
    page.controls.number("max_depth")._asked(Typed("6 nm"))
    assert number.refused
    if act == "preset":
        page.controls.choices["preset"].value = list(PRESETS)[1]
    else:
        getattr(page, act).clicks += 1
    assert (number.refused, number.said) == (False, "")


def test_a_scene_from_a_file_can_be_chosen_only_where_there_is_one(page):
    presets = page.controls.choices["preset"]
    assert list(presets.options) == list(PRESETS)
    page.tell(lambda: link.load_scene(page.explorer, page.explorer.scene().to_json()))
    assert list(presets.options) == [*PRESETS, "Scene from a file"]
    assert presets.value == FROM_FILE
    presets.value = list(PRESETS)[3]
    assert page.explorer.preset == list(PRESETS)[3]
    assert list(presets.options) == list(PRESETS)
    page.undo.clicks += 1
    assert presets.value == page.explorer.preset == FROM_FILE


def found(page, title=PLOTS["section"].title):
    """What is shown of the section once the input has been at rest."""
    page._settled()
    until = time.monotonic() + 30
    while page.drawn.found[title] is COMPUTING or not page.drawn.found[title].rows:
        assert time.monotonic() < until
        time.sleep(0.02)
    return page.drawn.found[title]


def test_what_was_found_of_another_scene_or_state_is_not_shown(page):
    title = PLOTS["section"].title
    page.asked["section"].value = True
    assert page.drawn.found[title] == COMPUTING
    first = found(page)
    page.explorer.q_c = 1.2 * page.explorer.q_c
    assert page.drawn.found[title] == replace(COMPUTING, axes=first.axes)
    page.asked["section"].value = False
    page.tell(page.explorer.undo)
    page.asked["section"].value = True
    assert page.drawn.found[title] is first
    page._stood("value_throttled", page.way.now, 5)
    assert page.drawn.found[title].note == "computing …"
    assert found(page).rows["contact radius a"][0][0] == page.way.state.contact_radius


def test_what_is_found_at_rest_and_cannot_be_drawn(page, monkeypatch):
    show = page.grid.show
    page.asked["section"].value = True
    monkeypatch.setattr(
        page.grid, "show", lambda view, names: failing() if found_rows(view) else show(view, names)
    )
    page._settled()
    until = time.monotonic() + 30
    while page.drawn.found[PLOTS["section"].title] is not FAULT:
        assert time.monotonic() < until
        time.sleep(0.02)
    assert_in_use(page)


def found_rows(view):
    return view.found[PLOTS["section"].title].rows
