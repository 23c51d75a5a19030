"""States, courses and views for tests without a browser."""

from app.explorer import changes, link
from app.explorer.drives import follow
from app.explorer.extras.comparison import computed
from app.explorer.extras.guide import TOURS, step_state
from app.explorer.plot import View
from app.explorer.readouts import readings
from app.explorer.search import exact
from app.explorer.state import OF_EXTRAS, State, preset_state
from app.explorer.widgets import Parts

from .conftest import DROP, GOLD


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
