"""Saved fits, links, and the way to the explorer."""

import csv
import json
import re
from html import unescape
from io import StringIO

import pytest

import mdr_core as mdr
from app.explorer import link
from app.explorer.state import medium, profile
from app.measurement import query
from app.measurement.analysis import Row
from app.measurement.export import rounded, table_of
from mdr_core.show.csv_text import csv_text

from ...approx import approx
from ..measuring import (
    choose,
    choose_samples,
    curve_file,
    headline,
    link_of,
    opened,
    page_of,
    saved,
    take_file,
    take_sample,
    workbook,
)
from ..states import FORMULAS


def test_the_files_of_a_fit_have_its_numbers():
    """Values and errors of the result, digit for digit; held ones have no error."""
    page = opened(curve_file(noise=0.004))
    choose_samples(page, 1, 350)
    found = page.found.fit
    told = json.loads(saved(page, "json"), parse_constant=pytest.fail)
    rows = saved(page, "csv").splitlines()
    heads = [line for line in rows if line.startswith("# ")]
    lines = {row["name"]: row for row in csv.DictReader(rows[len(heads) :])}
    for name, value in found.to_dict().items():
        kind = "standard_error" if name.endswith("_error") else "value"
        name = name.removesuffix("_error")
        assert told["numbers"][name][kind] == value
        assert float(lines[name][kind.replace("_", " ")]) == value
    assert lines["baseline"]["standard error"] == ""
    assert told["numbers"]["quoted"]["value"] == found.quoted.value
    assert told["quoted"]["source"] == "fit"
    for letter, each in found.classes.items():
        assert told["numbers"][f"misfit_{letter}"]["value"] == float(each.misfit)
    assert told["samples"] == {"first": 1, "last": 350, "of": 400, "fitted": 350}
    assert heads[0].startswith(f"# mdr_core {mdr.__version__}: fit to run.csv, samples 1 to 350 of 400")
    scene = mdr.Scene.from_json(json.dumps(told["scene"]))
    assert (scene.profile, scene.medium) == (found.profile, found.medium)
    assert told["samples_fitted"]["depth"]["values"] == found.depth.tolist()
    # An elastic medium has q_c = ∞, which JSON has no number for.
    choose(page, medium="gel")
    assert json.loads(saved(page, "json"))["numbers"]["q_c"]["value"] is None


def test_a_link_to_a_curve_beyond_the_file_shows_the_last_one():
    page = page_of("file=map.xlsx&tip=paraboloid&radius=1e-5&medium=gel&curve=7")
    take_file(page, "map.xlsx", workbook())
    assert (page.results.number.value, link_of(page).curve) == (3, 2)
    assert page.found.fit.medium.E_star == approx(3e4, rel=1e-4)


def test_the_link_asks_for_the_same_file_with_everything_that_was_told():
    page = opened(curve_file(timed=True), "constant", "rounded_cone", radius=5e-8, half_angle=1.2)
    choose(page, E_star=81e9)
    choose(page, baseline=None)
    choose(page, frame=1e-7)
    choose(page, poisson=0.2, tip_modulus=1.1e12)
    choose_samples(page, 1, 300)
    again = page_of("fit=&" + page.link().query())
    assert again.link() == page.link()
    take_file(again, "run.csv", curve_file(timed=True))
    assert again.link() == page.link()
    assert again.found.fit.to_dict() == page.found.fit.to_dict()
    assert page.address.value == f"?fit&{page.link().query()}"
    example = page_of(
        "fit&file=Fused+silica,+Berkovich+tip.csv&tip=berkovich&medium=constant&contact_point=0.0"
    )
    assert headline(example).startswith("E* = 69.6")


