"""The page for a measurement as a person uses it, in a browser, and what it does to others."""

import itertools
import re
import zipfile
from io import BytesIO
from urllib.request import urlopen

import numpy as np
import pandas
import pytest

import mdr_core as mdr
from mdr_core.show.figures import ROLES

from .conftest import ROOT, Explorer, Server
from .measuring import TIP
from .states import table
from .test_plausible import heights

Image = pytest.importorskip("PIL.Image")
READY = "Bokeh.documents.length && Bokeh.documents.every((each) => each.is_idle)"


@pytest.fixture
def measurement(server, context):
    """The page freshly opened; afterwards nothing may have been complained about or left the host."""
    opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
    yield opened
    assert opened.problems == []
    opened.page.close()
    assert server.faults == ""


def number(opened, text):
    """Wait for the number that is large, and return it."""
    shown = opened.page.locator(".big output", has_text=re.compile(text))
    shown.wait_for()
    return shown.inner_text()


def drop(opened, *files):
    opened.page.locator('.filepond--browser, input[type="file"]').first.set_input_files(files)


def curve(path, medium, depth=None):
    depth = (
        1e-6 * np.append(np.linspace(-0.05, 1, 240), np.linspace(1, 0.7, 160)) if depth is None else depth
    )
    force = mdr.indent(TIP, medium, depth).force
    path.write_text(table({"h (nm)": 1e9 * depth, "F (mN)": 1e3 * force}), encoding="utf-8")
    return path


def test_a_sample_is_one_click_and_all_of_it_is_in_sight(measurement):
    """At 1280 × 720 without scrolling: number, class, curve and residuals; the link has the sample."""
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    measurement.press("Sample: fused silica")
    assert re.fullmatch(r"69\.\d\d GPa", number(measurement, "69"))
    page.get_by_text("The curve is of class (a), constant hardness.").wait_for()
    for place in (".big output", ".classes table", ".of-force canvas", ".of-residual canvas"):
        box = page.locator(place).first.bounding_box()
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= 720, place
    assert page.locator(".big").evaluate("(each) => parseFloat(getComputedStyle(each).fontSize)") >= 30
    measurement.wait("location.search.includes('medium=constant')")
    again = page.url
    page.goto(again)
    number(measurement, "69")
    page.context.grant_permissions(["clipboard-read"])
    measurement.press("Copy")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert re.search(r"E\* = 69\.\d+ ± 0\.\d+ GPa", copied)
    assert re.search(r"constant hardness H\t14\.\d+ ± 0\.\d+ GPa", copied)
    for button, start in (("CSV", "# mdr_core "), ("JSON", '{\n "version": "mdr_core ')):
        with page.expect_download() as download:
            page.get_by_text(button, exact=True).click()
        assert download.value.path().read_text(encoding="utf-8").startswith(start)


def test_a_narrow_window_has_one_column_and_nothing_over_another(measurement):
    """No scrolling sideways; the number, the buttons, the classes and the plots stand below each other."""
    page = measurement.page
    page.set_viewport_size({"width": 390, "height": 800})
    measurement.press("Sample: fused silica")
    number(measurement, "69")
    page.get_by_text("The curve is of class (a), constant hardness.").wait_for()
    for width in (390, 720, 1040, 1100):
        page.set_viewport_size({"width": width, "height": 800})
        measurement.wait("document.documentElement.scrollWidth <= innerWidth")
        places = (".big output", ".second >> nth=-1", ".tools button:visible >> nth=2", ".classes table")
        boxes = [page.locator(place).bounding_box() for place in (*places, ".of-force", ".of-residual")]
        for above, below in itertools.pairwise(boxes):
            assert above["y"] + above["height"] <= below["y"] + 1
        # Both plots are high enough to be read.
        assert boxes[-2]["height"] > 200
        assert boxes[-1]["height"] > 100


def test_a_file_is_dropped_and_a_handle_takes_fewer_samples(measurement, tmp_path):
    page = measurement.page
    drop(measurement, curve(tmp_path / "run.csv", mdr.Medium(80e9, hardness=14e9)))
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
    drop(measurement, curve(tmp_path / "run.csv", mdr.Medium(40e9, hardness=14e9)))
    page.get_by_placeholder("40 GPa").wait_for()


