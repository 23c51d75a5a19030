"""Extras: the page works without each of them, and a new one is a file."""

import importlib
import json
import re
import shutil
import sys
from functools import cache
from html import unescape

import numpy as np
import pytest
from bokeh.core.has_props import HasProps, _default_resolver

from app.common.quantities import CHOICES, QUANTITIES
from app.explorer import changes
from app.explorer.extra import EXTRAS
from app.explorer.page import Page
from app.explorer.plot import rows_of
from app.explorer.plots import NAMED, PLOTS
from app.explorer.readouts import MOST
from app.explorer.state import OF_EXTRAS, preset_state
from mdr_core.show.units import UNITS

from ..conftest import DROP, ROOT, Explorer, Server


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder of copies that can be imported."""
    folder = tmp_path_factory.mktemp("copies")
    sys.path.insert(0, str(folder))
    known = set(HasProps.model_class_reverse_map.values())
    yield folder
    sys.path.remove(str(folder))
    # Bokeh imports the package of each model that it knows when it writes a page, in later tests too.
    for model in set(HasProps.model_class_reverse_map.values()) - known:
        _default_resolver.remove(model)


def strings(value):
    """All texts within a value of a model; of the columns of a source, names of rows."""
    if isinstance(value, str):
        # Panes of HTML escape theirs.
        yield unescape(value)
    if isinstance(value, dict):
        yield from strings(value.get("row"))
    for each in value if isinstance(value, list | tuple) else ():
        yield from strings(each)


def texts(page):
    """All that a page has for the browser, with every part and plot opened."""
    seen = set()

    def look():
        for parts in page.root.select(type(page.layout.header)):
            for part in parts.parts.values():
                seen.update(strings(list(part.look.values())))

    for name, each in sys.modules[type(page).__module__].EXTRAS.items():
        if each.side:
            page.layout.toggle(name)
            look()
    for drive in dict(page.choice("drive").look["options"]):
        page.choose("drive", drive)
        for name, _ in page.layout.others(page.view).look["options"]:
            page.layout.others(page.view).act(name)
            look()
    page.document.add_root(page.root.get_root(page.document))
    for model in page.document.models:
        for value in model.properties_with_values(include_defaults=False).values():
            seen.update(strings(value))
    return seen


@pytest.fixture(scope="module")
def whole():
    return texts(Page())


def copied(folder, package, *without):
    """A copy of the app under a name, without some extras."""
    # The library, too: a server that runs there may have no other.
    for other in ("assets", "mdr_core"):
        if not (folder / other).exists():
            (folder / other).symlink_to(ROOT / other)
    shutil.copytree(ROOT / "app", folder / package, ignore=shutil.ignore_patterns("__pycache__"))
    for name in without:
        for path in (folder / package / "explorer" / "extras").glob(f"{name}*"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    return folder / package


def linked(name):
    """Links that mention an extra."""
    extra = EXTRAS[name]
    # A drive that takes the place of one of the page is there without it, too.
    own = [drive for drive in extra.drives if drive not in ("depth", "force", "impact")]
    links = [f"drive={drive}" for drive in own] + [f"tiles={plot.name}" for plot in extra.plots]
    of_it = [value for value in OF_EXTRAS if value.startswith(f"{name}.")]
    return links + [f"{value}=1" for value in of_it]


@cache
def opened():
    """A page as it opens."""
    return Page()


def words(name):
    """What a person reads of an extra: buttons, titles, choices with their options, numbers, readouts."""
    extra, path = EXTRAS[name], ROOT / f"app/explorer/extras/{name}.json"
    data = json.loads(path.read_text(encoding="utf-8")) if path.exists() and name != "guide" else {}
    found = [extra.tab, *(part for plot in extra.plots for part in (plot.tab, plot.title))]
    found += [label for label, _, _ in extra.files]
    found += [row.name for overlay in extra.overlays for row in overlay.rows if row.legend]
    found += [number["label"] for number in data.get("numbers", ())]
    choices = data.get("choices", {})
    found += [choice["label"] for name, choice in choices.items() if "." in name]
    found += [drive.get("label", "") for drive in choices.get("drive", {}).get("options", {}).values()]
    page = opened()
    buttons = *extra.on_plots(page, PLOTS["force"], page.view), extra.header(page, page.view)
    found += [each.look.get("label") for each in buttons if each is not None]
    notes = extra.notes(page.view)
    found += re.findall("<summary>(.*?)</summary>", notes.pop("below", str)())
    found += notes.values()
    return {each for each in found if each}


def said(word, texts):
    """Whether texts have a word, as a whole text or that of an element, or a sentence."""
    inside = re.compile(rf">([^<>]* )?{re.escape(word)}<")
    sentence = word.endswith(".")
    return any(inside.search(text) or text == word or (sentence and word in text) for text in texts)


@pytest.mark.few(1)
@pytest.mark.parametrize("name", EXTRAS)
def test_without_an_extra_the_page_builds_and_has_no_word_of_it(folder, whole, name, monkeypatch):
    copied(folder, f"without_{name}", name)
    made = importlib.import_module(f"without_{name}.explorer.page")
    assert set(made.EXTRAS) == set(EXTRAS) - {name}
    notices = []
    monkeypatch.setattr(made.Page, "notify", lambda page, text: notices.append(text))
    page = made.Page()
    assert notices == []
    text = texts(page)
    assert notices == []
    # Each word is there with the extra, so that it is missed without.
    shown = {word for word in words(name) if said(word, whole)}
    assert shown or name in ("guide", "labels", "zoom")
    # The form has the word "Hardness", too.
    others = {"Hardness"}.union(*(words(other) for other in EXTRAS if other != name))
    assert {word for word in shown - others if said(word, text)} == set()
    for query in linked(name):
        notices.clear()
        page = made.Page(f"max_depth=5e-09&{query}")
        assert len(notices) == 1, query
        assert query.split("=")[query.startswith("tiles")] in notices[0]
        assert page.state.max_depth == (preset_state().max_depth if "drive" in query else 5e-9)
    # And it is in use.
    before = page.state
    page.apply(lambda state: changes.set_value(state, "mass", 2 * state.mass))
    page.undo()
    assert page.state == before


def test_the_page_with_no_extras_at_all(browser, tmp_path):
    """Three plots, the form and the readouts are in use, without what extras share too."""
    copied(tmp_path, "app", *EXTRAS)
    server = Server(root=tmp_path)
    try:
        with browser.new_context(viewport={"width": 1280, "height": 720}) as context:
            explorer = Explorer(context.new_page(), server.url)
            assert explorer.readout("force") == "4.514 µN"
            assert explorer.page.locator(".header .act, .more .act").all_inner_texts() == ["Dark"]
            assert explorer.page.locator(".card").count() == 3
            assert explorer.page.locator(".tabs button").count() == 0
            explorer.change(explorer.type, "d_max", "5 nm")
            assert explorer.readout("depth") == "5.000 nm"
            assert explorer.link("max_depth=") == {"max_depth": "5e-09"}
            explorer.pick("impact")
            assert explorer.page.locator('output[data-name="restitution"]').count() == 1
            explorer.change(explorer.press, "Undo")
            assert explorer.readout("depth") == "5.000 nm"
            assert explorer.problems == []
    finally:
        server.stop()
    assert server.faults == ""


def test_a_new_extra_is_a_file_of_its_own(folder):
    """The example of CONTRIBUTING.md: a plot with a choice, which is in the link."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(\"\"\"The plot \*Area\*.*?)```", text, re.DOTALL)
    (data,) = re.findall(r"```json\n(.*?)```", text, re.DOTALL)
    extras = copied(folder, "with_area") / "explorer" / "extras"
    (extras / "area.py").write_text(code, encoding="utf-8")
    (extras / "area.json").write_text(data, encoding="utf-8")
    page = importlib.import_module("with_area.explorer.page").Page(
        f"preset={DROP}&tiles=area&area.of=plastic"
    )
    assert page.layout.others(page.view).look["value"] == "area"
    states = page.view.course.states
    plot = page.layout.cards["area"].plot
    for option, radius in (("plastic", states.plastic_radius), ("contact", states.contact_radius)):
        page.choose("area.of", option)
        _, area = page.view.places(plot, 0)["area"]
        np.testing.assert_allclose(area, np.pi * radius**2, rtol=1e-12)
        assert ("area.of=plastic" in page.query()[0]) == (option == "plastic")


