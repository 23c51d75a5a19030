"""Parts of the page, drawn by the browser: buttons, choices, number fields, and the form."""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import panel as pn
import param
from markupsafe import Markup

from mdr_core.show.units import UNITS, Unit, fitting, format_quantity

from ..common.folders import Files
from ..common.process import Refused, Replaced, SynchronousWorker, Worker, queue_text
from ..common.quantities import CHOICES, QUANTITIES, Quantity
from ..common.ui import JS, LAYOUT, WIDE, as_html, html_subscripts, linked, show, symbol
from ..common.units import entry, read
from ..common.upload import TIP_BYTES, Uploaded, in_line
from . import changes
from .changes import option, options
from .plot import View
from .state import FOLDED_CHOICES, PRESETS, State, changed_from_preset, checked, folded, numbers_of, regions

#: Number of letters in all options below which a choice has radio buttons instead of a list.
_SHORT = 48
#: Option of the list of presets for an altered scene, so that the user can choose its preset again.
_ALTERED = "altered"


@dataclass(frozen=True)
class Part:
    """Part of the page: its kind, its name in the component, and its look in the browser.

    `act` gets the message of a user's action.
    """

    kind: str
    name: str
    look: dict[str, Any]
    act: Callable[[Any], None] = lambda message: None


def text(name: str, html: str, classes: str = "note") -> Part:
    """Return a text, or HTML."""
    return Part("text", name, {"object": as_html(html), "classes": classes})


def button(
    label: str, act: Callable[[], None], pressed: bool | None = None, disabled: bool = False, key: str = "",
    opens: str = "",
) -> Part:  # fmt: skip
    """Return a button: `pressed` is None if it does not stay down, `key` is a key of the keyboard.

    A click scrolls the element with the class `opens` into view.
    """
    look = {"label": label, "pressed": pressed, "disabled": disabled, "key": key, "opens": opens}
    return Part("button", label, look, lambda message: None if disabled else act())


def upload(
    label: str, accept: str, take: Callable[[Uploaded], None], refused: str = "", busy: str = ""
) -> Part:
    """Return a field for a file, with the error or the progress of the last file."""
    look = {"label": as_html(label), "accept": accept, "most": TIP_BYTES, "refused": refused, "busy": busy}
    return Part("file", label, look, lambda message: take(Uploaded(**message)))


def choice(name: str, state: State, choose: Callable[[str], None]) -> Part:
    """Return a choice with its explanation, as radio buttons or a list.

    If the scene differs from its preset, the chosen preset is an additional option, "altered".
    """
    chosen = option(state, name)
    pairs = [[each, CHOICES[name].options[each].label] for each in options(state, name)]
    if name == "preset" and changed_from_preset(state):
        chosen = _ALTERED
        pairs.append([_ALTERED, f"{PRESETS[state.preset].label}, altered"])
    look = _about(name) | {"options": pairs, "value": chosen}
    return Part("choice", name, look, choose)


@cache
def _about(name: str) -> dict[str, Any]:
    known = CHOICES[name]
    radio = sum(len(each.label) for each in known.options.values()) < _SHORT
    classes = f"of-{name.replace('.', '-')}"
    return {"label": as_html(known.label), "about": linked(known.help), "radio": radio, "classes": classes}


class Parts(pn.custom.JSComponent):
    """Parts of the page below each other, or in a row (class "bar")."""

    #: Number of answered messages, and looks of the parts; as text, because Bokeh would check each value.
    payload = param.String("[0, []]")

    # The script imports a link, so that the browser loads it once.
    _esm = JS["parts"]

    def __init__(self, *classes: str, **options: Any):
        self.parts: dict[str, Part] = {}
        self._answered = 0
        super().__init__(css_classes=list(classes), **WIDE | options)
        self.on_msg(self._on_message)

    def show(self, parts: list[Part]) -> None:
        """Show only these parts."""
        self.parts = {part.name: part for part in parts}
        self._send()

    def _send(self):
        looks = [{"kind": part.kind, "name": part.name} | part.look for part in self.parts.values()]
        show(self, payload=json.dumps([self._answered, looks], ensure_ascii=False))

    @pn.io.hold()
    def _on_message(self, event):
        """Do the user's action, and answer it even if it fails."""
        name, message = event.data
        self._answered += 1
        # The name may be any value from outside, even a list.
        if part := self.parts.get(str(name)):
            part.act(message)
        self._send()


#: Option of the list of shapes for a file.
_FILE = "file"
_FIRST = "Move a slider. Orange springs have yielded. "


