"""The form: number fields and choices, each with symbol, name, unit and explanation."""

from functools import cache
from typing import Any

from mdr_core.profiles.samples import decoded
from mdr_core.results.units import UNITS, entry, fitting, read, written

from . import changes
from .parts import Part, Parts, button, text, upload
from .plot import View
from .quantities import QUANTITIES, Scale
from .state import MEDIUM_CHOICES, PRESETS, State, altered, regions
from .tip import read_tip
from .ui import LAYOUT, linked, marked, symbol

_FIRST = "Move a slider: orange springs have yielded."
#: Places of the form that have notes of extras.
_PLACES = ("drive", "shape", "medium", "more", "sources")


class Field:
    """What a number field remembers: its unit, the middle of its slider, and what was refused in it."""

    def __init__(self, name: str, page: Any):
        self._name, self._page, self._known = name, page, QUANTITIES[name]
        # The number and its preset as they were shown, and whether the next one was typed or dragged here.
        self._value, self._preset, self._asked = self._known.default, "", False
        self.refused = ""

    def part(self, state: State, like: float = 0.0) -> Part:
        """The field with the number of a state; zero in the unit that fits the value `like`.

        The unit is that of the preset's number until another one is typed. What others change is shown in
        it, too, unless that takes a power of ten. A refusal stays until the number changes.
        """
        value, loaded = state[self._name], self._preset != state.preset
        changed = value != self._value
        if loaded or (changed and not self._asked and not self._unit.fits(value)):
            self._unit = fitting(value, self._known.kind, like)
        if loaded or changed:
            self.refused = ""
        # The middle of the slider stays while it moves.
        middle = PRESETS[state.preset].values.get(self._name, value) if loaded else self._scale.middle
        self._scale = Scale.about(self._known, middle, value)
        self._value, self._preset = value, state.preset
        look = _words(self._name) | {
            "text": entry(value, self._unit),
            "refused": self.refused,
            "position": self._scale.position(value),
        }
        return Part("number", self._name, look, self._take)

    def _take(self, message: dict[str, Any]) -> None:
        """Take a number that is typed or dragged; a refusal is shown beside it."""
        unit, self.refused, self._asked = self._unit, "", "reset" not in message
        try:
            self._change(message)
        except ValueError as error:
            self._refuse(str(error))
        self._asked = False
        if self.refused:
            self._unit = unit
        if self.refused or "position" not in message:
            # A number in another unit may be the present one, so that nothing else shows the unit.
            self._page.refresh()

    def _change(self, message):
        if isinstance(message.get("text"), str):
            value, self._unit = read(message["text"], self._known.kind, self._unit)
            self._put(value)
        elif isinstance(message.get("position"), int | float):
            self._put(self._scale.value(message["position"]), mark=self._name)
        elif "reset" in message:
            self._put(self._scale.middle)

    def _put(self, value, mark=None):
        self._page.apply(lambda state: changes.put(state, self._name, value), self._refuse, mark)

    def _refuse(self, text: str) -> None:
        self.refused = text


@cache
def _words(name: str) -> dict[str, Any]:
    """What is said of a number."""
    known = QUANTITIES[name]
    low, high = (written(bound, known.kind, 2) for bound in known.bounds)
    units = ", ".join(unit.name for unit in UNITS[known.kind] if unit.name)
    rows = [linked(known.help), f"<em>{linked(known.equation)}</em>" if known.equation else ""]
    rows.append(f"Usual: {marked(known.typical)}." if known.typical else "")
    rows.append(f"From {low} to {high}" + (f"; units {units}." if units else "."))
    return {
        "label": f"{symbol(known.symbol)} {marked(known.label)}",
        "spoken": f"{known.symbol}, {known.label}",
        "about": "".join(f"<p>{row}</p>" for row in rows if row),
        "steps": Scale.STEPS * (known.span >= 0),
    }


def take_tip(page: Any) -> Part:
    """The field for the file of a measured tip."""

    def take(file):
        page.apply(lambda state: changes.take_tip(state, *read_tip(decoded(file.read()), file.name)))

    return upload("CSV file of a measured tip: r, z", ".csv,.txt,text/csv", take)


def title(text_: str) -> Part:
    return text(text_, f"<h2>{text_}</h2>", "title")


class Form:
    """The form: drive, shape, E* and q_c; the rest of the medium folds."""

    def __init__(self, page: Any):
        self._page, self._open, self._in_use, self._notes = page, False, False, {}
        self.view = Parts("form", stylesheets=LAYOUT)

    def rest(self, notes: dict[str, str]) -> None:
        """Take notes (HTML) on regions of the form."""
        self._notes = notes

    def show(self, view: View) -> None:
        state, page = view.state, self._page
        # What differs from the preset is unfolded, once.
        in_use = not {*MEDIUM_CHOICES, *regions(state)["more"]}.isdisjoint(altered(state))
        self._open |= in_use and not self._in_use
        self._in_use = in_use
        likes = {"plastic_depth": float(view.course.turning_point.depth)}
        numbers = {
            region: [page.number(name, likes.get(name, 0.0)) for name in names]
            for region, names in regions(state).items()
        }
        note = {place: text(f"note {place}", self._notes.get(place, "")) for place in _PLACES}
        again = button("Hit again", self._hit_again)
        parts = [
            text("first", f"{_FIRST} {self._notes.get('first', '')}"),
            page.choice("drive"), *numbers["drive"], note["drive"],
            *map(page.choice, state.chosen("drive").form), *[again] * (state.drive == "impact"),
            title("Indenter"), page.choice("shape"), note["shape"], *numbers["shape"],
            title("Medium"), *numbers["medium"], note["medium"],
            button("More about the medium", self._fold, pressed=self._open),
        ]  # fmt: skip
        if self._open:
            parts += [*map(page.choice, MEDIUM_CHOICES), *numbers["more"], note["more"]]
        self.view.show([*parts, title("Tip and sources"), take_tip(page), note["sources"]])

    def _hit_again(self) -> None:
        hit = self._page.shown.course.hit
        self._page.apply(lambda state: changes.hit_again(state, hit))

    def _fold(self) -> None:
        """Open or close the rest of the medium."""
        self._open = not self._open
        self._page.refresh()
