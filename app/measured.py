"""A measured curve: its columns and units as guessed or corrected, where it lies, and the fit to it."""

import re
from dataclasses import dataclass, replace
from functools import cached_property
from io import StringIO

import numpy as np

import mdr_core as mdr
from mdr_core.shapes.tables import read_columns

from .parts import decoded
from .tip import MOST_ROWS
from .units import UNITS, fitting, named

#: Parameters of a fit, in the order in which they can be held, and those that are none of the medium.
PARAMETERS = ("E_star", "q_c", "contact_point", "baseline", "frame_compliance")
PLACE = PARAMETERS[2:]
#: Most samples of a file that are taken, and that are drawn.
_MOST, _DRAWN = 2000, 600
#: What the columns are called, as far as headers say it, and the kind of their units.
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


@dataclass(frozen=True, eq=False)
class Measured:
    """A curve from a file: the names of its columns and their numbers, and what is made of them.

    `columns` has the number of the column of depth, of force, and of time or −1, `units` names of
    `SIZES`. `fit` is the fit to it, and `asked` what that was given beside the curve.
    """

    name: str
    heads: tuple[str, ...]
    values: np.ndarray
    columns: dict[str, int]
    units: dict[str, str]
    note: str
    made: bool = False
    fit: mdr.IndentationFit | None = None
    asked: dict | None = None

    @cached_property
    def data(self):
        """Depth (m) and force (N) in the order of time."""
        time = self.columns["time"]
        order = slice(None) if time < 0 else np.argsort(self.values[:, time], kind="stable")
        return [
            self.values[order, self.columns[role]] * size[self.units[role]] for role, size in SIZES.items()
        ]

    def corrected(self, role, chosen):
        """With another column or another unit of "depth", "force" or "time"; a fit is not kept."""
        columns = dict(self.columns)
        if isinstance(chosen, str):
            return replace(self, units=self.units | {role: chosen}, fit=None, asked=None)
        taken = next((other for other in columns if columns[other] == chosen >= 0), role)
        if taken != role and columns[role] < 0:
            raise ValueError(f"that is the column of {taken}: choose another one for that first")
        # Who had that column gets the other one.
        columns[taken], columns[role] = columns[role], chosen
        return replace(self, columns=columns, fit=None, asked=None)


