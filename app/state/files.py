"""Uploaded files: measured tips and curves."""

import tempfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.fit.errors import roughness
from mdr_core.fit.indentation import IndentationFit
from mdr_core.profiles.samples import axis_of_symmetry, samples_of
from mdr_core.reading import MeasuredCurve, curve_of

from . import State, checked, medium, profile
from .units import written

#: Most samples that are pressed without keeping everybody waiting, most that a tip is fitted to or that are
#: taken of a curve, most rows of a tip and most bytes of a file.
MAX_SAMPLES, _FITTED, _MAX_ROWS, MAX_BYTES = 60, 2000, 20_000, 5_000_000
#: Parameters of a fit: those of the medium, with the choice and option of the page, and the rest.
OF_MEDIUM = {
    "E_star": ("elasticity", "modulus"), "q_c": ("plasticity", "q_c"), "eta": ("damping", "eta"),
    "work_of_adhesion": ("adhesion", "work"),
}  # fmt: skip
PLACED = ("contact_point", "baseline", "tilt", "drag")
FITTED = (*OF_MEDIUM, *PLACED)
#: Those that need the times of the samples.
_IN_TIME = ("eta", "drag")


@dataclass(frozen=True)
class Uploaded:
    """A file from the browser: name, size (bytes), and data unless it is too large to be sent."""

    name: str
    size: int
    data: bytes | None

    def read(self) -> bytes:
        """Data of the file. Raises ValueError if it is too large."""
        if self.data is None or len(self.data) > MAX_BYTES:
            sizes = f"{self.size / 1e6:.3g} MB, more than {MAX_BYTES / 1e6:g} MB"
            raise ValueError(f"{self.name:.80} has {sizes}; thin out its samples")
        return self.data


def _named(name: str) -> str:
    """Name of a file in a line of text."""
    return " ".join(name.split())[:80]


def read_tip(text: str, name: str = "the file") -> tuple[tuple[Any, Any], str]:
    """Radii and heights (m) of an uploaded tip, and a note; the header names the units.

    Long, noisy or two-sided data become the nearest convex tip, see `mdr.Sampled.fit`. Raises ValueError.
    """
    name = _named(name)
    r, z = samples_of(text, name, None, _MAX_ROWS)
    try:
        if len(r) <= MAX_SAMPLES:
            return (mdr.Sampled(r, z).r, z - z[0]), f"{len(r)} samples as they are"
    except ValueError:
        # Noise makes any tip concave somewhere.
        pass
    rows = len(r)
    if min(r) < 0 < max(r):
        r = r - axis_of_symmetry(r, z)
    parts = np.array_split(np.argsort(r, kind="stable"), min(rows, _FITTED))
    averages = [np.array([np.mean(of[part]) for part in parts]) for of in (r, z)]
    try:
        tip = mdr.Sampled.fit(*averages)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    # On a convex polygon every other one of its vertices is convex too.
    subset = np.unique(np.linspace(0, len(tip.r) - 1, MAX_SAMPLES).round().astype(int))
    samples = np.array(tip.r)[subset], np.array(tip.z)[subset]
    by = written(float(np.std(z - np.interp(np.abs(r), *samples))), "length", 2)
    return samples, f"{len(subset)} samples, nearest to {rows} rows, which scatter by {by} about them"


