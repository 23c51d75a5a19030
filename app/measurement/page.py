"""The page of one user for a measurement, from a file to the number to quote."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import panel as pn
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import CustomJS
from markupsafe import Markup

from mdr_core.base.remark import Remark

from ..common.errors import Refused
from ..common.folders import Files
from ..common.process import SynchronousWorker, Worker
from ..common.ui import BOTH, WIDE, button, call, html, landmarks, show
from ..common.upload import in_line
from . import analysis, query
from .actions import Actions
from .choices import CANTILEVER, CORRECTIONS, EXAMPLES, FITTED, MEDIA, NUMBERS, PARTS
from .form import Form
from .results import Results
from .widgets import ERROR

#: Roles and names of the parts of the page, by their classes.
_LANDMARKS = {
    "fit-header": ("banner", "Measurement"),
    "asked": ("complementary", "Curve, tip and sample"),
    "found": ("main", "Result"),
}
#: Largest number of curves in one job.
_CURVES = 100
#: Seconds after a file in which further files belong to the same set.
_TOGETHER = 0.7


class Measurement(Actions):
    """Page with the file, the range and the options of the reader; widgets have tip, sample and numbers.

    Its main actions are `take_file`, `read` and `fit`; each continues with the next action.
    """

    def __init__(self, link: str = "", worker: Worker | SynchronousWorker | None = None):
        super().__init__(worker)
        # Name of the file or set, its path or paths on the server, name of the example, and time of the
        # last file (s).
        self.file, self.path, self._example, self._taken_at = "", "", "", -_TOGETHER
        self._files = Files()
        # Cancels the reading of a set; None if no set waits.
        self._waiting: Callable[[], None] | None = None
        #: Options `columns` and `by` of the reader; and options of tables with known heads.
        self.options: dict[str, Any] = {}
        self._known: dict[Any, tuple[dict[str, Any], dict[str, float]]] = {}
        #: The curve, the number of curves, its thinned samples, and the question about its file.
        self.curve, self.count, self.taken, self.question = None, 0, None, None
        #: The fit, Young's modulus of the sample and its error (Pa), and rows of all curves.
        self.found = self.E = None
        self.rows: list[analysis.Row] = []
        #: Unread files of a set, with reasons.
        self.unread: list[str] = []
        #: Whether the user has stopped the job; the next change starts it again.
        self.cancelled = False
        # Chosen samples, () for the default of the kind of sample; and the last kind of sample.
        self._samples, self._medium = (), ""
        self.form, self.results = Form(self), Results(self)
        self._view()
        self._open(query.read(link))

    def _view(self) -> None:
        header = (
            html(Markup("<h1>Measurement</h1>"), "name"),
            html(Markup('<a href="?">Indentation explorer</a>'), "way", sizing_mode=None),
            button("Dark", None, "theme"),
        )
        self.address = pn.widgets.TextInput(visible=False)
        self.address.jscallback(value="history.replaceState(null, '', source.value)")
        columns = pn.Row(self.form.view, self.results.view, css_classes=["fit-columns"], **BOTH)
        head = pn.Row(*header, self.address, css_classes=["fit-header"], **WIDE)
        self.view = pn.Column(head, columns, css_classes=["fit-page"], **BOTH)
        landmarks(self.document, _LANDMARKS, "found", "Skip to the result")
        # The address restores the typed values after a lost session.
        self.document.js_on_event(ConnectionLost, CustomJS(code=call("again")))
        self.host.on_close(self.close)

    def __panel__(self) -> Any:
        return self.view

    def close(self) -> None:
        """End the process, and remove the files."""
        self.worker.stop()
        self._files.clear()
        self.form.close()

    def message(self, text: str, remedy: tuple[Any, ...] = ()) -> Refused:
        """Return an error with the name of the dropped file, instead of the name of the kept file."""
        kept = Path(self.path).name if isinstance(self.path, str) else ""
        return Refused(text.replace(kept or "\0", self.file), remedy)

    def cancel(self) -> None:
        """Stop the running job."""
        self.stop()
        self.cancelled = self.found is None
        self.show()

    # The link.

    def _open(self, link: query.Link) -> None:
        """Show the content of a link: an example once the page is loaded, another file by its name."""
        self._begin(link.tip, link.medium, link.numbers)
        self.file, self.options, self._samples = link.file, link.options, link.samples
        with self.setting():
            self.results.number.param.update(end=link.curve + 1, value=link.curve + 1)
        if example := next((name for name, each in EXAMPLES.items() if each.name == self.file), ""):
            begin = partial(self.do, self._take, self.file, EXAMPLES[example].read(), example)
            if not self.host.processes:
                begin()
                return
            # Start a process only for a connected page, not for a request alone.
            self.document.on_event(DocumentReady, lambda event: self.path or begin())
            self.busy = f"Reading {self.file}"
        self.show()

    def _begin(self, tip: str, medium: str, numbers: dict[str, float | None]) -> None:
        """Set a tip, a kind of sample and numbers, for the first curve of another file."""
        with self.setting():
            self.form.tip.value = tip
            self._set_medium(medium)
            for name, value in numbers.items():
                self.form.numbers[name].set(value)
            self.results.number.value = 1
        self.options, self._samples = {}, ()

    def link(self) -> query.Link:
        """Return the link of the typed and chosen values."""
        tip, medium, curve = self.form.tip.value, self.form.medium.value, self.results.number.value - 1
        numbers = self.form.unusual_numbers()
        return query.Link(self.file, curve, tip, medium, numbers, self._samples, self.options)

    # Files.

    async def take_file(self, name: str, data: bytes, began: float) -> None:
        """Read a dropped file or set. Keep tip and sample, unless they belong to an example."""
        together, self._taken_at = began < self._taken_at + _TOGETHER, monotonic()
        if together:
            self._take_together(name, data)
            return
        form, name = self.form, in_line(name)
        if self._example:
            self._begin("", "", dict.fromkeys(form.numbers))
        elif name != self.file:
            # Clear the corrections of another curve.
            self._begin(form.tip.value, form.medium.value, dict.fromkeys((*CORRECTIONS, *CANTILEVER)))
        await self._take(name, data)

    async def take_example(self, name: str) -> None:
        """Read a measured example with its tip and sample."""
        example = EXAMPLES[name]
        numbers = dict.fromkeys((*NUMBERS,)) | example.numbers
        self._begin(example.tip, example.medium, numbers)
        await self._take(example.name, example.read(), name)

    async def _take(self, name: str, data: bytes, example: str = "") -> None:
        self._forget()
        self.file, self._example = name, example
        self.path = self._files.keep(data, name)
        await self.read()

    def _forget(self) -> None:
        """Forget the last file."""
        self.curve, self.question, self.found, self.count, self.path = None, None, None, 0, ""
        self.cancelled = False

    def _take_together(self, name: str, data: bytes) -> None:
        """Read a file together with the last files, once no further file follows."""
        self.stop()
        if self._waiting:
            self._waiting()
        self._waiting = None
        self._forget()
        self._files.add(data, name)
        self.path = [*self._files.paths]
        self.file, self.busy = f"{len(self.path)} files", f"Taking {len(self.path)} files"
        # Show the whole page once, then only the number of files.
        (self.show if len(self.path) == 2 else self.results.show_headline)()
        self._waiting = self.host.call_later(self._read_together, round(1000 * _TOGETHER))

    def _read_together(self) -> None:
        self._waiting = None
        self.do(self.read)

    # Reading.

    @property
    def table(self) -> Any:
        """First rows of the table of the curve or the question, or None."""
        return getattr(self.question or self.curve, "table", None)

    @property
    def deflection(self) -> Remark | None:
        """Remark that the depth needs the stiffness of the cantilever, or None."""
        return analysis.deflection(self.curve) if self.curve is not None else None

    @property
    def wanted(self) -> set[str]:
        """Names of missing inputs of the reader."""
        asked = (self.problem if self.curve is None else None), self.deflection
        names = {each.what for one in asked if one for each in one.remedy if each.action == "give"}
        return names | {"columns"} if self.question else names

    @property
    def _reading(self) -> dict[str, Any]:
        """Options of the reader."""
        return self.form.given(*CANTILEVER) | self.options

    async def read(self) -> None:
        """Read the curve of the file and fit it, or ask about its columns."""
        confirmed = self.question is not None
        self.curve = self.taken = self.found = self.question = None
        self.rows = []
        if not self.path:
            self.show()
            return
        number = self.results.number.value - 1
        answer = await self.run(f"Reading {self.file}", analysis.read, self.path, self._reading, number)
        curve, self.count, question, self.unread = answer
        with self.setting():
            self.results.number.value = max(1, min(self.results.number.value, self.count))
        if question is not None:
            await self._ask(question)
            return
        remarks = tuple(analysis.with_text(each, self.message(each.text).text) for each in curve.remarks)
        self.curve = replace(curve, remarks=remarks)
        if self.table is not None:
            columns = self.options.get("columns")
            if self.options:
                self._known[self.table.key] = self.options, self.form.given(*CANTILEVER)
            with self.setting():
                shown = columns if isinstance(columns, list) else curve.columns
                self.form.columns.show(self.table, shown, self.options.get("by"))
        if confirmed:
            show(self.form.reader, collapsed=True)
        await self.fit()

    async def _ask(self, question: Any) -> None:
        """Ask about the columns of a table, or read it like an earlier table with the same heads."""
        known = self._known.get(question.table.key)
        if known and not self.options:
            self.options, cantilever = known
            with self.setting():
                for name, value in cantilever.items():
                    self.form.numbers[name].set(value)
            await self.read()
            return
        why = question.text if question.text.endswith("?") else f"{question.text.rstrip('.')}."
        text = f"{self.file}: {why} Check the choices below, and press Read"
        self.question, self.problem = question, self.message(text, question.remedy)
        suggestion = question.suggestion
        with self.setting():
            self.form.columns.show(question.table, suggestion.get("columns") or {}, suggestion.get("by"))
        self.show()

    async def columns_changed(self) -> None:
        """Read a known file again; a question waits for its button."""
        if self.question is None:
            await self.read_as_chosen()
        else:
            # The preview shows the suggestion.
            self.question.preview = None
            show(self.results.figures, visible=False)

    async def read_as_chosen(self) -> None:
        """Read the file with the chosen columns."""
        await self.read_with(self.form.columns.options())

    async def read_with(self, options: dict[str, Any]) -> None:
        """Read the file with other columns, or with another option `by`."""
        self.options = options if "columns" in options else self.options | options
        self._samples = ()
        await self.read()

    async def curve_chosen(self) -> None:
        """Read another curve of the file."""
        self._samples = ()
        await self.read()

    # Fits.

    @property
    def ends(self) -> tuple[int, int]:
        """Numbers of the first and the last fitted sample."""
        count = len(self.curve)
        if self._samples and self._samples[0] < min(self._samples[1], count):
            return self._samples[0], min(self._samples[1], count)
        return self._ends_of(MEDIA[self.form.medium.value].part if self.form.medium.value else "all")

    def _ends_of(self, part: str) -> tuple[int, int]:
        return analysis.ends_of(self.taken, len(self.curve), part)

    @property
    def part(self) -> str | None:
        """Fitted part of the curve: "all", "loading", "unloading", or None for another range."""
        return next((part for part in PARTS.values() if self._ends_of(part) == self.ends), None)

    def _set_medium(self, name: str) -> None:
        self.form.set_medium(name)
        self._medium = name

    async def medium_chosen(self) -> None:
        """Fit another kind of sample; keep held parameters if both kinds yield."""
        before, name = self._medium, self.form.medium.value
        held = self.form.given("E_star", "contact_point", "baseline", "tilt", "drag")
        both_yield = before and name and MEDIA[before].letter and MEDIA[name].letter
        with self.setting():
            self._set_medium(name)
            if both_yield:
                for each in FITTED:
                    self.form.numbers[each].set(held.get(each))
            else:
                self._samples = ()
        await self.fit()

    async def part_chosen(self, part: str) -> None:
        """Fit a part of the curve: "all", "loading" or "unloading"."""
        if self.curve is not None and part:
            await self._fit_samples(self._ends_of(part))

    async def samples_chosen(self) -> None:
        """Fit the samples between the handles of the range."""
        if self.curve is not None and self.results.ends.value_throttled:
            first, last = (round(each) for each in self.results.ends.value_throttled)
            if first < last:
                await self._fit_samples((first, last))

    async def _fit_samples(self, ends: tuple[int, int]) -> None:
        # Without a choice, `ends` are the default ends.
        self._samples = ()
        self._samples = () if ends == self.ends else ends
        await self.fit()

    async def fit(self) -> None:
        """Fit the curve, once tip and sample are known."""
        self.found, self.E, self.rows = None, None, []
        cancelled, self.cancelled = self.cancelled, False
        if cancelled and self.curve is None:
            await self.read()
            return
        if self.curve is not None:
            self.problem = None
            self.taken = analysis.samples(self.curve, **self.form.corrections())
        if self.curve is not None and self.busy:
            # The running fit is for another tip or sample.
            self.stop()
        if self.curve is None or self.form.missing() or self.deflection:
            self.show()
            return
        request = self.form.request(self.curve.time is not None, self.ends if self._samples else ())
        self.found = await self.run("Fitting", analysis.fit, self.curve, request)
        await self.modulus_chosen()

    async def modulus_chosen(self) -> None:
        """Compute and show Young's modulus of the sample."""
        self.problem = self.E = None
        if self.found is not None:
            self.E = self.form.modulus(self.found.quoted)
        self.show()

    async def fit_all(self) -> None:
        """Fit each curve of the file like the shown curve."""
        self.rows = []

        def one(row: analysis.Row) -> None:
            self.rows.append(row._replace(reason=self.message(row.reason).text))
            self.busy = f"Fitting curve {min(len(self.rows) + 1, self.count)} of {self.count}"
            self.results.show_headline()
            self.results.show_progress()

        request = self.form.request(True, self.ends if self._samples else ())
        # The time of a job is limited, and other sessions take turns between two jobs.
        for first in range(0, self.count, _CURVES):
            text, last = f"Fitting curve {first + 1} of {self.count}", min(first + _CURVES, self.count)
            given = self.path, self._reading, request, first, last
            await self.run(text, analysis.fit_all, *given, part=one)
        self.show()

    @pn.io.hold()
    def show(self) -> None:
        """Show the present state of the page."""
        with self.setting():
            self.form.show(self)
            self.results.show()
            self.form.show_about(self)
            problems = (self.problem,) if self.problem and self.curve is None else ()
            self.results.fill(self.form.errors, problems, ERROR)
            link = self.link().query()
            self.address.value = "?fit" + f"&{link}" * bool(link)
