"""What the plots show, as arrays and as Bokeh figures: every row against the core, without a browser."""

import json
import re
from dataclasses import replace
from itertools import product

import bokeh.models as bk
import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.common.quantities import CHOICES, unicode_subscripts
from app.explorer import changes
from app.explorer.drives import follow, scene_of
from app.explorer.extras import notes
from app.explorer.extras.oblique import leaning
from app.explorer.extras.section import section
from app.explorer.extras.surface import Z as FAR_Z
from app.explorer.extras.surface import surface
from app.explorer.figures import Picture, drawn, legend, picture_of, ticks
from app.explorer.layout import frames, marked_states
from app.explorer.plot import Plot, View, rows_of
from app.explorer.plots import NAMED, PLOTS, D, F, P, R, X, force, pressure
from app.explorer.state import medium, preset_state, profile
from mdr_core.show.figures import line, mark, radii
from mdr_core.show.springs import SPRINGS
from mdr_core.show.units import written

from ..approx import approx
from .conftest import DROP, ELASTIC, GOLD, PUNCH
from .states import numbers, solved, state_with, view_of, viscous
from .test_drawn import amounts
from .test_drives import oblique_state

PDMS = "microsphere-pdms"
SHAPED = [shape for shape in CHOICES["shape"].options if shape != "sampled"]


@pytest.mark.parametrize("shape", SHAPED)
def test_loading_curve_and_pressure_are_those_of_the_core(shape):
    state = state_with(shape=shape)
    view = view_of(state)
    for name in ("elastic", "yielding"):
        depth, curve = force(view, 0)[name]
        result = mdr.indent(profile(state), medium(state), depth[:, None])
        np.testing.assert_allclose(curve, result.force[:, 0], rtol=1e-9, atol=1e-30)
    r, p = pressure(view, view.course.now)["p(r)"]
    np.testing.assert_allclose(p, np.minimum(view.course.state.pressure(r), 1e3 * view.end(P)), rtol=1e-9)


def drawn_with_every_option(view):
    """Plots that apply to a view, each with the view and with every other option of its choices."""
    for plot in (plot for plot in PLOTS.values() if plot.applies(view)):
        yield plot, view
        for name in plot.controls:
            for option in CHOICES[name].options:
                yield plot, View(view.state.replace(**{name: option}), view.course, view.computed)


@pytest.mark.parametrize("damping", ["none", "eta"])
def test_every_plot_of_every_state_can_be_drawn(damping):
    """Every plot that has its axes has all its rows in every state, and the same length in every column.

    With every option of its choices, and in an impact with adhesion, which has no motion.
    """
    r = np.linspace(0, 100e-9, 30)
    tip = changes.take_tip(preset_state(), (r, r**2 / 200e-9), "")
    oblique = state_with(DROP, "oblique", damping=damping)
    sticky = state_with(PDMS, "impact", adhesion="work")
    assert follow(sticky).hit is not None
    assert follow(sticky).motion is None
    views = [view_of(state) for state in (preset_state(), tip, sticky, state_with(DROP, damping=damping))]
    # An oblique impact beside a held one.
    for view in (*views, view_of(oblique, 1.0, oblique)):
        for plot, chosen in drawn_with_every_option(view):
            picture, names = picture_of(plot), {row.name for row in rows_of(plot)}
            for i in range(0, len(chosen.course), 25):
                rows = chosen.places(plot, i)
                assert all(np.size(x) == np.size(y) for x, y, *_ in rows.values())
                assert rows.keys() == names | ({"image"} if getattr(plot, "image", None) else set())
                for data in picture.columns(chosen, i).values():
                    assert len({len(column) for column in data.values()}) == 1


def test_a_peak_that_the_axis_does_not_reach_is_named():
    view = view_of(preset_state())
    states, half = view.course.states, view.end(R)
    tops = {i: states[i].pressure(radii(states[i], half)) for i in range(1, view.course.peak)}
    said = {i: pressure(view, i)["exceeds"][2] for i in tops}
    cut = [i for i, p in tops.items() if np.max(p) > view.end(P)]
    assert [i for i in tops if said[i]] == cut
    first = next(i for i in cut if np.isfinite(tops[i]).all())
    value, unit = re.search(r"= ([\d.]+) (\wPa)", said[first]).groups()
    assert float(value) * {"GPa": 1e9, "TPa": 1e12}[unit] == approx(np.max(tops[first]), rel=0.01)
    assert "∞ at the rim" in pressure(view_of(preset_state(PUNCH)), 50)["exceeds"][2]


def test_a_plot_without_contact_says_so():
    """Before first contact and after its loss, where the pressure is zero everywhere."""
    course = view_of(preset_state()).course
    said = [pressure(view_of(preset_state()), i)["exceeds"][2] == "no contact" for i in range(len(course))]
    assert said == (course.states.contact_radius == 0).tolist()
    assert said[0]
    assert said[-1]


