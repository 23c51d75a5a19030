"""All plots: rows, axes, colours, legends, and plots over time."""

import bokeh.models as bk
import numpy as np
import pytest
from scipy.integrate import trapezoid

from app.common.host import last
from app.common.quantities import CHOICES
from app.explorer import changes
from app.explorer.drives import follow
from app.explorer.extras import share, sweep
from app.explorer.extras.scene_file import scene_file
from app.explorer.extras.section import section
from app.explorer.figures import Picture, drawn, picture_of, ticks
from app.explorer.page import Page
from app.explorer.plot import View, rows_of
from app.explorer.plots import NAMED, PLOTS, visible
from app.explorer.search import AsyncPlot, as_steps
from app.explorer.state import PRESETS, preset_state
from mdr_core.show.units import format_quantity

from ...approx import approx
from ..conftest import DROP, ELASTIC
from ..states import PDMS, SILICA, STEEL, oblique_state, part, plain, solved, state_with, view_of, viscous


@pytest.mark.parametrize("damping", ["none", "eta"])
def test_every_plot_of_every_state_can_be_drawn(damping):
    """Every plot that has its axes has all its rows in every state, and the same length in every column.

    With every option of its choices, and in an impact with adhesion, which has no motion.
    """
    r = np.linspace(0, 100e-9, 30)
    tip = changes.take_tip(preset_state(), (r, r**2 / 200e-9), "")
    oblique = state_with(DROP, "oblique", damping=damping)
    sticky = state_with(PDMS, "impact", adhesion="work")
    views = [view_of(state) for state in (tip, sticky, state_with(DROP, damping=damping))]
    pictures = {plot.name: picture_of(plot) for plot in PLOTS.values()}
    # An oblique impact beside a held one.
    for view in (*views, view_of(oblique, 1.0, oblique)):
        states = 0, len(view.course) // 3, view.course.peak, len(view.course) - 1
        for plot in (plot for plot in PLOTS.values() if plot.applies(view)):
            options = [{name: option} for name in plot.controls for option in CHOICES[name].options]
            for chosen in ({}, *options):
                of_choice = View(view.state.replace(**chosen), view.course, view.computed)
                picture, names = pictures[plot.name], {row.name for row in rows_of(plot)}
                for i in states if not chosen else states[1:2]:
                    rows = of_choice.places(plot, i)
                    assert all(np.size(x) == np.size(y) for x, y, *_ in rows.values())
                    assert rows.keys() == names | ({"image"} if getattr(plot, "image", None) else set())
                    for data in picture.columns(of_choice, i).values():
                        assert len({len(column) for column in data.values()}) == 1


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


def test_legends_name_what_is_drawn_only():
    shown = drawn(view_of(preset_state()), PLOTS["force"])
    assert "held 1" not in shown
    elastic = preset_state(ELASTIC)
    assert not drawn(view_of(elastic), PLOTS["force"]).keys() & {"yielding", "plastic work Wₚ"}
    elastic = changes.choose(elastic, "drive", "impact")
    assert set(drawn(view_of(elastic), PLOTS["energy"])) == {"stored", "kinetic", "time"}


def test_numbers_along_a_logarithmic_axis_have_room_and_one_form():
    short, written_short = ticks(0.9, 90)
    assert [tick for tick in short.ticks if 0.9 <= tick <= 90] == [1, 2, 5, 10, 20, 50]
    # Below a decade numbers are at equal distances, and over many decades at powers.
    few, many = (ticks(1, most)[0] for most in (3, 1000))
    assert not hasattr(few, "ticks")
    assert not hasattr(many, "ticks")
    assert written_short.code == ticks(0.01, 1e3)[1].code
    # Units of areas are a million apart.
    assert [format_quantity(area, "area") for area in (9.99e-9, 4.98e-7)] == ["9990 µm²", "0.4980 mm²"]


@pytest.fixture(scope="module")
def oblique():
    state = oblique_state()
    return View(state, solved(state))


def test_a_band_of_the_energy_is_as_high_as_what_it_is_named_after(oblique):
    """With dashpots, and with friction, of which some is left at the end."""
    names = {
        "friction": "friction_work", "plastic": "plastic_work", "viscous": "viscous_work",
        "stored": "stored_energy", "kinetic": "kinetic_energy",
    }  # fmt: skip
    for view, lost in ((view_of(viscous()), {"plastic", "viscous"}), (oblique, {"friction"})):
        rows, motion = view.places(PLOTS["energy"], view.course.now), view.course.motion
        seen = {name for name in names if np.isfinite(rows[name][0]).any()}
        assert seen == lost | {"stored", "kinetic"}
        for name in seen:
            upper, lower = np.split(rows[name][1], 2)
            # To the rounding of a sum of them.
            expected = getattr(motion, names[name])
            np.testing.assert_allclose(upper - lower[::-1], expected, atol=1e-12 * upper.max())
            assert (expected[-1] > 0.01 * upper.max()) == (name in lost | {"kinetic"})


