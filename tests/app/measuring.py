"""The page for measurements in tests: what a person gives it, and what it shows."""

import re
from io import BytesIO
from math import inf

import numpy as np
import panel as pn
import pytest

import mdr_core as mdr
from app.common.process import SynchronousWorker
from app.measurement import query
from app.measurement.page import Measurement

from .conftest import ROOT
from .states import plain, table

DATA = ROOT / "tests" / "data"
TIP = mdr.Cone.from_half_angle(70.3)
GLASS = mdr.Medium(80e9, hardness=14e9)
#: Depths (m) from before first contact to a third back.
DEPTH = 1e-6 * np.append(np.linspace(-0.05, 1, 240), np.linspace(1, 0.7, 160))


def page_of(link="", worker=None):
    return Measurement(link, worker or SynchronousWorker())


def take_file(page, name, data):
    """Drop a file, long after the last one."""
    page.do(page.take_file, name, data, inf)


def take_tip(page, name, data):
    page.do(page.form.take_tip, name, data, inf)


def take_sample(page, name):
    page.do(page.take_example, name)


def choose(page, **values):
    """Choose tip and kind of sample, and type numbers (SI); None empties a field."""
    for name, value in values.items():
        if name in ("tip", "medium"):
            getattr(page.form, name).value = value
        else:
            page.form.numbers[name].si = value


def choose_samples(page, *ends):
    """Let the handles of the range go, as the browser tells it."""
    page.results.ends._process_events({"value_throttled": ends})


def opened(data, medium="constant", tip="berkovich", name="run.csv", **numbers):
    """A page with a file, a tip and a kind of sample."""
    page = page_of()
    take_file(page, name, data)
    choose(page, **numbers, tip=tip, medium=medium)
    return page


def measured(name, medium, tip="berkovich", **numbers):
    """A page with a measured curve of the tests."""
    return opened((DATA / f"{name}.csv").read_bytes(), medium, tip, f"{name}.csv", **numbers)


def curve_file(medium=GLASS, tip=TIP, depth=DEPTH, offset=0.0, timed=False, noise=0.0):
    """A made curve as a file; 10⁻⁶ nm and mN are its last digits."""
    force = mdr.indent(tip, medium, depth).force
    force = force + noise * force.max() * np.random.default_rng(1).standard_normal(depth.size)
    columns = {"t (s)": 0.1 * np.arange(depth.size)} if timed else {}
    return table(columns | {"h (nm)": 1e9 * (depth + offset), "F (mN)": 1e3 * force}).encode()


def workbook():
    """A map as an Excel file: two curves, a dead one between them, and a sheet of results."""
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    file = BytesIO()
    with pandas.ExcelWriter(file) as writer:
        for number, E in enumerate((2e4, None, 3e4), 1):
            d = 1e-6 * np.append(np.linspace(-0.5, 1, 200), np.linspace(1, 0, 100))
            F = mdr.indent(mdr.Paraboloid(1e-5), mdr.Medium(E), d).force if E else np.zeros(d.size)
            frame = pandas.DataFrame({"depth (nm)": 1e9 * d, "force (nN)": 1e9 * F})
            frame.to_excel(writer, sheet_name=f"Test {number}", index=False)
        pandas.DataFrame({"E": [1, 2]}).to_excel(writer, sheet_name="Results")
    return file.getvalue()


def curve_at(path, medium=GLASS):
    """A file with a made curve."""
    path.write_bytes(curve_file(medium))
    return path


def silica_in(unit):
    """The curve of fused silica with another unit of depth."""
    return mdr.example("silica.csv").read_bytes().replace(b"_nm", f"_{unit}".encode())


def afm_curve():
    """A made gel of 20 kPa under a sphere of 5 µm: heights of an AFM without its k = 0.05 N/m."""
    afmformats = pytest.importorskip("afmformats")
    d = 1e-6 * np.append(np.linspace(-1.0, 0.6, 300), np.linspace(0.6, -1.0, 300)[1:])
    force = mdr.indent(mdr.Paraboloid(5e-6), mdr.Medium(20e3), d).force
    data = {"force": force, "height (measured)": -d - force / 0.05}
    data["segment"] = np.repeat([0, 1], [300, 299]).astype(np.uint8)
    known = {"enum": 0, "path": "made", "imaging mode": "force-distance"}
    return afmformats.mod_force_distance.AFMForceDistance(data, known)


# What is shown.


def text(*parts):
    """What is read in parts of the page that are seen."""
    panes = (each for part in parts for each in part.select(pn.pane.HTML) if part.visible)
    return " ".join(plain(each.object) for each in panes if each.visible)


def buttons(*parts):
    """Buttons in parts of the page, by their labels."""
    return {each.label: each for part in parts for each in part.select(pn.widgets.Button)}


def press(button):
    button.clicks += 1


def headline(page):
    return plain(page.results.headline.object)


def said(page):
    """All that is said on the right."""
    found = page.results
    return text(found.above, found.headline, found.below, found.errors, found.remarks, found.why)


def saved(page, kind):
    """The fit as a file, "json" or "csv"."""
    return page.results.files[kind].callback().read()


def link_of(page):
    return query.read(page.link().query())


# In a browser.


def drop(opened, *files):
    opened.page.locator('.filepond--browser, input[type="file"]').first.set_input_files(files)


def shown_number(opened, text):
    """Wait for the number that is large, and return it."""
    shown = opened.page.locator(".big output", has_text=re.compile(text))
    shown.wait_for()
    return shown.inner_text()


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
