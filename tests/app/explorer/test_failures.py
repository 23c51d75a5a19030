"""A change that cannot be shown leaves the page as it was, and usable."""

from dataclasses import replace

from app.explorer.figures import Picture
from app.explorer.search import COMPUTING, FAULT
from app.explorer.state import PRESETS

from ..conftest import DROP, GOLD
from ..states import part, press, put, rested

Q_C = PRESETS[GOLD].values["q_c"]


def assert_in_use(page):
    """It said so once, and the next change is drawn."""
    (notices,) = page.notices
    assert "Nothing was changed" in notices
    put(page, "q_c", 1.5 * Q_C)
    assert page.view.course.scene.medium.q_c == page.state.q_c == 1.5 * Q_C
    page.undo()
    assert page.view.course.scene.medium.q_c == Q_C
    assert len(page.notices) == 1


def failing(*arguments, **named):
    raise ArithmeticError("made to fail")


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
