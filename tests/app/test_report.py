"""The report says and draws what the page does, and needs nothing else."""

import re
from html import unescape

import numpy as np

from app import changes
from app.extras.held import Held
from app.extras.share import report
from app.plots import PLOTS
from app.readouts import readings, text
from app.state import PRESETS, preset_state

from .conftest import DROP
from .states import view_of


def plain(html):
    """What is read of a page."""
    body = re.sub(r"<(script|style).*?</\1>", "", html, flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", body)).split())


def test_the_report_says_what_the_page_says():
    state = changes.put(preset_state(DROP), "speed", 2.0)
    view = view_of(state, 1.5)
    course = view.course
    plots = [PLOTS[name] for name in ("springs", "pressure", "force", "motion", "energy")]
    view.computed["held"] = [Held("<b>stiff</b>", course)]
    said = plain(report(view, plots, course.scene.to_python(), "http://localhost/app?speed=2.0"))
    assert f"{PRESETS[DROP].label}, altered" in said
    assert "<b>stiff</b>." in said
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


def test_text_of_others_is_never_markup_in_a_report():
    r = np.linspace(0, 1e-6, 20)
    state = changes.take_tip(preset_state(), (r, r**2 / 1e-5), "20 rows of <img src=x>")
    html = report(view_of(state), [PLOTS["force"]], "")
    assert "<img src=x" not in html
    assert "20 rows of <img src=x>" in plain(html)
