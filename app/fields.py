"""The form: number fields and choices, each with symbol, name, unit and explanation."""

from collections.abc import Callable
from functools import cache, partial
from html import escape
from math import degrees
from typing import Any

import panel as pn

from mdr_core.profiles.samples import decoded
from mdr_core.results.units import UNITS, digits, entry, fitting, read, written

from . import changes
from .changes import option, options
from .courses import Course
from .parts import Button, Group, Part, Parts, Text
from .plot import View
from .quantities import ABOUT, CHOICES, LABELS, OF_DRIVE, QUANTITIES, SHAPES, Scale, with_symbol
from .readouts import law_of_hardness
from .state import MEDIUM_CHOICES, PRESETS, State, altered, regions
from .tip import MAX_BYTES, Uploaded, read_tip
from .ui import linked, marked, symbol

#: Standard acceleration of free fall (m/s²).
_GRAVITY = 9.80665
#: Option of the list of presets for a scene that is none of them, so that its preset can be chosen again.
_ALTERED = "altered"
#: Letters of all options of a choice below which it is shown as radio buttons, else as a list.
_SHORT = 48


@cache
def _about(known: Any) -> str:
    low, high = (written(bound, known.kind, 2) for bound in known.bounds)
    units = ", ".join(unit.name for unit in UNITS[known.kind] if unit.name)
    rows = [linked(known.help), f"<em>{linked(known.equation)}</em>" if known.equation else ""]
    rows.append(f"Usual: {marked(known.typical)}." if known.typical else "")
    rows.append(f"From {low} to {high}" + (f"; units {units}." if units else "."))
    return "".join(f"<p>{row}</p>" for row in rows if row)


class Number(Part):
    """A field and slider for a number.

    `apply_or_raise` takes a function from state to state, and a mark that joins steps of undo.
    """

    KIND = "number"
    LOOK = ("text", "refused", "position", "answered")

    def __init__(self, name: str, apply_or_raise: Callable[..., None]):
        known = QUANTITIES[name]
        self.key, self._apply_or_raise, self._preset = name, apply_or_raise, ""
        self._scale = Scale.about(known, known.default, known.default)
        self._unit = fitting(known.default, known.kind)
        # The number as it was shown, and whether the next one was typed or dragged here.
        self._value, self._asked = known.default, False
        self.text, self.refused, self.position, self.answered = "", "", 0, 0
        label, spoken = f"{symbol(known.symbol)} {marked(known.label)}", f"{known.symbol}, {known.label}"
        steps = Scale.STEPS * (known.span >= 0)
        super().__init__(label=label, spoken=spoken, about=_about(known), steps=steps)

    def take(self, message: Any) -> None:
        refused, unit, self._asked = "", self._unit, "reset" not in message
        with pn.io.hold():
            try:
                self._change(message)
            except ValueError as error:
                refused, self._unit = str(error), unit
            self._asked = False
            # A number in another unit may be the present one, so that nothing else shows the unit.
            text = entry(self._value, self._unit)
            self.show(text=text, refused=refused, answered=message["number"])

    def _change(self, message):
        if isinstance(message.get("text"), str):
            value, self._unit = read(message["text"], QUANTITIES[self.key].kind, self._unit)
            self._apply_or_raise(lambda state: changes.put(state, self.key, value))
        elif isinstance(message.get("position"), int | float):
            value = self._scale.value(message["position"])
            self._apply_or_raise(lambda state: changes.put(state, self.key, value), self.key)
        elif "reset" in message:
            self._apply_or_raise(lambda state: changes.put(state, self.key, self._scale.middle))

    def update(self, state: State, like: float = 0.0) -> None:
        """Show the number of a state; zero in the unit that fits the value `like`.

        The unit is that of the preset's number until another one is typed. What others change is shown in
        it, too, unless that takes a power of ten. A refusal stays until the number changes.
        """
        known, value = QUANTITIES[self.key], state[self.key]
        changed = value != self._value and not self._asked
        if self._preset != state.preset or (changed and not self._unit.fits(value)):
            self._unit = fitting(value, known.kind, like)
        refused = "" if value != self._value or self._preset != state.preset else self.refused
        self._value = value
        # The middle of the slider stays while it moves.
        middle = self._scale.middle
        if self._preset != state.preset:
            middle, self._preset = PRESETS[state.preset].values.get(self.key, value), state.preset
        self._scale = Scale.about(known, middle, value)
        text, position = entry(value, self._unit), self._scale.position(value)
        self.show(text=text, position=position, refused=refused)


