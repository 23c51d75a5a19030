"""Numbers that are typed with their units, and other fields of the left column."""

from collections.abc import Callable
from typing import Any

import panel as pn
from markupsafe import Markup

from mdr_core.show.units import UNITS, Unit, fitting

from ..ui import WIDE, html, show
from ..units import entry, read
from . import words
from .setting import Number

#: Units of numbers that have no value yet.
_FIRST = {
    "radius": "µm", "half_angle": "°", "tip_modulus": "GPa", "spring_constant": "N/m", "sensitivity": "nm",
    "drift": "nm/s", "frame": "nm/mN", "depth_noise": "nm", "contact_point": "nm",
}  # fmt: skip
_REFUSED = Markup('<p class="refused" role="alert">{}</p>')
#: Headings of a part of the column, and of a group in it.
_PART, GROUP = Markup("<h2>{}</h2>"), Markup('<h3 class="group">{}</h3>')


def field(kind: Any, *classes: str, **options: Any) -> Any:
    """A widget of Panel that looks like those of the explorer."""
    return kind(css_classes=["choice", *classes], **WIDE | options)


class Typed:
    """A number that is typed with its unit; a refusal stands below it."""

    def __init__(self, name: str, known: Number, take: Callable[[float], None]):
        self._known, self._take, self._name = known, take, name
        self._value: float | None = None
        # The value that was typed last, and its unit, in which it stays: a browser may tell a number twice,
        # which has to be the same without a unit, too.
        self._typed_as: tuple[float, Unit] | None = None
        self._text = ""
        self._empty = f"… {self._unit().name}" if self._unit().name else "type a value"
        self.field = field(pn.widgets.TextInput, "typed", label="", placeholder=self._empty)
        self.said = html("", "note")
        self.label = html(Markup("<label>{}</label>").format(words.name_html(known)), "name")
        self.row = pn.Row(self.label, self.field, css_classes=["fields"], **WIDE)
        self.view = pn.Column(self.row, self.said, css_classes=["typed-number", f"to-{name}"], **WIDE)
        self.field.param.watch(self._typed, "value")

    def show(self, value: float | None, **options: Any) -> None:
        """Show a value (SI), or an empty field."""
        self._value = value
        self._text = "" if value is None else entry(value, self._unit(value))
        show(self.said, object="")
        show(self.field, value=self._text, **options)

    @property
    def zero(self) -> str:
        """0 with its unit."""
        return entry(0.0, self._unit())

    def _unit(self, value: float = 0.0) -> Unit:
        """The unit of a value, and of the first one that is typed."""
        if self._typed_as is not None and value == self._typed_as[0]:
            return self._typed_as[1]
        units = {unit.name: unit.factor for unit in UNITS[self._known.kind]}
        return fitting(value, self._known.kind, units.get(_FIRST.get(self._name, ""), 0.0))

    def _typed(self, event: Any) -> None:
        if event.new == self._text:
            return
        try:
            value, unit = read(event.new, self._known.kind, self._unit(self._value or 0.0))
            value = self._known.checked(value)
        except ValueError as error:
            show(self.said, object=_REFUSED.format(words.sentence(str(error))))
            return
        self._typed_as = value, unit
        self._take(value)


def heading(text: str, of: Markup = _PART) -> Any:
    """A heading of a part of the column."""
    return html(of.format(text), "title")
