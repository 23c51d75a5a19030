"""What the served page draws and says of scenes that were drawn or said wrong, against formulas."""

import re

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.explorer.state import PRESETS
from mdr_core.show.units import UNITS

from ..approx import approx
from .conftest import DROP, GOLD, Explorer
from .states import table

SIZES = {unit.name: unit.factor for units in UNITS.values() for unit in units}
#: A glass ball on rubber.
RADIUS, W, Q_C = 50e-6, 0.05, 1.0
MODULUS = mdr.Medium.from_bodies(2e6, 0.5, 63e9, 0.2).E_star
BALL = f"preset=microsphere-pdms&adhesion=work&work_of_adhesion={W}"


@pytest.fixture(scope="module")
def page(server, context):
    """One page, on which one scene is opened after the other."""
    page = Explorer(context.new_page(), server.url)
    yield page
    assert page.problems == []
    page.page.close()


def drawn(page, figure, row):
    """Columns x and y of a row in SI, by the units that its axes name."""
    units = [re.search(r"\((\S+)\)$", label)[1] for label in page.axis(figure)["labels"]]
    return [SIZES[unit] * part for unit, part in zip(units, page.row(figure, row), strict=True)]


def named(page, plot, row):
    """How often the legend of a plot names a row."""
    return page.page.locator(f".card.{plot} .key").get_by_text(row, exact=True).count()


def amounts(text):
    """All values with units of a text, in SI."""
    found = re.findall(r"(−?[\d.]+) ([^\s\d.,;)]+)", text)
    return [float(number.replace("−", "-")) * SIZES[unit] for number, unit in found if unit in SIZES]


def painted(x, y):
    """Area that a polygon paints, however its edges turn, from 4000 vertical cuts: about 10⁻³ of it."""
    cuts = np.linspace(x.min(), x.max(), 4001)
    ends = np.column_stack([x, y, np.roll(x, -1), np.roll(y, -1)])
    area = 0.0
    for cut in (cuts[1:] + cuts[:-1]) / 2:
        one, _, other, _ = part = ends[(ends[:, 0] < cut) != (ends[:, 2] < cut)].T
        place = part[1] + (cut - one) / (other - one) * (part[3] - part[1])
        order = np.argsort(place)
        turns = np.cumsum(np.where(one < other, 1, -1)[order])
        area += np.sum(np.diff(place[order])[turns[:-1] != 0])
    return area * (cuts[1] - cuts[0])


def test_areas_with_adhesion_are_the_energies_that_are_said(server, page):
    """Yield takes d_c φ(d_p), the jump into contact 3/10 E* a⁵/R² of JKR, the rim of the imprint π w c²."""
    depth, critical = 1.7672e-6, np.pi * Q_C / (2 * MODULUS)
    a = (2 * np.pi * W * RADIUS**2 / MODULUS) ** (1 / 3)
    plastic = critical * 4 / 3 * MODULUS * RADIUS**0.5 * (depth - critical) ** 1.5
    c = np.sqrt(RADIUS * (depth - critical))
    lost = plastic + 0.3 * MODULUS * a**5 / RADIUS**2 + np.pi * W * c**2
    for at in (1.4, 1):
        page.goto(f"{server.url}?{BALL}&max_depth={depth}&at={at}")
        said = amounts(page.label("force", "W_a"))
        areas = [painted(*drawn(page, "force", row)) for row in ("dissipated", "gained")]
        # Three digits are said; chords between states miss the curve by some 10⁻³.
        assert said[:2] == approx(areas, rel=6e-3)
        assert said[2] == approx(lost, rel=6e-3)
        assert areas[0] - areas[1] == approx(lost, rel=5e-3)
        assert named(page, "force", "stored") == 0 < named(page, "force", "dissipated")
    # What comes back before tension, at the largest depth, from the core.
    medium = mdr.Medium(MODULUS, q_c=Q_C, work_of_adhesion=W)
    back = np.linspace(depth, depth - critical, 4000)
    F = mdr.indent(mdr.Paraboloid(RADIUS), medium, back).force
    returned = -trapezoid(np.maximum(F, 0.0), back)
    assert painted(*drawn(page, "force", "given back")) == approx(returned, rel=1e-2)
    assert amounts(page.label("force", "W_U"))[0] == approx(returned, rel=1e-2)


