"""The page of one person for a measurement: a file in, the number to quote out."""

from collections.abc import Callable
from functools import partial
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn
from bokeh.document import Document
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import ColumnDataSource, CustomJS
from markupsafe import Markup

from mdr_core.fit.indentation import IndentationFit

from ..server import host_of
from ..tip import in_line
from ..ui import JS, WIDE, html, landmarks
from . import words
from .files import as_csv, as_json
from .form import Form
from .measurement import Told, first_and_last, modulus_of_sample
from .results import Results
from .samples import EXAMPLES, example_named
from .setting import MEDIA, Setting
from .source import Source
from .tips import Tips
from .worker import Here, Worker, in_session, waiting

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


class Measurement(Source):
    """The page: a setting, the curve that is read, its samples and its fit, and what is shown of them."""

    def __init__(self, query: str = "", worker: Worker | Here | None = None):
        super().__init__(Setting.read(query), Worker() if worker is None else worker)
        self.document = pn.state.curdoc or Document()
        self.fit: IndentationFit | None = None
        self.told = Told((), None, "")
        self.E: tuple[float, float] | None = None
        # What is said of the fit, and what is being done.
        self.not_fitted, self.busy = "", ""
        #: Of each curve of a map its number, E*, error and reason, once all are asked for.
        self.rows: list[tuple[Any, ...]] = []
        self._job = 0
        # What is said below the file of the tip.
        self.of_tip = ""
        self._tips = Tips(host_of(self.document))
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
        if self.document.session_context is not None:
            self.document.on_session_destroyed(lambda context: self.close())
        self._begin()

    def __panel__(self) -> Any:
        """What Panel shows of it, so that `pn.panel(page)` and a layout take a page as it is."""
        return self.view

    def _begin(self) -> None:
        """Show what a link asks for: an example once the page is there, another file by its name."""
        asked = self.setting
        name = example_named(asked.file)
        if name and self.document.session_context is None:
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
        self.of_tip = words.refused(answer.rstrip(".") + ".") if kind == "refused" else answer
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

    def _ends_of(self, part: str) -> tuple[int, int]:
        return first_and_last(self.taken, len(self.curve), part)

    @property
    def ends(self) -> tuple[int, ...]:
        """Numbers of the first and the last sample that are fitted."""
        count = len(self.curve)
        chosen = self.setting.samples
        if chosen and chosen[0] < min(chosen[1], count):
            return chosen[0], min(chosen[1], count)
        return self._ends_of(self.setting.kind.part if self.setting.medium else "all")

    @property
    def part(self) -> str:
        """Which part the samples are: "all", "loading", "unloading", or none of them."""
        return next((p for p in ("all", "loading", "unloading") if self._ends_of(p) == self.ends), "")

    def correction(self, name: str) -> float | None:
        """What the depth is corrected by: as typed, or the noise that is estimated."""
        value = self.setting.corrections.get(name)
        if value is None and name == "depth_noise" and self.taken is not None:
            value = self.taken.depth_noise
        return value or None

    def value_of(self, name: str) -> str:
        """A parameter as it was found, in words."""
        return words.value_of(self.fit, name) if self.fit is not None else ""

    # Fits.

    def fit_again(self) -> None:
        """Fit, if everything is told."""
        self.fit, self.E, self.not_fitted, self.rows = None, None, "", []
        if self.curve is None or self.setting.missing:
            self.show()
            return
        try:
            profile, arguments = self.setting.profile, self._arguments()
        except ValueError as error:
            self.not_fitted = words.refused(f"{error}.")
            self.show()
            return
        taken = self.taken
        sent = {"depth": taken.depth, "force": taken.force, "time": taken.time}
        self.busy = "Fitting"
        self.show()
        sent["used"] = taken.within(self.ends)
        self.worker.ask("fit", profile, sent, arguments, tell=self._tell(self._have_fitted))

    def _arguments(self) -> dict[str, Any]:
        arguments = self.setting.arguments(self.curve.time is not None)
        if self.setting.kind.letter and (noise := self.correction("depth_noise")):
            arguments["depth_noise"] = noise
        return arguments

    def _have_fitted(self, kind: str, answer: Any) -> None:
        self.busy = ""
        if kind == "done":
            self.fit, self.told = answer[0], Told(**answer[1])
            self._find_modulus()
        else:
            self.not_fitted = words.refused(answer.rstrip(".") + ".")
        self.show()

    def _find_modulus(self) -> None:
        """Young's modulus of the sample, where Poisson's ratio is told."""
        asked, quoted = self.setting, self.fit.quoted
        if asked.poisson is None or quoted.value is None:
            return
        given = quoted.value, quoted.standard_error, asked.poisson, asked.tip_modulus, asked.tip_poisson
        try:
            self.E = modulus_of_sample(*given)
        except ValueError as error:
            self.not_fitted = words.refused(f"{error}.")

    def fit_all(self) -> None:
        """Fit each curve of the file as the one that is shown, and say which could not be."""
        asked = self.setting
        told = {name: asked.corrections[name] for name in ("drift", "frame") if name in asked.corrections}
        part = {
            "corrections": told, "noise": bool(asked.kind.letter), "samples": asked.samples,
            "part": asked.kind.part,
        }  # fmt: skip
        self.rows, self.busy = [], f"Fitting curve 1 of {self.count}"
        self.show()
        arguments = asked.arguments(True)
        jobs = self._path, self._given, part, asked.profile, arguments
        self.worker.ask("fit_all", *jobs, tell=self._tell(self._have_one))

    def _have_one(self, kind: str, answer: Any) -> None:
        if kind == "part":
            self.rows.append(answer)
            self.busy = f"Fitting curve {min(len(self.rows) + 1, self.count)} of {self.count}"
            self.results.show_progress()
            return
        self.busy = ""
        if kind != "done":
            self.not_fitted = words.refused(answer + ".")
        self.show()

    def cancel(self) -> None:
        """Stop what is being done."""
        self.worker.stop()
        self._job += 1
        self.busy = ""
        if self.fit is None:
            self.not_fitted = words.refused("Cancelled. Change something, or drop the file again.")
        self.show()

    def _tell(self, heard: Callable[[str, Any], None]) -> Callable[[str, Any], None]:
        """What a worker calls in its thread: `heard` is called where the page may be changed."""
        self._job += 1
        job, doing = self._job, self.busy

        def told(kind: str, answer: Any) -> None:
            # An answer that was on its way when something else was asked is nobody's.
            if job == self._job and kind == "waiting":
                self.busy = doing if answer is None else waiting(answer)
                self.results.show_busy()
            elif job == self._job:
                heard(kind, answer)

        return in_session(self.document, told)

    # What is shown and saved.

    @pn.io.hold()
    def show(self) -> None:
        """Show everything as it is."""
        self.form.show(self.setting)
        self.results.show()
        query = self.setting.query()
        self._address.value = "?fit" + f"&{query}" * bool(query)

    @property
    def used(self) -> np.ndarray:
        """Which of the samples that are taken are fitted."""
        return self.taken.within(self.ends)

    def written(self, name: str) -> StringIO:
        """The fit as a file: "json" or "csv"."""
        write = {"json": as_json, "csv": as_csv}[name]
        told = {
            "remarks": (*self.curve.remarks, *self.told.remarks), "samples": self.ends,
            "count": len(self.curve), "E": self.E,
        }  # fmt: skip
        return StringIO(write(self.setting, self.fit, told))


def served(query: str) -> Any:
    """The page of a session."""
    return Measurement(query)
