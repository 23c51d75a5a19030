"""What rounding leaves of a sum is shown and exported as 0; links have the digits that fields show."""

import re
from urllib.parse import parse_qsl

import numpy as np
import pytest

from app.common.tip import read_tip
from app.explorer import changes, link, readouts
from app.explorer.drives import follow
from app.explorer.extras.comparison import is_held, toggle_hold
from app.explorer.extras.share import csv
from app.explorer.page import Page
from app.explorer.state import PRESETS, preset_state
from app.explorer.widgets import Field
from mdr_core.show.units import UNITS

from ..approx import approx
from .conftest import DROP, GOLD
from .states import state_with, table, view_of

#: A power of ten in a readout: no preset has a result below a thousandth of the smallest unit.
TINY = re.compile(r"× 10⁻")


@pytest.mark.parametrize("key", PRESETS)
@pytest.mark.parametrize("drive", ["depth", "force", "path", "impact"])
@pytest.mark.parametrize("at", [0.0, 1.0, 2.0, 2.2])
def test_no_readout_is_a_residue_at_the_ends_of_a_path(key, drive, at):
    state = state_with(key, drive).replace(at=at)
    course = follow(state)
    shown = {each.name: readouts.text(each, v, course.now) for each, v in readouts.readings(course).items()}
    assert [text for text in shown.values() if TINY.search(text)] == []
    if at == 2.2 and drive in ("depth", "force") and not course.adhesive:
        assert shown["depth"] == shown["force"] == "0"


@pytest.mark.parametrize("key", PRESETS)
def test_a_path_ends_exactly_at_the_depth_that_is_asked_for_and_at_the_surface(key):
    """In the exported table, too: the last row is the indenter at the undeformed surface, without force."""
    state = preset_state(key)
    if state.drive != "depth":
        state = changes.choose(state, "drive", "depth")
    view = view_of(state)
    depth = view.course.states.depth
    assert float(depth.max()) == state.max_depth
    assert depth[-1] == 0.0
    *_, head, last = [line.split(",") for line in csv(view).splitlines() if line[0] != "#"][:: len(depth)]
    columns = dict(zip(head, last, strict=True))
    at = [text for name, text in columns.items() if " d (m)" in name or " F (N)" in name]
    assert at == ["0.0", "0.0"]


def test_a_tip_of_samples_on_both_sides_says_nothing_of_a_deviation_by_rounding():
    """Nine samples of a convex profile, five of them of one side."""
    r = np.linspace(-60, 60, 9)
    text = table({"r (nm)": r, "z (nm)": r**2 / 100}, "; ")
    (radii, _), note = read_tip(text)
    assert note == "9 rows reduced to 5 samples"
    assert len(radii) == 5
    # Samples out of order are taken as they are.
    mixed = np.random.default_rng(0).permutation(r[4:])
    assert read_tip(table({"r (nm)": mixed, "z (nm)": mixed**2 / 100}))[1] == "5 samples, as in the file"
    # A deviation that a file has is told: of 40 rows, with a wave of 0.1 nm.
    many = np.linspace(0, 60, 200)
    waved = table(
        {"r (nm)": many, "z (nm)": many**2 / 30 + 0.01 * np.random.default_rng(1).normal(size=200)}
    )
    assert "rms deviation" in read_tip(waved)[1]


@pytest.mark.parametrize("unit", ["metres", "Meters", "in m", "metre"])
def test_a_tip_whose_header_spells_its_unit(unit):
    r = np.linspace(0, 6, 7)
    (radii, _), _ = read_tip(table({f"r ({unit})": r, f"z ({unit})": r**2 / 100}))
    assert radii[-1] == 6


def test_a_refused_header_has_no_words_of_python():
    with pytest.raises(ValueError, match="must name the units") as refused:
        read_tip(table({"r": [0, 1, 2], "z": [0, 1, 3]}))
    assert "unit=" not in str(refused.value)


def shown_in_field(state, name):
    """The number (SI) that a field shows."""
    number, _, unit = Field(name, None).part(state).look["text"].partition(" ")
    kind = "slope" if unit == "" else next(k for k, units in UNITS.items() for u in units if u.name == unit)
    return float(number) * next(each.factor for each in UNITS[kind] if each.name == unit)


@pytest.mark.parametrize(
    ("query", "change", "name"),
    [
        ("elasticity=modulus&E_star=86806041176.72249", lambda state: state, "E_star"),
        ("q_c=98.76543210123", lambda state: state, "q_c"),
        ("", lambda state: changes.put(state, "E_star", 80e9), "E_1"),
        ("", lambda state: changes.put(state, "cone_slope", 1 / np.tan(np.radians(68))), "cone_slope"),
        (f"preset={DROP}", changes.hit_again, "plastic_depth"),
        ("", lambda state: changes.choose(state, "plasticity", "constant"), "volume_hardness"),
        ("max_depth=1.23456789e-9", lambda state: state, "max_depth"),
    ],
)
def test_the_address_has_the_digits_of_the_field(query, change, name):
    page = Page(query)
    page.apply(change)
    written = dict(parse_qsl(page.query()[0]))[name]
    assert float(written) == approx(shown_in_field(page.state, name), rel=1e-13)
    digits = f"{float(written):.15e}".partition("e")[0].replace(".", "").rstrip("0")
    assert len(digits) <= 9
    # What is opened from it shows the same, and has the same address.
    again = Page(page.query()[0])
    assert shown_in_field(again.state, name) == approx(shown_in_field(page.state, name), rel=1e-13)
    assert again.query() == page.query()


@pytest.mark.parametrize("key", PRESETS)
def test_the_address_of_a_preset_is_its_name(key):
    assert Page(f"preset={key}").query() == ("" if key == GOLD else f"preset={key}", "")


def test_a_held_scene_is_the_one_that_is_shown_whatever_its_digits():
    state = toggle_hold(link.read("q_c=98.76543210123"))
    assert is_held(state)
