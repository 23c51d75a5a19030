"""What the plots show, as arrays: every column against the core, without a browser."""

import re
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from app import columns, readouts, section
from app.comparison import Row, compare, points
from app.drives import follow
from app.explorer import Explorer
from app.figures import figure, ticks
from app.packet import drawn, layers, packed
from app.parts import legend
from app.plots import PLOTS, Plot
from app.presets import PRESETS
from app.quantities import SHAPES
from app.units import written
from app.view import View
from mdr_core.results.figures import SPRINGS, line, mark

from .conftest import DROP, ELASTIC

APP = Path(__file__).parents[2] / "app"


def seen(explorer, progress=1.0, **chosen):
    return View(follow(explorer.scene(), progress), chosen=chosen)


def assert_all_is_drawn(view, step=9):
    """Every plot that has its axes has all its rows in every state, and x for every y."""
    for plot in PLOTS.values():
        if not view.axes.keys() >= set(plot.axes):
            continue
        for i in range(0, len(view.way), step):
            rows = view.columns(plot, i)
            assert all(np.size(x) == np.size(y) for x, y, *_ in rows.values())
            assert rows.keys() == {row.name for row in plot.rows} | ({"image"} if plot.image else set())


def viscous():
    explorer = Explorer(DROP)
    explorer.choose("damping", "tau")
    return explorer


def measured():
    explorer = Explorer()
    r = np.linspace(0, 100e-9, 30)
    explorer.take_tip((r, r**2 / 200e-9), "")
    return explorer


@pytest.mark.parametrize("shape", [shape for shape in SHAPES if shape != "sampled"])
def test_loading_curve_and_pressure_are_those_of_the_core(shape):
    explorer = Explorer()
    explorer.choose("shape", shape)
    view = seen(explorer)
    rows = columns.force_still(view)
    for name in ("elastic", "yielding"):
        depth, force = rows[name]
        result = mdr.indent(explorer.profile(), explorer.medium(), depth[:, None])
        np.testing.assert_allclose(force, result.force[:, 0], rtol=1e-9, atol=1e-30)
    r, p = columns.pressure(view, view.way.now)["−σzz(r)"]
    np.testing.assert_allclose(p, np.minimum(view.way.state.pressure(r), 1e3 * view.end["p"]), rtol=1e-9)


@pytest.mark.parametrize("explorer", [Explorer(), Explorer(DROP), viscous(), measured()], ids=str)
def test_every_plot_of_every_state_can_be_drawn(explorer):
    assert_all_is_drawn(seen(explorer))


def test_springs_are_yielded_elastic_or_free_where_the_core_says():
    view = seen(Explorer())
    rows, state = columns.springs(view, view.way.now), view.way.state
    reach = {name: np.nanmax(np.abs(rows[name][0])) for name in ("yielded", "elastic")}
    spacing = 2 * view.end["x"] / SPRINGS
    assert reach["yielded"] == pytest.approx(state.plastic_radius, abs=spacing)
    assert reach["elastic"] == pytest.approx(state.contact_radius, abs=spacing)


def test_a_measured_tip_ends_at_its_rim_without_pressure():
    view = seen(measured())
    r, p = view.pressure(view.way.now)
    a = float(view.way.state.contact_radius)
    assert np.all(np.isfinite(p))
    assert p[np.argmin(np.abs(r - a))] == pytest.approx(0.0, abs=0.05 * p.max())
    assert view.beyond(view.way.now) == ""
    exact = view.way.state.pressure(r)
    assert np.max(np.abs(p - exact)[r < 0.97 * a]) < 0.01 * exact.max()


def test_the_contact_radius_falls_by_a_step_where_the_load_is_gone():
    for explorer in (Explorer(), Explorer(DROP), Explorer("Flat steel punch on glass-fibre epoxy")):
        view = seen(explorer)
        depth, radius = columns.radii_still(view)["unloading"]
        step = int(np.flatnonzero(radius == 0)[0])
        assert depth[step] == depth[step - 1]
        last = view.way.states.plastic_radius[-1] or explorer.profile().face_radius
        assert radius[step - 1] == pytest.approx(last)


def test_no_state_is_in_contact_without_a_force():
    for explorer in (Explorer(), measured()):
        way = follow(explorer.scene(), 2.0)
        assert way.progress[way.now] == 2.0
        assert way.state.contact_radius == 0
        assert np.all((way.states.contact_radius > 0) == (way.force > 0))


def test_a_peak_that_the_axis_does_not_reach_is_named():
    view = seen(Explorer())
    tops = {i: view.pressure(i)[1] for i in range(view.way.peak)}
    cut = [i for i, p in tops.items() if np.max(p) > view.end["p"]]
    assert cut
    for i in tops:
        assert bool(view.beyond(i)) == (i in cut)
    first = view.first
    value, unit = re.search(r"= ([\d.]+) (\wPa)", view.beyond(first)).groups()
    factor = {"GPa": 1e9, "TPa": 1e12}[unit]
    assert float(value) * factor == pytest.approx(np.max(view.pressure(first)[1]), rel=0.01)
    assert "∞ at the rim" in seen(Explorer("Flat steel punch on glass-fibre epoxy")).beyond(50)