def test_marks_of_the_present_time_are_on_the_curves_that_they_are_of(oblique):
    for name, curves in (
        ("motion", {"now": "depth d", "F now": "force F"}),
        ("forces", {"now": "tangential force Fₓ", "F now": "normal force F"}),
    ):
        i = len(oblique.course) // 3
        rows = oblique.places(PLOTS[name], i)
        axes = {row.name: row.axis for row in rows_of(PLOTS[name])}
        for point, curve in curves.items():
            assert axes[point] == axes[curve]
            assert [part[0] for part in rows[point]] == [part[i] for part in rows[curve]]


def test_the_drawn_force_of_friction_takes_the_speed_that_is_lost(oblique):
    """∫ Fₓ dt = m_t Δv, and nowhere is it more than μF."""
    time, force = oblique.places(PLOTS["forces"], 0)["tangential force Fₓ"]
    drive = oblique.course.scene.drive
    lost = drive.tangential_speed - oblique.course.rebound.contact_velocity
    # By the trapezoidal rule over 120 instants.
    assert trapezoid(force, time) == approx(drive.tangential_mass * lost, rel=2e-3)
    assert np.all(np.abs(force) <= drive.friction * oblique.course.states.force * (1 + 1e-9))


def test_one_thing_has_one_colour_on_all_plots():
    """Orange is what has yielded, as the form says; stick and slip are told apart by theirs."""
    colours = {
        "yielded": {
            "yielded", "yielding", "plastic", "plastic work Wₚ", "plastic zone r < c", "residual imprint",
            "at c",
        },
        "elastic": {"elastic", "unloading", "stored", "given back"},
        "stick": {"sticks", "tangential force Fₓ"},
        "slip": {"slips", "friction", "largest friction ±μF"},
    }  # fmt: skip
    rows = [row for plot in PLOTS.values() for row in rows_of(plot)]
    for role, names in colours.items():
        assert {row.name for row in rows} >= names
        assert {row.role for row in rows if row.name in names} == {role}


def test_equations_above_plots_are_those_of_the_drive():
    dry, wet = follow(preset_state(DROP)), follow(viscous())
    for name in ("force", "springs"):
        assert "η" not in PLOTS[name].formula_of(dry)
        assert "η" in PLOTS[name].formula_of(wet)
    assert "W_v" in PLOTS["energy"].formula_of(wet)
    assert "W_v" not in PLOTS["energy"].formula_of(dry)
    assert "W_f" in PLOTS["energy"].formula_of(follow(oblique_state()))


def test_a_plot_is_shown_if_the_drive_has_it():
    page = Page()
    page.apply(lambda state: state.replace(tiles=("forces",)))
    assert visible(page.view) == [PLOTS[name] for name in NAMED]
    assert "Friction" not in [text for _, text in part(page, "fourth plot").look["options"]]
    for drive, there in (("oblique", True), ("depth", False)):
        page.choose("drive", drive)
        assert ("forces" in [plot.name for plot in visible(page.view)]) is there


@pytest.mark.parametrize(
    ("key", "choices"),
    [(SILICA, {"drive": "path"}), (STEEL, {}), (STEEL, {"plasticity": "line", "damping": "eta"})],
)
def test_every_plot_and_export_has_the_class(key, choices):
    """The stress below the surface is found, and a sweep has no fast limit, which is of class (b)."""
    state = state_with(key, **choices)
    view = view_of(state, 0.9)
    for plot in (plot for plot in PLOTS.values() if plot.applies(view)):
        if not isinstance(plot, AsyncPlot):
            assert view.places(plot, view.course.now), plot.name
            continue
        found = last(as_steps(plot.find(view.course, plot.asked(state))))
        assert plot.name != "sweep" or sweep.FAST not in found.rows
        assert found.rows or found.note, plot.name
    constant, symbol = ("f_c", "f_c") if state.plasticity == "line" else ("hardness", "H")
    csv, python = share.csv(view), view.course.scene.to_python()
    assert f", {symbol} = " in csv
    assert f"{constant}=" in python
    if symbol == "H":
        assert PRESETS[key].sources["volume_hardness"] in plain(scene_file(view))


def test_titles_of_axes_are_painted_with_their_new_units_and_choices_above_a_plot_are_seen(explorer):
    """Also where a legend gets shorter, so that Bokeh paints the title before it has made the new one."""
    page, canvas = explorer.page, explorer.page.locator(".card.force canvas").first

    def title():
        return page.screenshot(clip=canvas.bounding_box() | {"width": 40})

    page.set_viewport_size({"width": 1280, "height": 720})
    explorer.wait("explorer.model('force').inner_width < 420")
    explorer.change(explorer.type, "d_max", "1.5")
    assert explorer.axis("force")["labels"][1].endswith("(nN)")
    seen = title()
    page.evaluate("explorer.model('force').change.emit()")
    page.wait_for_function("Bokeh.documents[0].is_idle")
    assert title() == seen
    for tab in ("Hardness", "Section", "Sweep"):
        page.get_by_label("Fourth plot", exact=True).select_option(label=tab)
        lists = page.locator(f".card.{tab.lower()} .heading select")
        lists.first.wait_for()
        for each in lists.all():
            box, options = each.bounding_box(), each.locator("option").all_inner_texts()
            # As high as a letter, and wide enough for some.
            assert box["height"] >= 12
            assert box["width"] >= 40
            assert len({*options}) == len(options) > 1
