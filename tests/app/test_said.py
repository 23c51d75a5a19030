"""What the page says and draws where it once was wrong, or said too much, without a browser."""

import re

import numpy as np

from app.common.host import last
from app.common.quantities import CHOICES
from app.common.ui import CSS
from app.explorer import readouts, theory
from app.explorer.changes import choose, hit_again, put
from app.explorer.extras import share, sweep
from app.explorer.figures import Picture, drawn, ticks
from app.explorer.link import file_name
from app.explorer.page import Page
from app.explorer.plots import PLOTS
from app.explorer.state import PRESETS, preset_state
from mdr_core.show.units import written

from ..approx import approx
from .conftest import DROP, ELASTIC, GOLD
from .states import part, press, side, state_with, view_of


def said(page, note):
    return re.sub("<[^>]+>", "", part(page, f"note {note}").look["object"])


def test_over_an_imprint_yield_goes_on_below_it():
    """Class (b): at the imprint and d_c = π q_c/(2E*), which is where a virgin surface begins to yield."""
    page = Page(f"preset={DROP}")
    assert "Yield starts at dy = 59.90 µm" in said(page, "medium")
    page.apply(lambda state: put(state, "plastic_depth", 3e-4))
    # 0.3 mm and 59.90 µm.
    assert "Over the imprint yield goes on at d = 359.9 µm" in said(page, "medium")
    page.apply(hit_again)
    assert "59.90" not in said(page, "medium")


def test_a_scene_that_does_not_yield_has_no_plastic_zone():
    for state in (preset_state(ELASTIC), state_with(GOLD).replace(max_depth=1e-9)):
        view = view_of(state)
        assert float(np.max(view.course.states.plastic_depth)) == 0
        assert "plastic zone, on loading" not in drawn(view, PLOTS["force"])
    assert "plastic zone, on loading" in drawn(view_of(preset_state()), PLOTS["force"])


def test_beside_the_springs_stands_when_one_yields_and_the_equations_stand_below():
    """Class (b): d_c = π q_c/(2E*) = 1.796 nm. Constant hardness: π a H/(2E*), at the present radius."""

    def aside(state, at=1.0):
        return PLOTS["springs"].aside(view_of(state, at))

    assert aside(preset_state()) == "a spring yields at u = d_c = 1.796 nm"
    state = state_with(plasticity="constant")
    said = [aside(state, at) for at in (0.5, 1.0)]
    for text, at in zip(said, (0.5, 1.0), strict=True):
        now = view_of(state, at).course.state
        cap = np.pi * float(now.contact_radius) * state.volume_hardness / (2 * state.E_star)
        assert text.startswith(f"a spring yields at u = u_c = {written(cap, 'length')} for a = "), text
    assert said[0] != said[1]
    for nothing in (state_with(plasticity="none"), state_with("microsphere-pdms", adhesion="work")):
        assert aside(nothing) == ""
    page = Page()
    titles = [card.head.parts["formula"].look["object"] for card in page.layout.cards.values()]
    assert not [title for title in titles if re.search(r"\(\d+\)|∫", title)]
    for card in page.layout.cards.values():
        assert card.plot.title in page.layout.below.object
    assert "∫ a(s) ds" in page.layout.below.object


def test_friction_is_said_to_be_the_work_so_far_beside_what_is_of_the_end():
    page = Page(f"preset={DROP}&drive=oblique")
    heads = part(page, "heads").look["object"]
    assert "friction so far" in heads


def test_a_sweep_has_the_unit_of_its_present_value():
    """A drop of 2.75 J over five decades: in J, although the range ends at 825 J and begins at 9 mJ."""
    state = preset_state(DROP).replace(**{"sweep.swept": "energy", "sweep.against": "restitution"})
    found = last(sweep.found(view_of(state).course, sweep.asked(state)))
    assert found.axes[0].label == "W, impact energy at fixed mass (J)"
    assert found.axes[0].start / found.axes[0].factor == approx(2.75 / 300, rel=1e-3)
    # A thousand times as hard, a thousand times the energy.
    state = state.replace(speed=state.speed * 1000**0.5)
    assert last(sweep.found(view_of(state).course, sweep.asked(state))).axes[0].unit == "kJ"