def lit(explorer):
    return list(readouts.lights(follow(explorer.scene(), 1.0), explorer))


def test_lights_of_the_presets_warn_of_nothing():
    for label in PRESETS:
        assert [level for level, _ in lit(Explorer(label))].count("beyond") == 0, label


def test_a_viscous_impact_has_the_error_of_the_fast_limit_and_its_poisson_ratio():
    explorer = viscous()
    found = lit(explorer)
    error = 100 * float(explorer.scene().solve().fast_limit.contact_area_error)
    assert error > 50
    assert any(
        level == "note" and f"+{error:.0f} %" in text and "does not hold" in text for level, text in found
    )
    assert any(level == "beyond" and "ν = ½" in text for level, text in found)
    explorer.nu_1 = 0.5
    assert any(level == "good" and "ν = ½" in text for level, text in lit(explorer))
    explorer.choose("elasticity", "modulus")
    assert any(level == "note" and "ν = ½" in text for level, text in lit(explorer))


def test_steep_slopes_and_fast_bodies_are_warned_of():
    explorer = Explorer(DROP)
    explorer.speed = 500.0
    assert [level for level, _ in lit(explorer)][:2] == ["beyond", "beyond"]


def test_after_another_hit_depth_and_force_of_yield_belong_together():
    explorer = Explorer(DROP)
    hit = explorer.scene().solve()
    explorer.hit_again(hit)
    way = follow(explorer.scene(), 1.0)
    cells = {symbol: float(value) for symbol, _, _, value in readouts.cells(way) if np.ndim(value) == 0}
    again = float(hit.plastic_depth) + explorer.medium().critical_depth
    assert cells["d_y"] == pytest.approx(again)
    assert not cells.keys() & {"d_c", "F_c"}
    assert cells["F_y"] == pytest.approx(float(way.onset.force))
    np.testing.assert_allclose(columns.force_still(View(way))["onset of yield"][0], again)


