"""A fit of a part of a measured curve: samples are chosen, drawn, fitted, and written to files."""

import csv
import json
import re

import numpy as np
import pytest

import mdr_core as mdr
from app import changes, link
from app.extra import EXTRAS
from app.extras import fit as fitting
from app.extras.fit.changes import choose_part, choose_samples
from app.extras.fit.files import as_csv, as_json
from app.extras.fit.measured import agrees, read_curve
from app.page import Page
from app.parts import Parts
from app.plots import PLOTS
from app.state import medium, preset_state, profile

from .states import fields_of, fitted, linked_state, part, side, table


def curve_on_a_substrate(start, timed=False):
    """A curve without noise whose force is half as large again from the 151st of 300 samples on."""
    d = start.max_depth * np.append(np.linspace(-0.05, 1, 200), np.linspace(1, 0.9, 100))
    F = mdr.indent(profile(start), medium(start), d).force * np.where(np.arange(300) < 150, 1.0, 1.5)
    columns = {"t (s)": np.arange(300.0)} if timed else {}
    return read_curve(table(columns | {"h (nm)": 1e9 * d, "F (pN)": 1e12 * F}).encode(), "film.csv")


def test_only_the_chosen_samples_are_fitted_and_the_others_are_faint():
    """Samples above the substrate have the q_c of the film; all of them together have another one."""
    page, start = Page(), preset_state()
    # The loading of a medium that yields nearly everywhere does not tell its modulus.
    held = ("E_star", *fitting.DEFAULT_FIXED)
    page.apply(
        lambda state: fitting.take(state, curve_on_a_substrate(state)).replace(**{"fit.fixed": held})
    )
    page.apply(fitting.fit)
    assert page.state.q_c != pytest.approx(start.q_c, rel=0.05)
    page.apply(lambda state: choose_samples(state, 1, 150))
    assert not agrees(page.state)
    page.apply(fitting.fit)
    # Samples are written with 10⁻⁶ nm and pN.
    assert page.state.q_c == pytest.approx(start.q_c, rel=1e-4)
    assert agrees(page.state)
    assert "film.csv, samples 1 to 150: " in page.state["fit.note"]
    rows = page.shown.places(PLOTS["force"], 0)
    z, _ = page.state["fit.curve"].data
    d = z - page.state["fit.contact_point"]
    np.testing.assert_allclose(rows["measured"][0], d[:150])
    np.testing.assert_allclose(rows["measured, not fitted"][0], d[150::1][: len(d)])
    # The residual has the fitted samples alone; the axes reach all.
    assert len(page.shown.computed["fit"].residual(page.shown.course.scene)) == 150
    assert page.board.cards["force"].plot is PLOTS["force"]
    # What is chosen is in links, and is undone.
    assert linked_state(page.state)["fit.samples"] == ("1", "150")
    page.undo()
    page.undo()
    assert page.state["fit.samples"] == ()
    assert agrees(page.state)
    # Another curve is fitted whole.
    page.apply(lambda state: choose_samples(state, 3, 200))
    page.apply(lambda state: fitting.take(state, curve_on_a_substrate(start)))
    assert page.state["fit.samples"] == ()
    for text in ("3", "9+3", "0+5", "a+5", "1+" + 5000 * "9"):
        with pytest.raises(ValueError, match="link"):
            link.read(f"fit.samples={text}")


def test_loading_and_unloading_are_parts_of_the_curve():
    """They meet at the largest depth; the unloading of silica alone has the E* of the whole curve."""
    page = Page()
    page.apply(fitting.silica)
    panel = side(page, "fit")
    curve = page.state["fit.curve"].curve
    top = 1 + int(np.argmax(curve.depth))
    for name, ends in (("Loading", (1, top)), ("Unloading", (top, 1220)), ("All", (1, 1220))):
        part(page, name).act(None)
        assert (panel.samples.value, part(page, name).look["pressed"]) == (ends, True)
        said = part(page, "ends").look["object"]
        assert f"From sample {ends[0]} (" in said
        assert re.search(rf"to {ends[1]} \(\S+ .m, \S+ mN\), of 1220\.$", said)
    panel.samples.value = (top, 1220)
    assert page.state["fit.samples"] == (str(top), "1220")
    page.apply(fitting.fit)
    # The model misses the curve by 0.4 % of the force.
    assert page.state.E_star == pytest.approx(fitting.fit(fitting.silica(preset_state())).E_star, rel=0.03)
    assert "fitted values have been put" in panel.said.object
    said = f"1220 samples; the fit is of samples {top} to 1220."
    assert said in panel.about.object
    assert said in EXTRAS["fit"].told(page.shown)[0][1]