def test_jump_into_contact_and_pull_off_are_marked_where_they_are(server, page):
    """JKR's −4/3 π w R at d = 0, and Kendall's √(8π w E* c³) of the imprint."""
    page.goto(f"{server.url}?{BALL}")
    depth = amounts(page.field("d_max").input_value())[0]
    x, y = drawn(page, "force", "jump into contact")
    assert x[0] == approx(0, abs=1e-3 * depth)
    assert y[0] == approx(-4 / 3 * np.pi * W * RADIUS, rel=1e-3)
    x, y = drawn(page, "force", "pull-off")
    critical = np.pi * Q_C / (2 * MODULUS)
    c = np.sqrt(RADIUS * (depth - critical))
    tension = np.sqrt(8 * np.pi * W * MODULUS * c**3)
    assert -y[0] == approx(tension, rel=1e-3)
    assert x[0] == approx(depth - critical - np.sqrt(2 * np.pi * c * W / MODULUS), rel=1e-3)
    label, place = page.label("force", "Fₐ"), drawn(page, "force", "Fₐ")
    assert amounts(label)[0] == approx(tension, rel=6e-3)
    wide, high = (np.ptp(page.axis("force")[axis]) * 1e-6 for axis in "xy")
    assert abs(place[0][0] - x[0]) < 0.1 * wide
    assert abs(place[1][0] - y[0]) < 0.1 * high
    # Where there is tension alone the axis is that of the tension: 3/2 π w R, of JKR.
    page.goto(f"{server.url}?{BALL}&max_depth=2e-7")
    bottom, top = page.axis("force")["y"]
    assert page.axis("force")["labels"][1].endswith("(µN)")
    assert (-bottom + top) * 1e-6 < 2 * 1.5 * np.pi * W * RADIUS


def test_stretched_springs_are_not_drawn_as_yielded(server, page):
    """Springs above the undeformed surface or the imprint carry tension: from √(R d) on, or all."""
    page.goto(f"{server.url}?{BALL}&max_depth=1.7672e-6")
    spacing = np.ptp(page.axis("springs")["x"]) * 1e-6 / 60
    x = np.abs(drawn(page, "springs", "stretched")[0].reshape(-1, 9)[:, 0])
    a = amounts(page.readout("contact_radius"))[0]
    assert x.min() == approx(np.sqrt(RADIUS * 1.7672e-6), abs=1.1 * spacing)
    assert x.max() == approx(a, abs=1.1 * spacing)
    page.goto(f"{server.url}?{BALL}&max_depth=1.7672e-6&at=1.9")
    assert page.readout("force").startswith("−")
    colours = {row: drawn(page, "springs", row)[0] for row in ("stretched", "yielded", "elastic")}
    assert np.isfinite(colours["stretched"]).any()
    assert not np.isfinite([*colours["yielded"], *colours["elastic"]]).any()
    assert named(page, "springs", "stretched") == 1


@pytest.mark.parametrize("drive", ["impact", "oblique"])
def test_an_impact_turns_orange_where_it_yields(server, page, drive):
    """Below the onset it is Hertz's curve, F ∝ d^(3/2), although yield begins after a few instants."""
    page.goto(f"{server.url}?preset={DROP}&drive={drive}")
    (depth,), (force,) = drawn(page, "force", "onset of yield")
    elastic, yielding = (drawn(page, "force", row) for row in ("elastic", "yielding"))
    # Four digits are drawn of the largest depth, which is ten times that of the onset.
    assert np.nanmax(elastic[0]) == approx(depth, rel=5e-3)
    assert np.nanmin(yielding[0]) == approx(depth, rel=5e-3)
    d = depth * np.linspace(0.05, 0.95, 30)
    inside = np.isfinite(elastic[0])
    F = np.interp(d, elastic[0][inside], elastic[1][inside])
    # A twentieth of the depth apart, a chord is above the curve by 10⁻³ of the force at its end.
    np.testing.assert_allclose(F, force * (d / depth) ** 1.5, atol=5e-3 * force)