def test_no_file_ends_the_session(measurement, tmp_path):
    """20 MB of zeros, NUL, words, a zip; then the next curve is read, in the same session."""
    page = measurement.page
    large = tmp_path / "large.csv"
    large.write_bytes(bytes(20_000_000))
    packed = tmp_path / "packed.zip"
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("large.jpk", bytes(10_000_000))
    words = tmp_path / "words.csv"
    words.write_text("force after\ndepth\n")
    for path in (large, packed, words):
        drop(measurement, path)
        refusal = page.locator("p.refused", has_text=re.compile(re.escape(path.name)))
        refusal.first.wait_for(timeout=60_000)
    # More than the limit is refused before it is sent, in words.
    huge = tmp_path / "huge.csv"
    with huge.open("wb") as file:
        file.truncate(60_000_000)
    drop(measurement, huge)
    page.get_by_text(re.compile("too large", re.IGNORECASE)).first.wait_for()
    page.get_by_text(re.compile("50 ?MB")).first.wait_for()
    measurement.press("Sample: gel by AFM")
    assert number(measurement, "kPa").startswith("19.7")


def test_it_adds_no_byte_to_the_explorer_in_the_same_process(browser):
    """What the explorer's page loads is the same before and after somebody has opened this page."""
    server = Server()
    try:

        def loaded():
            text = urlopen(server.url).read().decode()
            # Tokens and ids differ from session to session.
            text = re.sub(r'"token":"[^"]*"|"roots?[^}]*}|[0-9a-f]{8}-[0-9a-f-]{27}|p\d{4,}', "", text)
            return text, re.findall(r'(?:src|href)="([^"]+)"', text)

        before = loaded()
        with browser.new_context() as context:
            opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
            opened.press("Sample: fused silica")
            number(opened, "GPa")
            assert opened.problems == []
        after = loaded()
        assert after[1] == before[1]
        assert len(after[0]) == len(before[0])
        assert not any("filepond" in each.lower() or "tabulator" in each.lower() for each in after[1])
    finally:
        server.stop()
    assert server.faults == ""


def test_the_explorer_leads_there_and_back(explorer):
    page = explorer.page
    page.get_by_role("link", name="Fit a measurement").click()
    page.get_by_text("A curve in, E* out").wait_for()
    explorer.press("Sample: gel by AFM")
    number(explorer, "kPa")
    page.get_by_role("link", name="Model of this curve in the explorer").click()
    page.wait_for_function("window.explorer?.idle()")
    assert explorer.field("E*").input_value() == "19.7 kPa"
    # As deep as the curve from first contact on.
    assert explorer.field("d_max").input_value().startswith("138")
    assert explorer.chosen("Shape") == "Paraboloid"


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


def focused(page, name):
    """Wait until a field with a name has the focus, in whichever shadow it is."""
    page.wait_for_function(
        """(name) => {
          let each = document.activeElement
          while (each?.shadowRoot?.activeElement) each = each.shadowRoot.activeElement
          return (each?.ariaLabel ?? each?.labels?.[0]?.innerText ?? "").startsWith(name)
        }""",
        arg=name,
    )


def test_a_button_of_a_remark_leads_to_the_field_that_cures_it(measurement, tmp_path):
    """Silica with µm for nm, at 1280 × 720 without scrolling; then by keys alone."""
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    page.goto(f"{page.url}&tip=berkovich&medium=constant")
    measurement.wait(READY)
    path = tmp_path / "silica_um.csv"
    path.write_bytes((ROOT / "assets" / "silica.csv").read_bytes().replace(b"_nm", b"_um"))
    drop(measurement, path)
    button = page.get_by_role("button", name="Look at the unit of depth")
    button.wait_for()
    box = button.bounding_box()
    assert box["y"] + box["height"] < 720
    page.get_by_text("No E* to quote").wait_for()
    assert page.locator(".big output").count() == 0
    button.click()
    focused(page, "Unit of depth")
    page.get_by_label("Unit of depth").select_option("nm")
    assert number(measurement, "GPa").startswith("69.6")
    # What ± is stands below the number, on the first screen.
    box = page.get_by_text("an ideal tip and a rigid frame are assumed").bounding_box()
    assert box["y"] + box["height"] < 720


def test_an_afm_file_without_a_stiffness_is_asked_for_it_above_the_fold(measurement, tmp_path):
    pytest.importorskip("afmformats")
    pytest.importorskip("h5py")
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    page.goto(f"{page.url}&tip=paraboloid&radius=5e-6&medium=gel")
    measurement.wait(READY)
    heights().export_data(tmp_path / "gel_1.h5", fmt="hdf5")
    drop(measurement, tmp_path / "gel_1.h5")
    page.get_by_text("Give the spring constant k").wait_for()
    button = page.get_by_role("button", name="Give the spring constant of the cantilever")
    assert button.bounding_box()["y"] < 720
    button.click()
    focused(page, "k spring constant")
    page.keyboard.type("0.05")
    page.keyboard.press("Enter")
    assert number(measurement, "kPa").startswith("20")


