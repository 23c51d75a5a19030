"""The report says and draws what the page does, and needs nothing else."""

import re
from html import unescape

import numpy as np
import pytest

from app import changes
from app.panels import share
from app.panels.readouts import readings, text
from app.panels.report import printed, report
from app.plots import PLOTS
from app.state import PRESETS, preset_state
from app.state.units import written

from .conftest import DROP
from .states import view_of

SHOWN = [
    name
    for name, plot in PLOTS.items()
    if plot.there(view_of(preset_state())) and not plot.find and name != "residual"
]


def plain(html):
    """What is read of a page."""
    body = re.sub(r"<(script|style).*?</\1>", "", html, flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", body)).split())


def assert_names_nothing_outside(html):
    outside = re.sub(r"<script>.*?</script>", "", html, flags=re.DOTALL)
    tags = re.findall(r"<(?:script|link|img|iframe|source)\b[^>]*", outside)
    assert not [tag for tag in tags if re.search(r"(?:src|href)\s*=\s*[\"']?(?!data:)", tag)]


def test_the_report_says_what_the_page_says():
    state = changes.typed(preset_state(DROP), "speed", "2 m/s")
    view = view_of(state, 1.5)
    course, plots = (
        view.course,
        [PLOTS[name] for name in ("springs", "pressure", "force", "motion", "energy")],
    )
    html = report(
        state, view, plots, share.python(course.scene), "http://localhost/app?speed=2.0", ["<b>stiff</b>"]
    )
    assert_names_nothing_outside(html)
    said = plain(html)
    assert f"{PRESETS[DROP].label}, altered" in said
    assert "Held 1: <b>stiff</b>." in said
    for each, values in readings(course).items():
        assert f"{each.known.long_name} {text(each, values, course.now, 5)}" in said
    # What the preset says has its source; what was typed says so.
    assert PRESETS[DROP].sources["q_c"] in said
    assert "2.0000 m/s set on the page" in said
    for limit in course.hit.limits:
        assert limit.sentence.rstrip(".") in said
    assert "mdr.FreeImpact(mass=5.5, speed=2.0)" in said
    assert "http://localhost/app?speed=2.0" in said
    assert all(plot.title in said for plot in plots)
    assert written(2.0, "speed", 5) in said


def test_text_of_others_is_never_markup_in_a_report():
    r = np.linspace(0, 1e-6, 20)
    state = changes.take_tip(preset_state(), (r, r**2 / 1e-5), "20 rows of <img src=x>")
    html = report(state, view_of(state), [PLOTS["force"]], "")
    assert "<img src=x" not in html
    assert "20 rows of <img src=x>" in plain(html)


@pytest.mark.parametrize("name", SHOWN)
def test_figures_hold_the_rows_of_the_page(name):
    """Every row is in the source of the figure, in the units of its axes, to a fraction of a pixel."""
    view = view_of(preset_state())
    plot, figure = PLOTS[name], printed(view, PLOTS[name])
    rows, axes = view.rows(plot, view.course.now), view.axes_of(plot)
    assert figure.x_range.end == pytest.approx(axes[0].end / axes[0].factor)
    found = set()
    for renderer in figure.renderers:
        data = renderer.data_source.data
        for k, row in enumerate(data.get("row", ())):
            axis = axes[2 if renderer.y_range_name == "right" else 1]
            found.add(row)
            if "ys" not in data:
                drawn = [y for y, name in zip(data["y"], data["row"], strict=True) if name == row]
                expected = np.atleast_1d(rows[row][1]) / axis.factor
                np.testing.assert_allclose(drawn, expected, atol=1e-4 * axis.ends[1])
            else:
                # What leaves the axes is cut there.
                assert np.nanmax([*data["ys"][k], axis.ends[0]]) <= axis.ends[1] * (1 + 1e-4)
    assert found == {row.name for row in plot.rows}