def test_the_player_marks_the_largest_depth_and_the_loss_of_contact():
    for state in (preset_state(), preset_state(DROP)):
        course = view_of(state).course
        marks = marked_states(course)
        assert course.progress[marks["largest depth"]] == 1
        lost = marks["loss of contact"]
        assert course.states.contact_radius[lost - 1] > 0
        assert course.states.contact_radius[lost] == 0
    # A prescribed path may lose contact many times.
    assert set(marked_states(view_of(state_with(GOLD, "path")).course)) == {"largest depth"}


def test_after_another_hit_depth_and_force_of_yield_belong_together():
    hit = scene_of(preset_state(DROP)).solve()
    state = changes.hit_again(preset_state(DROP))
    course = follow(state)
    again = float(hit.plastic_depth) + medium(state).critical_depth
    assert numbers(course)["yield_force"] == approx(float(course.onset.force))
    np.testing.assert_allclose(force(view_of(state), 0)["onset of yield"][0], again)


def test_only_exceeded_assumptions_are_seen_and_the_rest_folds():
    def poisson(state):
        return {level for level, text in notes.limits(follow(state), state) if "ν = ½" in text}

    state = viscous()
    assert poisson(state) == {"beyond"}
    assert poisson(state.replace(nu_1=0.5)) == {"good"}
    given = changes.choose(state, "elasticity", "modulus")
    assert poisson(given) == {"note"}
    assert medium(given).poisson == 0.5
    html = notes.below(view_of(preset_state()))
    assert html.index("<details>") == 0
    steep = preset_state(DROP).replace(speed=500.0)
    html = notes.below(view_of(steep))
    assert html[: html.index("<details>")].count('class="beyond"') >= 2


def test_a_hold_of_a_medium_without_viscosity_says_that_nothing_changes():
    """Creep of an elastic-plastic medium: depth and force are constant over the whole hold."""
    for damping, pattern in product(("none", "eta"), ("creep", "hold", "cycles")):
        state = state_with(GOLD, "path", pattern=pattern, damping=damping)
        course = follow(state)
        said = [text for _, text in notes.limits(course, state) if "Without viscosity" in text]
        assert len(said) == (damping == "none" and pattern != "cycles")
        if said:
            held = course.motion.time >= state["path.ramp_time"]
            for values in (course.states.depth[held], course.states.force[held]):
                # To the rounding of the search for the depth under a force.
                assert np.ptp(values) <= 1e-9 * values.max()


@pytest.mark.parametrize("shape", SHAPED)
def test_the_surface_lies_on_the_tip_in_contact_and_below_it_beside(shape):
    state = state_with(shape=shape)
    view, made = view_of(state, 1.4), profile(state)
    now = view.course.state
    r, z = surface(view, view.course.now)["deformed surface"]
    gap = made.height(np.minimum(np.abs(r), made.known_radius)) - now.depth - z
    inside, scale = np.abs(r) <= now.contact_radius, view.end(FAR_Z)
    assert inside.sum() > 10
    # To the rounding of a depth.
    assert np.max(np.abs(gap[inside])) < 1e-14 * scale
    assert np.all(gap[~inside] > -1e-12 * scale)


@pytest.mark.parametrize("quantity", ["max_shear", "von_mises", "zz"])
@pytest.mark.parametrize("key", [ELASTIC, DROP])
def test_the_section_shows_the_stress_of_the_core(key, quantity):
    course = follow(preset_state(key))
    found = section(course, (quantity,))
    state, (r, z, colours) = course.state, found.axes
    (left, right), (bottom, top), image = found.rows["image"]
    assert (left, right, bottom, top) == (r.start, r.end, z.start, z.end) == (0, r.end, -r.end, 0)
    assert image.shape == PLOTS["section"].image
    down, along = (30 + 0.5) / image.shape[0], (50 + 0.5) / image.shape[1]
    stress = state.stress(r.end * along, -bottom * (1 - down))
    expected = {"zz": -stress.zz, "max_shear": stress.max_shear, "von_mises": stress.von_mises}[quantity]
    assert image[30, 50] == approx(expected, rel=1e-12)
    drawn_radii = [found.rows[name][0][0] for name in ("contact radius a", "plastic zone c")]
    # Where nothing has yielded no zone is drawn.
    np.testing.assert_array_equal(drawn_radii, [state.contact_radius, state.plastic_radius or np.nan])
    place = found.rows["largest"]
    if quantity == "zz":
        assert np.isnan(place[0]).all()
    else:
        peak = state.stress_peak(quantity)
        assert (place[0][0], place[1][0]) == (peak.r, -peak.z)
        assert image.max() <= peak.value <= colours.end
    if (key, quantity) == (ELASTIC, "max_shear"):
        # Hertz, ν of the preset: 0.3 to 0.33 p₀ on the axis, 0.4 to 0.6 a deep; the note says so.
        assert peak.value / state.pressure(0.0) == approx(0.31, abs=0.02)
        assert f"{peak.value / 1e6:.1f} MPa" in found.note
    unloaded = section(replace(course, now=len(course) - 1), (quantity,))
    assert (unloaded.rows, unloaded.note) == ({}, "No contact, and so no stress.")