def test_both_logarithmic_axes_write_their_numbers_in_one_way():
    _, short = ticks(0.01, 0.4)
    _, long = ticks(0.01, 1e3)
    assert short.code == long.code


def test_compare_says_what_it_has_done_where_one_looks_and_until_something_changes():
    page = Page()
    press(page, "Compare")

    def kept():
        figure = page.layout.cards["force"].picture.figure
        (source,) = (each.data_source.data for each in figure.renderers if each.name == "labels")
        return source["text"][source["row"].index("kept")]

    assert kept() == "Kept for comparison. Now change something."
    assert "Kept for comparison." in page.layout.parts["comparison"].view[-1].object
    page.apply(lambda state: put(state, "max_depth", 5e-9))
    assert kept() == ""


def test_pressure_has_one_name_and_what_is_below_the_surface_no_height():
    for name, plot in PLOTS.items():
        titles = [along.title for along in plot.axes]
        rows = [row.name + row.symbol for row in plot.rows]
        assert not [text for text in (*titles, *rows) if "zz" in text or "height" in text], name
    assert PLOTS["pressure"].axes[1].title == "p, pressure"
    # What p is stands with the equation.
    assert "p(r) = −σ_zz(r)" in PLOTS["pressure"].formula_of(view_of(preset_state()).course)


def test_typing_the_modulus_of_two_bodies_unfolds_nothing_and_what_is_unfolded_is_folded_again():
    page = Page()
    page.apply(lambda state: put(state, "E_star", 60e9))
    assert PRESETS[GOLD].values["E_1"] != page.state.E_1
    more = "More about the medium"
    assert part(page, more).look["pressed"] is False
    # A viscosity is seen when it comes, and may be folded.
    page.apply(lambda state: choose(state, "damping", "eta"))
    assert part(page, more).look["pressed"] is True
    assert not part(page, more).look["disabled"]
    press(page, more)
    assert part(page, more).look["pressed"] is False
    page.apply(lambda state: put(state, "q_c", 50.0))
    assert part(page, more).look["pressed"] is False


def test_files_of_two_scenes_have_two_names():
    opening = preset_state()
    states = [opening, opening.replace(max_depth=5e-9), state_with(DROP), state_with(GOLD, "impact")]
    names = [file_name(state, "curves.csv") for state in states]
    assert names[0] == "berkovich-gold_curves.csv"
    assert names[1] == "berkovich-gold_d_max=5nm_curves.csv"
    assert len({*names}) == len(names)
    assert all(re.fullmatch(r"[\w.=+-]+", name) for name in names)
    page = Page()
    shown = side(page, "share")
    page.apply(lambda state: state.replace(max_depth=5e-9))
    assert names[1] in [each.filename for each in shown.view.select(share.pn.widgets.FileDownload)]


def test_a_line_has_at_most_as_many_numbers_as_there_is_room_for():
    """Eight, each of which stands beside the others at 1280 pixels."""
    assert "repeat(8," in CSS
    for drive, option in CHOICES["drive"].options.items():
        assert len(option.line) <= readouts.MOST, drive


def test_a_page_opens_in_the_theme_that_the_browser_has_told():
    dark = Page("", True)
    assert dark.state.dark
    ink = dark.layout.cards["force"].picture.layers[-1].source.data["text_color"][0]
    assert ink == "#e4e7eb"
    # A link that asks for a theme is right; the address then has it.
    assert not Page("dark=0", True).state.dark
    assert dark.query()[0] == ""


def test_the_mark_of_the_present_state_is_whole_without_force():
    """It is 13 pixels wide, in a plot of at least 150 pixels."""
    page = Page("at=2")
    picture = page.layout.cards["force"].picture
    assert isinstance(picture, Picture)
    below = -picture.figure.y_range.start / (picture.figure.y_range.end - picture.figure.y_range.start)
    assert below * 150 >= 6.5


def test_the_theory_leads_to_no_file_that_is_not_served():
    shown = theory.html()
    assert not re.findall(r'href="(?!#|\?|http)[^"]*"', shown)
    # Its picture is in it.
    assert re.findall(r'src="([^"]{26})', shown) == ["data:image/svg+xml;base64,"]
