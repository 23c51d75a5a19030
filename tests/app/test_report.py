"""The report says and draws what the page does, and needs nothing else."""

import re
from html import unescape

import numpy as np
import pytest

from app import export
from app.drives import follow
from app.explorer import Explorer
from app.plots import PLOTS
from app.presets import PRESETS
from app.readouts import cells
from app.report import drawing, report
from app.units import written
from app.view import View

from .conftest import DROP

VIEW = View(follow(Explorer().scene(), 1.0))
SHOWN = [name for name, plot in PLOTS.items() if VIEW.axes.keys() >= set(plot.axes) and not plot.resting]


def plain(html):
    """What is read of a page."""
    body = re.sub(r"<(script|style).*?</\1>", "", html, flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", body)).split())


def assert_names_nothing_outside(html):
    outside = re.sub(r"<script>.*?</script>", "", html, flags=re.DOTALL)
    tags = re.findall(r"<(?:script|link|img|iframe|source)\b[^>]*", outside)
    assert not [tag for tag in tags if re.search(r"(?:src|href)\s*=\s*[\"']?(?!data:)", tag)]


def test_the_report_says_what_the_page_says():
    explorer = Explorer(DROP)
    explorer.type("speed", "2 m/s")
    way = follow(explorer.scene(), 1.5)
    names, view = ["springs", "force", "motion", "pressure", "radii", "energy"], View(way)
    html = report(explorer, view, names, export.python(way), "http://localhost/app", ["<b>stiff</b>"])
    assert_names_nothing_outside(html)
    text = plain(html)
    assert f"{DROP}, altered" in text
    assert "Held 1: <b>stiff</b>." in text
    for _, label, kind, values in cells(way):
        value = float(values if np.ndim(values) == 0 else values[way.now])
        assert f"{label} {written(value, kind, 5)}" in text
    # What the preset says has its source; what was typed says so.
    assert PRESETS[DROP].sources["q_c"][2] in text
    assert "2.0000 m/s set on the page" in text
    for limit in way.hit.limits:
        assert limit.sentence in text
    assert "mdr.impact(profile, medium, mass=5.5, speed=2.0)" in text
    assert "speed=2.0" in text.split("http://localhost/app?")[1]
    assert all(PLOTS[name].title in text for name in ("motion", "energy", "pressure"))


def test_text_of_others_is_never_markup_in_a_report():
    explorer = Explorer()
    r = np.linspace(0, 1e-6, 20)
    explorer.take_tip((r, r**2 / 1e-5), "20 rows of <img src=x>")
    html = report(explorer, View(follow(explorer.scene(), 1.0)), ["force"], "")
    assert "<img src=x" not in html
    assert "20 rows of <img src=x>" in plain(html)


@pytest.mark.parametrize("name", SHOWN)
def test_figures_hold_the_columns_of_the_page(name):
    """Every row that the page sends is in the source of the figure, in the units of its axes."""
    view = VIEW
    plot, made = PLOTS[name], drawing(view, name)
    columns, x = view.columns(plot, view.way.now), view.axes_of(plot)[0]
    assert made.x_range.end == pytest.approx(x.end / x.factor)
    found = set()
    for renderer in made.renderers:
        data = renderer.data_source.data
        if "image" in data:
            np.testing.assert_allclose(data["image"][0], columns["image"][2] / view.axes_of(plot)[2].factor)
        for k, row in enumerate(data.get("row", ())):
            if renderer.name.startswith("tips"):
                continue
            size = view.axes_of(plot)[2 if renderer.name.endswith("right") else 1].factor
            drawn = np.ravel(data["ys"][k]) if "ys" in data else np.asarray(data["y"])[data["row"] == row]
            np.testing.assert_allclose(drawn, np.ravel(columns[row][1]) / size)
            found.add(row)
    kinds = {row.name for row in plot.rows if row.kind != "labels"}
    assert found == kinds
