"""The file of a measurement: taking it, and reading the curve that is in it."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from markupsafe import Markup

from mdr_core.measured_curve import MeasuredCurve

from ..tip import in_line
from . import words
from .folders import NOT_KEPT, Files
from .measurement import Samples, samples
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
        # What is said below the file; what a refused file needs.
        self.about, self.refused = "", ""
        self.wants: set[str] = set()
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
            old = old.replace(curve=0, columns={}, corrections={}, samples=())
            old = old.with_medium(old.medium) if old.medium else old
            old = old.replace(spring_constant=None, sensitivity=None)
        self._take(name, data, old)

    def _take(self, name: str, data: bytes, setting: Setting, example: str = "") -> None:
        self.curve = self.taken = self.fit = self.table = self.E = None
        self.count, self.rows, self._example = 0, [], example
        self.about = self.refused = self.not_fitted = ""
        self.setting = setting.replace(file=name)
        suffix = re.sub(r"[^\w.-]", "", Path(name).suffix)[:20] if "\0" not in name else ""
        try:
            self._path = self._files.keep(data, suffix)
        except OSError:
            self._path = ""
            self._refuse(NOT_KEPT)
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
        return given | ({"columns": asked.columns} if asked.columns else {})

    def _read(self) -> None:
        self.busy = f"Reading {self.setting.file}"
        self.wants, self.refused, self.fit = set(), "", None
        self.show()
        self.worker.ask(
            "read", self._path, self._given, self.setting.curve, tell=self._tell(self._have_read)
        )

    def _have_read(self, kind: str, answer: Any) -> None:
        self.busy = ""
        if kind == "done" and answer[1]:
            self.curve, self.count = answer
            self.table = self.curve.table
            self.about = self._of_file()
            self._place()
            self.fit_again()
            return
        self.curve = self.taken = None
        if kind == "done":
            self.table = answer[0]
            self.wants = {"columns"}
            self._refuse(
                f"{self.setting.file} does not name its columns of depth and force with their units: "
                "choose them below"
            )
        else:
            text = answer.replace(Path(self._path).name, self.setting.file)
            self.wants = {
                name for name in ("spring constant", "sensitivity")
                if re.search(name.replace(" ", "."), text)
            }  # fmt: skip
            self._refuse(text)
        self.show()

    def _refuse(self, text: str) -> None:
        self.refused = words.refused(text.rstrip(".") + ".")

    def _of_file(self) -> str:
        curve = self.curve
        of = f", curve {self.setting.curve + 1} of {self.count}" if self.count > 1 else ""
        return Markup("<b>{}</b>{}: {} samples").format(self.setting.file, of, len(curve))

    def _place(self) -> None:
        """Take the samples of the curve without what is subtracted."""
        given = self.setting.corrections
        self.taken = samples(self.curve, given.get("drift", 0.0), given.get("frame", 0.0))
