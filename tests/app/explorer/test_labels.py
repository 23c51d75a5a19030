"""Labels in plots: they stay inside, do not overlap, name what is drawn and have contrast."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from app.common.quantities import CHOICES
from app.explorer.changes import choose
from app.explorer.drives import follow
from app.explorer.figures import drawn, in_legend, legend
from app.explorer.plot import HEIGHT, WIDTH, View, box, rows_of, width
from app.explorer.plots import NAMED, PLOTS
from app.explorer.state import PRESETS, preset_state
from mdr_core.show.figures import ROLES

from ..colours import contrast
from ..conftest import DROP, ELASTIC, GOLD, PUNCH, Explorer
from ..states import state_with, view_of

#: Shares of a path: before and at the largest depth, on the way back, and lifted.
STATES = (0.1, 0.5, 1.0, 1.5, 2.0)


def views(key):
    """A preset under each drive that it takes, in several states."""
    for drive in CHOICES["drive"].options:
        try:
            state = choose(preset_state(key), "drive", drive)
            course = follow(state)
        except ValueError:
            continue
        for at in STATES:
            now = int(np.argmin(np.abs(course.progress - at)))
            yield f"{key} {drive} {at}", View(state, replace(course, now=now)), now


def boxes(view, plot, i):
    """Boxes of all labels that are drawn, in the smallest plot."""
    places, axes = view.places(plot, i), plot.axes_of(view)
    found = {}
    for row in rows_of(plot):
        if row.kind == "labels":
            x, y, text = places[row.name]
            if text and np.isfinite(float(np.ravel(x)[0])):
                found[row.name] = box(row, float(np.ravel(x)[0]), float(np.ravel(y)[0]), text, axes)
    return found


@pytest.mark.few(4)
@pytest.mark.parametrize("key", PRESETS)
def test_labels_leave_no_plot_and_cover_no_other(key):
    for name, view, now in views(key):
        for plot in map(PLOTS.get, NAMED):
            found = boxes(view, plot, now)
            # The radii a and c are labelled where they are, beyond the axes, too, when these are kept.
            for label, each in found.items():
                assert each.inside or label in ("a", "c"), (name, plot.name, label, each)
            for (one, first), (other, second) in combinations(found.items(), 2):
                assert not first.covers(second), (name, plot.name, one, other)


def test_labels_of_the_opening_scene():
    """All that is to be read of it, and no legend."""
    view = view_of(preset_state())
    said = {
        name: {row.removeprefix("label ") for row in boxes(view, PLOTS[name], view.course.now)}
        for name in NAMED
    }
    assert said["springs"] >= {"indenter", "imprint", "yielded", "elastic", "free"}
    assert said["pressure"] >= {"plastic zone", "mean"}
    assert said["force"] >= {"plastic zone", "loading", "unloading", "stored", "plastic work"}
    assert [legend(PLOTS[name], drawn(view, PLOTS[name])) for name in NAMED] == ["", "", ""]


def test_what_no_label_names_is_in_the_legend():
    """Several loadings, of which no label tells one from the other, and a scene that is compared."""
    view = view_of(state_with(GOLD, "path"))
    named = {row.name for row in in_legend(PLOTS["force"], drawn(view, PLOTS["force"]))}
    assert {"path ahead", "plastic work Wₚ", "stored", "yielding", "unloading"} <= named
    view = view_of(preset_state(), 1.0, preset_state().replace(max_depth=5e-9))
    assert [row.name for row in in_legend(PLOTS["force"], drawn(view, PLOTS["force"]))] == ["held 1"]


def test_a_label_names_only_what_is_drawn():
    elastic = view_of(preset_state(ELASTIC))
    shown = drawn(elastic, PLOTS["force"])
    assert "label elastic" in shown
    others = ("loading", "plastic work", "unloading", "plastic zone")
    assert not shown.keys() & {f"label {name}" for name in others}
    # The onset, slightly ahead, is a mark with a label of its own.
    assert "label yield begins" in shown


def within(x, y, outline):
    """Whether a point is within a polygon."""
    u, v = (np.asarray(part, float) for part in outline[:2])
    keep = np.isfinite(u) & np.isfinite(v)
    u, v = u[keep], v[keep]
    u1, v1 = np.roll(u, -1), np.roll(v, -1)
    crosses = (v > y) != (v1 > y)
    at = u[crosses] + (y - v[crosses]) / (v1[crosses] - v[crosses]) * (u1[crosses] - u[crosses])
    return np.count_nonzero(at > x) % 2 == 1


def over(colour, ground, alpha):
    """A colour over another one, #rrggbb."""
    parts = ([int(each[k : k + 2], 16) for k in (1, 3, 5)] for each in (colour, ground))
    return "#" + "".join(f"{round(alpha * a + (1 - alpha) * b):02x}" for a, b in zip(*parts, strict=True))


