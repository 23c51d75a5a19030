"""Exports: link, Python, files that extras offer, and curves as CSV in SI."""

from io import StringIO
from typing import Any

import numpy as np
import panel as pn

import mdr_core as mdr
from mdr_core.show.csv_text import csv_text

from ...common.ui import WIDE, button, call, download, field, html, show, tools
from ..extra import EXTRAS, Extra
from ..link import file_name, summary
from ..plot import View
from ..readouts import readings


def csv(view: View) -> str:
    """Return all states along the path as CSV, with every readout that changes."""
    columns = {
        f"{each.long_name} {each.symbol} ({each.unit or '1'})": values
        for each, values in readings(view.course).items()
        if np.ndim(values)
    }
    return _table(view, "states along the path", columns)


def pressure_csv(view: View, points: int = 401) -> str:
    """Return pressure, line load and reduced profile of the present state as CSV."""
    now, profile = view.course.state, view.course.scene.profile
    largest = 1.25 * float(view.course.turning_point.contact_radius)
    r = np.linspace(0, min(largest, profile.known_radius), points)
    columns = {
        "radius r (m)": r,
        "sigma_zz (Pa)": 0.0 - now.pressure(r),
        "line load q (N/m)": now.line_load(r),
        "reduced profile g (m)": profile.reduced(r),
    }
    title = f"state at depth d = {float(now.depth)!r} m, force F = {float(now.force)!r} N"
    return _table(view, title, columns)


def _table(view: View, title: str, columns: dict[str, Any]) -> str:
    """Return columns in SI as CSV, with the scene in a header."""
    head = f"mdr_core {mdr.__version__}: {title}\n{summary(view.state)}\n{view.course.scene.to_python()}"
    rows = zip(*(np.asarray(column, float).tolist() for column in columns.values()), strict=True)
    return csv_text(head.splitlines(), [columns, *rows])


class Share:
    """The panel *Share*."""

    def __init__(self, page: Any):
        self._page = page
        self.link = field(pn.widgets.TextInput, label="Link to this page")
        self.python = field(pn.widgets.TextAreaInput, label="This scene in Python", rows=12)
        self._note = html()
        #: Download buttons by the names of their files.
        self._files = {
            name: download(label, lambda write=write: StringIO(write(page.view)), filename=name)
            for extra in EXTRAS.values()
            for label, name, write in extra.files
        }
        copy = button("Copy link")
        copy.js_on_click(args={"field": self.link}, code=call("copy", "field"))
        parts = self.link, self._note, tools(copy, *self._files.values()), self.python
        self.view = pn.Column(*parts, css_classes=["share"], **WIDE)

    def address(self) -> tuple[str, str]:
        """Return the link to the page, or an empty link and the reason."""
        query, note = self._page.query()
        base = pn.state.location.href.split("?")[0] if pn.state.location else ""
        return "" if note else base + f"?{query}" * bool(query), note

    def show(self, view: View) -> None:
        address, note = self.address()
        show(self.link, value=address)
        show(self._note, object=note)
        for name, each in self._files.items():
            show(each, filename=file_name(view.state, name))
        show(self.python, value=view.course.scene.to_python())


EXTRA = Extra(
    "share", order=20, tab="Share", place="over", side=Share,
    files=(("Curves (CSV)", "curves.csv", csv), ("Pressure (CSV)", "pressure.csv", pressure_csv)),
)  # fmt: skip
