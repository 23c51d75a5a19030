"""Remarks on a number: whether it is plausible, and the remedies that its buttons do."""

import json
import re

import numpy as np
import panel as pn
import pytest

import mdr_core as mdr
from app.measurement.choices import MEDIA
from app.measurement.texts import HELP

from ...approx import approx
from ..conftest import READY
from ..measuring import (
    DEPTH,
    GLASS,
    TIP,
    buttons,
    choose,
    choose_samples,
    curve_file,
    drop,
    focused,
    headline,
    measured,
    opened,
    page_of,
    plain,
    press,
    said,
    saved,
    shown_number,
    silica_in,
    take_sample,
    text,
)
from ..states import table


def test_steel_is_no_gel():
    """46 GPa from the loading, 2.1 TPa from the unloading: no number is shown, not that of either."""
    page = measured("steel", "gel")
    assert headline(page) == "No E* to quote"
    assert not re.search(r"[GT]Pa", said(page))
    assert json.loads(saved(page, "json"))["numbers"]["quoted"]["value"] is None
    # The kind of sample is a click away.
    press(buttons(page.results.below, page.results.remarks)["Take glass, metal or ceramic"])
    assert page.form.medium.value == "constant"
    assert page.found.fit.medium.E_star == approx(210e9, rel=0.1)


def test_a_gel_that_loses_energy_has_one_line_on_its_unloading():
    """8 kPa from the loading, 14 kPa from the unloading: 1.75 times."""
    depth = 1e-6 * np.append(np.linspace(-1, 1, 400), np.linspace(1, -1, 400)[1:])
    tip, noise = mdr.Paraboloid(1e-5), np.random.default_rng(5).normal(size=depth.size)
    # The unloading begins at the same force, and ends at another depth.
    later = 1e-6 * (1 - (8 / 14) ** (2 / 3))
    soft = mdr.indent(tip, mdr.Medium(8e3), depth).force
    back = mdr.indent(tip, mdr.Medium(14e3), np.maximum(depth - later, -1e-6)).force
    force = np.where(np.arange(depth.size) < 400, soft, back) + 5e-12 * noise
    data = table({"Indentation (nm)": 1e9 * depth, "Force (nN)": 1e9 * force}).encode()
    page = opened(data, "gel", "paraboloid", radius=1e-5)
    other = mdr.fit_indentation(tip, depth[400:], force[400:], q_c=np.inf, baseline=None)
    said_below = text(page.results.below)
    found = re.search(r"unloading alone gives ([\d.]+) kPa, a ratio of ([\d.]+)", said_below)
    # Two digits.
    assert float(found[1]) * 1e3 == approx(float(other.medium.E_star), rel=0.05)
    assert float(found[2]) == approx(float(other.medium.E_star) / page.found.quoted.value, rel=0.05)
    assert "from the fit" in headline(page)
    # Of the unloading the loading is the other half.
    page.results.part.value = "unloading"
    assert "the loading alone gives" in text(page.results.below)
    # Of a range of one's own, of a contact that is held, and of a kind with adhesion there is none.
    choose_samples(page, 1, 600)
    assert "alone gives" not in said(page)
    page.results.part.value = "loading"
    choose(page, contact_point=float(page.found.fit.contact_point))
    assert "alone gives" not in said(page)
    choose(page, medium="sticky")
    assert "alone gives" not in said(page)


def test_the_gel_of_the_page_sticks_and_an_adhesion_below_the_bound_is_silent():
    """The force of the gel falls below that of the air by 9 % of the largest one, on the retract alone.

    Both parts differ by a factor of 1.23. Exact JKR follows one curve there and back, but for the pull-off.
    """
    page = page_of()
    take_sample(page, "gel")
    assert page.part == "loading"
    assert text(page.results.above) == ""
    said = text(page.results.below)
    assert "adhesion" in said
    share = float(re.search(r"([\d.]+) % of the largest", said)[1])
    force = page.curve.force
    air = np.median(force[-400:])
    assert share / 100 == approx((air - force.min()) / force.max(), abs=0.04)
    (take,) = [each for each in page.results.below.select(pn.widgets.Button) if "adhesion" in each.label]
    take.clicks += 1
    assert page.form.medium.value == "sticky"
    d = np.append(np.linspace(-0.1e-6, 0.6e-6, 300), np.linspace(0.6e-6, -0.3e-6, 300))
    tip, made = mdr.Paraboloid(1e-5), mdr.Medium(20e3, work_of_adhesion=2e-6)
    force = mdr.indent(tip, made, d).force
    data = table({"Depth (nm)": 1e9 * d, "F (nN)": 1e9 * force}).encode()
    page = opened(data, "gel", "paraboloid", radius=1e-5)
    assert headline(page).startswith("E* = ")
    assert text(page.results.below) == ""


