"""The text alternative of a plot has the numbers that are drawn."""

import re

import pytest

from app.described import described
from app.drives import follow
from app.explorer import Explorer
from app.plots import PLOTS
from app.units import written
from app.view import View

from .conftest import DROP


def read(text, pattern):
    """The first number after a pattern."""
    return float(re.search(pattern + r"\D*?(−?[\d.]+)", text)[1].replace("−", "-"))


@pytest.mark.parametrize(
    ("preset", "at"), [(None, 1.0), (DROP, 1.0), (DROP, 1.7), (None, 2.2), (None, 0.0)]
)
def test_every_plot_is_described(preset, at):
    explorer = Explorer(preset) if preset else Explorer()
    view = View(follow(explorer.scene(), at))
    for plot in PLOTS.values():
        if not view.axes.keys() >= set(plot.axes):
            continue
        text = described(view, plot)
        assert text.startswith(f"{plot.title}: ")
        assert not re.search("nan|None|inf", text)


def test_force_and_depth_in_words():
    view = View(follow(Explorer().scene(), 1.0))
    text, way = described(view, PLOTS["force"]), view.way
    assert f"now: d = {written(float(way.state.depth), 'length', 3)}" in text
    # Forces are in the unit of the axis, µN, with three digits.
    assert read(text, "now: d = [^F]*F = ") == pytest.approx(float(way.state.force) * 1e6, rel=1e-2)
    assert read(text, "onset of yield: d = ") == pytest.approx(float(way.onset.depth) * 1e9, rel=1e-2)
    assert "held" not in text


def test_springs_in_words():
    view = View(follow(Explorer().scene(), 1.0))
    text, state = described(view, PLOTS["springs"]), view.way.state
    half = float(state.plastic_radius) * 1e9
    # A spring is drawn at its place, within half the distance to the next, of which there are 60.
    assert read(text, "yielded: from x = [^t]* to ") == pytest.approx(half, abs=40 / 60)
    assert "high" not in text


def test_energies_in_words_are_those_of_the_ledger():
    view = View(follow(Explorer(DROP).scene(), 1.0))
    text, motion = described(view, PLOTS["energy"]), view.way.motion
    assert read(text, "plastic: ") == pytest.approx(motion.plastic_work.max(), rel=1e-2)
    assert read(text, "stored: ") == pytest.approx(motion.stored_energy.max(), rel=1e-2)
    assert "viscous" not in text
