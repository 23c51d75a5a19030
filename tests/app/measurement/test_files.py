"""Files in the browser: dropped, asked about, refused, and the field for them."""

import re
import zipfile

import numpy as np

import mdr_core as mdr

from ..measuring import TIP, curve_at, drop, shown_number
from ..states import table


def test_a_file_is_dropped_and_a_handle_takes_fewer_samples(measurement, tmp_path):
    page = measurement.page
    drop(measurement, curve_at(tmp_path / "run.csv", mdr.Medium(80e9, hardness=14e9)))
    page.get_by_text("Give the tip", exact=True).wait_for()
    page.get_by_label("Tip", exact=True).select_option(label="Berkovich or Vickers (cone of 70.3°)")
    page.get_by_text("Give the sample", exact=True).wait_for()
    page.get_by_label("Sample", exact=True).select_option(label="Composite, PDMS: hardness ∝ 1/a")
    # The class that fits is a click away.
    page.get_by_role("button", name="Take class (a), constant hardness").click()
    page.get_by_text("14 GPa").or_(page.get_by_placeholder("14 GPa")).first.wait_for()
    handle = page.locator(".ends .noUi-handle-upper")
    # The handles are at both ends of a line that can be seen.
    lower = page.locator(".ends .noUi-handle-lower").bounding_box()
    assert handle.bounding_box()["x"] - lower["x"] > 200
    handle.focus()
    page.keyboard.press("ArrowLeft")
    page.get_by_text(re.compile("Fitted: samples 1 .* to 399 ")).wait_for()
    # A file of the same name is read again.
    drop(measurement, curve_at(tmp_path / "run.csv", mdr.Medium(40e9, hardness=14e9)))
    page.get_by_placeholder("40 GPa").wait_for()


def test_the_field_for_a_file_is_as_high_as_others_unless_a_file_is_over_it(measurement, tmp_path):
    """Or a file that is too large is named there, with the reason. No file ends the session."""
    page = measurement.page
    field, tip = page.locator(".filepond--root").first, page.get_by_label("Tip", exact=True)
    drawn = "explorer.all().find((each) => each.matches('.filepond--root')).offsetHeight"
    # The sheet of a component comes after it.
    measurement.wait(f"{drawn} < 40")
    usual = page.evaluate(drawn)
    assert abs(usual - tip.bounding_box()["height"]) <= 4
    field.evaluate("(each) => { each.dataset.hopperState = 'drag-over' }")
    assert page.evaluate(drawn) > 2 * usual
    field.evaluate("(each) => { delete each.dataset.hopperState }")
    drop(measurement, curve_at(tmp_path / "run.csv"))
    page.get_by_text("run.csv: 400 samples").wait_for()
    # The file is named below the field, once it has come.
    measurement.wait(f"(usual) => Math.abs({drawn} - usual) <= 1", usual)
    # More than the limit is refused before it is sent, in words.
    (tmp_path / "huge.csv").write_bytes(bytes(51_000_000))
    drop(measurement, tmp_path / "huge.csv")
    page.get_by_text(re.compile("too large", re.IGNORECASE)).first.wait_for()
    page.get_by_text(re.compile("50 ?MB")).first.wait_for()
    measurement.wait(f"(usual) => {drawn} > 1.5 * usual", usual)
    # Zeros, a zip of zeros, and words.
    (tmp_path / "large.csv").write_bytes(bytes(20_000_000))
    with zipfile.ZipFile(tmp_path / "packed.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("large.jpk", bytes(10_000_000))
    (tmp_path / "words.csv").write_text("force after\ndepth\n")
    for name in ("large.csv", "packed.zip", "words.csv"):
        drop(measurement, tmp_path / name)
        page.locator("p.refused", has_text=name).first.wait_for(timeout=60_000)
    measurement.press("Sample: gel by AFM")
    assert shown_number(measurement, "kPa").startswith("19.7")


def test_a_question_is_answered_by_one_click(measurement, tmp_path):
    """A German file: the choosers have the suggestion, which is drawn, and a folder is asked about once."""
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    depth = 1e-6 * np.append(np.linspace(-0.05, 1, 240), np.linspace(1, 0.7, 160))
    force = mdr.indent(TIP, mdr.Medium(E_star=80e9, hardness=8e9), depth).force
    for name in ("eine_datei.csv", "noch_eine.csv"):
        text = table({"Tiefe (nm)": 1e9 * depth, "Kraft (mN)": 1e3 * force})
        (tmp_path / name).write_text(text, encoding="utf-8")
    drop(measurement, tmp_path / "eine_datei.csv")
    page.get_by_text("eine_datei.csv: which column is the depth").wait_for()
    # The suggestion is drawn, on one screen with the question and its button.
    canvas = page.locator(".of-force canvas").first
    canvas.wait_for()
    read = page.get_by_role("button", name="Read", exact=True)
    for part in (canvas, read):
        box = part.bounding_box()
        assert 0 <= box["y"] < box["y"] + box["height"] <= 720
    read.click()
    page.get_by_text("eine_datei.csv: 400 samples").wait_for()
    drop(measurement, tmp_path / "noch_eine.csv")
    page.get_by_text("noch_eine.csv: 400 samples").wait_for()