def test_extras_have_names_of_their_own_and_known_units():
    """What would fail on the page without a word: two of one name, a plot without a tab, unknown units."""
    plots = [plot for extra in EXTRAS.values() for plot in extra.plots]
    names = [plot.name for plot in plots]
    assert len({*names, *NAMED}) == len(names) + len(NAMED)
    folder = ROOT / "app" / "explorer" / "extras"
    assert {*EXTRAS} == {path.stem for path in folder.glob("*.py")} - {"__init__"}
    for plot in plots:
        assert plot.tab
        rows = [row.name for row in rows_of(plot)]
        assert len({*rows}) == len(rows)
        assert {along.kind for along in plot.axes} <= {*UNITS}
        for name in plot.controls:
            assert name in QUANTITIES or not any(each.uses for each in CHOICES[name].options.values())
    for path in folder.glob("*.json"):
        data = json.loads(path.read_text(encoding="utf-8"))
        for number in data.get("numbers", ()):
            assert number["name"].startswith(f"{path.stem}.")
            assert QUANTITIES[number["name"]].kind in UNITS
        for name, choice in data.get("choices", {}).items():
            assert "label" not in choice or name.startswith(f"{path.stem}.")
        for drive in data.get("choices", {}).get("drive", {}).get("options", {}).values():
            assert len(drive.get("line", ())) <= MOST