def test_links_of_the_last_version_open():
    """Columns of one table and of pairs, words and numbers that part curves, parameters free and held."""
    for old, options in (
        ("depth_column=0,nm&force_column=1,mN&time_column=none&by=gaps",
         {"columns": {"depth": (0, "nm"), "force": (1, "mN"), "time": None}, "by": "gaps"}),
        ("piezo_column=2,µm&force_column=3,nN&by=0,4",
         {"columns": {"piezo": (2, "µm"), "force": (3, "nN")}, "by": [0, 4]}),
        ("depth_column=0,nm;2,nm&force_column=1,mN;3,mN&by=segments",
         {"columns": [{"depth": (0, "nm"), "force": (1, "mN")}, {"depth": (2, "nm"), "force": (3, "mN")}],
          "by": "segments"}),
    ):  # fmt: skip
        assert query.read(f"file=a.csv&{old}").options == options
        assert query.Link("a.csv", options=options).query().replace("%C2%B5", "µ") == f"file=a.csv&{old}"
    asked = "file=run.csv&tip=sphere&medium=gel&radius=5e-06&tilt=free&baseline=0.0"
    asked += "&samples=3-90&curve=2&frame=1e-07"
    link = page_of(asked).link()
    assert (link.file, link.tip, link.medium, link.samples, link.curve) == (
        "run.csv",
        "sphere",
        "gel",
        (3, 90),
        2,
    )
    assert link.numbers == {"radius": 5e-6, "tilt": None, "baseline": 0.0, "frame": 1e-7}


@pytest.mark.parametrize(
    "asked",
    [
        "tip=none&medium=x&radius=nan&half_angle=1e999&samples=9-3&curve=-5&held=1", "radius=-1&poisson=7",
        "depth_column=0,<b>&force_column=²,nm&curve=99999999999999", "E_star=abc&medium=gel&samples=1-²",
        "file=" + "<img src=x>" * 999, "&".join("medium=gel" for _ in range(999)), "%00=%00&file=%00",
    ],
)  # fmt: skip
def test_a_hostile_link_opens_the_page(asked):
    page = page_of(asked)
    assert page.found is None
    assert "<img" not in page.form.about.object
    take_file(page, "run.csv", curve_file())
    assert page.busy == ""


def way_to_explorer(page):
    return unescape(re.search(r'href="\?(.*?)"', page.results.explorer.object)[1])


def test_the_way_to_the_explorer_has_tip_and_medium_in_their_digits_and_nothing_else():
    page = opened(curve_file(noise=0.004, timed=True), poisson=0.2)
    state = link.read(way_to_explorer(page))
    E, error = page.found.fit.medium.E_star, page.found.fit.standard_errors["E_star"]
    assert state.E_star == approx(E, abs=0.06 * error)
    assert state.E_star != E
    assert len(f"{state.E_star:.15g}".rstrip("0")) <= 6
    assert (profile(state), medium(state).E_star) == (page.found.fit.profile, state.E_star)
    assert medium(state).hardness == approx(page.found.fit.medium.hardness, rel=1e-2)
    names = set(dict(part.split("=") for part in way_to_explorer(page).split("&")))
    own = {"elasticity", "plasticity", "shape", "cone_slope", "E_star", "volume_hardness", "max_depth"}
    assert names <= own
    # As deep as the curve is from first contact on.
    assert state.max_depth == approx(1e-6, rel=1e-3)
    gel = page_of()
    take_sample(gel, "gel")
    state = link.read(way_to_explorer(gel))
    assert (state.shape, state.paraboloid_radius, state.plasticity) == ("paraboloid", 10e-6, "none")
    assert state.E_star == 19700.0
    assert rounded(12345.678, None) == 12350.0
    assert rounded(-12345.678, 3.21) == -12345.7


@pytest.mark.parametrize("delimiter", [",", ";"])
def test_no_cell_of_somebodys_text_is_a_formula(delimiter):
    for name in FORMULAS:
        rows = [Row("1", name, E=1e9, E_error=2e7), Row("2", name, reason=f"{name}: no contact")]
        file = StringIO()
        table_of(rows, {"file": name}, None).to_csv(file)
        text = file.getvalue()
        for row in csv.reader(text.splitlines(), delimiter=delimiter):
            for cell in row:
                assert not cell.startswith(("=", "+", "-", "@", "\t")), cell
    # A number stays one.
    assert csv_text([], [[-1.5, "-1.5"]]) == "-1.5,'-1.5\n"
