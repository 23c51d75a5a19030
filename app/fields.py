"""The form: number fields and choices, each with symbol, name, unit and explanation."""

from collections.abc import Callable
from functools import partial
from html import escape
from math import atan, degrees
from typing import Any

import panel as pn
import param

from mdr_core.profiles.samples import decoded

from . import changes
from .changes import option, options
from .courses import Course
from .plot import View
from .quantities import ABOUT, CHOICES, LABELS, OF_DRIVE, QUANTITIES, SHAPES, Scale
from .readouts import law_of_hardness
from .state import MEDIUM_CHOICES, PRESETS, State, altered, regions
from .tip import MAX_BYTES, Uploaded, read_tip
from .ui import JS, WIDE, button, html, linked, marked, reveal, show, symbol
from .units import UNITS, digits, entry, fitting, read, with_symbol, written

#: Standard acceleration of free fall (m/s²).
_GRAVITY = 9.80665
#: Option of the list of presets for a scene that is none of them, so that its preset can be chosen again.
_ALTERED = "altered"
#: Letters of all options of a choice below which it is shown as radio buttons, else as a list.
_SHORT = 48


def _about(known: Any) -> str:
    low, high = (written(bound, known.kind, 2) for bound in known.bounds)
    units = ", ".join(unit.name for unit in UNITS[known.kind] if unit.name)
    rows = [linked(known.help), f"<em>{linked(known.equation)}</em>" if known.equation else ""]
    rows.append(f"Usual: {marked(known.typical)}." if known.typical else "")
    rows.append(f"From {low} to {high}" + (f"; units {units}." if units else "."))
    return "".join(f"<p>{row}</p>" for row in rows if row)


class Number(pn.custom.JSComponent):
    """A field and slider for a number.

    `apply_or_raise` takes a function from state to state, and a mark that joins steps of undo.
    """

    label, spoken, about = param.String(), param.String(), param.String()
    text, refused = param.String(), param.String()
    position, steps, answered = param.Integer(), param.Integer(), param.Integer()

    _esm = JS["quantity"]

    def __init__(self, name: str, apply_or_raise: Callable[..., None]):
        known = QUANTITIES[name]
        self.key, self._apply_or_raise, self._preset = name, apply_or_raise, ""
        self._scale, self._unit = Scale(known, known.default), fitting(known.default, known.kind)
        # The number as it was shown, and whether the next one was typed or dragged here.
        self._value, self._asked = known.default, False
        steps, label = Scale.STEPS * (known.span >= 0), f"{symbol(known.symbol)} {marked(known.label)}"
        texts = {"label": label, "spoken": f"{known.symbol}, {known.label}", "about": _about(known)}
        super().__init__(css_classes=["number"], steps=steps, **texts, **WIDE)
        self.on_msg(self._on_message)

    def _on_message(self, event):
        refused, unit, self._asked = "", self._unit, "reset" not in event.data
        with pn.io.hold():
            try:
                self._change(event.data)
            except ValueError as error:
                refused, self._unit = str(error), unit
            self._asked = False
            # A number in another unit may be the present one, so that nothing else shows the unit.
            text = entry(self._value, self._unit)
            self.param.update(text=text, refused=refused, answered=event.data["number"])

    def _change(self, message):
        if isinstance(message.get("text"), str):
            value, self._unit = read(message["text"], QUANTITIES[self.key].kind, self._unit)
            self._apply_or_raise(lambda state: changes.put(state, self.key, value))
        elif isinstance(message.get("position"), int | float):
            value = self._scale.value(message["position"])
            self._apply_or_raise(lambda state: changes.put(state, self.key, value), self.key)
        elif "reset" in message:
            self._apply_or_raise(lambda state: changes.put(state, self.key, self._scale.middle))

    def show(self, state: State, like: float = 0.0) -> None:
        """Show a number; zero in the unit that fits the value `like`.

        The unit is that of the preset's number until another one is typed. What others change is shown in
        it, too, unless that takes a power of ten. A refusal stays until the number changes.
        """
        known, value = QUANTITIES[self.key], state[self.key]
        changed = value != self._value and not self._asked
        if self._preset != state.preset or (changed and not self._unit.fits(value)):
            self._unit = fitting(value, known.kind, like)
        if value != self._value or self._preset != state.preset:
            show(self, refused="")
        self._value = value
        # The middle of the slider stays while it moves.
        if self._preset != state.preset or not self._scale.reaches(value):
            middle = PRESETS[state.preset].values.get(self.key, value)
            self._scale, self._preset = Scale.about(known, middle, value), state.preset
        text, position = entry(value, self._unit), self._scale.position(value)
        show(self, text=text, position=position)


