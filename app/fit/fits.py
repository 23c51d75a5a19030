"""Fits of a page: of the curve that is shown, once everything is told, and of all curves of a file."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import panel as pn
from bokeh.document import Document

from mdr_core.fit.indentation import IndentationFit

from ..server import host_of
from .asked import Each, first_and_last
from .measurement import Told, modulus_of_sample
from .refusals import NOTHING, Message, refusal
from .setting import Setting
from .source import Source
from .worker import Here, Worker, waiting


class Fits(Source):
    """The samples of a page that are fitted, and their fit; the page shows it by `results`."""

    results: Any

    def __init__(self, setting: Setting, worker: Worker | Here):
        super().__init__(setting, worker)
        self.document = pn.state.curdoc or Document()
        self.host = host_of(self.document)
        self.fit: IndentationFit | None = None
        self.told: Told | None = None
        #: Young's modulus of the sample and its error (Pa).
        self.E: tuple[float, float] | None = None
        #: Why there is no fit, and what is being done.
        self.not_fitted = NOTHING
        self.busy = ""
        #: Of each curve of a map its number, E*, error and reason, once all are asked for.
        self.rows: list[tuple[Any, ...]] = []
        self._job = 0

    # Samples.

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

    @property
    def used(self) -> np.ndarray:
        """Which of the samples that are taken are fitted."""
        return self.taken.within(self.ends)

    # Fits.

    def fit_again(self) -> None:
        """Fit, if everything is told."""
        self.fit, self.E, self.not_fitted, self.rows = None, None, NOTHING, []
        if self.curve is None or self.setting.missing or self.lacks:
            self.show()
            return
        try:
            asked = self._each(self.curve.time is not None).of(self.curve, self.taken)
        except ValueError as error:
            self.not_fitted = Message(*refusal(error))
            self.show()
            return
        self.busy = "Fitting"
        self.show()
        self.worker.ask("fit", vars(asked), tell=self._tell(self._have_fitted))

    def _each(self, timed: bool) -> Each:
        """What is asked of a curve. Raises ValueError for a tip that is none."""
        asked = self.setting
        arguments = asked.arguments(timed)
        if asked.kind.letter and "depth_noise" in asked.corrections:
            arguments["depth_noise"] = asked.corrections["depth_noise"]
        told = {name: asked.corrections[name] for name in ("drift", "frame") if name in asked.corrections}
        samples = () if self.curve is None or not asked.samples else self.ends
        return Each(asked.profile, asked.medium, arguments, asked.kind.part, samples, told)

    def _have_fitted(self, kind: str, answer: Any) -> None:
        self.busy = ""
        if kind == "done":
            self.fit, self.told = answer[0], Told(**answer[1])
            self._find_modulus()
        else:
            self.not_fitted = answer
        self.show()

    def _find_modulus(self) -> None:
        """Young's modulus of the sample, where Poisson's ratio is told."""
        asked, quoted = self.setting, self.told.quoted
        if asked.poisson is None or quoted.value is None:
            return
        given = quoted.value, quoted.standard_error, asked.poisson, asked.tip_modulus, asked.tip_poisson
        try:
            self.E = modulus_of_sample(*given)
        except ValueError as error:
            self.not_fitted = Message(*refusal(error))

    def fit_all(self) -> None:
        """Fit each curve of the file as the one that is shown, and say which could not be."""
        self.rows, self.busy = [], f"Fitting curve 1 of {self.count}"
        self.show()
        jobs = self._path, self._given, vars(self._each(True))
        self.worker.ask("fit_all", *jobs, tell=self._tell(self._have_one))

    def _have_one(self, kind: str, answer: Any) -> None:
        if kind == "part":
            self.rows.append(answer)
            self.busy = f"Fitting curve {min(len(self.rows) + 1, self.count)} of {self.count}"
            self.results.show_progress()
            return
        self.busy = ""
        if kind != "done":
            self.not_fitted = answer
        self.show()

    def cancel(self) -> None:
        """Stop what is being done."""
        self.worker.stop()
        self._job += 1
        self.busy = ""
        if self.fit is None:
            self.not_fitted = Message("Cancelled. Change something, or drop the file again")
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

        return lambda kind, answer: self.host.soon(partial(told, kind, answer))
