"""The served page in a real browser: what is drawn agrees with the core, whatever a person does."""

import os
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from app.packet import SPRINGS
from app.presets import OPENING, PRESETS
from app.quantities import QUANTITIES, shape_quantities
from app.shapes import SHAPES
from app.state import Explorer as State
from app.trajectory import follow
from app.units import UNITS, read

from .conftest import CHROMIUM

# Where the browser is required its absence is a failure.
pytestmark = pytest.mark.skipif(
    not Path(CHROMIUM).exists() and os.environ.get("MDR_BROWSER") != "required",
    reason="the page's tests need Chromium; set CHROMIUM to its path",
)

YIELDED, ELASTIC = "213,94,0", "0,114,178"
FIGURES = ("springs", "force", "pressure", "radii")
DROP = "Steel ball 16 mm on glass-fibre epoxy, drop weight"


def unit(label, kind):
    """SI size of the unit that an axis label names."""
    name = label.rpartition("(")[2].rstrip(")")
    return next(unit.factor for unit in UNITS[kind] if unit.name == name)


def drawn(explorer, figure, layer):
    """What a layer draws: x and y, where y is a number."""
    x, y = (np.array(explorer.column(figure, layer, name), float) for name in "xy")
    return x[np.isfinite(y)], y[np.isfinite(y)]


def now(explorer):
    """Depth and force (SI) of the marker in the force–depth plot."""
    axis = explorer.axis("force")
    factors = unit(axis["labels"][0], "length"), unit(axis["labels"][1], "force")
    return [explorer.column("force", "now", name)[0] * f for name, f in zip("xy", factors, strict=True)]


def assert_draws(explorer, state):
    """All that the page draws of the present state is what the core says of `state`."""
    way = follow(state.scene(), state.progress)
    result = way.state
    np.testing.assert_allclose(now(explorer), [result.depth, way.force[way.now]], rtol=1e-6, atol=1e-30)
    assert_curves(explorer, way)
    assert_pressure(explorer, way)
    assert_springs(explorer, result)


def assert_curves(explorer, way):
    axis = explorer.axis("force")
    length, force = unit(axis["labels"][0], "length"), unit(axis["labels"][1], "force")
    for layer in ("elastic", "yielding"):
        depth, shown = drawn(explorer, "force", layer)
        loading = mdr.indent(way.scene.profile, way.scene.medium, depth[:, None] * length)[:, 0]
        np.testing.assert_allclose(shown * force, loading.force, rtol=1e-5, atol=1e-6 * way.deepest.force)


def assert_pressure(explorer, way):
    result, axis = way.state, explorer.axis("pressure")
    length, stress = unit(axis["labels"][0], "length"), unit(axis["labels"][1], "pressure")
    r, shown = drawn(explorer, "pressure", "−σ_zz(r)")
    expected = result.pressure(r * length)
    # Away from edges, where float32 radii do not resolve the slope, and below the clipped part.
    edges = np.array([0, result.plastic_radius, result.contact_radius]) / length
    smooth = np.min(np.abs(np.abs(r)[:, None] - edges), axis=1) > 0.01 * axis["x"][1]
    smooth &= shown < axis["y"][1]
    np.testing.assert_allclose(shown[smooth] * stress, expected[smooth], rtol=1e-3)


def assert_springs(explorer, result):
    axis = explorer.axis("springs")
    length, height = (unit(label, "length") for label in axis["labels"])
    reach = np.max(np.abs(drawn(explorer, "springs", "yielded")[0]), initial=0.0) * length
    spacing = 2 * axis["x"][1] * length / SPRINGS
    assert result.plastic_radius - spacing <= reach <= result.plastic_radius + spacing
    x, z = drawn(explorer, "springs", "profile g(x)")
    inside = np.abs(x) * length < 0.99 * result.contact_radius
    expected = result.profile.reduced(x[inside] * length) - result.depth
    np.testing.assert_allclose(z[inside] * height, expected, rtol=1e-4, atol=1e-5 * result.depth)


def test_the_page_opens_on_a_cone_that_has_yielded(explorer):
    assert_draws(explorer, State())
    for figure in FIGURES:
        painted = explorer.colours(figure)
        assert painted.get(YIELDED, 0) > 50 or figure == "pressure", figure
        assert painted.get(ELASTIC, 0) > 50, figure
    assert explorer.page.title() == "Indentation explorer"
    assert explorer.readout("F") == "4.514 µN"
    assert explorer.readout("d/d_c") == "5.000"
    assert explorer.page.locator("math").count() >= len(FIGURES)


