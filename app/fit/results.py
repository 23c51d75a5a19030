"""The right column: the number to quote, why it is that one, the curve over the model, and its files."""

from functools import partial
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn
from bokeh.events import DocumentReady
from bokeh.models import CustomJS
from markupsafe import Markup

from mdr_core.fit.indentation import IndentationFit

from ..ui import JS, WIDE, html, own_html, show
from . import words
from .answer import answer_of
from .explorer import explorer_query
from .files import map_csv
from .form import field
from .plots import Plots
from .said import Said
from .setting import OF_CLASS

_SLIDER = Path(__file__).with_name("slider.css").read_text(encoding="utf-8")
_BOTH = {"sizing_mode": "stretch_both", "margin": 0}
#: Most curves of a file that are listed.
_LISTED = 300
_PARTS = {"All": "all", "Loading": "loading", "Unloading": "unloading"}
#: What a person sees before there is a curve: what the page does, and in grey what will come.
_WELCOME = own_html(Path(__file__).with_name("welcome.html"))
_EXPLORER = Markup('<a href="?{}">Model of this curve in the explorer</a>')
_CURVES = Markup(
    "<table><tr><th>curve</th><td>E*</td><td class='reason'>source, or why there is no number</td></tr>{}"
    "</table>{}"
)
_CURVE = Markup("<tr><th>{}</th><td>{}</td><td class='reason'>{}</td></tr>")


