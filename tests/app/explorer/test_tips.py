"""Measured tips: reading, errors, and the scene with a tip."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app.common.tip import read_tip
from app.common.upload import MAX_SAMPLES, Uploaded
from app.explorer import changes
from app.explorer.drives import follow
from app.explorer.page import Page
from app.explorer.state import medium, preset_state, profile

from ...approx import approx
from ..states import part, table


def test_a_measured_tip_is_taken_as_it_is_or_made_convex():
    few, note = read_tip(table({"r (nm)": [0, 1, 2, 4], "z (nm)": [0, 0.1, 0.3, 1]}))
    assert note == "4 samples, as in the file"
    assert few[1][-1] == approx(1e-9)
    state = changes.take_tip(preset_state(), few, note)
    assert state.max_depth < profile(state).known_depth
    assert follow(state).turning_point.force > 0
    rng, r = np.random.default_rng(3), np.linspace(0, 300, 20_000)
    z = r**2 / 2000 + 0.3 * rng.standard_normal(r.size)
    radii, heights = read_tip(table({"r (nm)": r, "z (nm)": z}, "\t"))[0]
    assert len(radii) <= MAX_SAMPLES
    assert heights[-1] == approx(45e-9, rel=0.01)
    # Few rows that noise has made concave.
    r = np.linspace(-50, 50, 41)
    z = 0.2 * np.abs(r) + 0.5 * rng.standard_normal(41)
    assert "41 rows" in read_tip(table({"r (nm)": r, "z (nm)": z}))[1]
    with pytest.raises(ValueError, match="increase"):
        read_tip(table({"r (nm)": r, "z (nm)": -np.abs(r)}))


def test_a_noisy_tip_is_as_hard_as_the_one_that_is_nearest_to_it():
    """As `Sampled.fit` has it of the same rows about their axis."""
    r = np.linspace(-300, 300, 400)
    z = r**2 / 2000 + 0.3 * np.random.default_rng(2).standard_normal(r.size)
    samples, note = read_tip(table({"r (nm)": r + 20, "z (nm)": z}, "; ", comma=True))
    assert "290 pm" in note
    tips = mdr.Sampled(*samples), mdr.Sampled.fit(r * 1e-9, z * 1e-9)
    depths = [2e-9, 5e-9, 10e-9]
    read, fitted = (mdr.indent(tip, medium(preset_state()), depths).force for tip in tips)
    # The axis is found to about noise/(slope √rows), 0.1 nm.
    np.testing.assert_allclose(read, fitted, rtol=0.01)


def test_a_tip_of_samples_on_both_sides_says_nothing_of_a_deviation_by_rounding():
    """Nine samples of a convex profile, five of them of one side."""
    r = np.linspace(-60, 60, 9)
    text = table({"r (nm)": r, "z (nm)": r**2 / 100}, "; ")
    (radii, _), note = read_tip(text)
    assert len(radii) == 5
    assert " pm" not in note
    # Samples out of order are taken as they are.
    mixed = np.random.default_rng(0).permutation(r[4:])
    assert len(read_tip(table({"r (nm)": mixed, "z (nm)": mixed**2 / 100}))[0][0]) == 5
    # A deviation that a file has is told: of 40 rows, with a wave of 0.1 nm.
    many = np.linspace(0, 60, 200)
    waved = table(
        {"r (nm)": many, "z (nm)": many**2 / 30 + 0.01 * np.random.default_rng(1).normal(size=200)}
    )
    assert " pm" in read_tip(waved)[1]


def test_a_tip_whose_header_spells_its_unit():
    r = np.linspace(0, 6, 7)
    for unit in ("metres", "Meters", "in m", "metre"):
        (radii, _), _ = read_tip(table({f"r ({unit})": r, f"z ({unit})": r**2 / 100}))
        assert radii[-1] == 6, unit


def test_a_refused_tip_is_named_with_its_misfit():
    page, r = Page(), np.linspace(0, 400, 200)
    wavy = table({"r (nm)": r, "z (nm)": r**2 / 2000 + 50 * np.sin(r / 30)})
    before, shapes = page.choice("preset").look["value"], part(page, "shape")
    shapes.act(shapes.look["options"][-1][0])

    def given(text):
        file = {"name": "my  tip.csv", "size": len(text), "data": text.encode()}
        part(page, "CSV file of a measured tip: r, z").act(file)

    for text, why in (
        (wavy, r"(\d\d) nm \(rms"), ("depth\n", "no samples"), ("r (nm), z (nm)\n0, 0\n1, x\n", "expected"),
        ("r, z\n0, 0\n1, 1\n", "header"),
    ):  # fmt: skip
        given(text)
        said = part(page, "CSV file of a measured tip: r, z").look["refused"]
        found = re.match(rf"my tip\.csv(?:, line \d)?: .*{why}", said)
        assert found, said
        # No word of the library.
        assert "unit=" not in said
        if text is wavy:
            # An rms of at most 50/√2 nm.
            assert 10 < float(found[1]) < 36
    assert page.state.shape == "cone"
    # Over a measured tip stands no preset's name, until it is chosen again.
    given(table({"r (nm)": r, "z (nm)": r**2 / 2000}))
    assert (page.state.shape, page.choice("preset").look["value"] == before) == ("sampled", False)
    page.choose("preset", page.state.preset)
    assert (page.state.shape, page.choice("preset").look["value"]) == ("cone", before)


def test_a_tip_limits_the_depth_of_every_drive_that_has_one():
    state = changes.choose(preset_state(), "drive", "path")
    r = np.linspace(0, 5e-9, 20)
    taken = changes.take_tip(state, (r, r**2 / 2e-9), "a tip")
    assert taken.max_depth < 0.51 * r[-1] ** 2 / 1e-9
    assert follow(taken).turning_point.depth == approx(taken.max_depth)


def test_an_error_of_a_tip_stands_beside_its_field_until_a_good_file(explorer, tmp_path):
    """No notice covers a plot, and text of others is never markup."""
    page, path, r = explorer.page, tmp_path / "tip.csv", np.linspace(0, 60, 40)
    page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
    tip, said = page.get_by_label("CSV file of a measured tip: r, z"), page.locator(".file .said:visible")
    markup = {
        "name": "<img src=x>",
        "mimeType": "",
        "buffer": b"<img src=x> (nm), z (nm)\n0, 0\n1, <img src=x>\n",
    }
    tip.set_input_files(markup)
    said.filter(has_text="<img src=x>").first.wait_for()
    assert page.locator("img[src=x]").count() == 0
    path.write_text(table({"r": r, "z": r**2 / 100}), encoding="utf-8")
    tip.set_input_files(path)
    # It is read in a process of its own.
    said.filter(has_text=re.compile("^tip.csv: ")).wait_for()
    assert page.locator(".notyf__toast").count() == 0
    path.write_text(table({"r (metres)": 1e-3 * r, "z (metres)": 1e-5 * r**2}), encoding="utf-8")
    tip.set_input_files(path)
    said.wait_for(state="detached")
    chosen = page.get_by_label("Shape", exact=True).locator("option:checked")
    chosen.filter(has_text=re.compile("^Measured tip$")).wait_for(state="attached")


def test_a_file_that_is_larger_than_the_browser_should_send_is_refused():
    with pytest.raises(ValueError, match=r"run\.csv .*5 MB"):
        Uploaded("run.csv", 5_000_001, b"1, 2\n" * 10**6 + b"3").read()