def test_springs_and_pressure_share_their_axis(explorer):
    assert explorer.axis("springs")["x"] == explorer.axis("pressure")["x"]
    frames = [explorer.page.evaluate("(name) => explorer.frame(name)", name) for name in FIGURES[::2]]
    assert frames[0] == frames[1]


def test_presets(explorer):
    for preset in [*(label for label in PRESETS if label != OPENING), OPENING]:
        explorer.choose("Preset", preset)
        assert_draws(explorer, State(preset))


def test_shapes(explorer):
    state = State()
    origin = explorer.page.get_by_text("Where the preset's numbers come from")
    assert "Altered" not in origin.inner_text()
    for shape in [*(key for key in SHAPES if key != state.shape), state.shape]:
        explorer.choose("Shape", SHAPES[shape].label)
        state.choose("shape", shape)
        assert_draws(explorer, state)
        for _, quantity in shape_quantities(shape):
            assert explorer.field(quantity.symbol).count() == 1
        assert origin.inner_text().startswith("Altered. ") == state.altered


def test_drives_and_media(explorer):
    state = State()
    for name, option, label in (
        ("drive", "force", "to a force"),
        ("elasticity", "modulus", "E*"),
        ("plasticity", "hardness", "hardness at a radius"),
        ("elasticity", "rigid_tip", "under a rigid tip"),
        ("plasticity", "none", "none"),
        ("drive", "depth", "to a depth"),
    ):
        explorer.pick(name, option, label)
        state.choose(name, option)
        assert_draws(explorer, state)
    assert explorer.readout("d_c") == "∞"


def test_impact_is_shown_over_time_with_its_ledger(explorer):
    explorer.choose("Preset", DROP)
    state = State(DROP)
    assert_draws(explorer, state)
    hit = state.scene().solve()
    assert explorer.readout("e") == f"{float(hit.restitution):.4f}"
    labels = explorer.axis("energy")["labels"]
    kinetic = np.array(explorer.column("energy", "kinetic", "y")) * unit(labels[1], "energy")
    energy = 5.5 * 1.0**2 / 2
    half = len(kinetic) // 2
    # The top of the stack is the energy before the impact, at every instant.
    np.testing.assert_allclose(kinetic[:half], energy, rtol=1e-5)
    time = np.array(explorer.column("motion", "depth d", "x")) * unit(labels[0], "time")
    assert time[-1] == pytest.approx(float(hit.contact_time), rel=1e-6)
    explorer.pick("damping", "tau", "τ")
    state.choose("damping", "tau")
    viscous = state.scene().solve()
    assert explorer.readout("e") == f"{float(viscous.restitution):.4f}"
    assert viscous.restitution < hit.restitution
    explorer.choose("Preset", OPENING)
    assert explorer.page.locator('[data-plot="motion"]').is_hidden()


def test_a_body_hits_the_same_spot_again(explorer):
    explorer.choose("Preset", DROP)
    hit = State(DROP).scene().solve()
    for _ in range(2):
        with explorer.change():
            explorer.page.get_by_role("button", name="Hit again").click()
        left = hit.plastic_depth
        hit = mdr.impact(hit.profile, hit.medium, hit.mass, hit.speed, plastic_depth=left)
        assert explorer.readout("e") == f"{float(hit.restitution):.4f}"
        depth = np.array(explorer.column("force", "elastic", "x"))
        scale = unit(explorer.axis("force")["labels"][0], "length")
        assert depth[0] * scale == pytest.approx(float(left), rel=1e-6)
        # Elastic again until it yields further.
        assert depth[-1] * scale == pytest.approx(float(left + hit.medium.critical_depth), rel=0.05)
    explorer.pick("damping", "tau", "τ")
    labels = explorer.axis("force")["labels"]
    joule = unit(labels[0], "length") * unit(labels[1], "force")
    shaded = [
        polygon_area(*(explorer.column("force", name, key) for key in "xy"))
        for name in ("dissipated", "recoverable")
    ]
    # Dashpots push at first touch of an imprint. All the body had is spent where it turns; the curves are
    # polygons of a hundred sides.
    assert sum(shaded) * joule == pytest.approx(hit.mass * hit.speed**2 / 2, rel=5e-3)


def polygon_area(x, y):
    x, y = np.array(x), np.array(y)
    return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2


def test_keys_on_a_slider_move_every_plot(explorer):
    state = State()
    for name in ("cone_slope", "E_1", "q_c", "max_depth"):
        quantity = QUANTITIES[name]
        force, pressure = now(explorer), explorer.column("pressure", "−σ_zz(r)", "y")
        for key in ("ArrowRight", "PageUp"):
            text = explorer.field(quantity.symbol).input_value()
            explorer.slider(quantity.symbol).focus()
            with explorer.change():
                explorer.page.keyboard.press(key)
            shown = explorer.field(quantity.symbol).input_value()
            assert shown != text
        assert now(explorer) != force
        assert explorer.column("pressure", "−σ_zz(r)", "y") != pressure
        state.set(name, read(shown, quantity.kind, UNITS[quantity.kind][0]))
        assert_draws(explorer, state)


