"""What is asked of a curve: the samples that are taken of it, and the fit of those in use."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.fit.noise import jitter
from mdr_core.measured_curve import MeasuredCurve
from mdr_core.show.units import written

from .setting import MEDIA

#: Most samples that are fitted and drawn: of more, one in two, three … is taken.
MOST = 2000


@dataclass(frozen=True)
class Samples:
    """The samples of a curve that are taken: numbers from 1 on, depth (m), force (N), and time (s).

    `held` are those of its holds.
    """

    number: np.ndarray
    depth: np.ndarray
    force: np.ndarray
    time: np.ndarray | None
    held: np.ndarray

    @property
    def deepest(self) -> int:
        """Number of the sample with the largest depth."""
        return int(self.number[np.argmax(self.depth)])

    @property
    def depth_noise(self) -> float:
        """Standard deviation (m) of depths that go back and forth, 0 where it hardly counts."""
        return float(f"{jitter(self.depth, self.force)[0]:.2g}")

    def within(self, ends: tuple[int, ...]) -> np.ndarray:
        """Which samples are between two numbers."""
        return (ends[0] <= self.number) & (self.number <= ends[1])

    def other(self, part: str) -> np.ndarray | None:
        """Which samples are those of unloading beside a part "loading", or the reverse, without holds."""
        later = self.number >= self.deepest
        of = {"loading": later, "unloading": ~later}.get(part)
        return None if of is None else of & ~self.held


def samples(curve: MeasuredCurve, drift: float = 0.0, frame: float = 0.0) -> Samples:
    """Samples of a curve without a drift (m/s) and the frame compliance (m/N)."""
    if drift and curve.time is not None:
        curve = curve.minus_drift(drift)
    if frame:
        curve = curve.minus_frame(frame)
    step = -(-len(curve) // MOST)
    columns = (np.arange(1, len(curve) + 1), curve.depth, curve.force, curve.time, curve.segment == "hold")
    return Samples(*(None if each is None else each[::step] for each in columns))


def first_and_last(taken: Samples, count: int, part: str) -> tuple[int, int]:
    """Numbers of the first and the last sample of a part: "all", "loading" or "unloading"."""
    top = taken.deepest
    ends = {"all": (1, count), "loading": (1, top), "unloading": (top, count)}[part]
    return ends if ends[0] < ends[1] else (1, count)


@dataclass(frozen=True)
class Asked:
    """What is fitted: a tip, samples with those in `used`, the kind of sample, and arguments of the fit.

    `part` is the part of the curve that they are, "loading" or "unloading", empty for others, and `other`
    are the samples of the other one, without holds. `units` are those of depth and force in the file.
    """

    profile: mdr.Profile
    depth: np.ndarray
    force: np.ndarray
    time: np.ndarray | None
    used: np.ndarray
    medium: str
    arguments: dict[str, Any]
    part: str = ""
    other: np.ndarray | None = None
    units: tuple[str, str] = ("", "")

    @property
    def needs_time(self) -> bool:
        """Whether something is fitted that needs times."""
        return any(self.arguments.get(name, 0.0) != 0 for name in ("eta", "drag"))


@dataclass(frozen=True)
class Each:
    """What is fitted of each curve: corrections of the depth, tip, kind of sample, part or range."""

    profile: mdr.Profile
    medium: str
    arguments: dict[str, Any]
    part: str
    samples: tuple[int, ...] = ()
    corrections: dict[str, float] = field(default_factory=dict)

    def of(self, curve: MeasuredCurve, taken: Samples | None = None) -> Asked:
        """What is asked of one curve; of `taken` samples, else of those with the corrections."""
        taken = samples(curve, **self.corrections) if taken is None else taken
        own = dict(self.arguments)
        if curve.time is None:
            own = {name: value for name, value in own.items() if name not in ("eta", "drag")}
        if MEDIA[self.medium].letter and taken.depth_noise:
            own.setdefault("depth_noise", taken.depth_noise)
        ends = self.samples or first_and_last(taken, len(curve), self.part)
        parts = ("loading", "unloading")
        part = next((each for each in parts if first_and_last(taken, len(curve), each) == ends), "")
        columns = {"depth": curve.columns.get("piezo")} | curve.columns
        units = tuple((columns.get(name) or ("", ""))[1].lstrip("−") for name in ("depth", "force"))
        return Asked(
            self.profile, taken.depth, taken.force, taken.time, taken.within(ends), self.medium, own,
            part=part, other=taken.other(part), units=units,
        )  # fmt: skip


def refuse_range(asked: Asked) -> None:
    """Refuse samples that need those before them: a medium remembers the largest depth, and rates."""
    depth, used, arguments = asked.depth, asked.used, asked.arguments
    if np.count_nonzero(used) < 2:
        raise ValueError("the range has fewer than two samples to be fitted: choose a longer range")
    first = int(np.argmax(used))
    if arguments.get("eta", 0.0) != 0 and first:
        raise ValueError(
            "with viscosity the force depends on all samples before: begin the range at sample 1"
        )
    largest, within = float(depth[: first + 1].max()), float(depth[used].max())
    # As for noise of the depth, a thousandth of the range hardly counts.
    if arguments.get("q_c") != np.inf and largest - within > 1e-3 * np.ptp(depth[used]):
        raise ValueError(
            f"the samples before the range reach deeper, {written(largest, 'length')}, than the range, "
            f"{written(within, 'length')}, and their yield would not be fitted: begin the range at the "
            "largest depth or before"
        )
    origin = arguments.get("contact_point")
    if origin is not None and origin >= depth[used].max():
        raise ValueError(
            f"first contact z₀ = {written(origin, 'length')} is held, and the samples reach only to "
            f"{written(within, 'length')}: let the fit find z₀, or type a smaller z₀"
        )