def test_springs_lean_as_far_as_they_are_loaded_and_stick_where_the_core_says():
    course = solved(oblique_state())
    view, m = View(oblique_state(), course), course.motion
    spacing = 2 * view.end(X) / SPRINGS
    share = m.stick_radius[1:-1] / m.contact_radius[1:-1]
    i = 1 + int(np.argmin(np.abs(share - 0.6)))
    rows = view.places(PLOTS["springs"], i)
    # The middles of the lines below the feet.
    stick, slip = (np.abs(rows[name][0].reshape(-1, 3)[:, :2].mean(axis=1)) for name in ("sticks", "slips"))
    assert stick.max() == approx(m.stick_radius[i], abs=1.5 * spacing)
    assert slip.min() > stick.max()
    # The springs carry the force: along the surface κE* times how far they lean.
    r = np.linspace(0, float(m.contact_radius[i]), 4001)
    lean, _ = leaning(course, i, r)
    made = course.scene.medium
    force = 2 * made.tangential_ratio * made.E_star * trapezoid(lean, r)
    assert force == approx(m.tangential_force[i], rel=0.01)


def jkr_loss(E_star, w, R):
    """Energy (J) of the elastic springs and the surfaces lost at first contact and at the pull-off, of JKR.

    The springs at x are compressed by d − x²/R, with d = a²/R − √(2πaw/E*). At first contact d = 0, and at
    the pull-off dd/da = 0.
    """
    stretch = np.sqrt(2 * np.pi * w / E_star)
    a = (stretch * R * np.array([1, 1 / 4])) ** (2 / 3)
    d = a**2 / R - stretch * np.sqrt(a)
    stored = E_star * (d**2 * a - 2 * d * a**3 / (3 * R) + a**5 / (5 * R**2))
    first, last = stored - np.pi * w * a**2
    return last - first


def polygon(x, y):
    """Area of a polygon."""
    return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2


@pytest.mark.parametrize(
    ("key", "radius", "depth"),
    [(ELASTIC, 1e-3, 1e-6), (ELASTIC, 1e-3, 1e-5), (ELASTIC, 1e-3, 1e-4), (PDMS, 50e-6, 3e-7)],
)
def test_elastic_adhesion_loses_what_jump_and_pull_off_take_at_every_depth(key, radius, depth):
    """Above first contact loading and unloading are one curve: nothing else is lost, nothing is gained."""
    shape = {"shape": "paraboloid", "paraboloid_radius": radius, "max_depth": depth}
    state = state_with(key, plasticity="none", adhesion="work").replace(work_of_adhesion=0.05, **shape)
    view, expected = view_of(state), jkr_loss(medium(state).E_star, 0.05, radius)
    for i in range(0, len(view.course), 10):
        rows = view.places(PLOTS["force"], i)
        assert np.isnan(rows["gained"][0]).all()
        # Chords of some 10⁻⁴, and three digits.
        assert polygon(*rows["dissipated"]) == approx(expected, rel=1e-3)
        assert re.findall("dissipated|gained", rows["W_a"][2]) == ["dissipated"]
        [said] = amounts(rows["W_a"][2])
        assert said == approx(expected, rel=5e-3)


def test_the_loop_of_yield_with_adhesion_is_plastic_work_and_what_the_surfaces_take():
    """Yield, the jump into contact of JKR and the rim of the imprint, π w c²; before yield JKR's alone.

    The energies are said where their areas are inside the axes.
    """
    state = state_with(PDMS, adhesion="work").replace(work_of_adhesion=0.05, max_depth=1.7672e-6)
    view, made, R = view_of(state), medium(state), 50e-6
    i, depth = view.course.peak, 1.7672e-6 - medium(state).critical_depth
    a = (2 * np.pi * 0.05 * R**2 / made.E_star) ** (1 / 3)
    plastic = made.critical_depth * 4 / 3 * made.E_star * R**0.5 * depth**1.5
    expected = plastic + 0.3 * made.E_star * a**5 / R**2 + np.pi * 0.05 * R * depth
    for each in (i, i + 20, len(view.course) - 1):
        rows = view.places(PLOTS["force"], each)
        said = amounts(rows["W_a"][2])
        assert said[:2] == approx([polygon(*rows[name]) for name in ("dissipated", "gained")], rel=5e-3)
        assert said[2] == approx(expected, rel=2e-3)
    # The loop of an early state is pulled off below the axis, on which the pull-off of the course is.
    early = int(np.argmax(view.course.states.depth > 0.9 * made.critical_depth))
    rows = view.places(PLOTS["force"], early)
    assert polygon(*rows["dissipated"]) == approx(jkr_loss(made.E_star, 0.05, R), rel=2e-3)
    assert rows["dissipated"][0].min() < view.axis(D).start
    assert rows["W_a"][2] == ""


