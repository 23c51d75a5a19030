"""Several curves: sets of files, maps, all fits at once, and their table."""

import re
import zipfile
from io import BytesIO
from time import monotonic

import numpy as np
import pandas
import pytest

import mdr_core as mdr
from app.common import folders
from app.common.process import Replaced, SynchronousWorker

from ...approx import approx
from ..conftest import READY
from ..measuring import (
    DEPTH,
    GLASS,
    TIP,
    choose,
    curve_at,
    curve_file,
    drop,
    headline,
    opened,
    page_of,
    plain,
    press,
    shown_number,
    silica_in,
    take_file,
    text,
    workbook,
)
from ..states import table


def take_set(page, files):
    """Drop files together; the action of the last one reads them all."""
    now = monotonic()
    for name, data in files.items():
        page.do(page.take_file, name, data, now)


def test_files_that_come_together_are_one_set_and_the_next_drop_is_another():
    page = page_of()
    choose(page, tip="berkovich", medium="constant")
    files = {f"lab/run {k}.csv": curve_file(mdr.Medium(k * 40e9, hardness=14e9)) for k in (1, 2, 10)}
    take_set(page, files | {"lab/notes.txt": b"nothing"})
    assert (page.file, page.count) == ("4 files", 3)
    assert "notes.txt" in text(page.form.about)
    # In the order of their names, 2 before 10.
    page.do(page.fit_all)
    assert [row.name for row in page.rows] == ["lab run 1.csv", "lab run 2.csv", "lab run 10.csv"]
    assert [row.E / GLASS.E_star for row in page.rows] == approx([0.5, 1, 5], rel=1e-3)
    take_file(page, "next.csv", curve_file())
    assert (page.file, page.count, page.rows) == ("next.csv", 1, [])
    assert "notes.txt" not in text(page.form.about)
    # A file that is dropped after one that was refused is another one.
    take_file(page, "wrong.csv", b"nothing")
    take_file(page, "right.csv", curve_file())
    assert page.file == "right.csv"


def test_a_set_asks_once_and_a_zip_is_one_too():
    force = mdr.indent(TIP, GLASS, DEPTH).force
    rows = "\n".join(f"{1e9 * h:.6f};{1e3 * f:.9f}" for h, f in zip(DEPTH, force, strict=True))
    files = {f"{k}.csv": f"Tiefe (nm);Kraft (mN)\n{rows}".encode() for k in range(3)}
    archive = BytesIO()
    with zipfile.ZipFile(archive, "w") as file:
        for name, data in files.items():
            file.writestr(name, data)
    for dropped in (
        lambda page: take_set(page, files),
        lambda page: take_file(page, "a.zip", archive.getvalue()),
    ):
        page = page_of()
        choose(page, tip="berkovich", medium="constant")
        dropped(page)
        assert page.question is not None
        assert not page.form.reader.collapsed
        press(page.form.columns.confirm)
        assert page.form.reader.collapsed
        assert page.count == 3
        press(page.results.all)
        assert [row.E for row in page.rows] == approx([GLASS.E_star] * 3, rel=1e-3)


@pytest.mark.parametrize("tip_modulus", [60e9, 20e9])
def test_a_set_is_fitted_and_saved_under_a_tip_that_is_softer_than_its_samples(tip_modulus):
    """Softer than some of them, or than all."""
    page = page_of()
    choose(page, tip="berkovich", medium="constant")
    take_set(page, {f"{k}.csv": curve_file(mdr.Medium(k * 20e9, hardness=14e9)) for k in (2, 4, 5)})
    choose(page, poisson=0.2, tip_modulus=tip_modulus)
    press(page.results.all)
    assert [row.E for row in page.rows] == approx([40e9, 80e9, 100e9], rel=1e-3)
    assert "3 of 3 curves fitted" in page.results.summary.object
    csv_file, _ = (each.callback() for each in page.results.curves_files)
    assert "softer than the contact of 2 of 3" in csv_file.read() or tip_modulus < 40e9


def test_a_set_has_bounds(monkeypatch):
    monkeypatch.setattr(folders, "SET_FILES", 2)
    page = page_of()
    take_set(page, {f"{k}.csv": curve_file() for k in range(3)})
    # Those before the bound are not read without a word.
    assert "At most 2 files" in text(page.form.errors)
    assert page.curve is None
    take_file(page, "next.csv", curve_file())
    assert page.curve is not None


class Watched(SynchronousWorker):
    """Jobs that are done at once; after each part of an answer `then` is called, which may stop the job."""

    stopped = False

    def then(self):
        """Look at the page."""

    async def run(self, job, *arguments, part=print, **options):
        def watched(answer):
            part(answer)
            self.then()
            if self.stopped:
                raise Replaced

        self.stopped = False
        return await super().run(job, *arguments, part=watched, **options)

    def stop(self):
        self.stopped = True


