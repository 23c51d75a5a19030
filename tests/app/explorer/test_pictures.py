"""Saved pictures: labels, legends and the picture of all plots."""

import io

import numpy as np
import pytest

from app.explorer.extras.cards import of_all
from app.explorer.figures import drawn, legend
from app.explorer.plots import PLOTS
from mdr_core.show.figures import ROLES

from ...approx import approx
from ..conftest import DROP, Explorer
from ..states import state_with, view_of


@pytest.fixture(scope="module", params=["light", pytest.param("dark", marks=pytest.mark.full)])
def saved(request, server, context):
    """Pictures of an impact: of every plot that is seen, and whether they are dark."""
    dark = request.param == "dark"
    explorer = Explorer(context.new_page(), f"{server.url}?preset={DROP}&dark={int(dark)}")
    pictures = {name: explorer.save(name) for name in ("springs", "pressure", "force")}
    # One optional plot is open at a time.
    for tab, name, row in (
        ("Sweep", "sweep", "this scene"), ("Section", "section", "plastic zone c"),
        ("Energy", "energy", "time"), ("In time", "motion", "time"),
    ):  # fmt: skip
        explorer.open(tab, name, row)
        pictures[name] = explorer.save(name)
    yield pictures, dark
    assert explorer.problems == []
    explorer.page.close()


def runs(there, gap):
    """First and last index of each run of true values, where fewer than `gap` false ones are no end."""
    at = np.flatnonzero(there)
    ends = np.flatnonzero(np.diff(at) > gap)
    return list(zip(at[[0, *(ends + 1)]], at[[*ends, -1]], strict=True)) if at.size else []


#: Pixels of a picture: below the title of a large plot; from a swatch to its word, and between two items.
TITLE, BESIDE, BETWEEN = 84, 19, 36
Image = pytest.importorskip("PIL.Image")


def legend_of(picture):
    """Swatches in the legend above a plot, as pixels, and how many words stand beside each."""
    image = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), int)
    painted = np.abs(image - image[0, 0]).max(axis=2) > 12
    # The plot begins where its axis does, the first line upward over half of the picture; an image may be
    # painted right of it. Left of it are numbers of the axis, and the legend begins at the same place.
    edge, top = next(
        (column, first)
        for column in range(150, 180)
        for first, last in runs(painted[:, column], 1)
        if last - first > len(image) / 2
    )
    left = edge - 2
    found = []
    for first, last in runs(painted[TITLE : top - 6, left:].any(axis=1), 2):
        line = slice(TITLE + first, TITLE + last + 1)
        columns = painted[line, left:].any(axis=0)
        for begin, end in runs(columns, BETWEEN):
            parts = runs(columns[begin : end + 1], BESIDE)
            swatch = image[line, left + begin : left + begin + parts[0][1] + 1]
            found.append((swatch, len(parts) - 1))
    return found


def has(swatch, wanted):
    return (np.abs(swatch - wanted).max(axis=2) < 8).any()


def colour(role, dark):
    return np.array([int(ROLES[role][dark][k : k + 2], 16) for k in (1, 3, 5)])


def test_words_of_a_saved_legend_stand_beside_what_they_name(saved):
    pictures, dark = saved
    view = view_of(state_with(DROP))
    items, plot = legend_of(pictures["energy"]), PLOTS["energy"]
    assert [words for _, words in items] == len(items) * [1]
    assert len(items) == legend(plot, drawn(view, plot)).count("<span") == 3
    # White lines on an image are seen beside it, too.
    assert [words for _, words in legend_of(pictures["section"])[:2]] == [1, 1]
    # In the order of the words, by their edges.
    for (swatch, _), role in zip(items, ("yielded", "elastic", "speed"), strict=True):
        assert has(swatch, colour(role, dark)), role
    # All swatches of lines and areas are equally wide.
    # Of the motion the solid one: dashes may end in a gap.
    line, _ = legend_of(pictures["motion"])[0]
    assert line.shape[1] == approx(items[0][0].shape[1], abs=4)


def test_a_saved_picture_has_the_labels_of_the_plot_and_then_no_legend(saved):
    pictures, dark = saved
    assert legend_of(pictures["sweep"]) == []
    for name in ("springs", "pressure", "force"):
        image = np.asarray(Image.open(io.BytesIO(pictures[name])).convert("RGB"), int)
        assert has(image[TITLE:], colour("yielded-text", dark)), name
        assert legend_of(pictures[name]) == [], name


def test_dashes_of_a_saved_legend_are_those_of_the_lines(saved):
    """One solid, and dashes 6 4, at two pixels a point."""
    pictures, _ = saved
    swatches = [swatch for swatch, _ in legend_of(pictures["motion"])]
    assert len(swatches) > 1
    for swatch, lengths in zip(swatches, ({56}, {12}), strict=False):
        line = np.abs(swatch - swatch[0, 0]).max(axis=2).max(axis=0) > 60
        seen = [last - first + 1 for first, last in runs(line, 1)]
        # A pixel is lost or won at each end.
        assert all(any(abs(length - wanted) <= 2 for wanted in lengths) for length in seen)
        assert all(any(abs(length - wanted) <= 2 for length in seen) for wanted in lengths)


def test_all_plots_are_one_picture_of_twice_the_screen(projector):
    page = projector.page
    with page.expect_download() as download:
        projector.press("Save plots")
    data = download.value.path().read_bytes()
    assert [int.from_bytes(data[k : k + 4], "big") for k in (16, 20)] == [2560, 1440]
    # Each plot has its colours: springs that have yielded, the pressure, the curve.
    image = np.asarray(pytest.importorskip("PIL.Image").open(io.BytesIO(data)).convert("RGB"), int)
    places = (
        (image[:696, :1280], "#d55e00"),
        (image[696:1392, :1280], "#0072b2"),
        (image[:, 1280:], "#d55e00"),
    )
    for part, colour in places:
        wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
        assert (np.abs(part - wanted).max(axis=2) < 8).sum() > 500


@pytest.mark.parametrize("tiles", [(), ("hardness",)])
def test_plots_of_one_picture_fill_it_side_by_side(tiles):
    """1280 pixels × 696 pixels above the caption, without a gap, each the same width."""
    view = view_of(state_with().replace(tiles=tiles))
    view.computed["save"] = {}
    places = [plot["place"] for plot in of_all(None, view).look["plots"]]
    assert len(places) == 3 + len(tiles)
    filled = np.zeros((696, 1280), int)
    for left, top, width, height in places:
        filled[top : top + height, left : left + width] += 1
    assert np.all(filled == 1)
    assert {width for _, _, width, _ in places} == {640}
