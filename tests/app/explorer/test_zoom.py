"""Scales: zoom by a box, and axes that stay during a drag."""

import numpy as np

from app.explorer import changes
from app.explorer.page import Page
from app.explorer.plots import PLOTS, D, F, R, X, Z

from ...approx import approx
from ..states import amounts


def test_axes_are_kept_while_something_is_dragged():
    """What leaves them is not drawn, and said. Another drive has its own; at the end they fit again."""
    page = Page()
    before = page.view
    page.messages.dragged = True
    page.apply(lambda state: changes.set_value(state, "max_depth", 2 * state.max_depth))
    view, i = page.view, page.view.course.now
    assert [view.axis(each) for each in (X, Z, R, D, F)] == [before.axis(each) for each in (X, Z, R, D, F)]
    state = view.course.state
    a, d, force = (float(each) for each in (state.contact_radius, state.depth, state.force))
    # A cone: a = 2 d/(π s).
    assert a == approx(2 * float(before.course.state.contact_radius), rel=1e-9)
    for plot, said in (("springs", [a, d]), ("force", [d, force])):
        # Three digits.
        assert amounts(view.places(PLOTS[plot], i)["cut off"][2]) == approx(said, rel=5e-3)
    page.undo()
    assert page.view.kept
    assert page.view.places(PLOTS["force"], i)["cut off"][2] == ""
    page.apply(lambda state: changes.choose(state, "drive", "impact"))
    assert page.view.kept == {}
    page.undo()
    page.apply(lambda state: changes.set_value(state, "max_depth", 2 * state.max_depth))
    assert page.view.kept
    page.messages.dragged = False
    assert page.view.kept == {}
    assert page.view.axis(D).end > before.axis(D).end


def test_scales_stay_while_a_slider_is_dragged(projector):
    mouse, box = projector.page.mouse, projector.slider("d_max").bounding_box()
    before, y = projector.axis("force"), box["y"] + box["height"] / 2
    mouse.move(box["x"] + box["width"] / 2, y)
    mouse.down()
    mouse.move(box["x"] + 0.6 * box["width"], y, steps=5)
    projector.wait("explorer.text('force', 'cut off')?.includes('d = 1')")
    assert projector.axis("force") == before
    mouse.up()
    projector.wait("(end) => explorer.model('force').x_range.end > end", before["x"][1])
    projector.wait("explorer.text('force', 'cut off') === ''")
    projector.link("max_depth=")
    projector.change(projector.press, "Undo")


def tools(explorer, name):
    """The buttons of the tools of a plot, which is pointed at or touched: a box, and the whole plot."""
    card = explorer.page.locator(f".card.{name}")
    return card.locator(".bk-OnOffButton"), card.locator(".bk-ClickButton")


def test_a_box_is_zoomed_to_until_a_double_click_or_another_drive(projector):
    """Its tool is seen while the plot is pointed at, and off after one box: the plot is dragged again."""
    page, before = projector.page, projector.axis("force")
    box, whole = tools(projector, "force")
    assert not box.is_visible()
    middle = page.locator(".card.force canvas").first.bounding_box()
    centre = middle["x"] + middle["width"] / 2, middle["y"] + middle["height"] / 2

    def zoom():
        page.mouse.move(*centre)
        box.click()
        projector.drag("force", (0.2, 0.15))
        narrow = "([a, b]) => { const { x } = explorer.axis('force'); return x[1] - x[0] < (b - a) / 2 }"
        projector.wait(narrow, before["x"])

    zoom()
    within = projector.axis("force")
    assert before["x"][0] < within["x"][0] < within["x"][1] < before["x"][1]
    assert before["y"][0] < within["y"][0] < within["y"][1] < before["y"][1]
    # It stays when a number is changed, and nothing was dragged.
    assert projector.readout("depth") == "8.978 nm"
    projector.change(projector.type, "q_c", "110 N/m")
    assert projector.axis("force")["x"] == within["x"]
    # In another unit it is the same part of the plot.
    projector.change(projector.type, "d_max", "900 pm")
    projector.change(projector.type, "d_max", "8.978 nm")
    np.testing.assert_allclose(projector.axis("force")["x"], within["x"], rtol=1e-9)
    # The tool is off: the mark on the curve is dragged.
    projector.drag("force", (-0.2, 0.2))
    projector.wait("player.value < 80")
    assert projector.axis("force")["x"] == within["x"]
    page.mouse.dblclick(*centre)
    projector.wait("(x) => explorer.axis('force').x.join() === x.join()", before["x"])
    zoom()
    page.mouse.move(*centre)
    whole.click()
    projector.wait("(x) => explorer.axis('force').x.join() === x.join()", before["x"])
    zoom()
    projector.pick("force")
    projector.wait("(wide) => Math.abs(explorer.axis('force').x[1] / wide - 1) < 1e-9", before["x"][1])
