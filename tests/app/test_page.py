"""The served page in a real browser: what is drawn agrees with the core, whatever a person does."""

import os
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from app.presets import OPENING, PRESETS
from app.shapes import SHAPES
from app.state import QUANTITIES
from app.state import Explorer as State
from app.units import UNITS, read

from .conftest import CHROMIUM

# Where the browser is required its absence is a failure.
pytestmark = pytest.mark.skipif(
    not Path(CHROMIUM).exists() and os.environ.get("MDR_BROWSER") != "required",
    reason="the page's tests need Chromium; set CHROMIUM to its path",
)

YIELDED, ELASTIC = "213,94,0", "0,114,178"
FIGURES = ("springs", "force", "pressure", "radii")


def unit(label, kind):
    """SI size of the unit that an axis label names."""
    name = label.rpartition("(")[2].rstrip(")")
    return next(unit.factor for unit in UNITS[kind] if unit.name == name)


def drawn(explorer, figure, layer, *columns):
    """Columns of a layer, where its last one is drawn."""
    values = [np.array(explorer.column(figure, layer, column), float) for column in columns]
    return [column[np.isfinite(values[-1])] for column in values]


def assert_draws(explorer, state):
    """All that the page draws of the present state is what the core says of `state`."""
    result = state.scene().solve()[-1]

    axis = explorer.axis("force")
    length, force = unit(axis["labels"][0], "length"), unit(axis["labels"][1], "force")
    now = [explorer.column("force", "now", key)[0] for key in ("d", "y")]
    np.testing.assert_allclose(np.multiply(now, [length, force]), [result.depth, result.force], rtol=1e-6)
    for layer in ("elastic", "yielding"):
        depth, shown = drawn(explorer, "force", layer, "x", layer)
        loading = mdr.indent(result.profile, result.medium, depth[:, None] * length)[:, 0]
        np.testing.assert_allclose(shown * force, loading.force, rtol=1e-5, atol=1e-6 * result.force)

    axis = explorer.axis("pressure")
    length, stress = unit(axis["labels"][0], "length"), unit(axis["labels"][1], "pressure")
    r, shown = drawn(explorer, "pressure", "−σ_zz(r)", "x", "p")
    expected = result.pressure(r * length)
    # Away from edges, where float32 radii do not resolve the slope, and below the clipped part.
    edges = np.array([0, result.plastic_radius, result.contact_radius]) / length
    smooth = np.min(np.abs(np.abs(r)[:, None] - edges), axis=1) > 0.01 * axis["x"][1]
    smooth &= shown < axis["y"][1]
    np.testing.assert_allclose(shown[smooth] * stress, expected[smooth], rtol=1e-3)

    axis = explorer.axis("springs")
    length, height = (unit(label, "length") for label in axis["labels"])
    yielded = drawn(explorer, "springs", "yielded", "x", "yielded")[0] * length
    reach = np.max(np.abs(yielded), initial=0.0)
    spacing = 2 * axis["x"][1] * length / 60
    assert result.plastic_radius - spacing <= reach <= result.plastic_radius + spacing
    x, z = drawn(explorer, "springs", "profile g(x)", "x", "g")
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
    assert explorer.page.locator("dl.readouts").inner_text().count("\n") > 10


def test_springs_and_pressure_share_their_axis(explorer):
    assert explorer.axis("springs")["x"] == explorer.axis("pressure")["x"]
    frames = [
        explorer.page.evaluate("(name) => explorer.frame(name)", name) for name in ("springs", "pressure")
    ]
    assert frames[0] == frames[1]


def test_presets(explorer):
    for preset in [*(label for label in PRESETS if label != OPENING), OPENING]:
        explorer.choose("Preset", preset)
        assert_draws(explorer, State(preset))


def test_shapes(explorer):
    state = State()
    for shape in [*(key for key in SHAPES if key != state.shape), state.shape]:
        explorer.choose("Shape", SHAPES[shape].label)
        state.choose(shape)
        assert_draws(explorer, state)
        for _, quantity in state.shape_quantities(shape):
            assert explorer.field(quantity.symbol).count() == 1


