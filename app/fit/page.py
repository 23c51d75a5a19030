"""The page of one person for a measurement: a file in, the number to quote out."""

from collections.abc import Callable
from functools import partial
from io import StringIO
from pathlib import Path
from typing import Any

import panel as pn
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import ColumnDataSource, CustomJS
from markupsafe import Markup

from mdr_core.numerics.remark import Remark

from ..tip import in_line
from ..ui import JS, WIDE, html, landmarks
from . import words
from .files import as_csv, as_json
from .fits import Fits
from .form import Form
from .refusals import NOTHING
from .results import Results
from .samples import EXAMPLES, example_named
from .setting import MEDIA, Setting
from .tips import Tips
from .worker import Here, Worker

#: Roles and names of the parts of the page, by their classes.
_LANDMARKS = {
    "fit-header": ("banner", "Measurement"),
    "asked": ("complementary", "Curve, tip and sample"),
    "found": ("main", "Result"),
}
#: What has the plots in it.
_BOTH = {"sizing_mode": "stretch_both", "margin": 0}
_OVER = "addEventListener('dragenter', () => { over.tags = ['file'] }, { once: true })"
_NAMES = Path(__file__).with_name("names.js").read_text(encoding="utf-8")


class Measurement(Fits):
    """The page: a setting, the curve that is read, its samples and its fit, and what is shown of them."""

    def __init__(self, query: str = "", worker: Worker | Here | None = None):
        super().__init__(Setting.read(query), Worker() if worker is None else worker)
        # What is said below the file of the tip, and why it is refused.
        self.of_tip, self.tip_refused = "", NOTHING
        self._tips = Tips(self.host)
        self.form, self.results = Form(self), Results(self)
        self._address = pn.widgets.TextInput(visible=False)
        self._address.jscallback(value="history.replaceState(null, '', source.value)")
        header = (
            html(Markup("<h1>Measurement</h1>"), "name", sizing_mode="stretch_width"),
            html(Markup('<a href="?">Indentation explorer</a>'), "links", sizing_mode=None),
        )
        columns = pn.Row(self.form.view, self.results.view, css_classes=["fit-columns"], **_BOTH)
        self.view = pn.Column(
            pn.Row(*header, self._address, css_classes=["fit-header"], **WIDE), columns,
            css_classes=["fit-page"], **_BOTH,
        )  # fmt: skip
        # The address restores what was told when the session is lost.
        self.document.js_on_event(ConnectionLost, CustomJS(code=JS["again"]))
        landmarks(self.document, _LANDMARKS, "found", "Skip to the result")
        self.document.js_on_event(DocumentReady, CustomJS(code=_NAMES))
        # The process starts while a file is still dragged over the page.
        over = ColumnDataSource()
        over.on_change("tags", lambda attr, old, new: self.worker.start())
        self.document.add_root(over)
        self.document.js_on_event(DocumentReady, CustomJS(args={"over": over}, code=_OVER))
        self.host.at_end(self.close)
        self._begin()

    def __panel__(self) -> Any:
        """What Panel shows of it, so that `pn.panel(page)` and a layout take a page as it is."""
        return self.view

    def _begin(self) -> None:
        """Show what a link asks for: an example once the page is there, another file by its name."""
        asked = self.setting
        name = example_named(asked.file)
        if name and not self.host.processes:
            self._open_example(name)
            return
        if name:
            # A process is for a page that has connected, which a request alone has not.
            self.document.on_event(DocumentReady, lambda event: self._path or self._open_example(name))
            self.busy = f"Reading {asked.file}"
        elif asked.file:
            about = Markup("This link was made with <b>{}</b>: drop that file here.")
            self.about = about.format(asked.file)
        self.show()

    def _open_example(self, name: str) -> None:
        """Read an example with the setting of the link."""
        self._take(EXAMPLES[name].name, EXAMPLES[name].read(), self.setting, name)

    def close(self) -> None:
        """End the process and remove the file."""
        self.worker.stop()
        self._files.clear()

    # What is set.

    def change(self, make: Callable[[Setting], Setting]) -> None:
        """Change the setting, and fit again."""
        self.setting = make(self.setting)
        self.fit_again()

    def choose_medium(self, name: str) -> None:
        """Take another kind of sample, whose parameters are free as it says.

        Of one that yields, too, what is held stays.
        """
        if name == self.setting.medium or self.form._quiet:
            return
        if self.setting.medium and self.setting.kind.letter and name and MEDIA[name].letter:
            self.take_class(name)
        else:
            self.change(lambda s: s.with_medium(name) if name else s.replace(medium="", held={}))

    def take_class(self, medium: str) -> None:
        """Fit the hardness of another class; what else is free or held, and the samples, stay."""
        constants = {"E_star", "contact_point", "baseline", "tilt", "drag"}
        held = {name: v for name, v in self.setting.held.items() if name in constants}
        self.change(lambda setting: setting.replace(medium=medium, held=held))

    def take_tip(self, name: str, data: bytes) -> None:
        """Take a measured tip from a file."""
        self._tips.read(in_line(name), data, partial(self._have_tip, in_line(name)))

    def _have_tip(self, name: str, kind: str, answer: Any) -> None:
        self.of_tip, self.tip_refused = ("", answer) if kind == "refused" else (answer, NOTHING)
        if kind == "done":
            columns, self.of_tip = answer
            samples = tuple(map(tuple, columns))
            self.change(lambda s: s.replace(tip="measured", tip_samples=samples, tip_name=name))
        else:
            self.form.show(self.setting)

    def hold(self, name: str, value: float) -> None:
        """Hold a parameter at a value, or correct the depth by one."""
        if name in ("drift", "frame", "depth_noise"):
            self.setting = self.setting.replace(corrections=self.setting.corrections | {name: value})
            if self.curve is not None:
                self._place()
            self.fit_again()
        else:
            self.change(lambda setting: setting.replace(held=setting.held | {name: value}))

    def free(self, name: str, free: bool) -> None:
        """Let the fit find a parameter, or hold it at what was found."""
        held = dict(self.setting.held)
        if self.form._quiet or free == (name not in held):
            return
        if free:
            del held[name]
        else:
            held[name] = float(self.fit.to_dict()[name]) if self.fit is not None else 0.0
            if self.fit is None and name in ("E_star", "hardness", "q_c", "f_c"):
                self.show()
                return
        self.change(lambda setting: setting.replace(held=held))

    def choose_samples(self, ends: tuple[int, ...]) -> None:
        """Fit the samples from one number to another."""
        if self.taken is not None and tuple(ends) != self.ends:
            whole = tuple(ends) == self._ends_of(self.setting.kind.part if self.setting.medium else "all")
            self.change(lambda setting: setting.replace(samples=() if whole else tuple(map(int, ends))))

    def choose_part(self, part: str) -> None:
        """Fit all samples, those of loading, or those of unloading."""
        if self.taken is not None:
            self.choose_samples(self._ends_of(part))

    def correction(self, name: str) -> float | None:
        """What the depth is corrected by: as typed, or the noise that is estimated."""
        value = self.setting.corrections.get(name)
        if value is None and name == "depth_noise" and self.taken is not None:
            value = self.taken.depth_noise
        return value or None

    def value_of(self, name: str) -> str:
        """A parameter as it was found, in words."""
        return words.value_of(self.fit, name) if self.fit is not None else ""

    # What is shown and saved.

    @pn.io.hold()
    def show(self) -> None:
        """Show everything as it is."""
        self.form.show(self.setting)
        self.results.show()
        query = self.setting.query()
        self._address.value = "?fit" + f"&{query}" * bool(query)

    def written(self, name: str) -> StringIO:
        """The fit as a file: "json" or "csv"."""
        write = {"json": as_json, "csv": as_csv}[name]
        told = {"told": self.told, "remarks": self.remarks, "samples": self.ends, "count": len(self.curve)}
        return StringIO(write(self.setting, self.fit, told | {"E": self.E}))

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """All remarks on the number, the fit, and the reading of the file."""
        told = self.told
        return tuple(dict.fromkeys((*told.above, *told.below, *told.remarks, *self.curve.remarks)))


def served(query: str) -> Any:
    """The page of a session."""
    return Measurement(query)
