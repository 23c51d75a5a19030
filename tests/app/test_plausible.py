"""Whether the number is plausible for the sample that was chosen, and what the buttons of remarks do."""

import json
import re

import numpy as np
import panel as pn
import pytest

import mdr_core as mdr
from app.common.quantities import ASSETS
from app.measurement.texts import HELP

from ..approx import approx
from .measuring import (
    DATA,
    DEPTH,
    GLASS,
    TIP,
    buttons,
    choose,
    choose_samples,
    curve_file,
    headline,
    link_of,
    measured,
    opened,
    page_of,
    plain,
    press,
    said,
    saved,
    take_file,
    take_sample,
    text,
)  # fmt: skip
from .states import table

# The other half.


def test_steel_is_no_gel():
    """46 GPa from the loading, 2.1 TPa from the unloading: no number is shown, not that of either."""
    page = measured("steel", "gel")
    assert headline(page) == "No E* to quote"
    assert not re.search(r"[GT]Pa", said(page))
    told = json.loads(saved(page, "json"))
    assert told["numbers"]["quoted"]["value"] is None
    assert told["quoted"]["source"] is None
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
    found = re.fullmatch(
        r"Of the loading; the unloading alone gives ([\d.]+) kPa, ([\d.]+) times: the sample yields, "
        r"sticks or loses energy\.",
        text(page.results.below),
    )
    # Two digits.
    assert float(found[1]) * 1e3 == approx(float(other.medium.E_star), rel=0.05)
    assert float(found[2]) == approx(float(other.medium.E_star) / page.found.quoted.value, rel=0.05)
    assert "from the fit" in headline(page)
    # Of the unloading the loading is the other half.
    page.results.part.value = "unloading"
    assert text(page.results.below).startswith("Of the unloading; the loading alone gives ")
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
    assert text(page.results.above).startswith("Few gels, cells and rubbers are so stiff: ")
    assert "look at the units of depth and force" in text(page.results.above)
    labels = ["Look at the unit of depth", "Look at the unit of force"]
    assert list(buttons(page.results.above)) == labels


# Plausible for what was chosen.


def silica(unit):
    return (ASSETS / "silica.csv").read_bytes().replace(b"_nm", f"_{unit}".encode())


def test_silica_with_micrometres_for_nanometres_is_no_glass():
    """69.62 kPa; the unit of depth alone makes it plausible, and its button leads there."""
    page = opened(silica("um"), name="silica_um.csv")
    assert headline(page) == "No E* to quote"
    reason = text(page.results.below)
    assert "below 1 MPa, which no glass, metal or ceramic has" in reason
    assert "the file is read with depth in µm; look at the unit of depth" in reason
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
    doubt = text(page.results.above)
    assert doubt.startswith("Few samples of constant hardness are so soft: ")
    assert "look at the unit of force" in doubt
    assert list(buttons(page.results.above)) == ["Look at the unit of force"]
    assert json.loads(saved(page, "json"))["remarks"][0]["kind"] == "units"
    # What has 0.2 GPa is not asked about, nor is a soft composite.
    assert text(opened(curve_file(mdr.Medium(0.2e9, hardness=5e6))).results.above) == ""
    assert text(opened(curve_file(mdr.Medium(50e6, q_c=50.0)), "composite").results.above) == ""


def test_the_curves_of_a_map_are_judged_as_one_is():
    page = opened(silica("um"))
    page.do(page.fit_all)
    (row,) = page.rows
    value, error, reason = row.E, row.E_error, row.reason
    assert (value, error) == (None, None)
    assert "below 1 MPa" in reason
    assert "below 1 MPa" in page.results.curves_files[0].callback().read()


# What ± is, and what it is said of.


def test_below_a_number_stands_what_its_error_does_not_have_in_it():
    page = opened(curve_file(noise=0.004))
    assert "of noise; an ideal tip and a rigid frame are assumed." in headline(page)
    choose(page, frame=1e-9)
    assert "of noise; an ideal tip is assumed." in headline(page)
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
    assert "2.5 times the area" not in said(page)
    help_ = plain(HELP)
    for words in ("13 % for a Berkovich", "contact radius of an elastic contact", "200 nm", "77.1 GPa"):
        assert words in help_
    # The slope of a sphere depends on its depth.
    d = 1e-6 * np.linspace(-0.02, 0.6, 200)
    force = mdr.indent(mdr.Sphere(1e-6), mdr.Medium(1e9), d).force
    data = table({"h (nm)": 1e9 * d, "F (mN)": 1e3 * force})
    page = opened(data.encode(), "gel", "sphere", radius=1e-6)
    assert "Slopes reach" in said(page)


