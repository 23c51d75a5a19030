"""What the page draws itself in place of Bokeh: what is seen is what is saved, pointed at and zoomed."""

import os
from pathlib import Path

import pytest

from .conftest import CHROMIUM
from .test_page import DROP, ELASTIC, FIGURES, YIELDED, now

# Where the browser is required its absence is a failure.
pytestmark = pytest.mark.skipif(
    not Path(CHROMIUM).exists() and os.environ.get("MDR_BROWSER") != "required",
    reason="the page's tests need Chromium; set CHROMIUM to its path",
)

# How many pixels of each colour stand on the canvas that is seen of a plot.
SHEET = """(name) => {
  const { shadow_el } = Bokeh.index.find_one(explorer.figure(name)).canvas_view
  const canvas = shadow_el.querySelector(`canvas[data-sheet="${name}"]`)
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d")
  copy.drawImage(canvas, 0, 0)
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height)
  const counts = {}
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] < 255) continue
    const key = [data[i], data[i + 1], data[i + 2]].join()
    counts[key] = (counts[key] ?? 0) + 1
  }
  return counts
}"""


def seen(explorer, figure):
    """Pixels by colour of the canvas that a person sees, at the next frame."""
    explorer.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")
    return explorer.page.evaluate(SHEET, figure)


def place(explorer, figure, layer, index):
    """Where on the page a point of a layer is."""
    box = explorer.page.locator(f'canvas[data-sheet="{figure}"]').bounding_box()
    x, y = (explorer.column(figure, layer, key)[index] for key in "xy")
    script = """([name, x, y]) => {
      const { frame } = Bokeh.index.find_one(explorer.figure(name))
      return [frame.x_scale.compute(x), frame.y_scale.compute(y)]
    }"""
    sx, sy = explorer.page.evaluate(script, [figure, x, y])
    return box["x"] + sx, box["y"] + sy


def test_what_is_seen_is_what_is_saved(explorer):
    for preset in (None, DROP):
        if preset is not None:
            explorer.choose("Preset", preset)
        for figure in FIGURES:
            shown, saved = seen(explorer, figure), explorer.colours(figure)
            for colour in (YIELDED, ELASTIC):
                # But for pixels at the edge of what is drawn.
                if saved.get(colour, 0) > 100:
                    assert 0.7 < shown[colour] / saved[colour] < 1.4, figure
            written = explorer.drawing(figure)
            assert all(label.replace("_", "") in written for label in explorer.axis(figure)["labels"])


def test_plots_out_of_sight_are_drawn_when_they_come_into_it(explorer):
    explorer.page.set_viewport_size({"width": 400, "height": 700})
    with explorer.change():
        explorer.type("d_max", "12 nm")
    explorer.page.locator('[data-plot="radii"]').scroll_into_view_if_needed()
    script = "(args) => (eval(args[0])(args[1])[args[2]] ?? 0) > 50"
    explorer.page.wait_for_function(script, arg=[SHEET, "radii", ELASTIC])
    assert now(explorer)[0] == pytest.approx(12e-9)


def test_tooltip_tells_what_is_drawn(explorer):
    with explorer.change():
        explorer.type("d_max", "15 nm")
    x, y = place(explorer, "pressure", "−σ_zz(r)", 150)
    labels = explorer.page.locator(".bk-tooltip-row-label")
    # Tooltips hear of what is drawn once the input has been still.
    for _ in range(300):
        explorer.page.mouse.move(x - 3, y)
        explorer.page.mouse.move(x, y)
        explorer.page.wait_for_timeout(100)
        if labels.count():
            break
    assert labels.all_inner_texts() == ["r:", "−σ_zz:"]
    told = float(explorer.page.locator(".bk-tooltip-row-value").last.inner_text().split()[0])
    assert told == pytest.approx(explorer.column("pressure", "−σ_zz(r)", "y")[150], rel=0.01)


def test_zoom_and_reset_are_drawn(explorer):
    plot = explorer.page.locator('[data-plot="radii"]')
    plot.scroll_into_view_if_needed()
    before, limits = seen(explorer, "radii"), explorer.axis("radii")["x"]
    plot.locator(".plot").hover()
    plot.locator("[class*=box-zoom]").click()
    box = plot.locator('canvas[data-sheet="radii"]').bounding_box()
    explorer.page.mouse.move(box["x"] + 150, box["y"] + 60)
    explorer.page.mouse.down()
    explorer.page.mouse.move(box["x"] + 300, box["y"] + 160, steps=4)
    explorer.page.mouse.up()
    explorer.page.wait_for_function("(limits) => explorer.axis('radii').x[1] < limits[1]", arg=limits)
    assert seen(explorer, "radii") != before
    plot.locator(".plot").hover()
    plot.locator(".bk-tool-icon-reset").click()
    explorer.page.wait_for_function("(limits) => explorer.axis('radii').x[1] === limits[1]", arg=limits)
    assert seen(explorer, "radii") == before