def slider_range(known: Quantity, middle: float, value: float) -> tuple[float, float, float]:
    """Return the lowest, middle and highest value (SI) of the slider of a number.

    The slider covers the span of the number in each direction from a middle value, or from the present
    value if it is out of this range. For span 0 it covers the bounds.
    """
    if known.span <= 0:
        return known.bounds[0], middle, known.bounds[1]
    value = known.bounded(value)
    low, high = (known.bounded(changes.shown(end)) for end in (middle / known.span, middle * known.span))
    return (low, middle, high) if low <= value <= high else slider_range(known, value, value)


class Field:
    """Memory of a number field: its unit, the middle of its slider, and the error of its last entry."""

    def __init__(self, name: str, page: Any):
        self._name, self._page, self._known = name, page, QUANTITIES[name]
        self._static_look = _static_look(self._known)
        # The last shown number and its preset.
        self._value, self._preset = self._known.default, ""
        self.refused = ""

    def part(self, state: State, like: float = 0.0) -> Part:
        """Return the field with the number of a state; zero has the unit that fits the value `like`.

        The unit fits the preset's number until the user types another unit. Later changes keep the unit
        unless another unit is easier to read: 2 m/s, not 2000 mm/s. An error message stays until the number
        changes.
        """
        value = checked(self._name, state[self._name])
        loaded = state.preset != self._preset
        changed = loaded or value != self._value
        if loaded:
            self._middle = PRESETS[state.preset].values.get(self._name, value)
        if loaded or (changed and not _reads_well(value, self._unit)):
            self._unit = fitting(value, self._known.kind, like)
        if changed:
            self.refused = ""
        self._value, self._preset = value, state.preset
        # The middle of the slider stays while it moves.
        low, self._middle, high = slider_range(self._known, self._middle, value)
        look = {"text": entry(value, self._unit), "refused": self.refused, "value": value}
        look |= {"low": low, "middle": self._middle, "high": high}
        look["ends"] = [format_quantity(end, self._known.kind, 3) for end in (low, high)]
        return Part("number", self._name, self._static_look | look, self._take)

    def _take(self, message: Any) -> None:
        """Take a typed number, or the value (SI) of the slider; show an error next to it."""
        self.refused, dragged = "", False
        self._typed = self._unit
        match message:
            case {"text": str(entered)}:
                self._page.apply(partial(self._read, entered), self._refuse)
            case {"value": int() | float() as value} if abs(value) < 1e300:
                dragged = "dragged" in message
                change = partial(changes.set_value, name=self._name, value=value)
                self._page.apply(change, self._refuse, self._name * dragged)
        if not (self.refused or dragged):
            # The typed unit replaces the unit that fits the number, which the field shows meanwhile.
            self._unit = self._typed
            self._page.refresh()

    def _read(self, entered: str, state: State) -> State:
        value, self._typed = read(entered, self._known.kind, self._unit)
        return changes.set_value(state, self._name, value)

    def _refuse(self, text: str) -> None:
        self.refused = text


def _reads_well(value: float, unit: Unit) -> bool:
    """Whether a value (SI) in a unit has at most three digits before the point and two zeros after it."""
    return value == 0 or 1e-3 <= abs(value) / unit.factor < 1e3 * (1 - 1e-9)


def _static_look(known: Quantity) -> dict[str, Any]:
    """Return the fixed part of a number's look: label, explanation and span."""
    low, high = (format_quantity(bound, known.kind, 2) for bound in known.bounds)
    units = ", ".join(unit.name for unit in UNITS[known.kind] if unit.name)
    rows = [linked(known.help)]
    rows.append(Markup("<em>{}</em>").format(linked(known.equation)) if known.equation else "")
    rows.append(Markup("Usual: {}.").format(html_subscripts(known.typical)) if known.typical else "")
    rows.append(f"From {low} to {high}" + (f"; units {units}." if units else "."))
    return {
        "label": Markup("{} {}").format(symbol(known.symbol), html_subscripts(known.label)),
        "spoken": as_html(f"{known.symbol}, {known.label}"),
        "about": Markup("").join(Markup("<p>{}</p>").format(row) for row in rows if row),
        "span": known.span,
    }


def title(text_: str) -> Part:
    return text(text_, Markup("<h2>{}</h2>").format(text_), "title")