def read_curve(data, name):
    """A measured curve from the bytes of a file; columns, units and signs are guessed.

    Raises ValueError if there are no two columns of numbers in it.
    """
    heads, values = read_columns(StringIO(decoded(data)), MOST_ROWS, "the file")
    if len(values) < 2:
        raise ValueError("the file has one row of numbers: give a curve, a sample a line")
    if values.shape[1] < 2:
        raise ValueError("the file has one column: give one of depth and one of force")
    if not np.isfinite(values).all():
        row = np.flatnonzero(~np.isfinite(values).all(axis=1))[0]
        raise ValueError(f"row {row + 1} of the numbers has one that is not finite: remove that row")
    step = -(-len(values) // _MOST)
    notes = [f"{len(values)} samples" + f", one in {step} of them taken" * (step > 1)]
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
    for role, way in (("depth", depth[most] - depth[0]), ("force", force[most] - force[0])):
        if way < 0:
            units[role] = f"−{units[role]}"
            notes.append(f"{role} turned round, as its sign would have the tip pulled")
    return replace(curve, note="; ".join(notes))


def _unit(head, kind):
    """The unit of some kind that the name of a column ends in, None if it has none."""
    parts, units = re.split(r"[\s()\[\]/,_]+", head.replace("μ", "µ")), named(kind)
    return next((units[part].name for part in reversed(parts) if part in units), None)


def _columns(heads):
    """The columns of depth, force and time: by their units, by their names, and in this order."""
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


def example(explorer):
    """A made curve as a file: the present tip on a medium other than the present one, with noise."""
    profile, medium, deepest = explorer.profile(), explorer.medium(), float(explorer.solved().depth)
    other = mdr.Medium(1.3 * medium.E_star, 0.8 * medium.q_c)
    back = deepest - 0.8 * min(deepest, other.critical_depth)
    path = np.append(np.linspace(-0.05, 1, 240) * deepest, np.linspace(deepest, back, 160))
    force = mdr.indent(profile, other, path).force
    force = force + 0.004 * force.max() * np.random.default_rng(1).standard_normal(path.size)
    units = fitting(deepest, "length"), fitting(force.max(), "force")
    columns = (path + 0.1 * deepest) / units[0].factor, force / units[1].factor
    rows = [f"{x:.6g}; {y:.6g}" for x, y in zip(*columns, strict=True)]
    text = "\n".join([f"depth ({units[0].name}); force ({units[1].name})", *rows])
    return replace(read_curve(text.encode(), "A made curve, no measurement"), made=True)


#: What is said of it.
MADE = "This tip on a medium of 1.3 E* and 0.8 q_c, which begins at a tenth of the depth, with 0.4 % noise."


def fit(explorer):
    """Set the medium, and where the measured curve lies, to what is nearest to it; pressed to its depth."""
    curve, medium = explorer.measured, explorer.medium()
    held = {name: getattr(explorer if name in PLACE else medium, name) for name in explorer.holds}
    asked = dict.fromkeys(PARAMETERS) | held
    if explorer.noise == "given":
        asked["depth_noise"] = explorer.depth_noise
    found = mdr.fit_indentation(explorer.profile(), *curve.data, **asked)
    numbers = {name: float(getattr(found, name)) for name in PLACE}
    numbers["max_depth"] = float(np.max(found.path.depth))
    choices = {"drive": "depth"}
    if "E_star" not in held:
        choices["elasticity"], numbers["E_star"] = "modulus", float(found.medium.E_star)
    if "q_c" not in held:
        yields = bool(np.isfinite(found.medium.q_c))
        choices["plasticity"] = "q_c" if yields else "none"
        numbers |= {"q_c": float(found.medium.q_c)} if yields else {}
    numbers = {name: explorer.checked(name, value) for name, value in numbers.items()}
    explorer.resets = explorer.resets | numbers
    explorer.param.update(measured=replace(curve, fit=found, asked=asked), **choices, **numbers)


def agrees(explorer):
    """Whether what is set on the page is what was fitted."""
    found, medium = explorer.measured.fit, explorer.medium()
    pairs = [(getattr(medium, name), getattr(found.medium, name)) for name in PARAMETERS[:2]]
    pairs += [(getattr(explorer, name), getattr(found, name)) for name in PLACE]
    return explorer.profile() == found.profile and all(one == other for one, other in pairs)


@dataclass(frozen=True, eq=False)
class Curve:
    """Depths (m) below first contact and forces (N) above the baseline; residuals of a fit that holds."""

    depth: np.ndarray
    force: np.ndarray
    fit: mdr.IndentationFit | None = None

    @classmethod
    def of(cls, explorer):
        """The measured curve where it is set to lie; None if there is none."""
        if explorer.measured is None:
            return None
        depth, force = explorer.measured.data
        force = force - explorer.baseline
        depth = depth - explorer.contact_point - explorer.frame_compliance * force
        found = explorer.measured.fit
        return cls(depth, force, found if found is not None and agrees(explorer) else None)

    def residual(self, scene):
        """Measured less modelled force (N); nothing where the scene's tip or medium has no such path."""
        if self.fit is not None:
            return self.fit.residuals
        try:
            return self.force - mdr.indent(scene.profile, scene.medium, self.depth).force
        except ValueError:
            return np.full_like(self.depth, np.nan)


def row(x, y):
    """A row of a plot, of not too many samples."""
    step = -(-len(x) // _DRAWN)
    return x[::step], y[::step]


def residual_still(view):
    """Rows of the residual, and of the noise around it."""
    curve, ends = view.curve, np.array([0.0, view.end["d"]])
    if curve is None:
        return {}
    missing = "no model at these depths" * bool(np.isnan(view.residual).all())
    rows = {
        "zero": (ends, np.zeros(2)),
        "measured − model": row(curve.depth, view.residual),
        "missing": (0.05 * ends[1], 0.9 * view.end["ΔF"], missing),
    }
    if curve.fit is not None:
        size = float(curve.fit.force_noise)
        rows["± noise"] = np.append(ends, [np.nan, *ends]), size * np.array([1, 1, np.nan, -1, -1])
    return rows