def test_a_wavy_tip_is_refused_and_a_preset_is_chosen_again(server, page, tmp_path):
    """What is refused changes nothing; over a measured tip stands no preset's name."""
    page.goto(server.url)
    page.page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
    tip, r = page.page.get_by_label("CSV file of a measured tip: r, z"), np.linspace(-400, 400, 161)
    path = tmp_path / "tip.csv"
    path.write_text(table({"r (nm)": r, "z (nm)": r**2 / 2000 + 50 * np.sin(r / 30)}), encoding="utf-8")
    tip.set_input_files(path)
    refused = page.page.get_by_text(re.compile(r"^tip\.csv: the nearest convex profile misses the")).first
    refused.wait_for()
    # An rms of at most 50/√2 nm.
    miss = float(re.search(r"by ([\d.]+) nm", refused.inner_text())[1])
    assert 10 < miss < 36
    assert page.chosen("Shape") == "Cone"
    assert page.chosen("Preset") == PRESETS[GOLD].label
    path.write_text(table({"r (nm)": r, "z (nm)": r**2 / 2000}), encoding="utf-8")
    page.change(tip.set_input_files, path)
    assert page.chosen("Shape") == "Measured tip"
    assert page.chosen("Preset") != PRESETS[GOLD].label
    page.choose("Preset", PRESETS[GOLD].label)
    assert page.chosen("Shape") == "Cone"
    assert page.chosen("Preset") == PRESETS[GOLD].label


def test_a_number_that_is_shown_is_the_one_that_is_used(server, page):
    """Young's modulus of diamond is 1.141 TPa; what is typed has nine digits, what is dragged five."""
    page.goto(server.url)
    page.press("More about the medium")
    page.page.get_by_text("Where the preset's numbers come from").wait_for()
    said = page.page.locator(".form dt").all_inner_texts()
    assert "E2 = 1.141 TPa" in said
    page.change(page.type, "d_max", "8.12345678 nm")
    assert page.field("d_max").input_value() == "8.12345678 nm"
    page.drag("springs", (0, 0.2))
    page.wait(
        "!location.search.includes('8.123') && explorer.model('dragging').depth === null && explorer.idle()"
    )
    used = float(page.link("max_depth=")["max_depth"])
    assert amounts(page.field("d_max").input_value())[0] == approx(used, rel=1e-12)
    page.change(page.pick, "force")
    used = float(page.link("max_force=")["max_force"])
    assert amounts(page.field("F_max").input_value())[0] == approx(used, rel=1e-12)


def test_a_steel_ball_is_one(server, page):
    """16 mm of steel, 7850 kg/m³. A link of version 0.6, which had a paraboloid, opens that."""
    page.goto(server.url)
    page.choose("Preset", "Steel ball 16 mm on glass-fibre epoxy")
    assert page.chosen("Shape") == "Sphere"
    assert page.field("R").input_value() == "8 mm"
    page.pick("impact")
    mass = 4 / 3 * np.pi * 0.008**3 * 7850
    # Three digits of it, in grams.
    assert amounts(page.field("m").input_value())[0] == approx(1e3 * mass * SIZES["g"], rel=3e-3)
    assert page.page.locator(".form").get_by_text("striker").count() == 0


def test_creep_creeps(server, page):
    """A Kelvin–Voigt medium reaches F(d) as exp(−t/τ): the ramp takes as long as τ, which is said."""
    page.goto(server.url)
    page.pick("path")
    page.press("More about the medium")
    page.pick("η")
    page.choose("Pattern", "creep under a force, in time")
    page.page.locator(".lights span", has_text="so far").wait_for(state="hidden")
    tau = amounts(page.page.locator(".form").get_by_text(re.compile("^η = .*τ = ")).inner_text())[1]
    assert amounts(page.field("t_1").input_value())[0] == approx(tau, rel=0.02)
    d, F = drawn(page, "force", "path ahead")
    held = d[np.argmax(np.isclose(F, F.max(), rtol=1e-3)) :]
    assert held.max() > 1.1 * held.min()


