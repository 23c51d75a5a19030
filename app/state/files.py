"""Uploaded files: tables of numbers, measured tips and curves."""

import re
import tempfile
from collections import Counter
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.fit.indentation import IndentationFit
from mdr_core.shapes.tables import read_samples

from . import State, medium, profile
from .units import UNITS, named, written

#: Most samples that are pressed without keeping everybody waiting, most that a tip is fitted to, and most
#: rows of a file.
MAX_SAMPLES, _FITTED, MAX_ROWS = 60, 2000, 20_000
#: Parameters of a fit: medium and position of the curve.
FITTED = ("E_star", "q_c", "contact_point", "baseline", "frame_compliance")
#: Most samples of a curve that are taken.
_CURVE_SAMPLES = 2000
#: What the columns are called, as far as headers say it, the kind of their units, and what is guessed.
_WORDS = {
    "depth": (r"depth|displ|indent|tiefe|weg|\b[hdz]\b", "length", "nm"),
    "force": (r"force|load|kraft|last|\b[fp]\b", "force", "µN"),
    "time": (r"time|zeit|\bt\b", "time", "s"),
}
#: Sizes of the units of depth and force; those with a minus turn a column round.
SIZES = {
    role: {u.name: u.factor for u in UNITS[kind]} | {f"−{u.name}": -u.factor for u in UNITS[kind]}
    for role, kind in (("depth", "length"), ("force", "force"))
}


def decoded(data: bytes) -> str:
    """Text of a file as UTF-8, UTF-16 or Windows-1252."""
    if not data.strip():
        raise ValueError("the file is empty")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


# Tables as instruments write them: a header and rows of numbers.


def _cells(line: str) -> list[str]:
    """Cells of a line; a comma is decimal if something else separates the cells."""
    line = line.strip().strip('"')
    if ";" in line or "\t" in line:
        return [
            cell.strip().strip('"').replace(",", ".") for cell in re.split(r"[;\t]", line.rstrip(";\t"))
        ]
    parts = line.split()
    if len(parts) > 1 and any(re.fullmatch(r"[-+]?\d+,\d+(e[-+]?\d+)?", part, re.I) for part in parts):
        return [part.replace(",", ".") for part in parts]
    parts = line.rstrip(",").split(",") if "," in line else parts
    return [part.strip().strip('"') for part in parts]