def test_keys_on_a_slider_move_every_plot(explorer):
    state = State()
    for name in ("cone_slope", "E_star", "q_c", "max_depth", "unloading"):
        quantity = QUANTITIES[name]
        force, pressure = explorer.column("force", "now", "y"), explorer.column("pressure", "−σ_zz(r)", "p")
        for key in ("ArrowRight", "PageUp"):
            text = explorer.field(quantity.symbol).input_value()
            explorer.slider(quantity.symbol).focus()
            with explorer.change():
                explorer.page.keyboard.press(key)
            shown = explorer.field(quantity.symbol).input_value()
            assert shown != text
        assert explorer.column("force", "now", "y") != force
        assert explorer.column("pressure", "−σ_zz(r)", "p") != pressure
        state.set(name, read(shown, quantity.kind, UNITS[quantity.kind][0]))
        assert_draws(explorer, state)


def test_unloading_leaves_the_imprint_behind(explorer):
    with explorer.change():
        explorer.type("u", "120")
    state = State()
    state.set("unloading", 1.2)
    assert_draws(explorer, state)
    result = state.scene().solve()[-1]
    assert result.force == 0
    height = unit(explorer.axis("springs")["labels"][1], "length")
    (imprint,) = drawn(explorer, "springs", "residual imprint", "imprint")
    imprint = imprint * height
    np.testing.assert_allclose(imprint.min(), -result.plastic_depth, rtol=1e-6)


def test_numbers_are_typed_and_a_double_click_resets(explorer):
    state = State()
    for text, value in (("25", 25e-9), ("2.6e1", 26e-9), ("0.012 µm", 12e-9), ("3e-3um", 3e-9)):
        with explorer.change():
            explorer.type("d_max", text)
        state.set("max_depth", value)
        assert_draws(explorer, state)
    explorer.slider("d_max").dblclick(position={"x": 5, "y": 8})
    explorer.page.wait_for_function("Math.abs(explorer.column('force', 'now', 'd')[0] - 8.978) < 1e-3")
    assert_draws(explorer, State())


def test_bad_numbers_give_a_notice_and_change_nothing(explorer):
    bad = ("", "abc", "1e999", "-3", "nan", "1e9 m", "3 MPa", "1,5", "<img src=x onerror=alert(1)>")
    notices = explorer.page.locator(".notyf__message")
    for count, text in enumerate(bad, start=1):
        explorer.type("d_max", text)
        explorer.page.wait_for_function("(n) => explorer.notices() >= n", arg=count)
        assert text in notices.last.inner_text() or "out of bounds" in notices.last.inner_text()
        assert explorer.field("d_max").input_value() == "8.978 nm"
    assert explorer.page.locator(".notyf__message img").count() == 0
    assert_draws(explorer, State())
    with explorer.change():
        explorer.type("d_max", "5")
    assert explorer.column("force", "now", "d") == pytest.approx([5])


def test_picture_is_clipped_and_says_so_where_the_pressure_is_singular(explorer):
    note = ("pressure", "note", "text")
    assert explorer.column(*note) == [""]
    explorer.choose("Shape", "Flat punch")
    assert "∞ at the rim" in explorer.column(*note)[0]
    explorer.choose("Shape", "Cone")
    with explorer.change():
        explorer.type("d_max", "1")
    assert "∞ at the axis" in explorer.column(*note)[0]


def test_two_people_do_not_disturb_each_other(explorer, server, browser):
    page = browser.new_page(viewport={"width": 400, "height": 800})
    other = type(explorer)(page, server.url)
    with other.change():
        other.type("d_max", "30")
    assert other.column("force", "now", "d") == pytest.approx([30])
    assert_draws(explorer, State())
    assert page.evaluate("document.documentElement.scrollWidth <= 400")
    assert other.problems == []
    page.close()