def grounds(view, plot, places, x, y, dark):
    """Colours on which a label may stand at a point: of areas on each other, also on their hatching."""
    plain = hatched = ROLES["paper"][dark]
    for row in rows_of(plot):
        if row.kind == "areas" and within(x, y, places[row.name]):
            look = row.look_in(dark)
            plain = over(look["fill_color"], plain, look["fill_alpha"])
            hatched = over(look["fill_color"], hatched, look["fill_alpha"])
            if look["hatch_pattern"] != " ":
                hatched = over(look["hatch_color"], hatched, look["hatch_alpha"])
    return plain, hatched


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.few(4)
@pytest.mark.parametrize("key", [GOLD, DROP, ELASTIC, PUNCH])
def test_labels_stand_out_from_what_they_stand_on(key, dark):
    """4.5 : 1 (WCAG 2.2, 1.4.3), of the colours as they are drawn; a canvas is not seen by other checks."""
    tested = 0
    for name, view, now in views(key):
        for plot in map(PLOTS.get, NAMED):
            places = view.places(plot, now)
            axes = plot.axes_of(view)
            for row in (row for row in rows_of(plot) if row.name in boxes(view, plot, now)):
                x, y = (float(np.ravel(each)[0]) for each in places[row.name][:2])
                place, look = box(row, x, y, places[row.name][2], axes), row.look_in(dark)
                for share in (0.05, 0.5, 0.95):
                    u = place.left + share * (place.right - place.left)
                    at = axes[0].start + u / WIDTH * (axes[0].end - axes[0].start)
                    up = (place.bottom + place.top) / 2 / HEIGHT
                    up = axes[1].start + up * (axes[1].end - axes[1].start)
                    for ground in grounds(view, plot, places, at, up, dark):
                        seen = over(look["background_fill_color"], ground, look["background_fill_alpha"])
                        assert contrast(look["text_color"], seen) >= 4.5, (name, row.name, seen)
                        tested += 1
    assert tested > 300


@pytest.mark.parametrize("query", ["", f"?preset={DROP}"])
def test_boxes_are_those_that_a_browser_paints(server, context, query):
    """Widths of the letters, and the size of the plots of a phone, on which the places are found."""
    page = context.new_page()
    page.set_viewport_size({"width": 390, "height": 844})
    explorer = Explorer(page, server.url + query)
    for name in NAMED:
        sizes = "(name) => ['inner_width', 'inner_height'].map((each) => explorer.model(name)[each])"
        wide, high = page.evaluate(sizes, name)
        # A little is seen below zero.
        assert wide / 1.02 >= WIDTH, name
        assert high / 1.05 >= HEIGHT, name
        texts = page.evaluate("""(name) => {
          const context = document.createElement("canvas").getContext("2d")
          context.font = "12px helvetica"
          const drawn = explorer.model(name).renderers.find((each) => each.name === "labels")
          const texts = drawn.data_source.data.text.filter(Boolean)
          return texts.map((text) => [text, context.measureText(text).width])
        }""", name)  # fmt: skip
        assert texts
        for text, measured in texts:
            assert measured - 2 <= width(text) <= 1.15 * measured + 3, text
    assert explorer.problems == []
    page.close()
