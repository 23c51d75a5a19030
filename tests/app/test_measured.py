"""A measured curve: read as instruments write it, laid over the model, and fitted."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app import changes
from app.drives import scene_of
from app.extras import fit as fitting
from app.extras.fit.drawn import RESIDUAL_FORCE
from app.extras.fit.measured import FITTED, agrees, offered, read_curve
from app.page import Page
from app.plots import PLOTS
from app.quantities import ASSETS
from app.state import PRESETS, medium, preset_state, profile
from app.tip import MAX_BYTES, Uploaded

from .states import example_curve, fitted, part, side, table, view_of
from .test_page import unit as unit_of


def residual_of(view):
    return view.computed["fit"].residual(view.course.scene)


def test_long_files_are_thinned_and_refused_in_words_of_the_page():
    """What the core reads and refuses is in its own tests."""
    depth = np.linspace(0, 10, 5000)
    curve = read_curve(table({"h (µm)": depth, "F (µN)": depth**2}).encode("cp1252"), "a/run  7.csv")
    assert curve.note == "5000 samples, one in 3 of them taken"
    assert curve.name == "a/run 7.csv"
    assert curve.data[0][-1] == pytest.approx(10e-6, rel=1e-3)
    assert len(curve.data[0]) <= 2000
    with pytest.raises(ValueError, match=r"^\.\./run\.csv has one column of numbers"):
        read_curve(b"h (nm)\n1\n2\n", "../run.csv")
    # A browser that sends more than it should.
    with pytest.raises(ValueError, match=r"run\.csv has 5 MB, more than 5 MB"):
        Uploaded("run.csv", 5_000_001, b"1, 2\n" * 10**6 + b"3").read()
    flat = read_curve(table({"h (nm)": range(6), "F (nN)": [0] * 6}).encode(), "flat")
    with pytest.raises(ValueError, match=r"largest force = 0 above the baseline: no contact"):
        fitting.fit(fitting.take(preset_state(), flat))


def test_a_refused_tip_is_named_with_its_misfit():
    page, notices = Page(), []
    page.notify = notices.append
    r = np.linspace(0, 400, 200)
    wavy = table({"r (nm)": r, "z (nm)": r**2 / 2000 + 50 * np.sin(r / 30)})
    for text, why in (
        (wavy, r"the nearest convex profile misses the samples by (\d\d) nm \(rms, most at r = \d+ nm\), "),
        ("depth\n", "no samples; expected rows of numbers"),
        ("r (nm), z (nm)\n0, 0\n1, x\n", "expected two numbers r, z, found"),
        ("r, z\n0, 0\n1, 1\n", "the header must name the units of r and z"),
    ):
        file = {"name": "my  tip.csv", "size": len(text), "data": text.encode()}
        part(page, "CSV file of a measured tip: r, z").act(file)
        found = re.match(rf"my tip\.csv(?:, line \d)?: {why}", notices[-1])
        assert found, notices[-1]
        if text is wavy:
            # An rms of at most 50/√2 nm.
            assert 10 < float(found[1]) < 36
    assert page.state.shape == "cone"


def test_the_manual_names_the_limits_of_files_and_messages():
    text = (ASSETS / "docs" / "explorer.md").read_text(encoding="utf-8")
    files, messages = re.search(r"Files are limited to (\d+) MB, messages to (\d+) MB", text).groups()
    assert int(files) * 10**6 == MAX_BYTES
    assert int(messages) * 10**6 == int(re.search(r"--websocket-max-message-size (\d+)", text)[1])


def test_a_new_file_starts_with_the_default_holds():
    """The example holds first contact at 0; a later curve begins elsewhere, 10 % of its depth into it."""
    default, page = preset_state()["fit.fixed"], Page()
    assert "contact_point" not in default
    for curve in (example_curve(), None):
        page.apply(fitting.silica)
        assert "contact_point" in page.state["fit.fixed"]
        page.apply(lambda state, curve=curve: fitting.take(state, curve))
        assert page.state["fit.fixed"] == default
    page.apply(fitting.silica)
    page.apply(lambda state: fitting.take(state, example_curve()))
    assert "need first contact" in side(page, "fit").unloading.object
    # The example curve is made under the tip of the opening.
    page.apply(lambda state: state.replace(shape="cone", cone_slope=preset_state().cone_slope))
    page.apply(fitting.fit)
    # Ten standard errors of 0.4 % noise in 400 samples.
    assert page.state.E_star == pytest.approx(1.3 * medium(preset_state()).E_star, rel=1e-2)


def test_one_result_of_oliver_and_pharr_stands_beside_a_curve():
    """That of the fit where it has one; it has none where the model does not fit, as for the example."""
    for change in (fitting.silica, lambda state: fitting.take(state, example_curve())):
        page = Page()
        page.apply(change)
        page.apply(fitting.fit)
        panel = side(page, "fit")
        texts = [panel.said.object, panel.unloading.object]
        assert sum(text.count("Oliver and Pharr") for text in texts) == 1


def test_the_measured_example_lies_over_its_tip_with_the_numbers_of_oliver_and_pharr():
    """E* by the unloading beside the fit, 69.6 GPa: its own numbers are tested in the core."""
    page = Page()
    page.apply(fitting.silica)
    state = page.state
    assert profile(state) == mdr.Cone.from_half_angle(70.3)
    assert "69.6" in side(page, "fit").unloading.object
    state = fitting.fit(state)
    # The core has 82.7 GPa with the contact point free; held at 0 it moves E* by a few per cent.
    assert state.E_star == pytest.approx(82.7e9, rel=0.03)
    # Loading alone has no unloading.
    depth = np.arange(9.0)
    curve = read_curve(table({"h (nm)": depth, "F (µN)": depth**2}).encode(), "run.csv")
    assert fitting.unloading(fitting.take(preset_state(), curve)) == ""


def test_columns_and_units_are_corrected():
    depth, force = [-1.0, 0.0, 2.0, 4.0, 3.0], [0.0, 0.0, 1.5, 6.0, 2.0]
    curve = read_curve(table({"h (nm)": depth, "F (mN)": force, "more": force}).encode(), "run.csv")
    np.testing.assert_allclose(curve.corrected("depth", "µm").data[0], 1e3 * curve.data[0])
    np.testing.assert_allclose(curve.corrected("depth", "−nm").data[0], -curve.data[0])
    swapped = {"depth": (1, "nm"), "force": (0, "mN"), "time": None}
    assert curve.corrected("depth", 1).curve.columns == swapped
    timed = table({"h (nm)": depth, "F (mN)": force, "more": range(5)}).encode()
    assert read_curve(timed, "run.csv").corrected("time", 2).curve.columns["time"] == (2, "s")
    with pytest.raises(ValueError, match="that is the column of force"):
        curve.corrected("time", 1)


def test_a_drift_and_the_give_of_a_frame_are_subtracted_before_a_fit():
    """E* of a curve with both is that of the curve without; without them the fit is of other numbers."""
    state = preset_state()
    d = np.append(np.linspace(-0.5e-9, 9e-9, 200), np.linspace(9e-9, 7e-9, 100))
    force, time = mdr.indent(profile(state), medium(state), d).force, 0.1 * np.arange(300)
    drift, frame = 0.02e-9, 1e-9 / force.max()
    z = d + drift * time + frame * force
    text = table({"t (s)": time, "h (pm)": 1e12 * z, "F (pN)": 1e12 * force}).encode()
    state = fitting.take(state, read_curve(text, "run.csv"))
    state = fitting.fit(state.replace(**{"fit.drift": drift, "fit.frame": frame}))
    # Six decimals of pN are 10⁻¹³ of the force.
    assert state.E_star == pytest.approx(medium(preset_state()).E_star, rel=1e-6)
    assert agrees(state)
    np.testing.assert_allclose(view_of(state).computed["fit"].depth, d, atol=1e-6 * d.max())
    assert not agrees(state.replace(**{"fit.frame": 0.0}))
    # Another curve has neither.
    state = fitting.take(state, example_curve())
    assert (state["fit.drift"], state["fit.frame"]) == (0.0, 0.0)
    # Without times there is no drift to type.
    page = Page()
    page.apply(lambda _: state)
    side(page, "fit")
    assert part(page, "fit.frame").kind == "number"
    with pytest.raises(AssertionError, match=r"no fit\.drift"):
        part(page, "fit.drift")


def test_a_table_without_a_header_asks_for_its_columns_and_units():
    """Nothing is taken until depth and force have both; then as if the header named them."""
    page, depth = Page(), np.array([0.0, 2.0, 4.0, 3.0])
    panel = side(page, "fit")
    rows = "\n".join(f"{t},{f},{h}" for t, f, h in zip(range(4), depth**2, depth, strict=True))
    panel._read(Uploaded("bare.csv", len(rows), rows.encode()))
    assert page.state["fit.curve"] is None
    assert (
        "bare.csv does not name its columns of depth and force, and their units" in panel.not_taken.object
    )
    assert panel._columns.visible
    assert list(panel.columns["depth"].options)[:2] == ["1: 0, 1, 2 …", "2: 0, 4, 16 …"]
    panel.columns["depth"].value = 2
    panel.columns["force"].value = 1
    panel.units["depth"].value = "nm"
    assert page.state["fit.curve"] is None
    panel.units["force"].value = "µN"
    curve = page.state["fit.curve"].curve
    np.testing.assert_allclose(curve.depth, 1e-9 * depth)
    np.testing.assert_allclose(curve.force, 1e-6 * depth**2)
    assert (curve.time, panel.not_taken.object) == (None, "")
    panel.columns["time"].value = 0
    assert page.state["fit.curve"].curve.time.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert panel.units["time"].value == "s"


def test_a_fit_moves_the_page_to_the_medium_and_is_undone():
    page = Page()
    before = medium(page.state)
    page.apply(lambda state: fitting.take(state, example_curve()))
    page.apply(fitting.fit)
    state = page.state
    # Ten standard errors of 0.4 % noise in 400 samples.
    assert state.E_star == pytest.approx(1.3 * before.E_star, rel=1e-2)
    assert state.q_c == pytest.approx(0.8 * before.q_c, rel=5e-3)
    assert scene_of(state).drive == mdr.DepthPath(float(np.max(state["fit.curve"].fit.path.depth)))
    assert agrees(state)
    assert "residual" in [card.plot.name for card in page.board.seen()]
    page.undo()
    assert medium(page.state) == before
    assert page.state["fit.curve"].fit is None
    page.undo()
    assert page.state["fit.curve"] is None
    page.redo()
    page.redo()
    assert page.state["fit.curve"] is not None


def test_what_is_fixed_stays():
    state = fitted(fixed=("E_star", "eta", "tilt", "drag"), depth_noise=1e-11)
    assert medium(state).E_star == medium(preset_state()).E_star
    assert state.elasticity == "bodies"
    assert state["fit.curve"].fit.standard_errors.keys() == {"q_c", "contact_point", "baseline"}
    assert state["fit.baseline"] == state["fit.curve"].fit.baseline != 0
    with pytest.raises(ValueError, match="the drag needs the times"):
        fitted(fixed=("eta",))


def test_a_work_of_adhesion_is_fitted_where_there_is_adhesion():
    start = preset_state().replace(adhesion="work", plasticity="none")
    d = np.append(np.linspace(-1e-9, 9e-9, 200), np.linspace(9e-9, -9e-9, 300))
    F = mdr.indent(profile(start), medium(start), d).force
    curve = read_curve(table({"h (nm)": 1e9 * d, "F (nN)": 1e9 * F}).encode(), "run.csv")
    held = tuple(name for name in FITTED if name not in ("E_star", "work_of_adhesion"))
    other = fitting.take(start, curve).replace(
        **{"fit.fixed": held}, work_of_adhesion=0.3 * start.work_of_adhesion
    )
    state = fitting.fit(other)
    assert state.work_of_adhesion == pytest.approx(start.work_of_adhesion, rel=1e-2)
    assert agrees(state)
    assert "work_of_adhesion" not in offered(other.replace(adhesion="none"))
    with pytest.raises(ValueError, match="elastic medium: choose yield none, and hold the hardness"):
        fitting.fit(other.replace(plasticity="q_c"))


def test_a_drag_is_fitted_where_there_are_times():
    """Without it the placed curve is that of the elastic medium."""
    t = np.linspace(0, 2, 401)
    d = 9e-9 * np.sin(np.pi * t / 2)
    start = preset_state().replace(plasticity="none")
    F = mdr.indent(profile(start), medium(start), d).force
    drag = 0.05 * F.max() / (9e-9 * np.pi / 2)
    columns = {"t (s)": t, "h (nm)": 1e9 * d, "F (nN)": 1e9 * (F + drag * np.gradient(d, t))}
    curve = read_curve(table(columns).encode(), "run.csv")
    held = tuple(name for name in curve.fitted if name not in ("E_star", "drag"))
    state = fitting.fit(fitting.take(start, curve).replace(**{"fit.fixed": held}))
    assert state["fit.drag"] == pytest.approx(drag, rel=1e-3)
    assert state.E_star == pytest.approx(medium(start).E_star, rel=1e-3)
    assert agrees(state)
    np.testing.assert_allclose(view_of(state).computed["fit"].force, F, atol=1e-3 * F.max())
    assert {"eta", "drag"} == set(curve.fitted) - set(example_curve().fitted)


def test_the_curve_lies_where_it_is_set_to_and_its_residual_is_of_what_is_set():
    state = fitted()
    np.testing.assert_allclose(residual_of(view_of(state)), state["fit.curve"].fit.residuals)
    z, F = state["fit.curve"].data
    state = state.replace(E_star=2e11, **{"fit.baseline": 1e-8, "fit.contact_point": 1e-9})
    view = view_of(state)
    d = z - 1e-9
    np.testing.assert_allclose(
        (view.computed["fit"].depth, view.computed["fit"].force), (d, F - 1e-8), rtol=1e-12
    )
    expected = F - 1e-8 - mdr.indent(profile(state), medium(state), d).force
    np.testing.assert_allclose(residual_of(view), expected, rtol=1e-9, atol=1e-15)
    assert np.isnan(view.places(PLOTS["residual"], 0)["± noise"][0]).all()
    assert view.end(RESIDUAL_FORCE) >= np.abs(expected).max()
    # A tip that ends above the measured depth says so.
    r = np.linspace(0, 5e-9, 20)
    state = changes.take_tip(state, (r, 0.1 * r), "")
    assert view_of(state).places(PLOTS["residual"], 0)["missing"][2] == "no model at these depths"


def test_refusals_say_why_and_what_stays_and_a_preset_leaves_the_curve(explorer, tmp_path):
    page, refused = explorer.page, explorer.page.locator(".refused:visible")
    large = tmp_path / "large.csv"
    with large.open("wb") as file:
        file.truncate(20_000_000)
    files = {"words": b"force after\ndepth\n", "binary": bytes(range(256)), "NUL": bytes(99), "empty": b""}
    files = [{"name": f"{name}.csv", "mimeType": "", "buffer": data} for name, data in files.items()]
    binary = "is a binary file of a kind that is not read"
    whys = ["no samples; expected rows of numbers", binary, binary, "is empty", "has 20 MB, more than 5 MB"]
    explorer.press("Fit a measurement")
    for loaded in (False, True):
        stays = " What is shown is still Fused silica, Berkovich tip.csv." * loaded
        for file, why in zip([*files, large], whys, strict=True):
            page.get_by_label("CSV file of a measured curve: depth, force").set_input_files(file)
            name = file.name if file is large else file["name"]
            refused.filter(has_text=re.compile(f"^Refused: {name}:? {why}.*\\.{stays}$")).wait_for()
        if not loaded:
            explorer.change(explorer.press, "Fused silica")
            assert refused.count() == 0
    explorer.change(explorer.type, "F_0", "1 N")
    explorer.press("Fit")
    refused.filter(has_text="above the baseline: no contact").wait_for()
    explorer.change(explorer.press, "Undo")

    def largest_depth():
        unit = unit_of(explorer.axis("force")["labels"][0], "length")
        return explorer.row("force", "measured")[0].max() * unit

    before = largest_depth()
    explorer.choose("Preset", PRESETS["berkovich-pdms"].label)
    # Places are drawn to 10⁻⁴ of an axis.
    assert largest_depth() == pytest.approx(before, rel=1e-2)
    assert page.get_by_text("Fused silica, Berkovich tip.csv:").is_visible()


def test_a_curve_is_dropped_corrected_and_fitted(explorer, tmp_path):
    page, path = explorer.page, tmp_path / "run.csv"
    d = np.append(np.linspace(-1e-9, 9e-9, 120), np.linspace(9e-9, 7.5e-9, 60))
    F = mdr.indent(mdr.Cone(0.358), mdr.Medium(60e9, 80.0), d).force
    path.write_text(table({"h (nm)": d * 1e9 + 0.5, "F (µN)": F * 1e9}, "; "), encoding="utf-8")
    explorer.press("Fit a measurement")
    for again in (False, True):
        if again:
            explorer.change(explorer.press, "Remove")
        # A file of the same name is read again.
        with page.expect_file_chooser() as chooser:
            page.get_by_label("CSV file of a measured curve: depth, force").click()
        explorer.change(chooser.value.set_files, path)
    explorer.press("Columns")
    time = page.get_by_label("Column of time")
    time.locator("option").first.wait_for(state="attached")
    assert time.evaluate("(list) => list.selectedOptions[0]?.text") == "none, rows in order"
    # The axes reach the samples before contact.
    assert explorer.axis("force")["x"][0] <= -0.5
    before = explorer.axis("force")["labels"][1]
    page.get_by_label("Unit of force", exact=True).select_option(label="nN")
    explorer.wait("(label) => explorer.axis('force').labels[1] !== label", before)
    explorer.change(explorer.press, "Fit")
    y = explorer.row("residual", "measured − model")[1]
    size = unit_of(explorer.axis("residual")["labels"][1], "force")
    assert np.nanmax(np.abs(y)) * size < 1e-3 * F.max()
    assert explorer.readout("depth") == "9.000 nm"
    modulus = re.search(r"E\*\s+([\d.]+)", page.locator(".said table").first.inner_text())[1]
    assert float(modulus) == pytest.approx(60, rel=1e-3)
    # The plots stay in view beside the form.
    for name in ("springs", "pressure", "force", "residual"):
        box = page.locator(f".card.{name}").bounding_box()
        assert box["y"] + box["height"] <= 900
    page.get_by_text("A link does not contain the curve").wait_for()
    # A table without names asks, and keeps the curve until it is answered.
    path.write_text("\n".join(f"{f:.9g} {z:.9g}" for f, z in zip(1e6 * F, 1e9 * d + 3, strict=True)))
    page.get_by_label("CSV file of a measured curve: depth, force").set_input_files(path)
    refused = page.locator(".refused:visible")
    refused.filter(has_text=re.compile("choose them below.*What is shown is still run.csv")).wait_for()
    for label, option in (("Column of depth", 1), ("Unit of depth", "nm"), ("Column of force", 0)):
        where = {"label": option} if isinstance(option, str) else {"index": option}
        page.get_by_label(label, exact=True).select_option(**where)
    explorer.change(page.get_by_label("Unit of force", exact=True).select_option, label="µN")
    assert refused.count() == 0
    assert explorer.row("force", "measured")[0].min() == pytest.approx(2.0, abs=0.02)


def test_depth_noise_counts_where_it_is_no_rounding_and_no_trifle():
    """Noise of a hundredth of the recovered depth is found; of a ten-thousandth, or none, it is 0."""
    d = np.append(np.linspace(-2, 15, 600), np.linspace(15, 12, 200))
    force = np.maximum(d, 0) ** 2
    for size, expected in ((0.03, 0.03), (3e-4, 0.0), (0.0, 0.0)):
        depth = d + size * np.random.default_rng(3).standard_normal(d.size)
        curve = read_curve(table({"h (nm)": depth, "F (µN)": force}).encode(), "run.csv")
        state = fitting.take(preset_state(), curve)
        # A standard deviation of 800 samples, from third differences.
        assert state["fit.depth_noise"] == pytest.approx(1e-9 * expected, rel=0.2)
        assert fitting.take(state, None)["fit.depth_noise"] == 0