class Results:
    """The right column of a page."""

    def __init__(self, page: Any):
        self._page, self._quiet = page, False
        self.headline = html(_WELCOME, "headline")
        self.above, self.below = Said(page, "above"), Said(page, "below")
        self.not_fitted = Said(page, alert=True)
        self._tools()
        self._classes()
        self._range()
        self._map()
        self.plots = Plots()
        shade = CustomJS(args={"looks": self.plots.looks}, code=JS["shade"])
        self._page.document.js_on_event(DocumentReady, shade)
        self.curve = pn.Column(
            pn.pane.Bokeh(self.plots.force, **_BOTH),
            pn.pane.Bokeh(self.plots.residual, **_BOTH),
            css_classes=["plots-of-fit"], visible=False, **_BOTH,
        )  # fmt: skip
        self.why, self.remarks = html("", "note", "why"), Said(page, "remarks")
        look = {"collapsed": True, "visible": False, "css_classes": ["fold", "remarks-fold"]}
        self.folded = pn.Card(self.remarks.view, title="Remarks", **look, **WIDE)
        look["css_classes"] = ["fold", "unloading-fold"]
        self.unloading = html("", "unloading")
        self.of_unloading = pn.Card(
            self.unloading, title="The unloading, by Oliver and Pharr", **look, **WIDE
        )
        left = pn.Column(
            self.above.view, self.headline, self.below.view, self.not_fitted.view, self.tools, **WIDE
        )
        # Side by side: the plots are in sight below them.
        folds = pn.Row(self.of_unloading, self.folded, css_classes=["folds"], **WIDE)
        right = pn.Column(self.classes, self.verdict, self.take, width=370, margin=0)
        self._right = right
        self.view = pn.Column(
            pn.Row(left, right, css_classes=["top-of-found"], **WIDE),
            self.why, folds, self.several, self.range, self.curve,
            css_classes=["found"], **_BOTH,
        )  # fmt: skip

    # The parts.

    def _tools(self) -> None:
        look = {"css_classes": ["button"], "margin": 0}
        self._report = pn.widgets.TextInput(visible=False)
        self.copy = pn.widgets.Button(label="Copy", **look)
        self.copy.js_on_click(args={"field": self._report}, code=JS["copy"])
        self.files = [
            pn.widgets.FileDownload(
                label=name.upper(), filename=f"fit.{name}", callback=partial(self._page.written, name),
                auto=True, **look,
            )
            for name in ("json", "csv")
        ]  # fmt: skip
        self.cancel = pn.widgets.Button(label="Cancel", visible=False, **look)
        self.cancel.on_click(lambda event: self._page.cancel())
        self.explorer = html("", "links", sizing_mode=None)
        self.saved = pn.Row(
            self.copy,
            *self.files,
            self.explorer,
            self._report,
            css_classes=["tools"],
            visible=False,
            **WIDE,
        )
        self.tools = pn.Column(self.saved, self.cancel, **WIDE)

    def _classes(self) -> None:
        self.classes, self.verdict = html("", "classes"), html("", "note")
        self.take = pn.widgets.Button(label="", visible=False, css_classes=["button", "primary"], margin=0)
        self.take.on_click(lambda event: self._page.take_class(OF_CLASS[self._better]))
        self._better = ""

    def _range(self) -> None:
        self.part = pn.widgets.RadioButtonGroup(
            options=list(_PARTS), value="All", css_classes=["parts-of-curve"], margin=0, width=220
        )
        self.part.param.watch(self._choose_part, "value")
        self.ends = pn.widgets.IntRangeSlider(
            label="", start=1, end=2, value=(1, 2), show_value=False,
            css_classes=["ends"], stylesheets=[_SLIDER], **WIDE,
        )  # fmt: skip
        self.ends.param.watch(self._choose_ends, "value_throttled")
        self.said = html("", "note")
        slider = pn.Column(self.said, self.ends, css_classes=["slider"], **WIDE)
        self.range = pn.Row(self.part, slider, css_classes=["range"], visible=False, **WIDE)

    def _choose_part(self, event: Any) -> None:
        if not self._quiet and event.new in _PARTS:
            self._page.choose_part(_PARTS[event.new])

    def _choose_ends(self, event: Any) -> None:
        if self._quiet or self._page.taken is None or event.new is None:
            return
        first, last = (round(each) for each in event.new)
        if first < last:
            self._page.choose_samples((first, last))

    def _map(self) -> None:
        """The curves of a file with several of them."""
        self.number = field(pn.widgets.IntInput, "curve-number", label="Curve", start=1, end=2, value=1)
        self.number.param.watch(self._choose_curve, "value")
        self.all = pn.widgets.Button(label="Fit all", css_classes=["button"], margin=0)
        self.all.on_click(lambda event: self._page.fit_all())
        self.progress = pn.indicators.Progress(value=0, max=1, visible=False, margin=0, width=220)
        self.summary = html("", "note")
        self.map_file = pn.widgets.FileDownload(
            label="All as CSV", filename="curves.csv", callback=self._map_written, auto=True,
            css_classes=["button"], margin=0, visible=False,
        )  # fmt: skip
        self.list = html("", "curves", visible=False)
        bar = pn.Row(self.number, self.all, self.progress, self.map_file, css_classes=["tools"], **WIDE)
        self.several = pn.Column(
            bar, self.summary, self.list, css_classes=["several"], visible=False, **WIDE
        )

    def _choose_curve(self, event: Any) -> None:
        if not self._quiet and event.new:
            self._page.choose_curve(event.new - 1)

    def _map_written(self) -> StringIO:
        return StringIO(map_csv(self._page.setting.file, self._page.rows))

    # What is shown.

    def show(self) -> None:
        """Show the page as it is."""
        self._quiet = True
        try:
            self._show_number()
            self._show_classes()
            self._show_curve()
            self._show_several()
        finally:
            self._quiet = False

    def _show_number(self) -> None:
        page, fit = self._page, self._page.fit
        answer = answer_of(page)
        show(self.headline, object=answer.large or _WELCOME)
        self.above.show(*answer.above)
        self.below.show(*answer.below)
        self.not_fitted.show(page.not_fitted)
        show(self.cancel, visible=bool(page.busy))
        show(self.saved, visible=fit is not None)
        show(self.why, object=words.why(fit, page.told) if fit is not None else "")
        unloading = page.told.unloading if fit is not None else None
        show(self.of_unloading, visible=unloading is not None)
        show(self.unloading, object=words.unloading_table(unloading) if unloading is not None else "")
        seen = {*answer.above, *answer.below}
        every = () if fit is None else (*page.remarks, *words.limits(page.setting, fit))
        # The doubt that withholds the number is the reason that is given.
        reason = "" if fit is None or page.told.quoted.value is not None else page.told.quoted.reason
        remarks = [each for each in every if each not in seen and not reason.endswith(each.text)]
        self.remarks.show(*remarks)
        name = f"{len(remarks)} remark{'s' * (len(remarks) > 1)} on this fit"
        show(self.folded, visible=bool(remarks), title=name)
        if fit is not None:
            self._show_files(fit)

    def _show_files(self, fit: IndentationFit) -> None:
        page = self._page
        for name, download in zip(("json", "csv"), self.files, strict=True):
            show(download, filename=f"{Path(page.setting.file).stem}_fit.{name}")
        show(self._report, value=words.report(page.setting, fit, page.told, page.E))
        try:
            link = _EXPLORER.format(explorer_query(page.setting, fit))
        except ValueError:
            link = ""
        show(self.explorer, object=link)

    def _show_classes(self) -> None:
        page, fit = self._page, self._page.fit
        letter = page.setting.kind.letter if page.setting.medium else ""
        sentence, misfits = words.verdict(fit, page.told) if fit is not None and letter else ("", {})
        self._better = words.better(misfits, letter)
        show(self._right, visible=bool(misfits))
        show(self.classes, object=words.classes_table(misfits, letter) if misfits else "")
        show(self.verdict, object=sentence)
        label = f"Take class ({self._better}), {words.CLASS_NAMES[self._better]}" if self._better else ""
        show(self.take, visible=bool(self._better), label=label)

    def _show_curve(self) -> None:
        page = self._page
        there = page.taken is not None
        show(self.curve, visible=there)
        show(self.curve[1], visible=page.fit is not None)
        show(self.range, visible=there)
        if not there:
            return
        count, ends = len(page.curve), page.ends
        show(self.ends, start=1, end=max(2, count), value=ends)
        name = next((name for name, part in _PARTS.items() if part == page.part), None)
        show(self.part, value=name)
        show(self.said, object=self._range_words(ends, count))
        self.plots.show(page.taken, page.used, page.fit)

    def _range_words(self, ends: tuple[int, ...], count: int) -> str:
        """The samples that are fitted, with depth and force of the first and the last one."""
        curve = self._page.curve
        deepest, largest = (float(np.max(np.abs(each))) for each in (curve.depth, curve.force))
        places = [
            f"{k} ({words.quantity(float(curve.depth[k - 1]), 'length', deepest)}, "
            f"{words.quantity(float(curve.force[k - 1]), 'force', largest)})"
            for k in ends
        ]
        return f"Fitted: samples {' to '.join(places)} of {count}"

    def _show_several(self) -> None:
        page = self._page
        several = page.count > 1
        show(self.several, visible=several)
        if not several:
            return
        show(self.number, end=page.count, value=page.setting.curve + 1, label=f"Curve, of {page.count}")
        ready = not (page.setting.missing or page.busy or page.lacks)
        show(self.all, label=f"Fit all {page.count}", disabled=not ready)
        self.show_progress()
        done = bool(page.rows) and not page.busy
        show(self.map_file, visible=done)
        self._show_list(done)

    def show_busy(self) -> None:
        """Show what is being done."""
        show(self.headline, object=answer_of(self._page).large)

    def show_progress(self) -> None:
        """Show how many curves of a file are fitted."""
        page = self._page
        running = bool(page.busy) and bool(page.rows)
        show(self.progress, visible=running, max=max(page.count, 1), value=len(page.rows))
        if running:
            self.show_busy()
        found = [row[1] for row in page.rows if row[1] is not None]
        text = ""
        if page.rows:
            median = words.amount(float(np.median(found)), None, "Pa") if found else "none"
            lost = len(page.rows) - len(found)
            text = f"{len(page.rows)} of {page.count} curves fitted: median E* {median}; "
            text += f"{lost} without a number to quote."
        show(self.summary, object=text)

    def _show_list(self, done: bool) -> None:
        """The curves as a table, those without a number first."""
        rows = sorted(self._page.rows, key=lambda row: (row[1] is not None, row[0])) if done else []
        cells = [
            _CURVE.format(
                number + 1,
                "–" if v is None else words.amount(v, error, "Pa"),
                words.sentence(reason, self._page.setting.file),
            )
            for number, v, error, reason in rows[:_LISTED]
        ]
        beyond = len(rows) - _LISTED
        more = Markup("<p>{} more are in the CSV.</p>").format(beyond) if beyond > 0 else ""
        table = _CURVES.format(Markup("").join(cells), more)
        show(self.list, visible=done, object=table if rows else "")
