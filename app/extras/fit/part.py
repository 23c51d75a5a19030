"""The part of the side: a file, the indenter, the samples that are fitted, the fit and its result."""

from functools import partial
from html import escape
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn

from mdr_core.reading import SIZES, UnknownColumns
from mdr_core.results.units import written

from ...fields import take_tip, title
from ...parts import Parts, button, text, upload
from ...plot import View
from ...shared import widgets
from ...shared.widgets import field, tools
from ...state import profile, used_by
from ...ui import WIDE, html, show
from .changes import choose_part, choose_samples, fit, quantity_of, silica, take
from .files import as_csv, as_json
from .measured import FITTED, PLACED, SUBTRACTED, offered, read_curve, with_curve
from .words import result, unloading

#: Names of files of measured curves.
_KINDS = ".csv,.txt,.dat,.tab,text/csv,.xls,.xlsx,.jpk-force,.jpk-force-map,.jpk-qi-data,.h5,.ibw,.zip"
#: The look of the slider of two handles.
_SLIDER = {"stylesheets": [Path(__file__).with_name("slider.css").read_text(encoding="utf-8")]}
#: Script of the button that copies the report: as text, and as tables where they are pasted into one.
COPY = """
const report = document.createElement("div")
report.innerHTML = new DOMParser().parseFromString(said.text, "text/html").documentElement.textContent
document.body.append(report)
getSelection().selectAllChildren(report)
document.execCommand("copy")
report.remove()
"""
#: The option for no column; a list shows an option of the value None as empty.
_NO_COLUMN = -1
#: The option for a unit that is still to be chosen.
_NO_UNIT = "unit?"