class Numbers(pn.Column):
    """A column of number fields; one is made when it is used for the first time, and stays."""

    def __init__(self, apply_or_raise: Callable[..., None]):
        super().__init__(css_classes=["numbers"], **WIDE)
        self._apply_or_raise = apply_or_raise

    def show(self, state: State, names: list[str], likes: dict[str, float] | None = None) -> None:
        for name in names:
            if name not in [each.key for each in self]:
                self.append(Number(name, self._apply_or_raise))
        for each in self:
            if each.key in names:
                each.show(state, (likes or {}).get(each.key, 0.0))
            show(each, visible=each.key in names)

    def forget(self) -> None:
        """Show the present numbers instead of refused ones."""
        for each in self:
            show(each, refused="")


class Upload(pn.custom.JSComponent):
    """A field for a file; `take` is called with each as an `Uploaded`."""

    label, accept, most = param.String(), param.String(), param.Integer(MAX_BYTES)

    _esm = JS["upload"]

    def __init__(self, label: str, accept: str, take: Callable[[Uploaded], None]):
        super().__init__(label=label, accept=accept, css_classes=["file"], **WIDE)
        self.on_msg(lambda event: take(Uploaded(**event.data)))


class Choice(pn.custom.JSComponent):
    """A choice with its explanation: radio buttons or a list; `choose` is called with the option."""

    label, about, value = param.String(), param.String(), param.String()
    options, radio, answered = param.List(), param.Boolean(), param.Integer()

    _esm = JS["choice"]

    def __init__(self, name: str, choose: Callable[[str], None]):
        self._choose = choose
        look = {"css_classes": [f"of-{name.replace('.', '-')}"], "label": LABELS[name], **WIDE}
        radio = sum(map(len, CHOICES[name].values())) < _SHORT
        super().__init__(about=linked(ABOUT[name]), radio=radio, **look)
        self.on_msg(self._on_message)

    def _on_message(self, event):
        if event.data in [option for option, _ in self.options]:
            self._choose(event.data)
        self.answered += 1


class Choices:
    """Choices of a session by name, made when first used."""

    def __init__(self, apply: Callable[..., None], state: Callable[[], State]):
        self._apply, self._state = apply, state
        self.rows: dict[str, Choice] = {}

    def row(self, name: str) -> Choice:
        if name not in self.rows:
            self.rows[name] = Choice(name, partial(self.choose, name))
            self._show(name)
        return self.rows[name]

    def choose(self, name: str, option: str) -> None:
        """Take another option."""
        if option != self._chosen(name):
            self._apply(lambda state: changes.choose(state, name, option))

    def _chosen(self, name):
        """Option that is shown; none of the presets if the scene differs from all."""
        state = self._state()
        return _ALTERED if name == "preset" and altered(state) else option(state, name)

    def _options(self, name):
        """Options with their texts."""
        state = self._state()
        pairs = [[option, CHOICES[name][option]] for option in options(state, name)]
        if self._chosen(name) == _ALTERED:
            pairs.append([_ALTERED, f"altered, from: {PRESETS[state.preset].label}"])
        return pairs

    def _show(self, name):
        show(self.rows[name], options=self._options(name), value=self._chosen(name))

    def show(self, state: State) -> None:
        for name in self.rows:
            self._show(name)