NUMBER = {
    "name": "wrong.share", "symbol": "φ", "label": "share", "kind": "number", "bounds": [0.0, 1.0],
    "default": 0.5, "span": -1.0, "help": "", "equation": "",
}  # fmt: skip
MISTAKES = {
    "nothing to load": ("", {}, "it must end with EXTRA = Extra"),
    "no bounds": ({}, {"numbers": [{"name": "wrong.share"}]}, "wrong.json does not describe"),
    "an unknown field": ({}, {"numbers": [NUMBER | {"colour": "red"}]}, "wrong.json does not describe"),
}
PLOT = """
from ..extra import Extra
from ..plot import AxisSpec, Plot
from mdr_core.show.figures import line
X = AxisSpec("x", "length", lambda course: (0.0, 1.0))
ROWS = (line("x", "ink"),)
PLOT = Plot("{plot}", "Wrong", "", (X, X), ROWS, {places}tab="{tab}", controls={controls})
EXTRA = Extra("wrong", plots=(PLOT,))
"""


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_in_an_extra_is_refused_in_words(folder, case):
    given, data, message = MISTAKES[case]
    words = {"plot": "wrong", "tab": "Wrong", "controls": "()", "places": ""}
    package = "wrong_" + case.translate({ord(" "): "_", ord("'"): "_"})
    extras = copied(folder, package) / "explorer" / "extras"
    code = PLOT.format(**words | given) if isinstance(given, dict) else given
    (extras / "wrong.py").write_text(code, encoding="utf-8")
    (extras / "wrong.json").write_text(json.dumps(data), encoding="utf-8")
    with pytest.raises(ValueError, match=re.escape(message)):
        importlib.import_module(f"{package}.explorer.page")


def test_a_row_that_a_plot_has_not_is_no_empty_curve(folder):
    extras = copied(folder, "wrong_row") / "explorer" / "extras"
    code = PLOT.format(
        plot="wrong", tab="Wrong", controls="()", places='lambda view, i: {"y": ([0], [0])}, '
    )
    (extras / "wrong.py").write_text(code, encoding="utf-8")
    page = importlib.import_module("wrong_row.explorer.page").Page()
    plot = sys.modules["wrong_row.explorer.plots"].PLOTS["wrong"]
    with pytest.raises(KeyError, match=r"places of unknown rows: \['y'\]"):
        page.view.places(plot, 0)


def test_a_number_above_a_plot_is_set_there_and_in_the_link(folder):
    extras = copied(folder, "with_number") / "explorer" / "extras"
    code = PLOT.format(plot="wrong", tab="Wrong", controls='("wrong.share",)', places="")
    (extras / "wrong.py").write_text(code, encoding="utf-8")
    (extras / "wrong.json").write_text(json.dumps({"numbers": [NUMBER]}), encoding="utf-8")
    page = importlib.import_module("with_number.explorer.page").Page("tiles=wrong")
    field = page.layout.cards["wrong"].head.parts["wrong.share"]
    field.act({"text": "0.25"})
    assert page.state["wrong.share"] == 0.25
    assert "wrong.share=0.25" in page.query()[0]
