"""Everything that stands on the page says what it is, and leads to the theory."""

import re
from html import unescape

import pytest

import mdr_core as mdr
from app.common.errors import error_text
from app.common.quantities import CHOICES, QUANTITIES, unicode_subscripts
from app.common.tip import read_tip
from app.common.ui import html_subscripts, linked
from app.explorer import changes, theory
from app.explorer.drives import follow
from app.explorer.extras.guide import TOURS
from app.explorer.page import Page
from app.explorer.plots import PLOTS
from app.explorer.readouts import READOUTS, explained, heads, line
from app.explorer.search import AsyncPlot
from app.explorer.state import PRESETS, preset_state

from ..approx import approx
from .conftest import DROP
from .states import fields_of, part, press, side, state_with, stepped, view_of


def places(html):
    """Where the links to the theory of a text lead to."""
    return re.findall(r'href="app/theory\.html#([\w-]+)"', html)


def test_every_number_says_what_it_is():
    for drive in ("depth", "impact", "oblique"):
        course = follow(state_with(DROP, drive, damping="eta"))
        numbers = line(course)
        # In the notes with their equations, and where they are pointed at.
        assert 6 <= explained(numbers).count("<dd>") == heads(numbers).count(' title="') <= 8
        assert all(
            unicode_subscripts(each.help.split(".")[0]) in unescape(heads(numbers)) for each in numbers
        )
    assert all(each.help.endswith(".") for each in (*READOUTS, *QUANTITIES.values()))
    assert all(". " in quantity.help and quantity.equation for quantity in QUANTITIES.values())
    options = [option for choice in CHOICES.values() for option in choice.options.values()]
    assert {name for option in options for name in option.uses} <= QUANTITIES.keys()
    assert {name for option in options for name in option.form} <= CHOICES.keys()
    assert len({each.name for each in READOUTS}) == len(READOUTS)
    assert all(choice.label and choice.help for choice in CHOICES.values())


def test_every_equation_leads_to_the_theory():
    html = theory.html()
    ids = set(re.findall(r'id="((?:eq|section)-\d+)"', html))
    # (11) is where the criterion is stated.
    after = html[html.index('id="eq-11"') :]
    assert after.index("Then the force at yield") < after.index("</p>")
    views = [view_of(state_with(DROP, drive, damping="eta")) for drive in ("depth", "impact", "oblique")]
    formulas = [
        plot.formula_of(view.course) for plot in PLOTS.values() for view in views if plot.applies(view)
    ]
    texts = formulas + [choice.help for choice in CHOICES.values()]
    texts += [part for q in (*QUANTITIES.values(), *READOUTS) for part in (q.help, q.equation)]
    led = {place for text in texts for place in places(linked(text))}
    assert len(led) > 20
    assert led <= ids
    # Each plot leads somewhere.
    assert all(places(linked(formula)) for formula in formulas)


def test_half_angle_beside_the_slope_and_drop_height_beside_the_speed():
    page = Page()
    assert "Half-angle 70.30°" in part(page, "note shape").look["object"]
    page.apply(lambda state: changes.choose(state, "preset", DROP))
    # 5.5 kg at 1 m/s: half a joule a kilogram; v²/2g is 1 m²/s² over 19.6133 m/s².
    said = re.sub("<[^>]+>", "", part(page, "note drive").look["object"])
    assert "Energy 2.750 J" in said
    assert "drop height 50.99 mm" in said
    assert "Half-angle" not in part(page, "note shape").look["object"]
    assert page.state.density == 1900
    # They are those of the speed along the normal, which other drives do not have.
    for drive in ("depth", "path", "oblique"):
        page.choose("drive", drive)
        assert part(page, "note drive").look["object"] == ""


def test_the_form_begins_with_the_drive_and_has_what_is_used():
    page = Page()
    form = page.layout.form.view
    assert fields_of(form) == ["max_depth", "cone_slope", "E_star", "q_c"]
    assert not part(page, "More about the medium").look["pressed"]
    press(page, "More about the medium")
    sources = unescape(part(page, "note sources").look["object"])
    assert all(source in sources for source in PRESETS[page.state.preset].sources.values())
    page.apply(lambda state: changes.choose(state, "damping", "eta"))
    assert part(page, "More about the medium").look["pressed"]
    assert "eta" in fields_of(form)
    assert "no effect here" in part(page, "note more").look["object"]
    page.apply(lambda state: changes.choose(state, "drive", "impact"))
    assert "no effect here" not in part(page, "note more").look["object"]
    assert fields_of(form)[:3] == ["mass", "speed", "plastic_depth"]
    page.apply(lambda state: changes.choose(state, "drive", "oblique"))
    page.apply(lambda state: changes.choose(state, "drive", "depth"))
    assert fields_of(form)[:2] == ["max_depth", "cone_slope"]


