"""The file of a measurement: taking it, and reading the curve that is in it."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from markupsafe import Markup

from mdr_core.measured_curve import MeasuredCurve
from mdr_core.numerics.remark import Remark

from ..tip import in_line
from .asked import Samples, samples
from .folders import NOT_KEPT, Files
from .measurement import Question
from .refusals import NOTHING, Message, changed, deflection
from .samples import EXAMPLES
from .setting import Setting
from .worker import Here, Worker

#: Beginnings of the suffixes of files that are no tables.
_AFM = ".jpk", ".h5", ".hdf5", ".ibw", ".nid", ".zip"


class Source:
    """The file of a page, the curve that is read, and its samples; the page shows and fits them."""

    show: Callable[[], None]
    fit_again: Callable[[], None]
    _tell: Callable[..., Callable[[str, Any], None]]

    def __init__(self, setting: Setting, worker: Worker | Here):
        self.setting, self.worker = setting, worker
        self.curve: MeasuredCurve | None = None
        self.count = 0
        self.table: Any = None
        self.taken: Samples | None = None
        # What is said below the file.
        self.about = ""
        self.refused = NOTHING
        #: The question about the file, until it is answered.
        self.question: Question | None = None
        # What was told of tables by their heads, so that a folder of files is asked about once.
        self._told: dict[Any, dict[str, Any]] = {}
        self._heads: Any = None
        self._files = Files()
        self._path, self._example = "", ""

    def take_sample(self, name: str) -> None:
        """Open a measured example with its tip and sample."""
        example = EXAMPLES[name]
        self._take(example.name, example.read(), example.setting, name)

    def take_file(self, name: str, data: bytes) -> None:
        """Read a file; tip and sample stay as they were told, unless they were those of an example."""
        old, name = self.setting, in_line(name)
        if self._example:
            old = Setting()
        if name != old.file:
            # What is known of another curve does not hold for this one.
            old = old.replace(curve=0, columns={}, by=None, corrections={}, samples=())
            old = old.with_medium(old.medium) if old.medium else old
            old = old.replace(spring_constant=None, sensitivity=None)
        self._take(name, data, old)

    def _take(self, name: str, data: bytes, setting: Setting, example: str = "") -> None:
        self.curve = self.taken = self.fit = self.table = self.E = None
        self.count, self.rows, self._example = 0, [], example
        self.about, self.refused, self.not_fitted = "", NOTHING, NOTHING
        self._heads = None
        self.setting = setting.replace(file=name)
        suffix = re.sub(r"[^\w.-]", "", Path(name).suffix)[:20] if "\0" not in name else ""
        try:
            self._path = self._files.keep(data, suffix)
        except OSError:
            self._path, self.refused = "", Message(NOT_KEPT)
            self.show()
            return
        self._read()

    def reread(self, **given: Any) -> None:
        """Read the file again with what it lacks."""
        self.setting = self.setting.replace(samples=(), **given)
        if self._path:
            self._read()

    def choose_curve(self, number: int) -> None:
        """Take another curve of the file."""
        if self.count and number != self.setting.curve:
            self.setting = self.setting.replace(curve=number, samples=())
            self._read()

    @property
    def is_afm(self) -> bool:
        """Whether the file is none of a table."""
        return Path(self._path).suffix.lower().startswith(_AFM)

    @property
    def _given(self) -> dict[str, Any]:
        asked = self.setting
        given = {"spring_constant": asked.spring_constant, "sensitivity": asked.sensitivity}
        given = {name: value for name, value in given.items() if value is not None}
        given |= {"columns": asked.columns} if asked.columns else {}
        return given | ({"by": asked.by} if asked.by is not None else {})

    @property
    def lacks(self) -> Remark | Message:
        """The remark that the depth of the curve lacks the stiffness of the cantilever, or nothing."""
        return (self.curve is not None and deflection(self.curve.remarks)) or NOTHING

    @property
    def wants(self) -> set[str]:
        """Names of what the reader of the file asks for."""
        asked = (*self.refused.remedy, *self.lacks.remedy)
        columns = {"columns"} if self.question is not None else set()
        return columns | {each.what for each in asked if each.action == "give"}

    def _read(self) -> None:
        self.busy = f"Reading {self.setting.file}"
        # Rows of a map are of the curves as they were read before.
        self.refused, self.fit, self.question, self.rows = NOTHING, None, None, []
        self.show()
        self.worker.ask(
            "read", self._path, self._given, self.setting.curve, tell=self._tell(self._have_read)
        )

    def _have_read(self, kind: str, answer: Any) -> None:
        self.busy = ""
        if kind == "done" and answer[0] is not None:
            curve, self.count, _ = answer
            remarks = tuple(changed(each, self._with_name) for each in curve.remarks)
            self.curve = replace(curve, remarks=remarks)
            self.table = self.curve.table
            if self._heads is not None:
                self._told[self._heads] = self._given
            self.about = self._of_file()
            self._place()
            self.fit_again()
            return
        self.curve = self.taken = None
        if kind == "done":
            self._ask(Question(**answer[2]), answer[1])
        else:
            self.refused = answer.changed(self._with_name)
        self.show()

    def _ask(self, question: Question, count: int) -> None:
        """Ask what a table is, or tell it as that of a file before with the same heads."""
        self.count, self.table, self._heads = count, question.table, question.table.key
        known = self._told.get(self._heads)
        if known and not self.setting.columns:
            self.setting = self.setting.replace(samples=(), **known)
            self._read()
            return
        self.question = question
        self.refused = Message(*question.why).changed(self._asked)

    def _asked(self, text: str) -> str:
        why = text if text.endswith("?") else f"{text.rstrip('.')}."
        return f"{self.setting.file}: {why} Check what is chosen below, and press Read"

    def _with_name(self, text: str) -> str:
        """A text with the name of the file that was dropped, in the place of that of the kept one."""
        kept = Path(self._path).name
        return text.replace(kept, self.setting.file) if kept else text

    def _of_file(self) -> str:
        curve = self.curve
        of = f", curve {self.setting.curve + 1} of {self.count}" if self.count > 1 else ""
        return Markup("<b>{}</b>{}: {} samples").format(self.setting.file, of, len(curve))

    def _place(self) -> None:
        """Take the samples of the curve without what is subtracted."""
        given = self.setting.corrections
        self.taken = samples(self.curve, given.get("drift", 0.0), given.get("frame", 0.0))