def test_files_that_are_dropped_together_are_fitted_together_and_saved(measurement, tmp_path):
    page = measurement.page
    media = [mdr.Medium(k * 1e10, hardness=14e9) for k in range(3, 13)]
    files = [curve(tmp_path / f"run_{k}.csv", each) for k, each in enumerate(media, 1)]
    (tmp_path / "notes.txt").write_text("nothing")
    drop(measurement, *files, tmp_path / "notes.txt")
    page.get_by_text("11 files, curve 1 of 10: 400 samples").wait_for()
    page.get_by_text("Not read: notes.txt").wait_for()
    page.get_by_label("Tip", exact=True).select_option(label="Berkovich or Vickers (cone of 70.3°)")
    page.get_by_text("Give the sample", exact=True).wait_for()
    page.get_by_label("Sample", exact=True).select_option(
        label="Glass, metal or ceramic: constant hardness"
    )
    page.get_by_role("button", name="Fit all 10").click()
    page.get_by_text("10 of 10 curves fitted; E* = 75 ± 30 GPa, mean ± standard deviation of 10").wait_for()
    # Below the number, how far the curves are apart.
    ends = re.search(r"the set’s 10 curves: (\d+) to (\d+) GPa", page.locator(".of").first.inner_text())
    assert int(ends[1]) < 45 < 105 < int(ends[2])
    # The list is there when all is done.
    page.get_by_role("figure", name="All curves").wait_for()
    names = page.locator(".curves th").all_inner_texts()
    assert names == ["curve", *(f"run_{k}.csv" for k in range(1, 11))]
    for kind, write in (("CSV", pandas.read_csv), ("Excel", pandas.read_excel)):
        with page.expect_download() as saved:
            page.get_by_role("button", name=f"All as {kind}").click()
        assert "run_10.csv" in str(write(saved.value.path(), header=None, names=range(20)).to_dict())
    # The next one is another.
    page.wait_for_timeout(1000)
    drop(measurement, curve(tmp_path / "next.csv", mdr.Medium(8e10, hardness=14e9)))
    page.get_by_text("next.csv: 400 samples").wait_for()
    assert page.get_by_text("Not read").count() == 0


def test_a_long_job_is_cancelled_and_the_next_one_is_done(measurement, tmp_path):
    """A map of 60 curves takes many seconds."""
    page, count = measurement.page, 60
    page.goto(f"{page.url}&tip=berkovich&medium=constant")
    measurement.wait(READY)
    depth = 1e-6 * np.append(np.linspace(-0.05, 1, 240), np.linspace(1, 0.7, 160))
    force = mdr.indent(TIP, mdr.Medium(80e9, hardness=14e9), depth).force
    columns = {"Depth (nm)": np.tile(1e9 * depth, count), "Load (mN)": np.tile(1e3 * force, count)}
    text = table({"x (um)": np.repeat(np.arange(count), depth.size)} | columns)
    (tmp_path / "map.csv").write_text(text, encoding="utf-8")
    drop(measurement, tmp_path / "map.csv")
    page.get_by_role("button", name="Read", exact=True).click()
    number(measurement, "80")
    page.get_by_role("button", name=f"Fit all {count}").click()
    page.get_by_text(re.compile(r"Fitting curve [2-9] of 60")).wait_for()
    page.locator("button.bk-btn:visible", has_text="Cancel").click()
    page.get_by_text(re.compile(r"^\d+ of 60 curves fitted; E\* = 80")).wait_for()
    page.get_by_text("Fitting curve").wait_for(state="detached")
    measurement.press("Sample: gel by AFM")
    number(measurement, "kPa")


DRAWN = """(name) => Bokeh.documents[0].get_model_by_name('force plot').renderers
  .find((each) => each.name === name).glyph[name === 'model' ? 'line_color' : 'fill_color'].value"""


def colours(opened):
    """Colours in which measured samples and the model are drawn."""
    return [opened.page.evaluate(DRAWN, name).lower() for name in ("measured", "model")]


LIGHT, DARK = ([ROLES[role][k].lower() for role in ("measured", "elastic")] for k in (0, 1))


def test_the_figures_are_dark_on_a_first_visit_with_a_dark_system(server, browser):
    """No cookie tells the server."""
    with browser.new_context(color_scheme="dark") as context:
        opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
        opened.press("Sample: fused silica")
        number(opened, "69")
        assert colours(opened) == DARK
        assert opened.page.get_by_role("button", name="Dark", pressed=True).is_visible()
        assert opened.problems == []