@pytest.mark.parametrize("drive", ["force", "impact"])
def test_no_loop_with_adhesion_gains_and_energies_are_said_where_it_is_drawn(drive):
    """A cone under a force is pulled off above first contact: no loop is closed before it yields."""
    view = view_of(state_with(GOLD, drive, adhesion="work").replace(work_of_adhesion=0.5))
    said = []
    for i in range(0, len(view.course), 10):
        rows = view.places(PLOTS["force"], i)
        seen = {name for name in ("dissipated", "gained") if np.isfinite(rows[name][0]).any()}
        named = set(re.findall("dissipated|gained", rows["W_a"][2]))
        inside = bool(seen) and rows["dissipated"][0].min() > view.axis(D).start - 1e-6 * view.end(D)
        assert named == (seen if inside else set())
        said.append(amounts(rows["W_a"][2]))
        assert all(amount > 0 for amount in said[-1])
    assert not said[0]
    assert said[-1]


def test_a_new_plot_is_one_entry():
    """The example of how to add a plot."""

    def work(view, i):
        course = view.course
        depth, lost = course.states.depth, course.ledger.plastic_work / course.scene.medium.critical_depth
        return {"W_p/d_c": (depth, lost), "now": (depth[[i]], lost[[i]])}

    plot = Plot(
        "work", "Plastic work", "W_p = d_c φ(d_p)", (D, F),
        (line("W_p/d_c", "yielded", 2.5, symbol="W_p/d_c"), mark("now")),
        work, tab="Work",
    )  # fmt: skip
    view, picture = view_of(preset_state()), Picture(plot)
    data = {source.name: columns for source, columns in picture.columns(view, 20).items()}
    assert data["work lines"]["row"] == [unicode_subscripts("W_p/d_c")]
    assert data["work marks"]["x"][0] == approx(view.course.states.depth[20] * 1e9, rel=1e-3)
    # The curve stays while the scene is played.
    sources, [marks], _, _ = frames(view, [picture])
    assert [source.name for source in sources] == ["work marks"]
    assert json.loads(marks[20]) == {name: data["work marks"][name] for name in ("x", "y")}
    assert legend(plot, drawn(view, plot)).count("<span") == 2


def test_another_theme_is_another_palette():
    views = [view_of(preset_state().replace(dark=dark)) for dark in (False, True)]
    picture = Picture(PLOTS["force"])
    light, dark = (list(picture.columns(view, 5).values()) for view in views)
    for one, other in zip(light, dark, strict=True):
        colours = [name for name in one if name.endswith("color")]
        assert colours
        assert all(one[name] != other[name] for name in colours)
    bar, view = picture_of(PLOTS["section"]), views[1]
    view.computed["section"] = section(view.course, ("zz",))
    bar.show(bar.columns(view, view.course.now), view)
    # The numbers of the colour bar can be read in the dark.
    assert bar.figure.select_one(bk.ColorBar).major_label_text_color == "#e4e7eb"


def test_the_models_of_a_figure_are_few():
    figures = [Picture(PLOTS[name]).figure for name in NAMED]
    assert sum(len(figure.references()) for figure in figures) < 180
    assert len(NAMED) == 3
    tabs = [plot.tab for plot in PLOTS.values() if plot.tab]
    assert len(set(tabs)) == len(tabs) == len(PLOTS) - len(NAMED)


def test_legends_name_what_is_drawn_only():
    shown = drawn(view_of(preset_state()), PLOTS["force"])
    assert "held 1" not in shown
    elastic = preset_state(ELASTIC)
    assert not drawn(view_of(elastic), PLOTS["force"]).keys() & {"yielding", "plastic work Wₚ"}
    elastic = changes.choose(elastic, "drive", "impact")
    assert set(drawn(view_of(elastic), PLOTS["energy"])) == {"stored", "kinetic", "time"}


def test_numbers_along_a_logarithmic_axis_have_room():
    short, _ = ticks(0.9, 90)
    assert [tick for tick in short.ticks if 0.9 <= tick <= 90] == [1, 2, 5, 10, 20, 50]
    assert [type(ticks(1, most)[0]).__name__ for most in (3, 1000)] == ["BasicTicker", "LogTicker"]
    # Units of areas are a million apart.
    assert [written(area, "area") for area in (9.99e-9, 4.98e-7)] == ["9990 µm²", "0.4980 mm²"]