def _number(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return np.nan


def table(text: str) -> tuple[list[str], np.ndarray, list[str]]:
    """Names of columns, numbers (rows, columns), and notes on what was left out.

    Columns without numbers in most rows and incomplete rows are left out. Raises ValueError without any
    rows.
    """
    lines = [(n, line, _cells(line)) for n, line in enumerate(text.splitlines()[: 2 * MAX_ROWS], 1)]
    lines = [each for each in lines if each[1].strip()]
    is_row = [
        np.isfinite([_number(c) for c in cells]).any() and not line.startswith("#")
        for _, line, cells in lines
    ]
    first = is_row.index(True) if any(is_row) else len(lines)
    header = [line for _, line, _ in lines[:first]]
    rows = [each for each in lines[first:] if each[1][0] != "#"]
    if not rows:
        raise ValueError("the file has no rows of numbers")
    if len(rows) > MAX_ROWS:
        raise ValueError(f"the file has more than {MAX_ROWS} samples; thin them out")
    width = Counter(len(cells) for *_, cells in rows).most_common(1)[0][0]
    heads = _heads(header, width)
    odd = [(n, f"has {len(cells)} cells, not {width}") for n, _, cells in rows if len(cells) != width]
    rows = [(n, [_number(cell) for cell in cells]) for n, _, cells in rows if len(cells) == width]
    values = np.array([cells for _, cells in rows])
    kept = np.isfinite(values).mean(axis=0) > 0.5
    bad = np.flatnonzero(~np.isfinite(values[:, kept]).all(axis=1)).tolist()
    odd += [(rows[k][0], "has a cell that is no finite number") for k in bad]
    notes = [f"column {k + 1} is no number and is left out" for k in np.flatnonzero(~kept)]
    notes += [f"line {n} {why} and is left out" for n, why in sorted(odd)[:3]]
    notes += [f"{len(odd) - 3} more lines are left out"] * (len(odd) > 3)
    if len(odd) > 0.5 * len(rows):
        raise ValueError(f"most lines of the file are no rows of numbers: line {min(odd)[0]} {min(odd)[1]}")
    heads = [head for head, keep in zip(heads, kept, strict=True) if keep]
    return heads, np.delete(values, bad, 0)[:, kept], notes


def _heads(header: list[str], width: int) -> list[str]:
    """Names of the columns, from the last two header lines of equal width."""
    rows = []
    for line in header:
        line = line.lstrip("# ").replace('"', "")
        between = next((s for s in ";\t," if s in line), r"\s{2,}")
        for cells in (re.split(between, line), *[line.split()] * (between not in ";\t,")):
            if len(cells) == width:
                rows.append([cell.strip() for cell in cells])
                break
    units = re.findall(r"[(\[]\s*([^(\[)\]\s]+)\s*[)\]]", header[-1]) if header else []
    if not rows and 1 < len(units) != width:
        raise ValueError(
            f"the header names {len(units)} units, the rows have {width} columns: where commas are decimal "
            "ones, separate columns by semicolons"
        )
    if not rows:
        rows = [units] if len(units) == width else [[""] * width]
    return [" ".join(words).strip() for words in zip(*rows[-2:], strict=True)]


def read_tip(text: str) -> tuple[tuple[Any, Any], str]:
    """Radii and heights (m) of an uploaded tip, and a note; the header names the units.

    Long, noisy or two-sided data become the nearest convex tip, see `mdr.Sampled.fit`. Raises ValueError.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tip.csv"
        # A comma is decimal if columns have another separator.
        columns = text.replace(",", ".") if ";" in text or "\t" in text else text
        path.write_text(columns, encoding="utf-8")
        try:
            r, z = read_samples(path, None, MAX_ROWS)
        except ValueError as error:
            raise ValueError(str(error).replace(str(path), "the file")) from None
    try:
        if len(r) <= MAX_SAMPLES:
            return (mdr.Sampled(r, z).r, z - z[0]), f"{len(r)} samples as they are"
    except ValueError:
        # Noise makes any tip concave somewhere.
        pass
    return _fitted(r, z)


def _fitted(r, z):
    """A convex tip of few samples, fitted to many."""
    rows = len(r)
    if min(r) < 0 < max(r):
        r = r - _axis(r, z)
    order = np.argsort(np.abs(r), kind="stable")
    parts = np.array_split(order, min(rows, _FITTED))
    tip = mdr.Sampled.fit(*(np.array([np.mean(of[part]) for part in parts]) for of in (np.abs(r), z)))
    # On a convex polygon every other one of its vertices is convex too.
    subset = np.unique(np.linspace(0, len(tip.r) - 1, MAX_SAMPLES).round().astype(int))
    samples = np.array(tip.r)[subset], np.array(tip.z)[subset]
    apart = z - np.interp(np.abs(r), *samples)
    by = written(float(np.std(apart)), "length", 2)
    return samples, f"{len(subset)} samples, nearest to {rows} rows, which scatter by {by} about them"


def _axis(r, z):
    """Radius of the axis of symmetry, near the lowest sample."""
    order = np.argsort(r, kind="stable")
    r, z, reach = r[order], z[order], np.ptp(r)
    lowest = np.clip(r[np.argmin(z)], r[0] + 0.2 * reach, r[-1] - 0.2 * reach)
    axes = lowest + 0.1 * reach * np.linspace(-1, 1, 41)
    away = np.linspace(0, min(axes[0] - r[0], r[-1] - axes[-1]), 400)
    sides = (np.interp(axes[:, None] + side * away, r, z) for side in (1, -1))
    # How unlike they are grows as a square; noise makes many least ones.
    a, b, _ = np.polyfit(axes - lowest, np.mean(np.subtract(*sides) ** 2, axis=1), 2)
    return float(lowest + np.clip(-b / (2 * a), axes[0] - lowest, axes[-1] - lowest)) if a > 0 else lowest


@dataclass(frozen=True, eq=False)
class Measured:
    """A curve from a file, with the numbers of its columns (time −1: none), their units, and its fit."""

    name: str
    heads: tuple[str, ...]
    values: np.ndarray
    columns: dict[str, int]
    units: dict[str, str]
    note: str
    fit: IndentationFit | None = None
    asked: dict | None = None

    @cached_property
    def data(self):
        """Depth (m) and force (N) in order of time."""
        time = self.columns["time"]
        order = slice(None) if time < 0 else np.argsort(self.values[:, time], kind="stable")
        return [
            self.values[order, self.columns[role]] * size[self.units[role]] for role, size in SIZES.items()
        ]

    def corrected(self, role, chosen):
        """With another column or unit of "depth", "force" or "time", without a fit."""
        columns = dict(self.columns)
        if isinstance(chosen, str):
            return replace(self, units=self.units | {role: chosen}, fit=None, asked=None)
        taken = next((other for other in columns if columns[other] == chosen >= 0), role)
        if taken != role and columns[role] < 0:
            raise ValueError(f"that is the column of {taken}: choose another one for that first")
        # Who had that column gets the other one.
        columns[taken], columns[role] = columns[role], chosen
        return replace(self, columns=columns, fit=None, asked=None)


def read_curve(data: bytes, name: str) -> Measured:
    """Measured curve from a file; columns, units and signs are guessed. Raises ValueError."""
    heads, values, left_out = table(decoded(data))
    if len(values) < 2:
        raise ValueError("the file has one row of numbers: give a curve, a sample a line")
    if values.shape[1] < 2:
        raise ValueError("the file has one column of numbers: give one of depth and one of force")
    step = -(-len(values) // _CURVE_SAMPLES)
    notes = [f"{len(values)} samples" + f", one in {step} of them taken" * (step > 1), *left_out]
    columns = _columns(heads)
    named = {role: _unit(heads[columns[role]], _WORDS[role][1]) for role in SIZES}
    guessed = [f"{role} in {_WORDS[role][2]}" for role, unit in named.items() if unit is None]
    notes += [f"no unit in the header: {' and '.join(guessed)} is a guess"] * bool(guessed)
    units = {role: unit or _WORDS[role][2] for role, unit in named.items()}
    name = " ".join(name.split())[:80]
    curve = Measured(name, tuple(heads), values[::step], columns, units, "")
    # The largest force is that of pressing; on the way there the depth grows.
    depth, force = curve.data
    most = int(np.argmax(np.abs(force - force[0])))
    for role, change in (("depth", depth[most] - depth[0]), ("force", force[most] - force[0])):
        if change < 0:
            units[role] = f"−{units[role]}"
            notes.append(f"{role} turned round, as its sign would have the tip pulled")
    return replace(curve, note="; ".join(notes))


def _unit(head, kind):
    """Unit of a kind in the name of a column, or None."""
    parts, units = re.split(r"[\s()\[\]/,_]+", head.replace("μ", "µ")), named(kind)
    return next((units[part].name for part in reversed(parts) if part in units), None)


def _columns(heads):
    """Columns of depth, force and time, guessed from units, names and order."""
    found, left = {}, dict(enumerate(heads))
    for role in ("time", "force", "depth"):
        words, kind, _ = _WORDS[role]
        score = {
            k: 2 * bool(_unit(head, kind)) + bool(re.search(words, head, re.I)) for k, head in left.items()
        }
        best = max(score, key=score.get)
        if role == "force" and score[best] == 0 and len(left) > 1:
            best = list(left)[1]
        absent = role == "time" and (score[best] == 0 or len(left) < 3)
        found[role] = -1 if absent else best
        left.pop(found[role], None)
    return {role: found[role] for role in _WORDS}


def agrees(state: State) -> bool:
    """Whether the page shows the result of the fit."""
    found, made = state.curve.fit, medium(state)
    pairs = [(getattr(made, name), getattr(found.medium, name)) for name in FITTED[:2]]
    pairs += [(state[name], getattr(found, name)) for name in FITTED[2:]]
    return profile(state) == found.profile and bool(
        np.allclose(*zip(*pairs, strict=True), rtol=1e-9, atol=0)
    )


@dataclass(frozen=True, eq=False)
class Curve:
    """Depths (m) below first contact and forces (N) above the baseline, with the fit if it holds."""

    depth: np.ndarray
    force: np.ndarray
    fit: IndentationFit | None = None
    asked: dict[str, Any] | None = None

    @classmethod
    def of(cls, state: State) -> "Curve | None":
        """The measured curve at its position on the page, or None."""
        if state.curve is None:
            return None
        depth, force = state.curve.data
        force = force - state.baseline
        depth = depth - state.contact_point - state.frame_compliance * force
        found = state.curve.fit
        return cls(depth, force, found if found is not None and agrees(state) else None, state.curve.asked)

    def residual(self, scene):
        """Measured minus modelled force (N); NaN if the scene cannot be solved."""
        if self.fit is not None:
            return self.fit.residuals
        try:
            return self.force - mdr.indent(scene.profile, scene.medium, self.depth).force
        except ValueError:
            return np.full_like(self.depth, np.nan)

    def noise(self, stiffness: Any) -> np.ndarray:
        """Standard deviation (N) of the residual at a stiffness (N/m)."""
        depth_noise = float(self.asked.get("depth_noise") or 0.0)
        slope = stiffness / (1 + self.fit.frame_compliance * stiffness)
        return np.hypot(float(self.fit.force_noise), slope * depth_noise)