def test_dark_is_the_theme_of_both_pages(server, browser):
    """One button as in the explorer: the page, its figures, and what a browser keeps for the next page."""
    with browser.new_context() as context:
        opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
        opened.press("Sample: fused silica")
        number(opened, "69")
        assert colours(opened) == LIGHT
        is_dark = "document.documentElement.classList.contains('dark')"
        for dark, drawn in ((True, DARK), (False, LIGHT), (True, DARK)):
            opened.press("Dark")
            opened.page.get_by_role("button", name="Dark", pressed=dark).wait_for()
            assert opened.page.evaluate(is_dark) is dark
            assert colours(opened) == drawn
            (cookie,) = (each["value"] for each in context.cookies() if each["name"] == "dark")
            assert cookie == str(int(dark))
        opened.goto(server.url)
        assert opened.page.evaluate(is_dark)
        assert opened.problems == []


def test_the_figure_is_saved_as_one_picture(measurement):
    """960 × 720 points of two pixels: samples over the model, the residuals, and a text at the bottom."""
    page = measurement.page
    measurement.press("Sample: fused silica")
    number(measurement, "69")
    page.locator(".of-residual canvas").first.wait_for()
    before = page.locator(".of-force").bounding_box()
    with page.expect_download() as download:
        measurement.press("Save figure")
    assert download.value.suggested_filename == "Fused silica, Berkovich tip_fit.png"
    image = np.asarray(Image.open(BytesIO(download.value.path().read_bytes())).convert("RGB"), int)
    assert image.shape == (1440, 1920, 3)

    def where(role):
        wanted = [int(ROLES[role][0][k : k + 2], 16) for k in (1, 3, 5)]
        return np.nonzero((np.abs(image - wanted).max(axis=2) < 8).any(axis=1))[0]

    model, measured = where("elastic"), where("measured")
    # A swatch in the legend, above the plot; the residuals have no model.
    assert 60 < model.min() < 100 < model.max() < 928
    assert measured.min() < 100
    assert 1000 < measured.max() < 1392
    text = np.abs(image[1396:] - image[0, 0]).max(axis=2) > 100
    assert np.count_nonzero(text.any(axis=0)) > 900
    # The plots have their size on the page again.
    height = "explorer.all().find((each) => each.matches('.of-force')).offsetHeight"
    measurement.wait(f"(before) => Math.abs({height} - before) < 2", before["height"])


def test_a_double_click_shows_the_whole_record(measurement):
    page = measurement.page
    measurement.press("Sample: gel by AFM")
    number(measurement, "kPa")
    page.locator(".of-force canvas").first.wait_for()
    start = "Bokeh.documents[0].get_model_by_name('force plot').x_range.start"
    # µm: the record has two of air, and 0.14 of contact.
    assert -0.1 < page.evaluate(start) < 0
    box = page.locator(".of-residual").bounding_box()
    page.mouse.dblclick(box["x"] + box["width"] / 2, box["y"] + box["height"] / 3)
    measurement.wait(f"{start} < -1.9")


def test_the_field_for_a_file_is_as_high_as_others_unless_a_file_is_over_it(measurement, tmp_path):
    page = measurement.page
    field, tip = page.locator(".filepond--root").first, page.get_by_label("Tip", exact=True)
    drawn = "explorer.all().find((each) => each.matches('.filepond--root')).offsetHeight"
    # The sheet of a component comes after it.
    measurement.wait(f"{drawn} < 40")

    def height():
        return field.bounding_box()["height"]

    usual = height()
    assert abs(usual - tip.bounding_box()["height"]) <= 4
    field.evaluate("(each) => { each.dataset.hopperState = 'drag-over' }")
    assert height() > 2 * usual
    field.evaluate("(each) => { delete each.dataset.hopperState }")
    drop(measurement, curve(tmp_path / "run.csv", mdr.Medium(80e9, hardness=14e9)))
    page.get_by_text("run.csv: 400 samples").wait_for()
    # The file is named below the field, once it has come.
    measurement.wait(f"(usual) => Math.abs({drawn} - usual) <= 1", usual)
    # A file that is too large is named there, with the reason.
    (tmp_path / "large.csv").write_bytes(bytes(51_000_000))
    drop(measurement, tmp_path / "large.csv")
    page.get_by_text("File is too large", exact=True).wait_for()
    measurement.wait(f"(usual) => {drawn} > 1.5 * usual", usual)


def test_a_wrong_number_has_its_error_below_the_field(measurement):
    page = measurement.page
    measurement.press("Sample: gel by AFM")
    number(measurement, "kPa")
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
    number(measurement, "13.9")