def test_all_curves_of_a_file_are_fitted_and_a_dead_one_says_why():
    page = page_of(worker=Watched())
    take_file(page, "map.xlsx", workbook())
    choose(page, tip="paraboloid", radius=1e-5)
    choose(page, medium="gel")
    assert page.count == 3
    assert "curve 1 of 3" in text(page.form.about)
    assert page.found.fit.medium.E_star == approx(2e4, rel=1e-4)
    # The dead curve alone has a reason, and the next one is a click away.
    page.results.number.value = 2
    assert page.found is None
    assert len(text(page.results.errors)) > 20
    page.results.number.value = 3
    assert page.found.fit.medium.E_star == approx(3e4, rel=1e-4)
    seen = []

    def look():
        assert page.results.all.disabled
        seen.append((headline(page), page.results.progress.value, page.results.cancel.visible))
        press(page.results.cancel)

    page.worker.then = look
    press(page.results.all)
    assert seen == [("Fitting curve 2 of 3 …", 1, True)]
    assert not page.results.cancel.visible
    assert text(page.results.errors) == ""
    assert "1 of 3 curves fitted" in page.results.summary.object
    page.worker.then = lambda: None
    press(page.results.all)
    values = [row.E for row in page.rows]
    assert values[0] == approx(2e4, rel=1e-4)
    assert values[1] is None
    assert values[2] == approx(3e4, rel=1e-4)
    assert "E* = 25.0" in page.results.summary.object
    assert "1 without a number" in page.results.summary.object
    rows = re.findall(r"<th>(\d)</th><td>(.*?)</td><td>(.*?)</td><td>(.*?)</td>", page.results.list.object)
    # Those without a number stand first.
    assert [row[0] for row in rows] == ["2", "1", "3"]
    assert rows[0][1] == "–"
    assert len(plain(rows[0][3])) > 20
    csv_file, excel_file = (each.callback() for each in page.results.curves_files)
    table = pandas.read_csv(csv_file, comment="#")
    assert table["E* (Pa)"].tolist() == approx([*values[:1], np.nan, *values[2:]], rel=1e-12, nan_ok=True)
    cells = pandas.read_excel(excel_file, header=None).to_numpy().ravel().tolist()
    # A workbook keeps 15 digits.
    assert any(isinstance(each, float) and each == approx(values[2], rel=1e-14) for each in cells)
    drawn = page.results.all_curves.curves.data
    assert max(map(np.max, drawn["y"])) > 0
    # They are of this tip: of another one all are to be fitted again.
    assert page.results.curves_files.visible
    choose(page, radius=2e-5)
    assert not page.results.list.visible
    assert not page.results.curves_files.visible
    assert page.results.summary.object == ""
    # So are those of columns that the file is no longer read by.
    press(page.results.all)
    assert page.results.list.visible
    page.do(page.read_with, {"columns": {"depth": (0, "m"), "force": (7, "N")}})
    assert page.curve is None
    assert not page.results.list.visible
    assert page.results.summary.object == ""


def test_the_curves_of_a_map_are_judged_as_one_is():
    page = opened(silica_in("um"))
    page.do(page.fit_all)
    (row,) = page.rows
    value, error, reason = row.E, row.E_error, row.reason
    assert (value, error) == (None, None)
    assert "below 1 MPa" in reason
    assert "below 1 MPa" in page.results.curves_files[0].callback().read()


def test_files_that_are_dropped_together_are_fitted_together_and_saved(measurement, tmp_path):
    page = measurement.page
    media = [mdr.Medium(k * 1e10, hardness=14e9) for k in range(3, 13)]
    files = [curve_at(tmp_path / f"run_{k}.csv", each) for k, each in enumerate(media, 1)]
    (tmp_path / "notes.txt").write_text("nothing")
    drop(measurement, *files, tmp_path / "notes.txt")
    page.get_by_text("11 files, curve 1 of 10: 400 samples").wait_for()
    page.evaluate("window.dropped = performance.now()")
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
    # The next one is another; files that come within a second of each other are one set.
    measurement.wait("performance.now() - dropped > 1000")
    drop(measurement, curve_at(tmp_path / "next.csv", mdr.Medium(8e10, hardness=14e9)))
    page.get_by_text("next.csv: 400 samples").wait_for()
    assert page.get_by_text("Not read").count() == 0


def test_a_long_job_is_cancelled_and_the_next_one_is_done(measurement, tmp_path):
    """A map of 30 curves takes some seconds."""
    page, count = measurement.page, 30
    page.goto(f"{page.url}&tip=berkovich&medium=constant")
    measurement.wait(READY)
    depth = 1e-6 * np.append(np.linspace(-0.05, 1, 240), np.linspace(1, 0.7, 160))
    force = mdr.indent(TIP, mdr.Medium(80e9, hardness=14e9), depth).force
    columns = {"Depth (nm)": np.tile(1e9 * depth, count), "Load (mN)": np.tile(1e3 * force, count)}
    text = table({"x (um)": np.repeat(np.arange(count), depth.size)} | columns)
    (tmp_path / "map.csv").write_text(text, encoding="utf-8")
    drop(measurement, tmp_path / "map.csv")
    page.get_by_role("button", name="Read", exact=True).click()
    shown_number(measurement, "80")
    page.get_by_role("button", name=f"Fit all {count}").click()
    page.get_by_text(re.compile(r"Fitting curve [2-9] of 30")).wait_for()
    page.locator("button.bk-btn:visible", has_text="Cancel").click()
    page.get_by_text(re.compile(r"^\d+ of 30 curves fitted; E\* = 80")).wait_for()
    page.get_by_text("Fitting curve").wait_for(state="detached")
    measurement.press("Sample: gel by AFM")
    shown_number(measurement, "kPa")