class Form:
    """Form: drive, shape, E*, the law of the hardness and its constant; a fold has the rest."""

    def __init__(self, page: Any):
        self._page, self._open = page, {"more": False, "tip": False}
        # Folded values that differ from the preset.
        self._altered: set[str] = set()
        # Error of the last file of a tip, or its progress.
        self._tip_refused = self._tip_busy = ""
        self._files, self._worker = Files(), Worker() if page.host.processes else SynchronousWorker()
        page.host.on_close(self._end_reading)
        self.view = Parts("form", stylesheets=LAYOUT)

    def show(self, view: View) -> None:
        state, page = view.state, self._page
        # An imprint of zero depth has the unit of the present depth.
        depth = float(view.course.turning_point.depth)
        named = regions(state)
        in_fold = named.pop("more")
        numbers = {region: [page.number(name, depth) for name in names] for region, names in named.items()}
        notes = page.notes(view)

        def note(place: str, before: str = "") -> Part:
            found = (each.get(place, "") for each in notes)
            return text(f"note {place}", Markup("").join((before, *found)))

        again = button("Hit again", partial(page.apply, changes.repeat_impact))
        # Unfold values that begin to differ from the preset, except moduli that follow a typed E*.
        now = {*FOLDED_CHOICES, *in_fold}.intersection(changed_from_preset(state)) - {"E_1", "E_2"}
        opened = self._open["more"] = self._open["more"] or bool(now - self._altered)
        self._altered = now
        modulus, *constant = numbers["medium"]
        # The numbers of an option are below its choice.
        more = []
        for choice in FOLDED_CHOICES if opened else ():
            names = (name for name in numbers_of(state, choice) if name in in_fold)
            more += [page.choice(choice), *(page.number(name, depth) for name in names)]
        more += [page.number(name, depth) for name in folded(state)] if opened else []
        with_tip = self._open["tip"] or state.shape == "sampled" or self._tip_refused or self._tip_busy
        parts = [
            note("first", _FIRST),
            page.choice("drive"), *numbers["drive"], note("drive"),
            *self._form(state, "drive"), note("form"), *[again] * (state.drive == "impact"),
            title("Indenter"), self._shape(state), *[self.tip()] * bool(with_tip), note("shape"),
            *numbers["shape"],
            title("Medium"), modulus, page.choice("plasticity"), *constant, *numbers["hardness"],
            note("medium"),
            button("More about the medium", self._fold, pressed=opened, key="fold"),
            *more, *[note("more"), note("sources")] * opened,
        ]  # fmt: skip
        self.view.show(parts)

    def _form(self, state: State, choice: str) -> Iterator[Part]:
        """Yield the choices of the chosen option, each with the numbers and choices of its option."""
        for name in state.chosen(choice).form:
            yield self._page.choice(name)
            yield from map(self._page.number, state.chosen(name).uses)
            yield from self._form(state, name)

    def _shape(self, state: State) -> Part:
        """Return the list of shapes, with an option for the file of a measured tip if there is no tip."""
        shapes = self._page.choice("shape")
        if state.samples:
            return shapes
        pairs = [*shapes.look["options"], [_FILE, "Measured tip: a file"]]

        def choose(option):
            self._open["tip"] = option == _FILE
            if option != _FILE:
                shapes.act(option)
            self._page.refresh()

        return Part("choice", "shape", shapes.look | {"options": pairs}, choose)

    def tip(self) -> Part:
        """Return the field for the file of a measured tip, with the error of the last file."""
        label = "CSV file of a measured tip: r, z"
        return upload(label, ".csv,.txt,text/csv", self._take_tip, self._tip_refused, self._tip_busy)

    def _take_tip(self, file: Uploaded) -> None:
        try:
            data = file.read()
        except ValueError as error:
            self._tip_refused = str(error)
            return
        self._page.host.run(partial(self._read_tip, in_line(file.name), data))

    async def _read_tip(self, name: str, data: bytes) -> None:
        """Read a tip in a process that ends after its answer."""
        self._show_busy(f"Reading {name}")
        try:
            path = self._files.keep(data)
            samples, note = await self._worker.run(
                "common.tip.read", path, name, waits=lambda before: self._show_busy(queue_text(before))
            )
        except Replaced:
            return
        except Refused as error:
            self._tip_refused = error.text
        else:
            self._page.apply(lambda state: changes.take_tip(state, samples, note), self._refuse_tip)
        self._tip_busy = ""
        self._end_reading()
        self._page.refresh()

    def _show_busy(self, text: str) -> None:
        self._tip_refused, self._tip_busy = "", f"{text} …"
        self._page.refresh()

    def _end_reading(self) -> None:
        """End the process, and remove the file."""
        self._worker.stop()
        self._files.clear()

    def _refuse_tip(self, text: str) -> None:
        self._tip_refused = text

    def _fold(self) -> None:
        """Open or close the rest of the medium."""
        self._open["more"] = not self._open["more"]
        self._page.refresh()
