"""What is shown on request, and paths, in a real browser."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app.explorer import Explorer as State
from app.presets import OPENING, PRESETS
from app.quantities import QUANTITIES
from app.sweep import FAST
from app.units import read

from .conftest import DROP
from .test_page import unit

#: Every plot, and what is said below it, is within its card.
WHOLE = """() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap(
    (each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
  const bottom = (on) => on.getBoundingClientRect().bottom
  const cards = all(document).filter((on) => on.shadowRoot && on.classList.contains("card"))
  return cards.every((card) => all(card.shadowRoot).filter((on) => on.matches("canvas, .found")).every(
    (on) => bottom(on) <= bottom(card) && on.scrollHeight <= on.clientHeight + 1))
}"""


def test_several_are_held_on_one_dimensionless_curve_and_come_back_from_the_address(explorer):
    page = explorer.page
    for k, depth in enumerate(("4 nm", "7 nm"), 1):
        with explorer.change():
            explorer.type("d_max", depth)
        page.locator("h1").click()
        page.keyboard.press("h")
        page.get_by_role("textbox", name=f"held {k}").wait_for()
    page.get_by_role("textbox", name="held 1").fill("shallow")
    page.get_by_role("textbox", name="held 1").press("Enter")
    explorer.link("shallow")
    explorer.choose("Axes", "dimensionless")
    explorer.choose("Preset", list(PRESETS)[4])
    assert explorer.axis("force")["labels"] == [
        "d, indentation depth (× d at onset)",
        "F, normal force (× F at onset)",
    ]
    # F/F_c = 2 d/d_c − 1 on every cone: gold is held, this is PDMS.
    for row in ("yielding", "held 2"):
        d, force = explorer.row("force", row)
        k = int(np.argmax(force))
        assert force[k] == pytest.approx(2 * d[k] - 1, rel=1e-5)
    page.get_by_role("button", name="Remove 1").click()
    page.get_by_role("textbox", name="held 2").wait_for(state="detached")
    assert page.get_by_role("textbox", name="held 1").input_value() == f"{OPENING}, altered"
    # A preset that was altered opens as it was.
    with explorer.change():
        explorer.type("q_c", "2 N/m")
    explorer.press("Map")
    page.locator(".card.map").wait_for()
    explorer.press("Dark")
    colour = "(on) => getComputedStyle(on).color"
    assert page.locator(".cells").last.evaluate(colour) == page.locator("h1").evaluate(colour)
    pairs, held = explorer.link("dark=1"), explorer.row("force", "held 1")
    assert (pairs["q_c"], pairs["plots"], pairs["dark"]) == ("2.0", "map", "1")
    assert explorer.axis("map")["labels"][1] == "y, in the plane (× largest a)"
    page.reload()
    explorer.wait("window.explorer?.idle() && document.documentElement.classList.contains('dark')")
    np.testing.assert_allclose(explorer.row("force", "held 1"), held, rtol=1e-6)
    assert page.locator(".card.map").count() == 1
    assert explorer.field("q_c").input_value() == "2 N/m"
    assert page.get_by_role("button", name="Undo").is_disabled()


def test_surface_references_and_logarithmic_axes(explorer):
    explorer.press("Surface")
    explorer.choose("Heights", "to scale")
    explorer.wait("explorer.axis('surface').labels[1].startsWith('z, height to scale')")
    ratio = """() => {
        const { x_range, y_range, inner_width, inner_height } = explorer.model("surface")
        return (x_range.end - x_range.start) / inner_width * inner_height / (y_range.end - y_range.start)
    }"""
    explorer.wait(f"() => Math.abs(({ratio})() - 1) < 1e-6")
    explorer.choose("Heights", "exaggerated")
    explorer.wait(f"() => ({ratio})() > 2")
    explorer.press("Log–log")
    explorer.choose("Reference curves", "elastic, and classes (a) and (c)")
    explorer.page.get_by_text("as hard as this scene").wait_for()
    explorer.wait(WHOLE)
    d, force = explorer.row("loglog", "elastic throughout")
    inside = np.isfinite(d) & np.isfinite(force)
    # Of a cone F = 2E* d²/(π s), to single precision; the last point is cut at the end of the axis.
    slope = np.diff(np.log(force[inside][:-1])) / np.diff(np.log(d[inside][:-1]))
    assert slope.size > 50
    np.testing.assert_allclose(slope, 2.0, rtol=1e-3)
    explorer.link("references=all")


def test_the_section_follows_once_the_input_rests_and_models_are_timed(explorer):
    """Speed against error is measured while it is looked at."""
    explorer.press("Section")
    explorer.wait("explorer.model('section') && explorer.row('section', 'largest')[0][0] > 0")
    state = State().solved()
    peak = state.stress_peak()
    x, z = explorer.row("section", "largest")
    assert [x[0], z[0]] == pytest.approx([peak.r * 1e9, -peak.z * 1e9], rel=1e-5)
    np.testing.assert_allclose(explorer.row("section", "contact radius a")[0], state.contact_radius * 1e9)
    explorer.choose("Stress", "von Mises stress")
    deeper = state.stress_peak("von_mises")
    explorer.wait(
        "(z) => Math.abs(explorer.row('section', 'largest')[1][0] + z) < 1e-4 * z", deeper.z * 1e9
    )
    explorer.page.get_by_text(f"σvM is largest at r = {deeper.r * 1e9:.1f} nm").wait_for()
    explorer.wait(WHOLE)
    explorer.link("section=von_mises")
    with explorer.change():
        explorer.type("d_max", "6 nm")
    a = float(mdr.indent(State().profile(), State().medium(), 6e-9).contact_radius)
    explorer.wait(
        "(a) => Math.abs(explorer.row('section', 'contact radius a')[0][0] - a) < 1e-4 * a", a * 1e9
    )
    page = explorer.page
    page.locator("h1").click()
    page.keyboard.press("s")
    page.get_by_text(re.compile("n elements|chains beyond")).wait_for()
    page.get_by_text("Used on this page: closed form, the cheapest exact one").wait_for()
    page.get_by_text("shortest of 3").wait_for()
    assert page.locator("tr").count() == 4
    explorer.wait("explorer.axis('speed').labels[0] === 'time to solve (s)'")


def test_the_sweep_shows_the_damaged_area_over_the_energy_and_moves_with_a_slider(explorer):
    state = State(DROP)
    explorer.choose("Preset", DROP)
    explorer.press("Sweep")
    explorer.wait("explorer.model('sweep') && explorer.row('sweep', 'this scene')[0].length > 50")
    labels = explorer.axis("sweep")["labels"]
    assert [label.split(",")[0] for label in labels] == ["W", "A"]

    def agrees():
        (x,), (y,) = explorer.row("sweep", "present value")
        hit = state.scene().solve()
        assert x * unit(labels[0], "energy") == pytest.approx(state.number("energy"), rel=1e-6)
        assert y * unit(labels[1], "area") == pytest.approx(hit.damaged_area, rel=1e-6)
        W, fast = explorer.row("sweep", FAST)
        k = len(W) // 2
        speed = (2 * W[k] * unit(labels[0], "energy") / state.mass) ** 0.5
        limit = mdr.impact(state.profile(), state.medium(), state.mass, speed).fast_limit
        assert fast[k] * unit(labels[1], "area") == pytest.approx(limit.contact_area, rel=1e-5)

    agrees()
    for name in ("q_c", "speed"):
        explorer.slider("q_c" if name == "q_c" else "v_0").focus()
        with explorer.change():
            explorer.page.keyboard.press("PageUp")
        labels = explorer.axis("sweep")["labels"]
        shown = explorer.field("q_c" if name == "q_c" else "v_0").input_value()
        setattr(state, name, state.checked(name, read(shown, QUANTITIES[name].kind, None)[0]))
        agrees()
    explorer.choose("Swept", "v₀, speed at first contact")
    with explorer.change():
        explorer.type("v_0 from", "20 mm/s")
    assert explorer.axis("sweep")["x"][0] * unit(explorer.axis("sweep")["labels"][0], "speed") == 0.02
    explorer.link("speed_from=0.02")


def test_a_path_is_typed_played_and_taken_away(explorer):
    page, table = explorer.page, explorer.page.get_by_label("Vertices: one a line, with times or without")
    explorer.pick("path")
    explorer.choose("Pattern", "five cycles, growing")
    # On both sides of where the load is gone are states at the same place.
    rises = np.diff(explorer.row("force", "path ahead")[0])
    assert np.sum(np.diff(np.sign(rises[np.abs(rises) > 1e-5])) < 0) == 5
    assert len(table.input_value().splitlines()) == 10
    table.fill("10 nm\n5 bananas")
    table.blur()
    page.get_by_text("Line 2: “5 bananas” is not a number").wait_for()
    assert table.input_value() == "10 nm\n5 bananas"
    with explorer.change():
        table.fill("6 nm\n5 nm\n8 nm")
        table.blur()
    explorer.wait("explorer.row('force', 'path ahead')[0].at(-1).toFixed(6) === '8.000000'")
    assert explorer.link("pattern=own")["path"] == "6e-09 5e-09 8e-09"
    # What is ahead is drawn as one comes there.
    page.get_by_label("State along the way").press("Home")
    explorer.wait("explorer.played() && explorer.row('force', 'now')[0][0] === 0")
    assert not np.isfinite(explorer.row("force", "yielding")[0]).any()
    page.get_by_label("State along the way").press("End")
    explorer.wait("explorer.row('force', 'now')[0][0].toFixed(6) === '8.000000'")
    assert np.nanmax(explorer.row("force", "yielding")[0]) == pytest.approx(8.0)
    # In time, with dashpots: under a force first without them.
    explorer.pick("τ")
    explorer.choose("Pattern", "creep under a force, in time")
    explorer.wait("explorer.row('motion', 'depth d')[0].length === 17")
    assert explorer.readout("ε") != ""
    explorer.wait(WHOLE)
