"""Widgets of the page: number with unit, field for a file, list and fold."""

from collections.abc import Callable
from typing import Any, ClassVar

import panel as pn
import param
from bokeh.models.dom import HTML
from markupsafe import Markup

from mdr_core.show.units import UNITS, fitting

from ..common.ui import WIDE, field, html, html_subscripts, show
from ..common.units import entry, read
from ..common.upload import PART_BYTES, SESSION_BYTES, Uploads
from .choices import Number

#: Message of an error.
ERROR = Markup('<p class="refused" role="alert">{}</p>')
_LABEL = Markup("<span><i>{}</i> {}</span>")


def select(label: str, options: Any, *classes: str) -> Any:
    """Return a drop-down list."""
    return field(pn.widgets.Select, *classes, label=label, options=options)


def fold(title: str, *parts: Any, **options: Any) -> Any:
    """Return a card that folds."""
    return pn.Card(*parts, title=title, **{"collapsed": True, "css_classes": ["fold"]} | WIDE | options)


class UnitInput(pn.widgets.TextInput):
    """Number field with a unit, such as "10 µm"; `si` is its value, None while the field is empty.

    `error` is the reason why the last text was rejected, shown below the field.
    """

    si = param.Number(None, allow_None=True)
    error = param.String("")
    _rename: ClassVar[dict[str, Any]] = {"si": None, "error": None}

    def __init__(self, known: Number, **options: Any):
        self._units = {unit.name: unit for unit in UNITS[known.kind]}
        self._known, self._first = known, self._units.get(known.unit) or fitting(0.0, known.kind, 1.0)
        self._unit = self._first
        empty = f"… {self._unit.name}" if self._unit.name else "type a value"
        super().__init__(label=f"{known.symbol} {known.label}", placeholder=empty, **WIDE | options)
        self.param.watch(self._typed, "value")
        self.param.watch(self._show, "si")

    def set(self, si: float | None) -> None:
        """Set the value, which also replaces a rejected text."""
        self.si, self._unit = si, self._first
        self._show()

    def hint(self, text: str) -> None:
        """Show a text in the empty field; a number without a unit has the unit of the text."""
        if self.si is None:
            self._unit = self._units.get(text.rpartition(" ")[2], self._first)
        show(self, placeholder=text)

    def _process_param_change(self, params: dict[str, Any]) -> dict[str, Any]:
        found = super()._process_param_change(params)
        if "title" in found:
            # Bokeh accepts HTML, which indices of symbols need; Panel only text.
            title = _LABEL.format(html_subscripts(self._known.symbol), self._known.label)
            found["title"] = HTML(html=[title])
        return found

    def _typed(self, event: Any) -> None:
        if event.new == self._text(self.si):
            self.error = ""
            return
        try:
            value = self._read(event.new) if event.new.strip() else None
        except ValueError as error:
            self.error = str(error)
            return
        self.param.update(si=value, error="")
        self._show()

    def _read(self, text: str) -> float:
        known = self._known
        value, unit = read(text, known.kind, self._unit)
        if not known.low <= value <= known.high:
            low, high = (entry(end, fitting(end, known.kind)) for end in (known.low, known.high))
            raise ValueError(f"{known.label} {text} must be from {low} to {high}")
        self._unit = unit
        return value

    def _text(self, value: float | None) -> str:
        if value and not 1e-3 <= abs(value) / self._unit.factor < 1e4:
            self._unit = fitting(value, self._known.kind)
        return "" if value is None else entry(value, self._unit)

    def _show(self, *events: Any) -> None:
        self.param.update(value=self._text(self.si), error="")


def show_errors(column: pn.Column) -> pn.Column:
    """Show the error of each number field in a column below the field."""

    errors: dict[UnitInput, Any] = {}

    def changed(event: Any) -> None:
        old = errors.pop(event.obj, None)
        parts = [each for each in column if each is not old]
        if event.new:
            errors[event.obj] = html(ERROR.format(event.new), "note")
            parts.insert(parts.index(event.obj) + 1, errors[event.obj])
        column.objects = parts

    for each in column:
        if isinstance(each, UnitInput):
            each.param.watch(changed, "error")
    return column


class FileField(pn.widgets.FileDropper):
    """Field for a file of bounded size, which arrives in parts.

    `take` gets name, data and start time of a file, as `Uploads.add` returns them; `refuse` gets an error.
    """

    def __init__(
        self,
        uploads: Uploads,
        most: int,
        take: Callable[[str, bytes, float], None],
        refuse: Callable[[str], None],
        **options: Any,
    ):
        self._uploads, self._most, self._take, self._refuse = uploads, most, take, refuse
        look = {"max_file_size": f"{most / 1e6:g}MB", "max_total_file_size": f"{SESSION_BYTES / 1e6:g}MB"}
        look |= {"chunk_size": PART_BYTES, "multiple": True, "layout": "compact", "css_classes": ["drop"]}
        super().__init__(**look, **WIDE | options)

    def _process_event(self, event: Any) -> None:
        if event.event_name != "upload_event":
            return
        try:
            whole = self._uploads.add(event.data, self._most)
        except ValueError as error:
            self._refuse(str(error))
            return
        if whole is not None:
            self._take(*whole)