class Fitting:
    """The part of the side."""

    def __init__(self, page: Any):
        self._page, self._apply, self._placed, self._curve = page, page.apply, None, None
        # A file whose columns are asked for, and its table; and whether the columns are shown.
        self._asked, self._folded = None, False
        self._make_file()
        self._indenter, self._hardness, self._place = Parts(), Parts(), Parts()
        self._make_samples()
        self._make_result()
        self._make_parameters()
        self._rest = pn.Column(
            self._indenter, self._samples, self.samples, self._results, self.not_fitted, self.said,
            self.unloading, self._hardness, self.fixed, self._place,
            visible=False, **WIDE,
        )  # fmt: skip
        parts = (self._file, self.not_taken, self.about, self._columns, self._rest)
        self.view = pn.Column(*parts, **WIDE)

    def _make_file(self):
        """The file, what is read of it, and what was refused."""
        self._upload, self._tools = Parts(), Parts("bar")
        self._file = pn.Column(self._upload, self._tools, **WIDE)
        self.about, self.not_taken = html(), html()
        select = pn.widgets.Select
        self.columns = {role: field(select, "column", label=f"Column of {role}") for role in SIZES}
        self.units = {
            role: field(select, "unit", label=f"Unit of {role}", options=list(sizes))
            for role, sizes in SIZES.items()
        }
        for role in SIZES:
            for widget in (self.columns[role], self.units[role]):
                widget.param.watch(lambda event, role=role: self._correct(role, event.new), "value")
        rows = (pn.Row(self.columns[role], self.units[role], **WIDE) for role in SIZES)
        self._columns = pn.Column(*rows, visible=False, **WIDE)

    def _make_samples(self):
        """The range of samples that is fitted."""
        self._parts, self._ends = Parts("bar"), Parts()
        head = html("<h2>Samples that are fitted</h2>", "title")
        self._samples = pn.Column(head, self._parts, self._ends, **WIDE)
        self.samples = field(
            pn.widgets.IntRangeSlider, label="Samples", start=1, end=2, show_value=False, **_SLIDER
        )
        self.samples.param.watch(
            lambda event: self._choose(choose_samples, *event.new, mark="fit.samples"), "value"
        )

    def _make_result(self):
        """The button that fits, the result, and its files."""
        self.fit, self.said, self.not_fitted = widgets.button("Fit"), html("", "note", "said"), html()
        self.unloading = html("", "note", "unloading")
        self.fit.on_click(lambda event: self._change(fit, self.not_fitted))
        self.files = [
            pn.widgets.FileDownload(
                label=label, filename=name, callback=partial(self._written, write), auto=True,
                css_classes=["button"], margin=0, visible=False,
            )
            for label, name, write in (
                ("Fit (JSON)", "fit.json", as_json), ("Fit (CSV)", "fit.csv", as_csv),
            )
        ]  # fmt: skip
        self.copy = widgets.button("Copy", visible=False)
        self.copy.js_on_click(args={"said": self.said}, code=COPY)
        self._results = tools(self.fit, *self.files, self.copy)

    def _make_parameters(self):
        """What is fitted and what is held, and where the curve lies."""
        names = {quantity_of(name).label: name for name in FITTED}
        self.fixed = field(pn.widgets.CheckBoxGroup, "fixed", inline=False, options=names)
        self.fixed.param.watch(lambda event: self._hold(event.new), "value")

    def _written(self, write):
        return StringIO(write(self._curve))

    def _remove(self):
        self._change(lambda state: take(state, None), self.not_taken)

    def _fold(self):
        """Show the columns and units of the curve, or hide them."""
        self._folded = not self._folded
        self._page.refresh()

    def _choose(self, change, *values, mark=""):
        """Choose samples; the slider is set to those of the state, which is no choice."""
        if self._curve is not None and values != self._curve.range(self._page.state):
            self._forget()
            self._apply(lambda state: change(state, *values), mark=mark)

    def _hold(self, names):
        """Hold parameters; those that the curve does not offer stay as they are."""

        def change(state):
            others = [
                name for name in state["fit.fixed"] if state["fit.curve"] and name not in offered(state)
            ]
            kept = tuple(name for name in FITTED if name in (*names, *others))
            return state.replace(**{"fit.fixed": kept})

        self._apply(change)

    def _change(self, change, where):
        """Apply a change; if it is refused say so, and which curve stays."""

        def refuse(text):
            text = f"Refused: {text}."
            if where is self.not_taken and self._curve is not None:
                text += f" What is shown is still {self._curve.name}."
            # What is asked for stands there before the request.
            self._show_columns()
            show(where, object=f'<span class="refused" role="alert">{escape(text)}</span>')

        self._forget()
        self._asked = None
        self._apply(change, refuse)
        self._show_columns()

    def _forget(self):
        for each in (self.not_taken, self.not_fitted):
            show(each, object="")

    def _read(self, file, columns=None):
        def change(state):
            try:
                return take(state, read_curve(file.read(), file.name, columns))
            except UnknownColumns as error:
                self._asked = file, error.table
                self._folded = True
                raise

        self._change(change, self.not_taken)

    def _correct(self, role, chosen):
        if self._asked:
            roles = {each: (self.columns[each].value, self.units[each].value) for each in SIZES}
            given = {
                each: pair for each, pair in roles.items() if pair[0] != _NO_COLUMN and pair[1] != _NO_UNIT
            }
            if {"depth", "force"} <= set(given):
                self._read(self._asked[0], {"time": None} | given)
            return
        curve, chosen = self._curve, None if chosen == _NO_COLUMN else chosen
        # A list that is set to what the curve has.
        if curve is None or chosen == _NO_UNIT or chosen in (curve.curve.columns[role] or (None,)):
            return

        def change(state):
            return with_curve(state, curve.corrected(role, chosen))

        self._change(change, self.not_taken)

    def _show_columns(self):
        """Columns and units of the curve, or the choice of those that are asked for."""
        show(self._columns, visible=bool(self._folded and (self._asked or self._curve)))
        if not self._columns.visible:
            return
        table = self._asked[1] if self._asked else self._curve.curve.table
        # A column without a name is known by its first numbers.
        firsts = {k: ", ".join(f"{x:.3g}" for x in values[:3]) for k, values in table.values.items()}
        heads = {f"{k + 1}: {head or f'{firsts[k]} …'}": k for k, head in table.heads.items()}
        for role, sizes in SIZES.items():
            column = None if self._asked else self._curve.curve.columns[role]
            nothing = {"none, rows in order": _NO_COLUMN} if role == "time" else {"column?": _NO_COLUMN}
            optional = nothing if column is None or role == "time" else {}
            number, unit = column or (_NO_COLUMN, _NO_UNIT)
            show(self.columns[role], options=heads | optional, value=number)
            show(self.units[role], options=[*[_NO_UNIT] * (column is None), *sizes], value=unit)

    def show(self, view: View) -> None:
        state = view.state
        curve = state["fit.curve"]
        if curve is not self._curve:
            self._curve = curve
            self._forget()
        self._show_columns()
        show(self._rest, visible=curve is not None)
        self._upload.show([upload("CSV file of a measured curve: depth, force", _KINDS, self._read)])
        silica_ = partial(self._change, silica, self.not_taken)
        self._tools.show(
            [
                button("Fused silica", silica_),
                button("Remove", self._remove, disabled=curve is None),
                button("Columns", self._fold, pressed=self._folded, disabled=curve is None),
            ]
        )
        show(self.said, object=result(state))
        if curve is None:
            show(
                self.about,
                object=result(state) or "Load a table of depth and force to fit the model to it.",
            )
            return
        about = f"<b>{escape(curve.name)}</b>: {escape(curve.note)}. A link does not contain the curve."
        show(self.about, object=about)
        page = self._page
        numbers = [page.number(name) for name in used_by(state, "shape")]
        self._indenter.show([title("Indenter"), page.choice("shape"), *numbers, take_tip(page)])
        self._show_samples(state)
        for each in (*self.files, self.copy):
            show(each, visible=curve.fit is not None)
        self._show_parameters(state)

    def _show_samples(self, state):
        """The chosen samples, with the depth and force of the first and the last one."""
        curve, count = self._curve, len(self._curve.curve)
        first, last = curve.range(state)
        show(self.samples, start=1, end=max(2, count), value=(first, last))
        texts = [
            f"{k} ({written(float(curve.curve.depth[k - 1]), 'length', 4)}, "
            f"{written(float(curve.curve.force[k - 1]), 'force', 4)})"
            for k in (first, last)
        ]
        self._ends.show([text("ends", f"From sample {' to '.join(texts)}, of {count}.")])
        top = curve.deepest(state)
        ranges = {"All": (1, count), "Loading": (1, top), "Unloading": (top, count)}
        self._parts.show(
            [
                button(name, partial(self._choose, choose_part, name), pressed=(first, last) == ends)
                for name, ends in ranges.items()
            ]
        )

    def _show_parameters(self, state):
        curve = self._curve
        numbers = [f"fit.{name}" for name in (*PLACED, *SUBTRACTED)]
        numbers.append("fit.samples")
        placed = curve, profile(state), state["fit.fixed"], *(state[name] for name in numbers)
        if placed != self._placed:
            self._placed, self.unloading.object = placed, unloading(state)
        depth, force = (float(np.max(np.abs(part))) for part in curve.data)
        likes = {"fit.contact_point": depth, "fit.baseline": force, "fit.drift": 1e-10}
        likes["fit.depth_noise"] = depth
        # A frame gives by some hundredth of the depth.
        likes["fit.frame"] = 0.01 * depth / force if force else 0.0
        names = [f"fit.{name}" for name in curve.known((*PLACED, *SUBTRACTED))]
        numbers = [self._page.number(name, likes.get(name, 0.0)) for name in ("fit.depth_noise", *names)]
        self._hardness.show([self._page.choice("fit.hardness"), title("Fixed parameters")])
        self._place.show(numbers)
        options = {quantity_of(name).label: name for name in offered(state)}
        held = [name for name in state["fit.fixed"] if name in offered(state)]
        show(self.fixed, options=options, value=held)
