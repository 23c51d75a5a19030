"""The right column: the number to quote with its reasons, the curve with the model, and downloads."""

from functools import partial
from importlib.util import find_spec
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn
from bokeh.events import DocumentReady
from bokeh.models import CustomJS
from markupsafe import Markup

import mdr_core as mdr

from ..common.ui import BOTH, WIDE, button, call, download, html, show
from . import export, texts
from .choices import CLASS_NAMES, MEDIA, OF_CLASS, PARTS, TIPS
from .plots import AllCurves, Plots
from .remedies import remedy_button
from .widgets import ERROR, fold

_HERE = Path(__file__).parent
_SLIDER = (_HERE / "slider.css").read_text(encoding="utf-8")
#: Send all dropped files at once; by default a browser sends two files every two seconds.
_DROPS = "FilePond.setOptions({maxParallelUploads: 1000, itemInsertInterval: 0})"
_REMARK = Markup("<p>{}</p>")
_EXPLORER = Markup('<a href="?{}">Model of this curve in the explorer</a>')


class Results:
    """Right column of a page."""

    def __init__(self, page: Any):
        self._page = page
        self.headline, self.why = html(texts.WELCOME, "headline"), html("", "note", "why")
        self.above, self.below, self.errors, self.remarks = (
            pn.Column(css_classes=["said", name], visible=False, **WIDE)
            for name in ("above", "below", "errors", "remarks")
        )
        self.plots = Plots()
        self._tools()
        self._range()
        self._curves()
        self.classes = html("", "classes", sizing_mode=None, width=370)
        self.take = button("", self._take_class, "primary", visible=False)
        self.aside = pn.Column(self.classes, self.take, width=370, margin=0, visible=False)
        self.unloading = html("", "unloading")
        self.folds = [
            fold(
                "The unloading, by Oliver and Pharr", self.unloading, css_classes=["fold", "unloading-fold"]
            ),
            fold("Remarks", self.remarks, css_classes=["fold", "remarks-fold"]),
        ]
        looks = {"looks": self.plots.looks + self.all_curves.looks}
        theme = CustomJS(args=looks, code=call("theme_button", "looks"))
        for code in (theme, CustomJS(code=call("name_handles")), CustomJS(code=_DROPS)):
            page.document.js_on_event(DocumentReady, code)
        self.figures = self.plots.view
        words = self.above, self.headline, self.below, self.errors, self.saved, self.cancel
        top = pn.Row(pn.Column(*words, **WIDE), self.aside, css_classes=["top-of-found"], **WIDE)
        folds = pn.Row(*self.folds, css_classes=["folds"], **WIDE)
        parts = top, self.why, folds, self.several, self.range, self.figures
        self.view = pn.Column(*parts, css_classes=["found"], **BOTH)

    # The parts.

    def _tools(self) -> None:
        page = self._page
        self.cancel = button("Cancel", page.cancel, visible=False)
        # The width of a hidden field would set the width of the row.
        self.report = pn.widgets.TextInput(visible=False, **WIDE)
        self.copy = button("Copy")
        self.copy.js_on_click(args={"field": self.report}, code=call("copy", "field"))
        self.files = {
            kind: download(kind.upper(), partial(self._written, write))
            for kind, write in (("json", export.as_json), ("csv", export.as_csv))
        }
        self.picture = button("Save figure")
        figures = {"figures": [self.plots.force, self.plots.residual]}
        self.picture.js_on_click(args=figures, code=call("save_fit", "figures"))
        self.explorer = html("", "links", sizing_mode=None)
        parts = self.copy, *self.files.values(), self.picture, self.explorer, self.report
        self.saved = pn.Row(*parts, css_classes=["tools"], visible=False, **WIDE)

    def _range(self) -> None:
        page = self._page
        self.part = pn.widgets.RadioButtonGroup(
            options=PARTS, value="all", css_classes=["parts-of-curve"], margin=0, width=220
        )
        self.part.param.watch(page.when_changed(lambda: page.part_chosen(self.part.value)), "value")
        self.ends = pn.widgets.IntRangeSlider(
            label="", start=1, end=2, value=(1, 2), show_value=False, css_classes=["ends"],
            stylesheets=[_SLIDER], **WIDE,
        )  # fmt: skip
        self.ends.param.watch(page.when_changed(page.samples_chosen), "value_throttled")
        self.fitted = html("", "note")
        slider = pn.Column(self.fitted, self.ends, css_classes=["slider"], **WIDE)
        self.range = pn.Row(self.part, slider, css_classes=["range"], visible=False, **WIDE)

    def _curves(self) -> None:
        """Make the parts for a file with several curves."""
        page = self._page
        self.number = pn.widgets.IntInput(
            label="Curve", start=1, end=2, value=1, css_classes=["choice", "curve-number"], **WIDE
        )
        self.number.param.watch(page.when_changed(page.curve_chosen), "value")
        self.all = button("Fit all", partial(page.do, page.fit_all))
        self.progress = pn.indicators.Progress(value=0, max=1, visible=False, margin=0, width=220)
        self.summary, self.list = html("", "note"), html("", "curves", visible=False)
        csv = download("All as CSV", self._csv, filename="curves.csv")
        excel = download("All as Excel", self._excel, filename="curves.xlsx")
        # A static page has no package for Excel files.
        excel.visible = find_spec("openpyxl") is not None
        files = {"visible": False, "sizing_mode": None, "margin": 0}
        self.curves_files = pn.Row(csv, excel, css_classes=["tools"], **files)
        tools = self.number, self.all, self.progress, self.curves_files
        bar = pn.Row(*tools, css_classes=["tools"], **WIDE)
        self.all_curves = AllCurves()
        parts = bar, self.summary, self.list, self.all_curves.view
        self.several = pn.Column(*parts, css_classes=["several"], visible=False, **WIDE)

    def _table(self) -> mdr.CurveTable:
        """Return all fitted curves as a table."""
        page = self._page
        settings = {"made by": f"mdr_core {mdr.__version__}", "file": page.file} | page.form.settings()
        if page.unread:
            settings["files not read"] = "; ".join(page.unread)
        return export.table_of(page.rows, settings, page.form.materials())

    def _csv(self) -> StringIO:
        file = StringIO()
        self._table().to_csv(file)
        file.seek(0)
        return file

    def _excel(self) -> BytesIO:
        file = BytesIO()
        self._table().to_excel(file)
        file.seek(0)
        return file

    def _take_class(self) -> None:
        medium = self._page.form.medium
        medium.value = OF_CLASS[texts.better(self._page.found, MEDIA[medium.value].letter)]

    def all_remarks(self) -> tuple[Any, ...]:
        """Return all remarks on a fit and its curve, once each."""
        found = self._page.found
        every = (*found.above, *found.below, *found.remarks, *self._page.curve.remarks)
        return tuple(dict.fromkeys(every))

    def contents(self) -> dict[str, Any]:
        """Return the contents of the files of a fit."""
        page = self._page
        about = {"file": page.file, "curve": self.number.value - 1, "length": len(page.curve), "E": page.E}
        about["remarks"] = self.all_remarks()
        return export.contents(page.found, about, page.form.corrections())

    def _written(self, write: Any) -> StringIO:
        return StringIO(write(self._page.found, self.contents()))

    # Display.

    def show(self) -> None:
        """Show the present state of the page."""
        page = self._page
        self.show_headline()
        found = page.found
        above, below = (found.above, found.below) if found else ((), ())
        if found and found.quoted.value is None:
            below = (page.message(found.quoted.reason, found.quoted.remedy), *below)
        lacking = page.deflection if found is None else None
        self.fill(self.above, above)
        self.fill(self.below, (lacking,) if lacking else below)
        self.fill(self.errors, (page.problem,) if page.problem and page.curve is not None else (), ERROR)
        show(self.saved, visible=found is not None)
        show(self.why, object=texts.why(found) if found else "")
        for each in (*self.folds, self.aside):
            show(each, visible=False)
        if found:
            self._show_classes(found)
            self._show_folds(found, {*above, *below})
            self._show_files(found)
        self._show_curve(found)
        self._show_curves()

    def show_headline(self) -> None:
        """Show the number, the running job, or the missing input."""
        show(self.cancel, visible=bool(self._page.busy))
        show(self.headline, object=self._headline())

    def _headline(self) -> Markup:
        page = self._page
        if page.busy:
            return texts.waiting(page.busy)
        if page.found:
            wants_poisson = page.found.quoted.value is not None and page.form.value("poisson") is None
            return self._number() + (texts.GIVE_POISSON if wants_poisson else "")
        if page.deflection:
            return texts.to_do("Give the spring constant k")
        if page.curve is not None:
            missing = page.form.missing()
            if page.cancelled and not missing:
                return texts.to_do("Cancelled", "Change something, or drop the file again.")
            return texts.to_do(f"Give {missing}") if missing else texts.to_do("No fit", "")
        if page.wanted:
            return texts.to_do("The curve is not read yet", "Give the missing information on the left.")
        if page.cancelled:
            return texts.to_do("Cancelled", "Change something, or drop the file again.")
        if page.problem:
            how = "The reason is on the left. Drop another file, or correct this one."
            return texts.to_do("This file cannot be read", how)
        return texts.WELCOME

    def _number(self) -> Markup:
        page, form = self._page, self._page.form
        assumed = ["an ideal tip"] * (form.tip.value != "measured")
        assumed += ["a rigid frame"] * (not form.value("frame"))
        others = texts.of_curves(page.rows, "set’s" if isinstance(page.path, list) else "file’s")
        return texts.headline(page.found, page.E, assumed, others)

    def _show_classes(self, found: Any) -> None:
        letter = MEDIA[self._page.form.medium.value].letter
        if not (letter and texts.misfits(found)):
            return
        better = texts.better(found, letter)
        label = f"Take class ({better}), {CLASS_NAMES[better]}" if better else ""
        show(self.aside, visible=True)
        show(self.classes, object=texts.classes_table(found, letter))
        show(self.take, visible=bool(better), label=label)

    def _show_folds(self, found: Any, seen: set[Any]) -> None:
        page, (of_unloading, remarks) = self._page, self.folds
        show(of_unloading, visible=found.unloading is not None)
        if found.unloading is not None:
            show(self.unloading, object=texts.unloading_table(found.unloading))
        # Omit the remark that is already the reason for no number.
        reason = found.quoted.reason if found.quoted.value is None else ""
        every = [each for each in self.all_remarks() if each not in seen and not reason.endswith(each.text)]
        every += map(page.message, texts.limits(found, page.form.tip.value, page.form.medium.value))
        self.fill(self.remarks, every)
        show(remarks, visible=bool(every), title=f"{len(every)} remark{'s' * (len(every) > 1)} on this fit")

    def _show_files(self, found: Any) -> None:
        page, form = self._page, self._page.form
        name = f"{Path(page.file).stem}_fit"
        for kind, widget in self.files.items():
            show(widget, filename=f"{name}.{kind}")
        # Name and caption of a saved picture.
        self.plots.force.tags = [name, texts.caption(found, page.E, page.file)]
        shown = form.parameters(found.fit.time is not None)
        given = form.corrections() | form.given("depth_noise")
        show(self.report, value=texts.report(found, page.E, page.file, shown, given))
        tip = form.tip.value
        try:
            query = export.explorer_query(found, tip, form.given(*TIPS[tip].numbers), form.medium.value)
            show(self.explorer, object=_EXPLORER.format(query))
        except ValueError:
            show(self.explorer, object="")

    def _show_curve(self, found: Any) -> None:
        page, curve = self._page, self._page.curve
        preview = page.question.preview if page.question else None
        taken = preview if curve is None else page.taken
        show(self.figures, visible=taken is not None)
        show(self.range, visible=curve is not None)
        if taken is not None:
            ends = (1, np.inf) if curve is None else page.ends
            used = (ends[0] <= taken.number) & (taken.number <= ends[1])
            self.plots.show(taken, used, found and found.fit)
        if curve is None:
            return
        show(self.ends, start=1, end=max(2, len(curve)), value=page.ends)
        show(self.part, value=page.part)
        show(self.fitted, object=texts.range_text(curve, page.ends, found is not None))

    def _show_curves(self) -> None:
        page = self._page
        show(self.several, visible=page.count > 1)
        if page.count < 2:
            return
        ready = not (page.busy or page.form.missing() or page.deflection or page.curve is None)
        show(self.number, end=page.count, label=f"Curve, of {page.count}")
        show(self.all, label=f"Fit all {page.count}", disabled=not ready)
        self.show_progress()
        done = bool(page.rows) and not page.busy
        show(self.curves_files, visible=done)
        show(self.all_curves.view, visible=done)
        if done:
            self.all_curves.show(page.rows)
        show(self.list, visible=done, object=texts.curves_table(page.rows, page.file) if done else "")

    def show_progress(self) -> None:
        """Show the number of fitted curves of a file."""
        page = self._page
        running = bool(page.busy) and bool(page.rows)
        show(self.progress, visible=running, max=max(page.count, 1), value=len(page.rows))
        text = f"{len(page.rows)} of {page.count} curves fitted" if page.rows else ""
        if page.rows and not running:
            text = texts.curves_summary(text, self._table())
        show(self.summary, object=text)

    def fill(self, column: Any, remarks: Any, form: Markup = _REMARK) -> None:
        """Show remarks in a column, each with buttons for its remedies."""
        page, parts = self._page, []
        for remark in remarks:
            buttons = [each for each in (remedy_button(one, page) for one in remark.remedy) if each]
            parts.append(html(form.format(texts.sentence(remark.text, page.file)), "note", "remark"))
            parts += [pn.Row(*buttons, css_classes=["tools", "remedies"], **WIDE)] * bool(buttons)
        column.objects = parts
        show(column, visible=bool(parts))
