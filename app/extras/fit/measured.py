"""Measured curves: read, placed over the model, and what a fit of them agrees with."""

import re
import tempfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

import mdr_core as mdr
from mdr_core.fit.indentation import IndentationFit
from mdr_core.fit.noise import jitter
from mdr_core.fit.parameters import CLASSES
from mdr_core.measured_curve import MeasuredCurve
from mdr_core.reading import SIZES, UnknownColumns, curve_of

from ...state import State, checked, medium, profile
from ...tip import FITTED as MOST
from ...tip import in_line

#: Parameters of a fit: those of the medium, with the choice and option of the page, and the rest.
OF_MEDIUM = {
    "E_star": ("elasticity", "modulus"), "q_c": ("plasticity", "q_c"),
    "hardness": ("plasticity", "constant"), "f_c": ("plasticity", "line"),
    "eta": ("damping", "eta"), "work_of_adhesion": ("adhesion", "work"),
}  # fmt: skip
PLACED = ("contact_point", "baseline", "tilt", "drag")
#: What is subtracted from the depth before a fit.
SUBTRACTED = ("drift", "frame")
FITTED = (*OF_MEDIUM, *PLACED)
#: Constants of the hardness, of which a fit has one, by the options of the choice "plasticity".
CONSTANTS = {option: name for name, (choice, option) in OF_MEDIUM.items() if choice == "plasticity"}
#: What the hardness of a class is.
_HARDNESS = {"a": "constant", "b": "∝ 1/a", "c": "∝ 1/a²"}
#: Those that need the times of the samples.
_IN_TIME = ("eta", "drag", "drift")