class Form:
    """The form: drive, shape, E* and q_c; the rest of the medium folds, and is made when it is opened."""

    def __init__(self, page: Any):
        self._page, self._in_use, choices = page, False, page.choices
        self.numbers = {name: page.numbers() for name in ("drive", "shape", "medium", "more")}
        self.notes = {name: html() for name in (*self.numbers, "sources")}
        self.again = button("Hit again", width=90)
        self.again.on_click(
            lambda event: page.apply(lambda state: changes.hit_again(state, page.shown.course.hit))
        )
        self.tip = Upload("CSV file of a measured tip: r, z", ".csv,.txt,text/csv", self._take_tip)
        look = {"css_classes": ["button", "more"], "margin": (4, 0)}
        self.more = pn.widgets.Toggle(label="More about the medium", **look)
        self._folded = pn.Column(self.more, **WIDE)
        self.more.param.watch(lambda event: self._fold(event.new), "value")
        self._forms = pn.Column(**WIDE)
        drive = (choices.row("drive"), self.numbers["drive"], self.notes["drive"], self._forms)
        shape = (choices.row("shape"), self.notes["shape"], self.numbers["shape"])
        medium = (self.numbers["medium"], self.notes["medium"], self._folded)
        sources = (self.tip, self.notes["sources"])
        heads = [html(f"<h2>{text}</h2>", "title") for text in ("Indenter", "Medium", "Tip and sources")]
        parts = (*drive, heads[0], *shape, heads[1], *medium, heads[2], *sources)
        self.view = pn.Column(*parts, css_classes=["form"], **WIDE)

    def _take_tip(self, file: Uploaded) -> None:
        def change(state):
            return changes.take_tip(state, *read_tip(decoded(file.read()), file.name))

        self._page.apply(change)

    def _fold(self, open_: bool) -> None:
        if len(self._folded) == 1:
            rows = map(self._page.choices.row, MEDIUM_CHOICES)
            self._folded.append(pn.Column(*rows, self.numbers["more"], self.notes["more"], **WIDE))
        show(self._folded[1], visible=open_)

    def show(self, view: View) -> None:
        """Show the numbers and choices in use."""
        state, course = view.state, view.course
        parts = [self._page.choices.row(name) for name in OF_DRIVE[state.drive]["form"]]
        parts += [self.again] * (state.drive == "impact")
        for part in (*self._forms, *parts):
            reveal(self._forms, part, part in parts)
        numbers = regions(state)
        for region, names in numbers.items():
            self.numbers[region].show(state, names, {"plastic_depth": float(course.turning_point.depth)})
        in_use = bool({*MEDIUM_CHOICES, *numbers["more"]} & set(altered(state)))
        if in_use and not self._in_use:
            show(self.more, value=True)
        self._in_use = in_use

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
        slope = getattr(state, f"{state.shape}_slope", None)
        angle = f"Half-angle {digits(90 - degrees(atan(slope)))}°" if slope is not None else ""
        eta, tau = written(made.eta, "viscosity"), written(made.relaxation_time, "time")
        idle = "" if course.dashpots else "; no effect here: pressing is quasi-static"
        texts = {
            "drive": f"Energy {energy}; speed of a fall from {height}" * (state.drive == "impact"),
            "shape": f"<figcaption>{marked(shape.height)}<br>{marked(shape.reduced)}</figcaption>"
            + marked(state.tip_note if state.shape == "sampled" else angle),
            "medium": linked(law_of_hardness(course)),
            "more": linked(f"η = {eta}, τ = 4η/E* = {tau} (1){idle}") if made.eta > 0 else "",
            "sources": f"<details><summary>{title}</summary><dl>{sources}</dl></details>",
        }
        for name, text in texts.items():
            show(self.notes[name], object=text)