class Numbers(Group):
    """Number fields below each other; one is made when it is used for the first time, and stays."""

    def __init__(self, apply_or_raise: Callable[..., None]):
        super().__init__()
        self._apply_or_raise = apply_or_raise

    def update(self, state: State, names: list[str], likes: dict[str, float] | None = None) -> None:
        """Show some numbers of a state."""
        made = {each.key: each for each in self.parts}
        parts = [made.get(name) or Number(name, self._apply_or_raise) for name in names]
        for each in parts:
            each.update(state, (likes or {}).get(each.key, 0.0))
        self.show(parts)

    def forget(self) -> None:
        """Show the present numbers instead of refused ones."""
        for each in self.parts:
            each.show(refused="")


class Upload(Part):
    """A field for a file; `take` is called with each as an `Uploaded`."""

    KIND = "file"

    def __init__(self, label: str, accept: str, take: Callable[[Uploaded], None]):
        super().__init__(label=label, accept=accept, most=MAX_BYTES)
        self._take = take

    def take(self, message: Any) -> None:
        self._take(Uploaded(**message))


class Choice(Part):
    """A choice with its explanation: radio buttons or a list; `choose` is called with the option."""

    KIND = "choice"
    LOOK = ("options", "value", "answered")

    def __init__(self, name: str, choose: Callable[[str], None]):
        self.key, self._choose, self.answered = name, choose, 0
        self.options, self.value = [], ""
        radio = sum(map(len, CHOICES[name].values())) < _SHORT
        about, classes = linked(ABOUT[name]), f"of-{name.replace('.', '-')}"
        super().__init__(label=LABELS[name], about=about, radio=radio, classes=classes)

    def take(self, message: Any) -> None:
        if message in [option for option, _ in self.options]:
            self._choose(message)
        self.show(answered=self.answered + 1)

    def update(self, state: State) -> None:
        """Show the options of a state; no preset is chosen if the scene differs from all."""
        chosen = option(state, self.key)
        pairs = [[each, CHOICES[self.key][each]] for each in options(state, self.key)]
        if self.key == "preset" and altered(state):
            chosen = _ALTERED
            pairs.append([_ALTERED, f"altered, from: {PRESETS[state.preset].label}"])
        self.show(options=pairs, value=chosen)


class Choices:
    """Choices of a session by name, made when first used."""

    def __init__(self, apply: Callable[..., None], state: Callable[[], State]):
        self._apply, self._state = apply, state
        self.made: dict[str, Choice] = {}

    def part(self, name: str) -> Choice:
        if name not in self.made:
            self.made[name] = Choice(name, partial(self.choose, name))
            self.made[name].update(self._state())
        return self.made[name]

    def choose(self, name: str, option: str) -> None:
        """Take another option."""
        if option != self.part(name).value:
            self._apply(lambda state: changes.choose(state, name, option))

    def show(self, state: State) -> None:
        for each in self.made.values():
            each.update(state)