def test_dragging_along_the_curve_moves_every_plot_without_the_server(explorer):
    explorer.wait_for_frames()
    traffic = explorer.listen()
    box = explorer.page.locator('canvas[data-sheet="force"]').bounding_box()
    left, right = explorer.page.evaluate("explorer.frame('force')")
    explorer.page.mouse.move(box["x"] + right - 5, box["y"] + 40)
    explorer.page.mouse.down()
    seen = []
    for share in (0.8, 0.6, 0.4, 0.2):
        explorer.page.mouse.move(box["x"] + left + share * (right - left), box["y"] + box["height"] / 2)
        seen.append((now(explorer)[0], tuple(explorer.column("springs", "profile g(x)", "y"))))
    assert len(set(seen)) == len(seen)
    assert traffic() == []
    with explorer.change():
        explorer.page.mouse.up()
    assert traffic() != []
    state = State()
    state.move(explorer.link()["at"])
    assert 0 < state.progress < 1
    assert_draws(explorer, state)


def test_player_plays_the_impact_without_the_server(explorer):
    explorer.choose("Preset", DROP)
    explorer.wait_for_frames()
    traffic = explorer.listen()
    explorer.page.locator("h1").click()
    explorer.page.keyboard.press(" ")
    slider = explorer.page.get_by_label("State along the way")
    places = {slider.input_value()}
    explorer.page.wait_for_function(
        "(v) => explorer.main().querySelector('.player input').value !== v", arg=places.pop()
    )
    depths = set()
    for _ in range(60):
        depths.add(now(explorer)[0])
        if len(depths) > 2:
            break
        explorer.page.wait_for_timeout(100)
    assert len(depths) > 2
    assert traffic() == []
    explorer.page.keyboard.press(" ")
    explorer.page.wait_for_function("explorer.idle()")
    assert "▶" in explorer.page.locator(".player button").inner_text()


def test_unloading_leaves_the_imprint_behind(explorer):
    slider = explorer.page.get_by_label("State along the way")
    slider.focus()
    with explorer.change():
        explorer.page.keyboard.press("End")
    state = State()
    state.move(2.2)
    assert_draws(explorer, state)
    result = follow(state.scene(), 2.2).state
    assert result.force == 0
    height = unit(explorer.axis("springs")["labels"][1], "length")
    imprint = drawn(explorer, "springs", "residual imprint")[1] * height
    np.testing.assert_allclose(imprint.min(), -result.plastic_depth, rtol=1e-6)


def test_numbers_are_typed_and_a_double_click_resets(explorer):
    state = State()
    for text, value in (("25", 25e-9), ("2.6e1", 26e-9), ("0.012 µm", 12e-9), ("3e-3um", 3e-9)):
        with explorer.change():
            explorer.type("d_max", text)
        state.set("max_depth", value)
        assert_draws(explorer, state)
    explorer.slider("d_max").dblclick(position={"x": 5, "y": 8})
    explorer.page.wait_for_function("Math.abs(explorer.column('force', 'now', 'x')[0] - 8.978) < 1e-3")
    assert_draws(explorer, State())


def test_bad_numbers_give_a_notice_and_change_nothing(explorer):
    bad = ("", "abc", "1e999", "-3", "nan", "1e9 m", "3 MPa", "1,5", "<img src=x onerror=alert(1)>")
    notices = explorer.page.locator(".notice")
    for text in bad:
        explorer.hush()
        explorer.type("d_max", text)
        explorer.page.wait_for_function("explorer.notices() === 1")
        assert text in notices.last.inner_text() or "out of bounds" in notices.last.inner_text()
        assert explorer.field("d_max").input_value() == "8.978 nm"
        assert notices.locator("img").count() == 0
    assert_draws(explorer, State())
    with explorer.change():
        explorer.type("d_max", "5")
    assert now(explorer)[0] == pytest.approx(5e-9)


def test_picture_is_clipped_and_says_so_where_the_pressure_is_singular(explorer):
    note = ("pressure", "note", "text")
    assert explorer.column(*note) == [""]
    explorer.choose("Shape", "Flat punch")
    assert "∞ at the rim" in explorer.column(*note)[0]
    explorer.choose("Shape", "Cone")
    with explorer.change():
        explorer.type("d_max", "1")
    assert "∞ at the axis" in explorer.column(*note)[0]