def test_the_shape_is_chosen_in_the_part_of_the_fit_and_in_the_form():
    """One state: what is chosen or typed in one place is shown in the other."""
    page = Page()
    page.apply(fitting.silica)
    panel = side(page, "fit")
    (of_fit,) = [each for each in panel.view.select(Parts) if "shape" in each.parts]
    of_fit.parts["shape"].act("paraboloid")
    assert page.state.shape == of_fit.parts["shape"].look["value"] == "paraboloid"
    assert fields_of(of_fit) == ["paraboloid_radius"]
    page.frame.toggle("explore")
    form = page.frame.form.view
    assert form.parts["shape"].look["value"] == "paraboloid"
    form.parts["shape"].act("cone")
    page.apply(lambda state: changes.put(state, "cone_slope", 0.4))
    page.frame.toggle("fit")
    assert of_fit.parts["shape"].look["value"] == "cone"
    assert of_fit.parts["cone_slope"].look["text"] == "0.4"


def test_refusals_name_their_cause_in_words_of_the_page():
    start = preset_state()
    state = fitting.take(start, curve_on_a_substrate(start, timed=True))
    # Samples 200 and 201 are both at the largest depth.
    assert choose_part(state, "Unloading")["fit.samples"] == ("200", "300")
    late = choose_samples(state, 240, 300)
    with pytest.raises(
        ValueError, match=r"samples before the range reach deeper, \S+ nm, than those in it"
    ):
        fitting.fit(late)
    # An elastic medium has no memory.
    elastic = late.replace(plasticity="none", **{"fit.fixed": ("q_c", *fitting.DEFAULT_FIXED)})
    assert fitting.fit(elastic)["fit.curve"].fit is not None
    viscous = choose_samples(state, 5, 300).replace(**{"fit.fixed": ("drag",)})
    with pytest.raises(ValueError, match="begin the range at sample 1, or hold the viscosity at 0"):
        fitting.fit(viscous)
    below = {"fit.fixed": ("contact_point", *fitting.DEFAULT_FIXED), "fit.contact_point": 1e-3}
    with pytest.raises(
        ValueError, match=r"contact point z_0 = 1\.000 mm is held, and the samples reach only"
    ):
        fitting.fit(state.replace(**below))
    with pytest.raises(ValueError, match=r"^2 samples do not determine E\*, q_c, contact point: hold some"):
        fitting.fit(choose_samples(state, 1, 2))
    for first, last in ((0, 5), (5, 5), (1, 301)):
        with pytest.raises(ValueError, match=f"samples {first} to {last} are not two of 1 to 300"):
            choose_samples(state, first, last)
    # Of a long file one in three samples is taken.
    long = table({"h (nm)": range(5000), "F (nN)": range(5000)}).encode()
    state = fitting.take(start, read_curve(long, "long.csv"))
    with pytest.raises(ValueError, match=r"samples 2 to 5 are too few: one in 3 is taken"):
        choose_samples(state, 2, 5)
    assert np.count_nonzero(state["fit.curve"].used(choose_samples(state, 1, 4))) == 2