@dataclass(frozen=True, eq=False)
class Measured:
    """A curve from a file, as the core reads it, and its fit."""

    name: str
    curve: MeasuredCurve
    fit: IndentationFit | None = None

    @property
    def _step(self):
        return -(-len(self.curve) // _FITTED)

    @property
    def data(self):
        """Depth (m) and force (N) of the samples that are taken."""
        return self.curve.depth[:: self._step], self.curve.force[:: self._step]

    @property
    def time(self):
        """Time (s) of the same samples, or None."""
        return None if self.curve.time is None else self.curve.time[:: self._step]

    @property
    def depth_noise(self):
        """Standard deviation (m) of depths that go back and forth, 0 where it hardly counts.

        Taken for real maxima of depth it changes E* by about its share of the depth that is recovered on
        unloading; below a thousandth the model is further off.
        """
        depth, force = self.data
        steps, noise = np.diff(depth), roughness(depth[None])[0, 0]
        reversals = np.count_nonzero(steps[1:] * steps[:-1] < 0)
        last = int(np.argmax(depth))
        loaded = depth[last:][force[last:] > 0.05 * force.max()]
        recovered = np.ptp(np.append(depth[last], loaded))
        counts = reversals > max(4, 0.05 * steps.size) and noise > 1e-3 * recovered
        return float(f"{noise:.2g}") if counts else 0.0

    #: Report of the fit as HTML.
    report = cached_property(lambda self: self.fit._repr_html_())

    @property
    def fitted(self):
        """Names of the parameters that a fit can have."""
        return [name for name in FITTED if self.time is not None or name not in _IN_TIME]

    @property
    def note(self):
        taken = f"{len(self.curve)} samples" + f", one in {self._step} of them taken" * (self._step > 1)
        return "; ".join([taken, *self.curve.remarks])

    def placed(self, state):
        """The curve at its position on the page."""
        (depth, force), time = self.data, self.time
        force = force - state.baseline - state.tilt * depth
        if state.drag and time is not None:
            force = force - state.drag * np.gradient(depth, time)
        fit = self.fit if self.fit is not None and agrees(state) else None
        return Curve(depth - state.contact_point, force, fit)

    def corrected(self, role, chosen):
        """With another column or unit of "depth", "force" or "time", without a fit."""
        columns, units = dict(self.curve.columns), dict(self.curve.units)
        if isinstance(chosen, str):
            units[role] = chosen
        else:
            taken = next((k for k, column in columns.items() if column == chosen is not None), role)
            if taken != role and columns[role] is None:
                raise ValueError(f"that is the column of {taken}: choose another one for that first")
            # Who had that column gets the other one.
            columns[taken], columns[role] = columns[role], chosen
        return Measured(self.name, curve_of(self.curve.table, "the file", columns, units))


def read_curve(data: bytes, name: str) -> Measured:
    """Measured curve from a file, see `mdr.read_curve`. Raises ValueError."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"the file{Path(name).suffix}"
        path.write_bytes(data)
        name = _named(name)
        try:
            return Measured(name, mdr.read_curve(path))
        except ValueError as error:
            raise ValueError(str(error).replace(path.name, name)) from None


def with_curve(state: State, curve: Measured | None) -> State:
    """With a curve that has no fit, or none, and the noise of its depth; with adhesion none is fitted."""
    noise = curve.depth_noise if curve and state.adhesion == "none" else 0.0
    return state.replace(curve=curve, fit_note="", depth_noise=checked("depth_noise", noise))


def offered(state: State) -> list[str]:
    """Names of the parameters that a fit of the curve can have on the page: w only with adhesion."""
    adhesive = state.adhesion == "work"
    return [name for name in state.curve.fitted if adhesive or name != "work_of_adhesion"]


def agrees(state: State) -> bool:
    """Whether the page shows the result of the fit."""
    found, made = state.curve.fit, medium(state)
    values, names = found.to_dict(), state.curve.fitted
    pairs = [(state[name] if name in PLACED else getattr(made, name), values[name]) for name in names]
    return profile(state) == found.profile and bool(
        np.allclose(*zip(*pairs, strict=True), rtol=1e-9, atol=0)
    )


@dataclass(frozen=True, eq=False)
class Curve:
    """Depths (m) below first contact and forces (N) above the baseline, with the fit if it holds."""

    depth: np.ndarray
    force: np.ndarray
    fit: IndentationFit | None = None

    def residual(self, scene):
        """Measured minus modelled force (N); NaN if the scene cannot be solved."""
        if self.fit is not None:
            return self.fit.residuals
        try:
            return self.force - mdr.indent(scene.profile, scene.medium, self.depth).force
        except ValueError:
            return np.full_like(self.depth, np.nan)