def test_a_stiff_elastic_sample_is_asked_about_unless_both_halves_agree():
    """70 GPa that do not yield: silent. A range of it: the question, with units to look at."""
    page = opened(curve_file(mdr.Medium(70e9), noise=1e-4), "gel")
    assert headline(page).startswith("E* = 70.00 GPa")
    assert text(page.results.above) == ""
    choose_samples(page, 1, page._ends_of("loading")[1] - 1)
    assert headline(page).startswith("E* = ")
    assert text(page.results.above)
    labels = ["Look at the unit of depth", "Look at the unit of force"]
    assert list(buttons(page.results.above)) == labels


def test_silica_with_micrometres_for_nanometres_is_no_glass():
    """69.62 kPa; the unit of depth alone makes it plausible, and its button leads there."""
    page = opened(silica_in("um"), name="silica_um.csv")
    assert headline(page) == "No E* to quote"
    reason = text(page.results.below)
    assert "below 1 MPa" in reason
    assert "depth in µm" in reason
    assert "kPa" not in said(page)
    assert json.loads(saved(page, "json"))["quoted"]["kind"] == "units"
    press(buttons(page.results.below)["Look at the unit of depth"])
    assert page.form.reader.collapsed is False
    page.form.columns.units["depth"].value = "nm"
    assert headline(page).startswith("E* = 69.6")


def test_a_soft_sample_of_constant_hardness_is_quoted_below_a_question():
    """50 MPa: with a force of a thousand times 50 GPa, with a depth of a thousandth 50 TPa."""
    page = opened(curve_file(mdr.Medium(50e6, hardness=5e6)))
    assert headline(page).startswith("E* = ")
    assert list(buttons(page.results.above)) == ["Look at the unit of force"]
    assert json.loads(saved(page, "json"))["remarks"][0]["kind"] == "units"
    # What has 0.2 GPa is not asked about, nor is a soft composite.
    assert text(opened(curve_file(mdr.Medium(0.2e9, hardness=5e6))).results.above) == ""
    assert text(opened(curve_file(mdr.Medium(50e6, q_c=50.0)), "composite").results.above) == ""


def test_below_a_number_stands_what_its_error_does_not_have_in_it():
    page = opened(curve_file(noise=0.004))
    assert "rigid frame" in headline(page)
    choose(page, frame=1e-9)
    assert "rigid frame" not in headline(page)
    assert "ideal tip" in headline(page)
    # An exact curve has no ±.
    force = mdr.indent(mdr.Paraboloid(1e-5), mdr.Medium(20e3), DEPTH).force
    data = table({"Depth (nm)": 1e9 * DEPTH, "F (pN)": 1e12 * force}).encode()
    exact = opened(data, "gel", "paraboloid", radius=1e-5)
    assert headline(exact).startswith("E* = 20 kPa")
    assert "±" not in headline(exact)


def test_what_every_berkovich_has_stands_once_in_the_help():
    """Slopes of 0.358, and the contact radius of an elastic contact: known from tip and sample."""
    page = page_of()
    take_sample(page, "silica")
    assert "slopes" not in said(page)
    assert "contact radius of an elastic contact" not in said(page)
    for words in ("13 %", "contact radius", "200 nm", "77.1 GPa"):
        assert words in plain(HELP)
    # The slope of a sphere depends on its depth.
    d = 1e-6 * np.linspace(-0.02, 0.6, 200)
    force = mdr.indent(mdr.Sphere(1e-6), mdr.Medium(1e9), d).force
    data = table({"h (nm)": 1e9 * d, "F (mN)": 1e3 * force})
    page = opened(data.encode(), "gel", "sphere", radius=1e-6)
    assert "slopes" in said(page).lower()


def test_a_drag_that_is_left_out_is_freed_by_a_button():
    """A gel in a liquid, the force of which has a part with the speed."""
    made, tip = mdr.Medium(20e3), mdr.Paraboloid(10e-6)
    t = np.linspace(0, 2, 401)
    d = 1e-6 * np.sin(np.pi * t / 2) - 0.2e-6
    force = mdr.indent(tip, made, d).force
    drag = 0.1 * force.max() / (1e-6 * np.pi / 2)
    columns = {"t (s)": t, "Depth (nm)": 1e9 * d, "F (pN)": 1e12 * (force + drag * np.gradient(d, t))}
    page = opened(table(columns).encode(), "gel", "paraboloid", radius=10e-6)
    page.results.part.value = "all"
    assert headline(page) == "No E* to quote"
    press(buttons(page.results.below)["Free the drag"])
    assert page.found.fit.drag == approx(drag, rel=0.05)
    assert headline(page).startswith("E* = ")


