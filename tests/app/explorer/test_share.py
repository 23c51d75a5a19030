"""Shared scenes: tables, Python, names of files, and buttons."""

import re

import numpy as np
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.explorer import changes
from app.explorer.drives import follow
from app.explorer.extras import share
from app.explorer.link import file_name
from app.explorer.page import Page
from app.explorer.state import medium, preset_state, profile
from mdr_core.show.csv_text import csv_text

from ...approx import approx
from ..conftest import DROP, GOLD
from ..states import FORMULAS, part, side, state_with, table, view_of


def test_the_csv_has_the_scene_and_its_states():
    state = preset_state()
    lines = share.csv(view_of(state)).splitlines()
    assert any("poisson=0.42" in line for line in lines)
    heads, *rows = (line.split(",") for line in lines if line[0] != "#")
    assert heads[:2] == ["normal force F (N)", "indentation depth d (m)"]
    force, depth = np.array(rows, float)[:, :2].T
    expected = mdr.indent(profile(state), medium(state), depth)
    np.testing.assert_allclose(force, expected.force, rtol=1e-9, atol=1e-20)
    rows = [line.split(",") for line in share.pressure_csv(view_of(state)).splitlines() if line[0] != "#"]
    r, sigma, load, reduced = np.array(rows[1:], float).T
    now = follow(state).state
    np.testing.assert_allclose(-sigma, now.pressure(r), rtol=1e-12)
    # Both halves of the row of springs, by the trapezoidal rule over 320 of them; a cone has g = π s r/2.
    assert 2 * trapezoid(load, r) == approx(float(now.force), rel=0.01)
    np.testing.assert_allclose(reduced, np.pi / 2 * state.cone_slope * r, rtol=1e-12)


def test_numbers_link_and_python_follow_a_change_and_its_undoing():
    page = Page()
    shared = side(page, "share")

    def seen():
        field = part(page, "max_depth").look["text"]
        return field, str(page.messages.words), shared.link.value, shared.python.value

    opening = seen()
    page.apply(lambda state: changes.set_value(state, "max_depth", 5e-9))
    field, words, address, python = seen()
    assert field == "5 nm"
    assert '<output data-name="depth">5.000 nm</output>' in words
    assert "max_depth=5e-09" in address
    values = {}
    exec(python, values)
    assert values["scene"] == page.view.course.scene
    page.undo()
    assert seen() == opening


def test_what_the_page_writes_is_read_back(tmp_path):
    """States of a scene, below a header with commas and quotation marks."""
    view = view_of(preset_state())
    path = tmp_path / "curves.csv"
    path.write_text(share.csv(view), encoding="utf-8")
    curve = mdr.read_curve(path)
    assert np.array_equal(curve.depth, view.course.states.depth)
    assert np.array_equal(curve.force, view.course.states.force)
    # With a name as that of a file in its header.
    for name in FORMULAS:
        header = [f"made of {name}", "d (m), F (N)"]
        rows = zip(curve.depth.tolist(), curve.force.tolist(), strict=True)
        path.write_text(csv_text(header, [["depth (m)", "force (N)"], *rows]), encoding="utf-8")
        assert np.array_equal(mdr.read_curve(path).force, curve.force)


def test_files_of_two_scenes_have_two_names():
    opening = preset_state()
    states = [opening, opening.replace(max_depth=5e-9), state_with(DROP), state_with(GOLD, "impact")]
    names = [file_name(state, "curves.csv") for state in states]
    assert names[0] == "berkovich-gold_curves.csv"
    assert names[1] == "berkovich-gold_d_max=5nm_curves.csv"
    assert len({*names}) == len(names)
    assert all(re.fullmatch(r"[\w.=+-]+", name) for name in names)
    page = Page()
    shown = side(page, "share")
    page.apply(lambda state: state.replace(max_depth=5e-9))
    assert names[1] in [each.filename for each in shown.view.select(share.pn.widgets.FileDownload)]


def test_what_is_shared_comes_back(explorer, tmp_path):
    """Link and Python; a measured tip."""
    page = explorer.page
    explorer.press("Share")
    code = page.get_by_label("This scene in Python")
    page.wait_for_function("(on) => on.value.includes('scene.solve()')", arg=code.element_handle())
    assert page.get_by_label("Link to this page").input_value() == page.url.split("?")[0]
    explorer.press("Share")
    page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
    path, r = tmp_path / "tip.csv", np.linspace(0, 60, 40)
    path.write_text(table({"r (nm)": r, "z (nm)": r**2 / 100}, "; ", comma=True))
    explorer.change(page.get_by_label("CSV file of a measured tip: r, z").set_input_files, path)
    assert explorer.chosen("Shape") == "Measured tip"
    assert page.get_by_text("40 samples, as in the file").count() == 1