def test_the_ledger_of_an_impact_sums_up():
    view = seen(viscous())
    t, top = columns.energy_still(view)["kinetic"]
    np.testing.assert_allclose(top[: len(top) // 2], 5.5 / 2, rtol=1e-6)
    assert t.max() == pytest.approx(float(view.way.hit.contact_time))


def test_a_new_plot_is_one_entry(monkeypatch):
    """The example of how to add a plot."""

    def work(view, some):
        way = view.way
        return way.states.depth[some], way.plastic_work[some] / way.scene.medium.critical_depth

    plot = Plot(
        "Plastic work",
        "W_p = d_c φ(d_p)",
        ("d", "F"),
        (line("W_p/d_c", "yielded", 2.5, symbol="W_p/d_c"), mark("now")),
        still=lambda view: {"W_p/d_c": work(view, slice(None))},
        moving=lambda view, i: {"now": work(view, [i])},
    )
    monkeypatch.setitem(PLOTS, "work", plot)
    view, made = seen(Explorer()), figure("work")
    shown = layers({"work": made})
    values, starts, labels = packed(view, shown, [0, view.way.now])
    assert [layer.rows for layer in shown] == [["W_p/d_c"], ["now"]]
    assert len(starts) == len(labels) == 2
    # A line may have another point where it leaves the axes.
    assert values[0] >= len(view.way)
    assert legend(plot, drawn(view, plot, [view.way.now])).count("<span") == 2


@pytest.mark.parametrize("quantity", ["max_shear", "von_mises", "zz"])
@pytest.mark.parametrize("label", [ELASTIC, DROP])
def test_the_section_shows_the_stress_of_the_core(label, quantity):
    view = seen(Explorer(label))
    (found,) = section.found(view.way, quantity)
    state, (r, z, colours) = view.way.state, found.axes
    (left, right), (bottom, top), image = found.rows["image"]
    assert (left, right, bottom, top) == (r.start, r.end, z.start, z.end) == (0, r.end, -r.end, 0)
    assert image.shape == PLOTS["section"].image
    down, along = (30 + 0.5) / image.shape[0], (50 + 0.5) / image.shape[1]
    stress = state.stress(r.end * along, -bottom * (1 - down))
    expected = {"zz": -stress.zz, "max_shear": stress.max_shear, "von_mises": stress.von_mises}[quantity]
    assert image[30, 50] == pytest.approx(expected, rel=1e-12)
    assert np.unique(found.rows["contact radius a"][0]) == state.contact_radius
    x, y = (part[np.isfinite(part)] for part in found.rows["equal stress"])
    assert 0 <= x.min() <= x.max() <= r.end
    assert z.start <= y.min() <= y.max() <= 0
    place = found.rows["largest"]
    if quantity == "zz":
        assert np.isnan(place[0]).all()
    else:
        peak = state.stress_peak(quantity)
        assert (place[0][0], place[1][0]) == (peak.r, -peak.z)
        assert image.max() <= peak.value <= colours.end
    shown = drawn(View(view.way, found={PLOTS["section"].title: found}), PLOTS["section"], [view.way.now])
    assert shown >= {"equal stress", "contact radius a"}
    assert ("plastic zone c" in shown) == (label == DROP)
    if (label, quantity) == (ELASTIC, "max_shear"):
        # Hertz, ν of the preset: 0.3 to 0.33 p₀ on the axis, 0.4 to 0.6 a deep; the note says so.
        assert peak.value / state.pressure(0.0) == pytest.approx(0.31, abs=0.02)
        assert "largest at r = 0, " in found.note
        assert f"{peak.value / 1e6:.1f} MPa" in found.note


def test_the_section_of_an_unloaded_state_is_empty():
    way = follow(Explorer().scene(), 2.2)
    (found,) = section.found(way, "zz")
    assert found.rows == {}
    assert found.note == "The load is gone."


def test_what_is_found_at_rest_is_drawn_on_its_own_axes():
    plot, way = PLOTS["section"], follow(Explorer().scene(), 1.0)
    assert np.isnan(View(way).columns(plot, way.now)["image"][2]).all()
    (found,) = section.found(way, "zz")
    shown = layers({"section": figure("section")})
    empty, _, _ = packed(View(way), shown, [way.now])
    assert empty[6] == np.prod(plot.image)
    values, _, _ = packed(View(way, found={plot.title: found}), shown, [way.now])
    r, z, colours = found.axes
    sizes = values[0], values[3]
    assert sizes == (2, 2)
    np.testing.assert_allclose(values[1:3], r.ends, rtol=1e-6)
    np.testing.assert_allclose(values[4:6], z.ends, rtol=1e-6)
    count = int(values[6])
    drawn = values[7 : 7 + count].reshape(plot.image)
    np.testing.assert_allclose(drawn * colours.factor, found.rows["image"][2], rtol=1e-6)


def test_legends_name_what_is_drawn_only():
    shown = drawn(seen(Explorer()), PLOTS["force"], [50])
    assert "held 1" not in shown
    elastic = Explorer(ELASTIC)
    assert not drawn(seen(elastic), PLOTS["force"], [20, 40]) & {"yielding", "dissipated"}
    elastic.choose("drive", "impact")
    assert drawn(seen(elastic), PLOTS["energy"], [20]) == {"stored", "kinetic", "time"}


def test_numbers_along_a_logarithmic_axis_have_room():
    short, _ = ticks(0.9, 90)
    assert [tick for tick in short.ticks if 0.9 <= tick <= 90] == [1, 2, 5, 10, 20, 50]
    assert [type(ticks(1, most)[0]).__name__ for most in (3, 1000)] == ["BasicTicker", "LogTicker"]
    # Units of areas are a million apart.
    assert [written(area, "area") for area in (9.99e-9, 4.98e-7)] == ["9990 µm²", "0.4980 mm²"]


def test_every_model_is_timed_alike_and_the_chains_go_from_left_to_right():
    scene = Explorer().scene()
    rows = list(compare(scene, scene.solve(), cap=0.3))
    assert {row.model for row in rows} == {"closed form", "chain"}
    shuffled = [Row("chain", n, t, 1e-3) for n, t in ((32, 3e-3), (64, 1e-3), (128, 2e-3))]
    assert points(shuffled, "closed form")["chain"][0].tolist() == [1e-3, 2e-3, 3e-3]


#: What the first version used that no documentation of Bokeh, Panel or HoloViews has.
PRIVATE = re.compile(
    r"\b(_actual_paint|is_forcing_paint|map_data|mark_finished|canvas_view|plot_view|renderer_views|repainted"
    r"|_send_msg|_handle_msg|_models|_debounce|get_serialized_svg|embed_items|events_el|v_compute|pixel_ratio"
    r"|source_range|getContext|silent)\b"
)


def test_nothing_private_of_the_toolkit_is_used():
    for path in [*APP.glob("*.py"), *(APP / "js").glob("*.js")]:
        text = path.read_text(encoding="utf-8")
        assert PRIVATE.findall(text) == [], path.name
        if path.suffix == ".js":
            assert re.findall(r"\.(_\w+)", text) == [], path.name


def test_the_page_stays_small():
    lines = {
        kind: sum(len(p.read_text().splitlines()) for p in APP.rglob(f"*.{kind}")) for kind in ("js", "css")
    }
    assert lines["js"] <= 200
    assert lines["css"] <= 250
