"""The form: tip, sample, numbers with units, and errors below their fields."""

import re

import numpy as np

from ...approx import approx
from ..measuring import (
    DEPTH,
    choose,
    curve_file,
    headline,
    opened,
    page_of,
    shown_number,
    take_file,
    take_sample,
    take_tip,
    text,
)
from ..states import table


def test_tip_and_sample_are_asked_for_one_after_the_other():
    page = page_of()
    take_file(page, "run.csv", curve_file())
    assert headline(page).startswith("Give the tip")
    choose(page, tip="paraboloid")
    assert headline(page).startswith("Give the tip radius R")
    choose(page, tip="berkovich")
    assert headline(page).startswith("Give the sample")
    assert page.found is None
    page.form.medium.value = "constant"
    assert page.found.fit.medium.E_star == approx(80e9, rel=1e-4)
    # What was told holds for the next file; that of an example does not.
    take_file(page, "other.csv", curve_file(offset=5e-9))
    assert page.found.fit.contact_point == approx(5e-9, abs=1e-12)
    take_sample(page, "gel")
    take_file(page, "run.csv", curve_file())
    assert headline(page).startswith("Give the tip")


def test_a_number_without_a_unit_has_that_of_the_number_in_its_field():
    """Also of a result, and of the one before it is emptied."""
    page = page_of()
    take_sample(page, "silica")
    modulus, frame = page.form.numbers["E_star"], page.form.numbers["frame"]
    for _ in range(2):
        assert modulus.placeholder.endswith(" GPa")
        modulus.value = "70"
        assert (modulus.value, page.found.fit.medium.E_star) == ("70 GPa", 70e9)
        modulus.value = ""
    frame.value = "1e-9 m/N"
    assert frame.si == 1e-9
    frame.value = ""
    frame.value = "0.1"
    assert frame.si == approx(0.1e-6, rel=1e-12)


def test_a_wrong_entry_goes_with_its_field_its_sample_and_its_file():
    page = page_of()
    take_sample(page, "silica")
    field = page.form.numbers["E_star"]
    field.value = "abc"
    assert field.error
    take_sample(page, "gel")
    assert (field.value, field.error) == ("", "")
    page.form.numbers["radius"].value = "xx"
    choose(page, tip="berkovich")
    assert page.form.numbers["radius"].error == ""


def test_a_tip_is_read_from_a_file():
    r = np.linspace(0, 1e-6, 30)
    page = opened(curve_file(), tip="measured")
    assert headline(page).startswith("Give the file of the tip")
    take_tip(page, "<b>tip.csv", table({"r (nm)": 1e9 * r, "z (nm)": 1e9 * r**2 / 1e-5}).encode())
    assert text(page.form.tip_about) == "30 samples, as in the file"
    E = page.found.fit.medium.E_star
    take_tip(page, "<b>tip.csv", b"nothing")
    assert "<b>tip.csv" in text(page.form.tip_about)
    assert "<b>" not in page.form.tip_about.object
    # The tip before it stays.
    choose(page, frame=1e-12)
    assert page.found.fit.medium.E_star == approx(E, rel=1e-3)


def test_each_field_has_a_unit_before_anything_is_typed():
    """But those of numbers without one."""
    page = opened(curve_file(timed=True), "viscous")
    form = page.form
    for name, field in form.numbers.items():
        shown = field.value or field.placeholder
        unit = {"poisson": "type a value", "tip_poisson": "type a value"}
        assert shown == unit.get(name) or re.search(r"[A-Za-zµ°]", shown), (name, shown)
    choose(page, medium="constant")
    assert form.numbers["baseline"].value == "0 N"
    assert form.numbers["drift"].placeholder == "0 nm/s"
    assert "(0 µm, 0 mN)" in opened(curve_file(depth=np.append(0, DEPTH[DEPTH > 0]))).results.fitted.object


def test_a_wrong_number_has_its_error_below_the_field(measurement):
    page = measurement.page
    measurement.press("Sample: gel by AFM")
    shown_number(measurement, "kPa")
    field = page.get_by_label("R tip radius")
    field.fill("10 furlongs")
    field.press("Enter")
    error = page.get_by_role("alert").filter(has_text="10 furlongs")
    error.wait_for()
    below = error.bounding_box()["y"] - field.bounding_box()["y"]
    assert 0 < below < 60
    field.fill("20 µm")
    field.press("Enter")
    error.wait_for(state="detached")
    shown_number(measurement, "13.9")


def test_what_was_said_of_a_file_is_gone_with_the_next():
    """Of a curve, also where the next file cannot be read; of a tip."""
    page = opened(curve_file())
    choose(page, contact_point=1e-3)
    assert "First contact" in text(page.results.errors)
    take_file(page, "damaged.csv", b"nothing")
    assert text(page.results.errors) == ""
    assert "damaged.csv" in text(page.form.errors)
    choose(page, tip="measured")
    take_tip(page, "wrong.csv", b"nothing")
    assert "wrong.csv" in text(page.form.tip_about)
    r = np.linspace(0, 1000, 30)
    take_tip(page, "tip.csv", table({"r (nm)": r, "z (nm)": r**2 / 1e4}).encode())
    assert text(page.form.tip_about) == "30 samples, as in the file"
