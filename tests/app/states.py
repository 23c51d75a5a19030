"""States, courses, views and texts for tests, and what a browser draws against the core."""

import re
from html import unescape

import numpy as np

from app.common.quantities import CHOICES
from app.explorer import changes, link
from app.explorer.drives import follow
from app.explorer.extras.comparison import computed
from app.explorer.extras.guide import TOURS, step_state
from app.explorer.figures import Picture
from app.explorer.plot import View
from app.explorer.plots import PLOTS
from app.explorer.readouts import readings
from app.explorer.search import exact
from app.explorer.state import OF_EXTRAS, State, preset_state
from app.explorer.widgets import Parts
from mdr_core.show.units import UNITS

from .conftest import DROP, ELASTIC, GOLD

#: Presets of constant hardness, and one that sticks.
SILICA, STEEL, PDMS = "berkovich-fused_silica", "ball-steel", "microsphere-pdms"
SHAPED = [shape for shape in CHOICES["shape"].options if shape != "sampled"]
#: Sizes (SI) of all units, by their names.
SIZES = {unit.name: unit.factor for units in UNITS.values() for unit in units}
#: Text that runs if it is taken for HTML, in an attribute, a script or a text.
HOSTILE = (
    "<img src=x onerror=\"window.run = 1\">", "\"><svg onload='window.run = 1'>",
    "</script><script>window.run = 1</script>", "<b onclick=window.run=1>bold</b>",
    "' autofocus onfocus='window.run = 1",
)  # fmt: skip
#: Names of files that put a formula into a cell, if cells are parted at commas or semicolons.
FORMULAS = (
    'a,=HYPERLINK("http://evil.example","x").csv', "=1+1.csv", "@SUM(A1).csv", "a;=1+1.csv", 'a","=1+1.csv',
    "+cmd|' /C calc'!A0", "-2+3,+cmd", "a,\t=1+1",
)  # fmt: skip


def full_name(name: str) -> str:
    """Name of a value of the state of which the part of its extra may be left out."""
    return next((each for each in OF_EXTRAS if each.endswith(f".{name}")), name)


def state_with(key=GOLD, drive=None, **choices) -> State:
    """A preset with a drive, and options of choices as a person takes them, one after the other."""
    state = changes.choose(preset_state(key), "drive", drive) if drive else preset_state(key)
    for name, option in choices.items():
        # Of choices of extras the last word: "pattern" is "path.pattern".
        state = changes.choose(state, full_name(name), option)
    return state


def view_of(state: State, progress=1.0, *held: State) -> View:
    """A view as the page makes it, with other scenes held."""
    state = state.replace(at=progress)
    if held:
        state = state.replace(**{"held.scenes": tuple(link.write(each) for each in held)})
    return View(state, follow(state), {"held": computed(state)})


def stepped(title: str) -> list:
    """The course of each step of a guided scene."""
    return [follow(step_state(step, preset_state())) for step in TOURS[title]]


def linked_state(state: State) -> State:
    """What a link of a state says."""
    return link.read(link.write(state))


def solved(state: State):
    """The course of a state, in full."""
    course = follow(state)
    return exact(course) if course.pending else course


def side(page, name: str):
    """A part of the side, opened."""
    page.layout.toggle(name)
    return page.layout.parts[name]


def part(page, name: str):
    """A part that the page shows: a button by its label, a field or choice by its name."""
    shown = [each.parts for each in page.root.select(Parts) if name in each.parts]
    assert shown, f"the page has no {name}"
    return shown[0][name]


def press(page, label: str) -> None:
    """Press a button, or open or close an optional plot by its name in their list."""
    plots = part(page, "fourth plot")
    names = {shown: name for name, shown in plots.look["options"]}
    if label in names:
        plots.act("" if plots.look["value"] == names[label] else names[label])
    else:
        part(page, label).act(None)


def fields_of(parts) -> list[str]:
    """Names of the number fields that a component shows, in their order."""
    return [each.name for each in parts.parts.values() if each.kind == "number"]


def viscous() -> State:
    return state_with(DROP, damping="eta")


def table(columns: dict, between=", ", comma=False) -> str:
    """Columns under their heads, as an instrument writes them."""
    rows = [between.join(f"{x:.6f}" for x in row) for row in zip(*columns.values(), strict=True)]
    text = "\n".join([between.join(columns), *rows])
    return text.replace(".", ",") if comma else text


def numbers(course) -> dict:
    """Values of all readouts of a course, by name."""
    return {each.name: values for each, values in readings(course).items()}


def path(pattern, **choices) -> State:
    """A path of a pattern."""
    return changes.choose(changes.choose(state_with(**choices), "drive", "path"), "path.pattern", pattern)


def oblique_state(key=ELASTIC, **numbers) -> State:
    numbers = {"oblique.attack": 0.9, "oblique.friction": 0.5} | numbers
    return state_with(key, "oblique", body="solid").replace(**numbers)


def adhesive(drive="depth", **more) -> State:
    """A glass ball on rubber, w = 50 mJ/m², pressed to many times the critical depth."""
    state = state_with(PDMS, drive, adhesion="work")
    return changes.set_value(state, "work_of_adhesion", 0.05).replace(**more)


def put(page, name: str, value) -> None:
    page.apply(lambda state: changes.set_value(state, name, value))


def rested(page):
    """What is found of the section when the input is at rest."""
    page._input_rests()
    return page.view.computed.get("section")


def plain(html: str) -> str:
    """What is read of HTML."""
    html = re.sub(r"<(script|style).*?</\1>", "", html, flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", html)).split())


def note(page, name: str) -> str:
    """What is read of a note of the form."""
    return re.sub("<[^>]+>", "", part(page, f"note {name}").look["object"])


def amounts(text: str) -> list[float]:
    """All values with units of a text, in SI."""
    found = re.findall(r"(−?[\d.]+) ([^\s\d.,;)]+)", text)
    return [float(number.replace("−", "-")) * SIZES[unit] for number, unit in found if unit in SIZES]


def unit(label: str) -> float:
    """SI size of the unit that the label of an axis names."""
    return SIZES[label.rpartition("(")[2].rstrip(")")]


def now(explorer) -> list[float]:
    """Depth and force (SI) of the mark in the plot of force and depth."""
    labels = explorer.axis("force")["labels"]
    return [part[0] * unit(label) for part, label in zip(explorer.row("force", "now"), labels, strict=True)]


def assert_draws(explorer, state: State) -> None:
    """All that a browser draws of the present state is what the plots have of `state`."""
    view = view_of(state, state.at)
    shown = view.course.state
    np.testing.assert_allclose(now(explorer), (shown.depth, shown.force), rtol=1e-3, atol=1e-30)
    for figure, name in (("springs", "yielded"), ("springs", "profile g(x)"), ("pressure", "p(r)")):
        columns = Picture(PLOTS[figure]).columns(view, view.course.now)
        data = next(data for data in columns.values() if name in data["row"])
        k = data["row"].index(name)
        places = np.array([data["xs"][k], data["ys"][k]], float)
        np.testing.assert_allclose(explorer.row(figure, name), places, rtol=1e-6, atol=1e-9)


def polygon(x, y) -> float:
    """Area of a polygon."""
    return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