# Units, names of files.


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


def test_a_name_of_a_file_is_no_symbol():
    """“d_c” is typeset with an index, “d_c.csv” is not."""
    page = page_of()
    for data in (b"nothing", b"a,b\n1,2\n2,3\n3,5\n"):
        take_file(page, "d_c.csv", data)
        (error,) = page.form.errors
        assert "d_c.csv" in error.object
        assert "<sub>" not in error.object.partition(":")[0]


def test_remarks_name_the_file_that_was_dropped():
    """In a file that is kept under another name, in a folder of the server."""
    page = opened((DATA / "steel.csv").read_bytes(), name="steel_1.csv")
    texts = said(page) + saved(page, "json") + saved(page, "csv")
    assert not re.search(r"file \d+\.csv|/tmp|mdr-explorer-", texts)


# An AFM file without a stiffness.


def heights():
    """A made gel of 20 kPa under a sphere of 5 µm: heights of an AFM without its k = 0.05 N/m."""
    afmformats = pytest.importorskip("afmformats")
    d = 1e-6 * np.append(np.linspace(-1.0, 0.6, 300), np.linspace(0.6, -1.0, 300)[1:])
    force = mdr.indent(mdr.Paraboloid(5e-6), mdr.Medium(20e3), d).force
    data = {"force": force, "height (measured)": -d - force / 0.05}
    data["segment"] = np.repeat([0, 1], [300, 299]).astype(np.uint8)
    known = {"enum": 0, "path": "made", "imaging mode": "force-distance"}
    return afmformats.mod_force_distance.AFMForceDistance(data, known)


def test_an_afm_file_without_a_stiffness_is_asked_for_it_and_not_fitted(tmp_path):
    pytest.importorskip("h5py")
    heights().export_data(tmp_path / "gel_1.h5", fmt="hdf5")
    page = opened((tmp_path / "gel_1.h5").read_bytes(), "gel", "paraboloid", "gel_1.h5", radius=5e-6)
    assert headline(page).startswith("Give the spring constant k")
    assert "includes the deflection" in text(page.results.below)
    assert page.found is None
    # The curve is seen.
    assert page.results.figures.visible
    assert "Pa" not in said(page)
    press(buttons(page.results.below)["Give the spring constant of the cantilever"])
    assert page.form.reader.visible
    assert not page.form.reader.collapsed
    assert not page.form.columns.view.visible
    # A browser may tell a number twice: without a unit it is still in that in which it was typed.
    stiffness = page.form.numbers["spring_constant"]
    for _ in range(2):
        stiffness.value = "0.05"
        assert stiffness.value == "0.05 N/m"
    assert headline(page).startswith("E* = 20")
    assert page.found.quoted.value == approx(20e3, rel=1e-3)
    # The link has it.
    assert link_of(page).numbers["spring_constant"] == 0.05


def test_a_map_without_a_stiffness_is_not_fitted(tmp_path):
    """Nor is one of its curves, where others have it."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "map.h5", "w") as file:
        for k in range(2):
            made = heights()
            made.metadata["enum"] = k
            made.export_data(file, fmt="hdf5")
    page = opened((tmp_path / "map.h5").read_bytes(), "gel", "paraboloid", "map.h5", radius=5e-6)
    assert page.count == 2
    assert page.results.all.disabled
    page.do(page.fit_all)
    assert [row.E for row in page.rows] == [None, None]
    assert all("includes the deflection" in row.reason for row in page.rows)
    choose(page, spring_constant=0.05)
    assert not page.results.all.disabled
    page.do(page.fit_all)
    assert [row.E for row in page.rows] == approx([20e3, 20e3], rel=1e-3)


# Buttons that do a remedy.


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
    remarks = {each.kind: each for each in page.results.all_remarks()}
    assert "noise" in remarks
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
    assert text(page.results.below).startswith("An ideal tip at a contact depth of ")
    assert "Choose another tip" in buttons(page.results.below)
    assert "tip" in {each["kind"] for each in json.loads(saved(page, "json"))["remarks"]}
    assert text(opened(curve_file()).results.below) == ""