class Form:
    """The form: drive, shape, E* and q_c; the rest of the medium folds, and is made when it is opened."""

    def __init__(self, page: Any):
        self._page, self._in_use, choice = page, False, page.choices.part
        self.numbers = {name: page.numbers() for name in ("drive", "shape", "medium", "more")}
        self.notes = {name: Text() for name in (*self.numbers, "sources")}
        self.again = Button(
            "Hit again", lambda: page.apply(lambda state: changes.hit_again(state, page.shown.course.hit))
        )
        self.tip = Upload("CSV file of a measured tip: r, z", ".csv,.txt,text/csv", self._take_tip)
        self.more = Button("More about the medium", self._fold, pressed=False)
        self._of_drive, self._of_medium = Group(), Group()
        first = Text(object="Move a slider or drag the indenter by ●: orange springs have yielded.")
        drive = (first, choice("drive"), self.numbers["drive"], self.notes["drive"], self._of_drive)
        shape = (choice("shape"), self.notes["shape"], self.numbers["shape"])
        medium = (self.numbers["medium"], self.notes["medium"], self.more, self._of_medium)
        medium += (self.numbers["more"], self.notes["more"])
        sources = (self.tip, self.notes["sources"])
        heads = [
            Text("title", object=f"<h2>{text}</h2>") for text in ("Indenter", "Medium", "Tip and sources")
        ]
        parts = (*drive, heads[0], *shape, heads[1], *medium, heads[2], *sources)
        self.view = Parts(*parts, classes=("form",))

    def _take_tip(self, file: Uploaded) -> None:
        def change(state):
            return changes.take_tip(state, *read_tip(decoded(file.read()), file.name))

        self._page.apply(change)

    def _fold(self) -> None:
        """Open or close the rest of the medium."""
        self.more.show(pressed=not self.more.pressed)
        self._show_numbers(self._page.shown)

    def show(self, view: View) -> None:
        """Show the numbers and choices in use."""
        used = {*MEDIUM_CHOICES, *regions(view.state)["more"]} & set(altered(view.state))
        if used and not self._in_use:
            self.more.show(pressed=True)
        self._in_use = bool(used)
        self._show_numbers(view)

    def _show_numbers(self, view):
        state, choice, open_ = view.state, self._page.choices.part, bool(self.more.pressed)
        likes = {"plastic_depth": float(view.course.turning_point.depth)}
        for region, names in regions(state).items():
            self.numbers[region].update(state, names if region != "more" or open_ else [], likes)
        self.notes["more"].show(visible=open_)
        self._of_medium.show([choice(name) for name in MEDIUM_CHOICES] if open_ else [])
        parts = [choice(name) for name in OF_DRIVE[state.drive]["form"]]
        self._of_drive.show([*parts, *[self.again] * (state.drive == "impact")])

    def show_texts(self, state: State, course: Course) -> None:
        """Update the texts."""
        preset, shape, made = PRESETS[state.preset], SHAPES[state.shape], course.scene.medium
        sources = ""
        for name, text in preset.sources.items():
            value = marked(with_symbol(name, preset.values[name]))
            sources += f"<dt>{value}</dt><dd>{escape(text)}</dd>"
        title = f"{'Altered. ' if altered(state) else ''}Where the preset's numbers come from"
        energy = written(state.mass * state.speed**2 / 2, "energy")
        height = written(state.speed**2 / (2 * _GRAVITY), "length")
        angle = f"Half-angle {digits(degrees(course.half_angle))}°" if course.half_angle else ""
        eta, tau = written(made.eta, "viscosity"), written(made.relaxation_time, "time")
        idle = "" if course.dashpots else "; no effect here, where pressing is quasi-static"
        texts = {
            "drive": f"Energy {energy}; equivalent drop height {height}" * (state.drive == "impact"),
            "shape": f"<figcaption>{marked(shape.height)}<br>{marked(shape.reduced)}</figcaption>"
            + marked(state.tip_note if state.shape == "sampled" else angle),
            "medium": linked(law_of_hardness(course)),
            "more": linked(f"η = {eta}, τ = 4η/E* = {tau} (1){idle}") if made.eta > 0 else "",
            "sources": f"<details><summary>{title}</summary><dl>{sources}</dl></details>",
        }
        for name, text in texts.items():
            self.notes[name].show(object=text)