def test_guided_scenes_say_what_is_so():
    elastic, begun, deep, lifted = stepped("First yield")
    assert elastic.state.plastic_radius == 0
    assert elastic.state.pressure(0.0) == float("inf")
    assert begun.state.plastic_radius > 0
    assert begun.state.pressure(0.0) < float("inf")
    # (21): the ring a − c stays as wide as it is.
    rings = [float(course.state.contact_radius - course.state.plastic_radius) for course in (begun, deep)]
    assert rings[0] == approx(rings[1], rel=1e-9)
    assert lifted.states.force[lifted.now] == 0
    left = float(deep.state.depth) - elastic.onset.depth
    assert float(lifted.state.depth) == approx(left, rel=1e-9)
    courses = stepped("A fast impact, and what it destroys")
    slow, onset, fast, one, twice, _ = (course.hit for course in courses)
    assert slow.restitution == 1
    assert slow.damaged_area == 0
    assert onset.damaged_area > 0
    assert fast.plastic_work / (fast.mass * fast.speed**2 / 2) > 0.9
    assert twice.damaged_area / one.damaged_area == approx(4, rel=0.05)
    fast, slow, thick, thin = (course.hit for course in stepped("Why a slow drop bounces better"))
    assert slow.restitution > 4 * fast.restitution
    assert thin.contact_time > 2 * thick.contact_time
    assert thin.restitution > thick.restitution
    assert thick.plastic_work == thin.plastic_work == 0
    courses = stepped("It bounces only between two speeds")
    assert [bool(course.hit.captured) for course in courses] == [False, True, True]
    courses = stepped("Harder pressed, harder to pull off")
    forces = [float(course.states.pull_off_force[-1]) for course in courses]
    assert forces[0] < forces[1] == forces[2] < forces[3]


def test_a_guided_scene_is_stepped_through_and_undone():
    page = Page()
    press(page, "Surface")
    opening = page.state.scene_values
    for at, step in enumerate(TOURS["First yield"]):
        side(page, "guide").next.clicks += 1
        assert page.state.max_depth == step["set"]["max_depth"]
        assert page.state.at == step["set"].get("at", 1.0)
        assert f"{at + 1} of 4" in side(page, "guide").words.object
        assert "{" not in side(page, "guide").words.object
    assert side(page, "guide").next.disabled
    told = []
    side(page, "guide").words.param.watch(lambda event: told.append(event.new), "object")
    side(page, "guide").title.value = "A fast impact, and what it destroys"
    # Its text is the only one: it is not taken for a scene that was changed by hand.
    assert [text for text in told if "has been changed" in text] == []
    assert len(told) == 1
    assert "e = 1.00" in re.sub("<[^>]+>", "", side(page, "guide").words.object)
    # A scene has its own plots.
    assert page.state.tiles == ()
    # What it says is gone while the page shows something else.
    page.apply(lambda state: changes.put(state, "speed", 2 * state.speed))
    assert "1 of 6. The scene has been changed" in side(page, "guide").words.object
    page.undo()
    assert "e = 1.00" in re.sub("<[^>]+>", "", side(page, "guide").words.object)
    # Each step that sets something is one change.
    for _ in range(4):
        page.undo()
    while page.history.at:
        page.undo()
    assert page.state.scene_values == opening


def test_python_and_raw_indices_are_not_on_the_page():
    # Laws of the hardness are texts of a list, and Unicode has no lowered c.
    choices = [each for name, each in CHOICES.items() if name != "plasticity"]
    shown = [option.label for choice in choices for option in choice.options.values()]
    shown.append(CHOICES["shape"].help)
    shown += [quantity.label for quantity in QUANTITIES.values()]
    view = view_of(preset_state())
    plots = [plot for plot in PLOTS.values() if plot.applies(view) and not isinstance(plot, AsyncPlot)]
    shown += [axis.label for plot in plots for axis in plot.axes_of(view)]
    assert [text for text in shown if "_" in text] == []
    for shape in CHOICES["shape"].options.values():
        assert "_" not in html_subscripts(shape.height + shape.reduced)
    with pytest.raises(ValueError, match=r"E₁ = 1\.000 mPa is out of bounds"):
        changes.put(preset_state(), "E_1", 1e-3)
    with pytest.raises(ValueError, match="header must name") as refused:
        read_tip("0, 0\n1, 1\n")
    assert "m, mm, µm, nm, pm, Å" in str(refused.value)


def test_a_refused_argument_of_the_core_is_said_by_symbol_value_and_bound():
    """Without the names of Python and the remedies for those who call it; all else as the core has it."""
    with pytest.raises(ValueError, match="E_star") as refused:
        mdr.Medium(E_star=-2e9, q_c=1.0)
    assert error_text(refused.value) == "E*, effective modulus, = −2.000 GPa must be finite and positive"
    assert error_text(ValueError("no contact")) == "no contact"


def test_the_hardness_leads_to_a_law_of_your_own():
    """Its explanation names the class of the library, and links to the section that explains it."""
    html = str(linked(CHOICES["plasticity"].help))
    assert hasattr(mdr, "HardnessLaw")
    link = r'([^.]*HardnessLaw[^.]*)<a href="app/theory.html#(section-\d+)"'
    sentence, place = re.search(link, html).groups()
    assert "Python" in sentence
    section = theory.html().partition(f'id="{place}"')[2].partition('id="section-')[0]
    assert "HardnessLaw" in section