def test_the_files_of_a_fit_have_its_numbers():
    """Values and errors of the result, digit for digit; held ones have no error."""
    state = choose_samples(fitted(), 1, 350)
    state = fitting.fit(state)
    curve = state["fit.curve"]
    found = curve.fit
    told = json.loads(as_json(curve), parse_constant=pytest.fail)
    rows = as_csv(curve).splitlines()
    heads = [line for line in rows if line.startswith("# ")]
    lines = {row["name"]: row for row in csv.DictReader(rows[len(heads) :])}
    for name, value in found.to_dict().items():
        kind = "standard_error" if name.endswith("_error") else "value"
        name = name.removesuffix("_error")
        assert told["numbers"][name][kind] == value
        assert float(lines[name][kind.replace("_", " ")]) == value
    assert told["numbers"]["eta"]["standard_error"] is None
    assert lines["eta"]["standard error"] == ""
    assert (lines["E_star"]["unit"], told["numbers"]["E_star"]["units"]) == ("Pa", "Pa")
    for letter, each in found.classes.items():
        assert told["numbers"][f"misfit_{letter}"]["value"] == float(lines[f"misfit_{letter}"]["value"])
        assert told["numbers"][f"misfit_{letter}"]["value"] == float(each.misfit)
    assert told["version"] == f"mdr_core {mdr.__version__}"
    assert told["samples"] == {"first": 1, "last": 350, "of": 400, "fitted": 350}
    assert heads[0] == f"# {told['version']}: fit to {curve.name}, samples 1 to 350 of 400, 350 fitted"
    assert heads[1:] == [f"# {text}" for text in [*told["remarks"], *told["limits"]]]
    assert told["curve"]["depth"]["values"] == found.depth.tolist()
    scene = mdr.Scene.from_json(json.dumps(told["scene"]))
    assert (scene.profile, scene.medium) == (found.profile, found.medium)
    # An elastic medium has q_c = ∞, which JSON has no number for.
    elastic = fitting.fit(
        state.replace(plasticity="none", **{"fit.fixed": ("q_c", *fitting.DEFAULT_FIXED)})
    )
    assert json.loads(as_json(elastic["fit.curve"]))["numbers"]["q_c"]["value"] is None


def test_noise_of_the_example_hardly_counts():
    """The page and the remarks of the core have one rule for it."""
    state = fitting.silica(preset_state())
    assert state["fit.depth_noise"] == 0
    assert "back and forth" not in fitting.result(fitting.fit(state))


def test_the_result_is_in_sight_and_is_saved(explorer):
    """At 1280 × 720, without scrolling; the unloading alone is chosen on the slider."""
    page = explorer.page
    page.set_viewport_size({"width": 1280, "height": 720})
    explorer.press("Fit a measurement")
    explorer.change(explorer.press, "Fused silica")
    legend = page.locator(".card.force .key").filter(has_text="measured")
    faint = legend.get_by_text("measured, not fitted", exact=True)
    assert (legend.count(), faint.count()) == (1, 0)
    explorer.change(explorer.press, "Unloading")
    assert explorer.row("force", "measured, not fitted")[0].size > 100
    faint.wait_for()
    # The same choice as in the form, which is not shown.
    explorer.change(
        page.get_by_label("Shape", exact=True).locator("visible=true").select_option, label="Paraboloid"
    )
    explorer.change(explorer.press, "Undo")
    handle = page.locator(".side .noUi-handle-lower")
    handle.focus()
    explorer.change(page.keyboard.press, "Home")
    page.get_by_text("From sample 1 (").wait_for()
    explorer.change(explorer.press, "Fit")
    modulus = page.get_by_role("cell", name=re.compile(r"^84\.5\d ± 0\.4\d GPa$"))
    box = modulus.bounding_box()
    assert box["y"] + box["height"] <= 720
    page.context.grant_permissions(["clipboard-read"])
    explorer.press("Copy")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert re.search(r"^effective modulus E\*\s+84\.5\d ± 0\.4\d GPa$", copied, re.MULTILINE)
    for button, start in (("Fit (CSV)", "# mdr_core "), ("Fit (JSON)", '{\n "version": "mdr_core ')):
        with page.expect_download() as download:
            page.get_by_text(button, exact=True).click()
        assert download.value.path().read_text(encoding="utf-8").startswith(start)