@dataclass(frozen=True, eq=False)
class Measured:
    """A curve from a file, as the core reads it, and its fit with what that subtracts and which samples."""

    name: str
    curve: MeasuredCurve
    fit: IndentationFit | None = None
    subtracted: tuple[float, ...] = (0.0, 0.0)
    #: Numbers of the first and the last sample of the fit, from 1 on.
    chosen: tuple[int, ...] = ()

    @property
    def step(self):
        """One in this many samples is taken."""
        return -(-len(self.curve) // MOST)

    @property
    def data(self):
        """Depth (m) and force (N) of the samples that are taken."""
        return self.curve.depth[:: self.step], self.curve.force[:: self.step]

    @property
    def time(self):
        """Time (s) of the same samples, or None."""
        return None if self.curve.time is None else self.curve.time[:: self.step]

    def samples(self, state):
        """`data` without the drift and the give of the frame."""
        curve = self.curve
        if state["fit.drift"] and curve.time is not None:
            curve = curve.minus_drift(state["fit.drift"])
        if state["fit.frame"]:
            curve = curve.minus_frame(state["fit.frame"])
        return curve.depth[:: self.step], curve.force[:: self.step]

    def range(self, state):
        """Numbers of the first and the last sample that are chosen, from 1 on."""
        first, last = map(int, state["fit.samples"] or (1, len(self.curve)))
        return first, min(last, len(self.curve))

    def used(self, state):
        """Which of the samples that are taken are in the chosen range."""
        first, last = self.range(state)
        number = np.arange(1, len(self.curve) + 1)[:: self.step]
        return (first <= number) & (number <= last)

    def deepest(self, state):
        """Number of the sample with the largest depth, from 1 on."""
        return 1 + self.step * int(np.argmax(self.samples(state)[0]))

    @property
    def depth_noise(self):
        """Standard deviation (m) of depths that go back and forth, 0 where it hardly counts."""
        return float(f"{jitter(*self.data)[0]:.2g}")

    #: Report of the fit as HTML.
    report = cached_property(lambda self: self.fit._repr_html_())

    @cached_property
    def verdict(self):
        """What the report says on the class of hardness, in one line; empty where it has nothing."""
        rows = dict(self.fit._rows())
        if "class of hardness" not in rows:
            return ""
        answer, _, misfits = rows["class of hardness"].partition(": ")
        own = next(letter for letter, name in CLASSES.items() if getattr(self.fit.medium, name))
        told = re.sub(r"\((.)\)", lambda letter: f"({letter[1]}) {_HARDNESS[letter[1]]}", answer)
        other = f" This fit is of class ({own}), {_HARDNESS[own]}." * (f"({own})" not in answer)
        return (
            f"Class of hardness: {told}; {misfits}.{other} The class presumes {rows['the class presumes']}."
        )

    def known(self, names):
        """Those of some parameters that are known without the times of the samples, or with them."""
        return [name for name in names if self.time is not None or name not in _IN_TIME]

    @property
    def fitted(self):
        """Names of the parameters that a fit can have."""
        return self.known(FITTED)

    @property
    def note(self):
        taken = f"{len(self.curve)} samples" + f", one in {self.step} of them taken" * (self.step > 1)
        part = ["the fit is of samples {} to {}".format(*self.chosen)] if self.of_part else []
        return "; ".join([taken, *part, *self.curve.remarks])

    @property
    def of_part(self):
        """Whether the fit is of a part of the samples."""
        return self.fit is not None and self.chosen != (1, len(self.curve))

    def placed(self, state):
        """The curve at its position on the page."""
        (depth, force), time = self.samples(state), self.time
        force = force - state["fit.baseline"] - state["fit.tilt"] * depth
        if state["fit.drag"] and time is not None:
            force = force - state["fit.drag"] * np.gradient(depth, time)
        fit = self.fit if self.fit is not None and agrees(state) else None
        return Curve(depth - state["fit.contact_point"], force, self.used(state), fit)

    def corrected(self, role, chosen):
        """With another column or unit of "depth", "force" or "time", without a fit."""
        columns, table = dict(self.curve.columns), self.curve.table
        own = columns[role]
        if isinstance(chosen, str):
            columns[role] = own and (own[0], chosen)
        elif chosen is None:
            columns[role] = None
        else:
            taken = next((k for k, column in columns.items() if column and column[0] == chosen), role)
            if taken != role and own is None:
                raise ValueError(f"that is the column of {taken}: choose another one for that first")
            # Who had that column gets the other one.
            columns[taken] = own and (own[0], columns[taken][1])
            unit = table.unit(chosen)
            columns[role] = chosen, own[1] if own else unit if unit in SIZES[role] else "s"
        curve = curve_of(table, "the file", columns, self.curve.spring_constant, turn=False)
        return Measured(self.name, curve)


def read_curve(data: bytes, name: str, columns: dict | None = None) -> Measured:
    """Measured curve from a file, see `mdr.read_curve`.

    Raises ValueError, and UnknownColumns if the columns are not given and the header does not name them.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"the file{Path(name).suffix}"
        path.write_bytes(data)
        name = in_line(name)
        try:
            return Measured(name, mdr.read_curve(path, columns=columns))
        except UnknownColumns as error:
            text = (
                f"{name} does not name its columns of depth and force, and their units: choose them below"
            )
            raise UnknownColumns(text, error.table) from None
        except (ValueError, ImportError) as error:
            raise ValueError(str(error).replace(path.name, name)) from None


def with_curve(state: State, curve: Measured | None) -> State:
    """With a curve that has no fit, or none, and the noise of its depth; with adhesion none is fitted."""
    noise = curve.depth_noise if curve and state.adhesion == "none" else 0.0
    noise = checked("fit.depth_noise", noise)
    values = {"fit.curve": curve, "fit.note": "", "fit.depth_noise": noise, "fit.samples": ()}
    return state.replace(**values)


def offered(state: State) -> list[str]:
    """Names of the parameters that a fit of the curve can have on the page.

    Of the constants of the hardness that is the chosen one, and w only with adhesion.
    """
    no = set(CONSTANTS.values()) - {state["fit.hardness"]}
    no |= set() if state.adhesion == "work" else {"work_of_adhesion"}
    return [name for name in state["fit.curve"].fitted if name not in no]


def agrees(state: State) -> bool:
    """Whether the page shows the result of the fit."""
    found, made = state["fit.curve"].fit, medium(state)
    values, names = found.to_dict(), state["fit.curve"].fitted
    pairs = [
        (state[f"fit.{name}"] if name in PLACED else getattr(made, name), values[name]) for name in names
    ]
    pairs += [
        (state[f"fit.{name}"], value)
        for name, value in zip(SUBTRACTED, state["fit.curve"].subtracted, strict=True)
    ]
    same = profile(state) == found.profile and state["fit.curve"].range(state) == state["fit.curve"].chosen
    return same and bool(np.allclose(*zip(*pairs, strict=True), rtol=1e-9, atol=0))


@dataclass(frozen=True, eq=False)
class Curve:
    """Depths (m) below first contact and forces (N) above the baseline, with the fit if it holds.

    `used` says which of the samples are in the chosen range.
    """

    depth: np.ndarray
    force: np.ndarray
    used: np.ndarray
    fit: IndentationFit | None = None

    def residual(self, scene):
        """Measured minus modelled force (N) of the samples in use; NaN if the scene cannot be solved."""
        if self.fit is not None:
            return self.fit.residuals
        try:
            modelled = mdr.indent(scene.profile, scene.medium, self.depth).force
            return (self.force - modelled)[self.used]
        except ValueError:
            return np.full(np.count_nonzero(self.used), np.nan)
