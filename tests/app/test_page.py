"""The served page in a real browser: what a person sees agrees with the core, whatever they do."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app import columns
from app.drives import follow
from app.explorer import Explorer as State
from app.packet import inside
from app.plots import PLOTS
from app.presets import PRESETS
from app.units import UNITS
from app.view import View

from .conftest import DROP


def unit(label, kind):
    """SI size of the unit that an axis label names."""
    name = label.rpartition("(")[2].rstrip(")")
    return next(each.factor for each in UNITS[kind] if each.name == name)


def now(explorer):
    """Depth and force (SI) of the mark in the plot of force and depth."""
    labels = explorer.axis("force")["labels"]
    x, y = explorer.row("force", "now")
    return [x[0] * unit(labels[0], "length"), y[0] * unit(labels[1], "force")]


def assert_draws(explorer, state):
    """All that the page draws of the present state is what the columns of `state` say."""
    view = View(follow(state.scene(), state.progress))
    way = view.way
    np.testing.assert_allclose(now(explorer), [way.state.depth, way.state.force], rtol=1e-6, atol=1e-30)
    rows = columns.springs(view, way.now) | columns.pressure(view, way.now)
    for figure, kind, name in (
        ("springs", "lines", "yielded"),
        ("springs", "areas", "profile g(x)"),
        ("pressure", "lines", "−σzz(r)"),
    ):
        plot = PLOTS[figure]
        row = inside(kind, view.axes_of(plot), rows[name])
        for drawn, expected, axis in zip(explorer.row(figure, name), row, view.axes_of(plot), strict=True):
            np.testing.assert_allclose(drawn, expected / axis.factor, rtol=1e-5, atol=1e-5 * axis.ends[1])


def test_the_page_opens_on_a_cone_that_has_yielded_and_says_what_everything_is(explorer):
    """Every control has a name and an explanation; tooltips are of the data and their own axis."""
    assert_draws(explorer, State())
    assert explorer.page.title() == "Indentation explorer"
    assert explorer.readout("F") == "4.514 µN"
    assert explorer.readout("d/d_c") == "5.000"
    assert explorer.axis("springs")["x"] == explorer.axis("pressure")["x"]
    page = explorer.page
    for each in page.locator("input, select, textarea").all():
        named = each.evaluate(
            """(on) => on.ariaLabel || on.labels?.[0]?.textContent.trim()
                || on.closest("label")?.textContent.trim()"""
        )
        assert named, each.evaluate("(on) => on.outerHTML")
    assert page.get_by_label("State along the way").get_attribute("role") == "slider"
    assert page.get_by_role("radiogroup", name="Viscosity").count() == 1
    explorer.page.get_by_label("What is q_c, yield constant?").click()
    about = page.locator(".number", has=explorer.field("q_c")).locator(".about")
    assert "Hardness times contact radius" in about.inner_text()
    assert "(11)" in about.inner_text()
    label = explorer.axis("radii")["labels"][1]
    c = explorer.row("radii", "plastic zone c")
    k = len(c[0]) * 2 // 3
    tip = explorer.hover("radii", "plastic zone c", k)
    assert tip[0] == "plastic zone c"
    assert tip[1].startswith("c = ")
    assert tip[1].endswith(label.rpartition("(")[2].rstrip(")"))
    said = float(re.search(r"[\d.]+", tip[1])[0])
    # One of the points drawn, to the digits shown.
    assert np.min(np.abs(c[1] - said) / said) < 1e-3


def test_keys_and_the_player_move_every_plot(explorer):
    """The imprint stays when the load is gone; playing and dragging need no server."""
    page = explorer.page
    for symbol in ("s", "q_c", "d_max"):
        before, text = now(explorer), explorer.field(symbol).input_value()
        explorer.slider(symbol).focus()
        with explorer.change():
            explorer.page.keyboard.press("PageUp")
        assert explorer.field(symbol).input_value() != text
        assert now(explorer) != before
    explorer.press("Reset")
    explorer.wait("explorer.row('force', 'now')[0][0].toFixed(3) === '8.978'")
    assert_draws(explorer, State())
    explorer.page.get_by_label("State along the way").press("End")
    explorer.wait("explorer.played() && explorer.row('force', 'now')[1][0] === 0")
    state = State()
    state.progress = 2.2
    assert_draws(explorer, state)
    assert explorer.readout("a") == "0"
    explorer.link("at=2.2")
    page.evaluate("explorer.listen()")
    box = page.locator(".card.force").bounding_box()
    page.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.down()
    for share in (0.6, 0.5, 0.4, 0.3):
        before = explorer.row("force", "now")[0][0]
        page.mouse.move(box["x"] + share * box["width"], box["y"] + 0.6 * box["height"])
        explorer.wait("(old) => explorer.row('force', 'now')[0][0] !== old", before)
    assert page.evaluate("explorer.sent") == []
    page.mouse.up()
    page.locator("h1").click()
    page.keyboard.press(" ")
    first = now(explorer)
    explorer.wait("(old) => Math.abs(explorer.row('force', 'now')[0][0] - old) > 0.01", first[0] * 1e9)
    page.keyboard.press(" ")
    page.get_by_role("button", name="▶ Play").wait_for()
    at = float(explorer.link("at=")["at"])
    assert 0 <= at <= 2.2


def test_typed_numbers_are_read_as_they_say_refused_where_they_stand_and_undone(explorer):
    """What is refused stays in its field, which says why."""
    with explorer.change():
        explorer.type("d_max", "2,5")
    assert now(explorer)[0] == pytest.approx(2.5e-9)
    with explorer.change():
        explorer.type("d_max", "1e-6")
    assert now(explorer)[0] == pytest.approx(1e-6)
    assert explorer.said("d_max") == "1e-6 in SI is 1.000 µm"
    explorer.slider("d_max").dblclick(position={"x": 3, "y": 2})
    explorer.wait("explorer.row('force', 'now')[0][0].toFixed(3) === '8.978'")
    for text, why in (
        ("abc", "is not a number"),
        ("1000 m", "out of bounds"),
        ("<img src=x>", "<img src=x>"),
    ):
        explorer.type("d_max", text)
        number = explorer.page.locator(".number", has=explorer.field("d_max"))
        number.locator("#said", has_text=why).wait_for()
        assert explorer.field("d_max").input_value() == text
        assert explorer.field("d_max").get_attribute("aria-invalid") == "true"
        assert number.locator("img").count() == 0
    assert_draws(explorer, State())
    explorer.press("Reset")
    number.locator("#said", has_text="is not").wait_for(state="detached")
    assert explorer.field("d_max").input_value() == "8.978 nm"
    assert explorer.field("d_max").get_attribute("aria-invalid") == "false"
    with explorer.change():
        explorer.type("d_max", "5 nm")
    assert explorer.field("d_max").get_attribute("aria-invalid") == "false"
    with explorer.change():
        explorer.press("Undo")
    assert_draws(explorer, State())
    with explorer.change():
        explorer.page.locator("h1").click()
        explorer.page.keyboard.press("y")
    assert now(explorer)[0] == pytest.approx(5e-9)


def test_in_time_each_axis_has_its_unit_and_a_body_hits_the_same_spot_again(explorer):
    explorer.choose("Preset", DROP)
    tip = explorer.hover("motion", "depth d", 20)
    assert tip[0] == "depth d"
    assert re.fullmatch(r"d = [\d.]+ [µm]m", tip[1])
    tip = explorer.hover("motion", "force F", 10)
    assert re.fullmatch(r"F = [\d.]+ kN", tip[1])
    assert re.fullmatch(r"t = [\d.]+ ms", tip[2])
    hit = State(DROP).scene().solve()
    with explorer.change():
        explorer.press("Hit again")
    again = mdr.impact(hit.profile, hit.medium, hit.mass, hit.speed, plastic_depth=hit.plastic_depth)
    assert explorer.readout("e") == f"{float(again.restitution):.4f}"
    assert explorer.page.locator('.cell[data-symbol="F_c"]').count() == 0
    assert explorer.page.locator('.cell[data-symbol="d_y"]').count() == 1


def test_a_peak_beyond_the_axis_is_named_and_presets_shapes_drives_and_media_are_drawn(explorer):
    assert explorer.labels("pressure")[2] == ""
    with explorer.change():
        explorer.type("d_max", "1.9 nm")
    explorer.page.get_by_label("State along the way").press("Home")
    explorer.wait("explorer.played()")
    explorer.choose("Preset", "Flat steel punch on glass-fibre epoxy")
    assert explorer.labels("pressure")[2] == "↑ −σzz → ∞ at the rim"
    for label in list(PRESETS)[1:4]:
        explorer.choose("Preset", label)
        assert_draws(explorer, State(label))
    state = State(label)
    explorer.choose("Shape", "Sphere")
    state.choose("shape", "sphere")
    assert_draws(explorer, state)
    for option, name, value in (
        ("to force", "drive", "force"),
        ("E*", "elasticity", "modulus"),
        ("hardness", "plasticity", "hardness"),
    ):
        explorer.pick(option)
        state.choose(name, value)
        assert_draws(explorer, state)
    assert explorer.page.get_by_text("Altered. Where the preset's numbers come from").count() == 1


def test_what_is_taken_away_comes_back(explorer, tmp_path):
    """Pictures with title, legend and inputs; link, snippet and scene; a measured tip."""
    picture = explorer.save("force", "SVG").read_text(encoding="utf-8")
    for text in ("Force and depth", "dissipated", "yielding", "Cone, s = 0.358"):
        assert text in picture
    assert "held" not in picture
    png = explorer.save("pressure", "PNG").read_bytes()
    width, height = (int.from_bytes(png[k : k + 4], "big") for k in (16, 20))
    assert min(width / 840, height / 600) >= 1
    page = explorer.page
    explorer.press("Take with you")
    snippet = page.get_by_label("This state with mdr_core")
    explorer.wait("explorer.idle()")
    page.wait_for_function("(on) => on.value.includes('mdr.indent')", arg=snippet.element_handle())
    assert page.get_by_label("Link to this page").input_value().startswith(page.url.split("?")[0])
    with page.expect_download() as download:
        page.get_by_text("Scene (JSON)", exact=True).click()
    scene = mdr.Scene.from_json(download.value.path().read_text(encoding="utf-8"))
    assert scene == State().scene()
    path = tmp_path / "scene.json"
    path.write_text(mdr.Scene(mdr.Sphere(1e-6), mdr.Medium(1e9, 1.0), mdr.DepthPath(2e-9)).to_json())
    with explorer.change():
        page.get_by_label("Load a scene (JSON)").set_input_files(path)
    assert page.get_by_label("Preset", exact=True).input_value() == "Scene from a file"
    page.get_by_text("A scene from a file").wait_for()
    assert now(explorer)[0] == pytest.approx(2e-9)
    page = explorer.page
    path = tmp_path / "tip.csv"
    r = np.linspace(0, 60, 40)
    path.write_text(
        "r (nm); z (nm)\n" + "\n".join(f"{x:.4f}; {x * x / 100:.6f}".replace(".", ",") for x in r)
    )
    with explorer.change():
        page.get_by_label("CSV file of a measured tip: r, z").set_input_files(path)
    assert page.get_by_label("Shape", exact=True).input_value() == "Measured tip (CSV)"
    assert page.get_by_text("40 samples as they are").count() == 1