#: What was said and is not so, of whatever scene.
FALSE = (
    "which is exact for ν = ½, and", "infinitely slow", "that exist", "hardness falls as 1/a",
    "indent_in_time", "Assumptions that hold", "*Sweep*", "&#x27;", "holds: ",
)  # fmt: skip
#: All texts of the page, those of explanations that are closed included.
TEXTS = """() => {
    const inside = (node) => [...(node.shadowRoot?.childNodes ?? []), ...node.childNodes]
    const shown = (node) => !/STYLE|SCRIPT/.test(node.tagName)
    const text = (node) => node.data ?? inside(node).filter(shown).map(text).join("")
    return text(document.body).replace(/\\s+/g, " ")
}"""


def said(page):
    text = page.page.evaluate(TEXTS)
    assert [words for words in FALSE if words in text] == []
    return text


def test_sentences_are_true(server, page):
    page.goto(f"{server.url}?preset={DROP}&drive=oblique")
    text = said(page)
    assert "This is exact only for ν = ½; here ν = 0.3." in text
    page.press("More about the medium")
    page.page.get_by_text("which of them are illustrative").wait_for()
    page.goto(f"{server.url}?damping=eta&eta=1e6")
    text = said(page)
    assert " act in the patterns in time of the drive path and in impacts." in text
    assert "Dashpots also act in the two patterns of a path in time." in text
    # A fast impact: the contact area of the limit over the present one; W = π q_c ∫ √(R s) ds.
    page.goto(f"{server.url}?preset={DROP}")
    (off,) = re.findall(
        r"The fast-impact limit, Eqs\. \(23\), \(24\), differs by (−[\d.]+) % in the", said(page)
    )
    given = PRESETS[DROP].values
    R, energy = given["paraboloid_radius"], given["mass"] * given["speed"] ** 2 / 2
    depth = (1.5 * energy / (np.pi * given["q_c"] * R**0.5)) ** (2 / 3)
    # a² = R d, as of every paraboloid in elastic contact; d has four digits.
    radius = (R * amounts(page.readout("depth"))[0]) ** 0.5
    assert float(off.replace("−", "-")) / 100 == approx(R * depth / radius**2 - 1, abs=1e-3)
    # The sweep draws the other classes of hardness, with their constants.
    page.goto(f"{server.url}?preset={DROP}&tiles=sweep&sweep.against=restitution")
    page.wait("explorer.row('sweep', 'this scene')?.[0].length > 1")
    labels = page.page.evaluate("explorer.model('sweep labels')?.data.text ?? []")
    assert {"this scene", "class (a)", "class (c)"} <= {*labels}
    assert re.search(r"e ∝ W.*Through the same point: \(a\) H = [\d.]+ MPa, W.*; \(c\) f", said(page))


def test_guided_scenes_are_true(server, page):
    """At d/d_c = 5 the mean pressure of a cone is 0.90 of q_c/a."""
    page.goto(server.url)
    page.press("Guide")
    for depth in ("1.5", "2", "9"):
        page.change(page.press, "Next")
        page.wait("(d) => explorer.row('force', 'now')[0][0].toFixed(1) === Number(d).toFixed(1)", depth)
    guide = page.page.locator("p[role=status]")
    guide.get_by_text("approaches q").wait_for()
    ratio = amounts(page.readout("mean_pressure"))[0] * amounts(page.readout("contact_radius"))[0] / 100
    assert ratio == approx(0.9, abs=0.01)
    assert page.readout("mean_pressure").split(".")[0] in guide.inner_text()
    said(page)
    page.page.get_by_label("Guided scene").select_option(label="It bounces only between two speeds")
    guide.get_by_text("Sweep", exact=True).wait_for()
    said(page)


def test_refusals_are_said_to_all(server, page, tmp_path):
    page.goto(server.url)
    path = tmp_path / "tip.csv"
    path.write_text("0, 0\n1, 1\n", encoding="utf-8")
    page.page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
    page.page.get_by_label("CSV file of a measured tip: r, z").set_input_files(path)
    page.page.get_by_text("header must name").last.wait_for()
    said(page)
    page.type("s", "90°")
    page.number("s").locator("p.said", has_text="half-angle must be above 0° and below 90°").wait_for()