def test_a_noise_of_the_depth_is_given_by_a_button():
    """Depths that go back and forth, taken as exact."""
    noise = 5e-9 * np.random.default_rng(3).standard_normal(DEPTH.size)
    force = mdr.indent(TIP, GLASS, DEPTH).force
    page = opened(table({"h (nm)": 1e9 * (DEPTH + noise), "F (mN)": 1e3 * force}).encode())
    choose(page, depth_noise=0.0)
    assert "noise" in {each.kind for each in page.results.all_remarks()}
    # No names of Python.
    shown = said(page) + page.results.report.value
    assert re.findall(r"[A-Za-z]{2,}_[a-z]+|E_star|\w=\w", shown) == []
    offers = buttons(page.results.remarks) | buttons(page.results.below)
    press(offers["Give the noise of the depth"])
    assert page.found.fit.depth_noise == approx(5e-9, rel=0.3)
    assert "noise" not in {each.kind for each in page.results.all_remarks()}


def test_remarks_are_kinds_texts_and_remedies_in_the_file():
    page = measured("steel", "constant")
    told = json.loads(saved(page, "json"))
    assert told["remarks"]
    for each, remark in zip(told["remarks"], page.results.all_remarks(), strict=True):
        assert each == {"kind": remark.kind, "text": remark.text, "remedy": each["remedy"]}
        assert [(one["action"], one["what"]) for one in each["remedy"]] == [
            (one.action, one.what) for one in remark.remedy
        ]
    lines = saved(page, "csv")
    for remark in page.results.all_remarks():
        assert remark.text in lines


def test_an_ideal_tip_at_a_small_depth_is_doubted_below_the_number():
    """At 100 nm, and not at 1 µm; the doubt comes with a way to another tip."""
    page = opened(curve_file(depth=0.1 * DEPTH))
    assert headline(page).startswith("E* = ")
    assert "ideal tip" in text(page.results.below)
    assert "Choose another tip" in buttons(page.results.below)
    assert "tip" in {each["kind"] for each in json.loads(saved(page, "json"))["remarks"]}
    assert text(opened(curve_file()).results.below) == ""


@pytest.mark.parametrize(
    ("made", "name"),
    [
        (mdr.Medium(80e9, q_c=5000.0), "composite"),
        (mdr.Medium(80e9, f_c=2e-3), "line"),
    ],
)  # fmt: skip
def test_the_class_that_fits_five_times_better_is_taken_by_a_button(made, name):
    """A curve without noise is fitted by its own class alone, with the constant it was made with."""
    own = MEDIA[name].letter
    data = curve_file(made)
    for other in {"constant", name}:
        page = opened(data, other)
        assert f"of class ({own})" in text(page.results.aside)
        button = page.results.take
        assert button.visible == (other != name)
        if button.visible:
            assert f"Take class ({own})" in button.label
            press(button)
        assert page.form.medium.value == name
        assert page.found.fit.medium.E_star == approx(80e9, rel=1e-4)
        constant = MEDIA[name].fitted[1]
        assert getattr(page.found.fit.medium, constant) == approx(getattr(made, constant), rel=1e-4)


def test_a_class_that_cannot_be_told_is_not_offered():
    """In 20 % of noise all classes are as good."""
    page = opened(curve_file(noise=0.2))
    assert not page.results.take.visible
    assert "of class (" not in text(page.results.aside)


def test_the_modulus_of_the_sample_goes_with_its_poisson_ratio():
    page = opened(curve_file(), poisson=0.2)
    assert re.search(r"E = [\d.]+ .*GPa", headline(page))
    assert "E_sample" in saved(page, "json")
    choose(page, poisson=None)
    assert "E = " not in headline(page)
    assert "E_sample" not in saved(page, "json")


def test_a_button_of_a_remark_leads_to_the_field_that_cures_it(measurement, tmp_path):
    """Silica with µm for nm, at 1280 × 720 without scrolling; then by keys alone."""
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    page.goto(f"{page.url}&tip=berkovich&medium=constant")
    measurement.wait(READY)
    (tmp_path / "silica_um.csv").write_bytes(silica_in("um"))
    drop(measurement, tmp_path / "silica_um.csv")
    button = page.get_by_role("button", name="Look at the unit of depth")
    button.wait_for()
    box = button.bounding_box()
    assert box["y"] + box["height"] < 720
    page.get_by_text("No E* to quote").wait_for()
    assert page.locator(".big output").count() == 0
    button.click()
    focused(page, "Unit of depth")
    page.get_by_label("Unit of depth").select_option("nm")
    assert shown_number(measurement, "GPa").startswith("69.6")
    # What ± is stands below the number, on the first screen.
    box = page.get_by_text("rigid frame").first.bounding_box()
    assert box["y"] + box["height"] < 720
