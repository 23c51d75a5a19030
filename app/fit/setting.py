"""What a person asks of a measurement: tip, medium, parameters that are free or held, and samples."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import inf, isfinite, radians, tan
from typing import Any
from urllib.parse import parse_qsl, urlencode

import mdr_core as mdr
from mdr_core.fit.parameters import PARAMETERS
from mdr_core.show.units import KINDS, written

from .told import told_by, told_columns, told_pairs

#: Most characters of a link that is read, and of a text in it.
_LINK, _TEXT = 4000, 200


@dataclass(frozen=True)
class Number:
    """A number that is typed: its symbol, name, kind of unit, and least and largest value (SI)."""

    symbol: str
    label: str
    kind: str
    least: float = -inf
    most: float = inf
    help: str = ""

    def checked(self, value: float) -> float:
        """A value within the bounds; else ValueError."""
        if not (isfinite(value) and self.least <= value <= self.most):
            low, high = (written(each, self.kind, 3) for each in (self.least, self.most))
            raise ValueError(f"{self.label} {written(value, self.kind)} must be from {low} to {high}")
        return value


_RADIUS = Number("R", "tip radius", "length", 1e-10, 1.0)
_ANGLE = Number("α", "half-angle", "angle", radians(1), radians(89.9))
#: Numbers of tips, of the sample and of what is told to the reader of a file, by their names in links.
NUMBERS = {
    "radius": _RADIUS,
    "half_angle": _ANGLE,
    "poisson": Number("ν", "Poisson's ratio of the sample", "number", 0.0, 0.5),
    "tip_modulus": Number("E_t", "Young's modulus of the tip", "pressure", 1e3, 1e13),
    "tip_poisson": Number("ν_t", "Poisson's ratio of the tip", "number", 0.0, 0.5),
    "spring_constant": Number("k", "spring constant of the cantilever", "yield constant", 1e-6, 1e9),
    "sensitivity": Number("s", "sensitivity, deflection for 1 V", "length", 1e-13, 1e-2),
}


@dataclass(frozen=True)
class Tip:
    """A kind of tip: its name, its numbers, and the profile that they make."""

    label: str
    numbers: tuple[str, ...]
    profile: Callable[..., mdr.Profile]


def slope_of(half_angle: float) -> float:
    return 1 / tan(half_angle)


TIPS = {
    "berkovich": Tip("Berkovich or Vickers (cone of 70.3°)", (), lambda: mdr.Cone.from_half_angle(70.3)),
    "cube_corner": Tip("Cube corner (cone of 42.28°)", (), lambda: mdr.Cone.from_half_angle(42.28)),
    "paraboloid": Tip(
        "Paraboloid: a colloid or a blunt tip", ("radius",), lambda radius: mdr.Paraboloid(radius)
    ),
    "sphere": Tip("Sphere", ("radius",), lambda radius: mdr.Sphere(radius)),
    "cone": Tip("Cone", ("half_angle",), lambda half_angle: mdr.Cone(slope_of(half_angle))),
    "rounded_cone": Tip(
        "Cone with a rounded tip",
        ("half_angle", "radius"),
        lambda half_angle, radius: mdr.RoundedCone(tip_radius=radius, slope=slope_of(half_angle)),
    ),
    "flat_punch": Tip("Flat punch", ("radius",), lambda radius: mdr.FlatPunch(radius)),
    "measured": Tip("Measured tip, from a file", (), lambda: mdr.Cone(1.0)),
}


@dataclass(frozen=True)
class Kind:
    """A kind of sample: its name, the parameters of its fit that are free at first, and the part fitted.

    `letter` is the class of its hardness, empty for a medium that does not yield.
    """

    label: str
    free: tuple[str, ...]
    part: str = "all"
    letter: str = ""


#: Kinds of samples by their names in links.
MEDIA = {
    "constant": Kind(
        "Glass, metal or ceramic: constant hardness", ("E_star", "hardness", "contact_point"), letter="a"
    ),
    "composite": Kind("Composite, PDMS: hardness ∝ 1/a", ("E_star", "q_c", "contact_point"), letter="b"),
    "line": Kind("Hardness ∝ 1/a²", ("E_star", "f_c", "contact_point"), letter="c"),
    "gel": Kind("Gel, cell, rubber: elastic", ("E_star", "contact_point", "baseline"), part="loading"),
    "viscous": Kind(
        "Viscous gel in a liquid (with times)", ("E_star", "eta", "contact_point", "baseline", "drag")
    ),
    "sticky": Kind(
        "Elastic with adhesion (pull-off)", ("E_star", "work_of_adhesion", "contact_point", "baseline")
    ),
}
#: The kind of sample with the hardness of each class.
OF_CLASS = {kind.letter: name for name, kind in MEDIA.items() if kind.letter}
#: What is said of a class.
CLASS_NAMES = {"a": "constant hardness", "b": "hardness ∝ 1/a", "c": "hardness ∝ 1/a²"}
#: What is subtracted from the depth before a fit, and the noise of the depth: typed, never free.
CORRECTIONS = {
    "drift": Number("v_d", "drift of the depth", "speed", -1.0, 1.0),
    "frame": Number("C_f", "frame compliance", "compliance", 0.0, 1e6),
    "depth_noise": Number("σ_d", "noise of the depth", "length", 0.0, 1e-3),
}
#: Corrections and parameters that need the times of the samples.
IN_TIME = ("drift", *(name for name, each in PARAMETERS.items() if each.in_time))


def parameter(name: str) -> Number:
    """A parameter of a fit, or a correction, as a number that is typed."""
    if name in CORRECTIONS:
        return CORRECTIONS[name]
    known = PARAMETERS[name].quantity
    return Number(known.symbol, known.long_name, KINDS[known.unit])


@dataclass(frozen=True)
class Setting:
    """Everything that a person has set, in SI units; a function of nothing else.

    `held` has the values of the parameters that are held. `samples` are the numbers of the first and the
    last sample that are fitted, from 1 on, or none for those that the kind of sample takes. `columns` are
    given to the reader of the file, of which `curve` is the number of the curve, from 0 on.
    """

    file: str = ""
    curve: int = 0
    columns: Any = field(default_factory=dict)
    #: What tells several curves of a table apart, or which parts they are, as `read_curves` has it.
    by: Any = None
    tip: str = ""
    #: Radii and heights (m) of a measured tip, and its name; in no link.
    tip_samples: tuple[Any, ...] = ()
    tip_name: str = ""
    medium: str = ""
    held: dict[str, float] = field(default_factory=dict)
    corrections: dict[str, float] = field(default_factory=dict)
    samples: tuple[int, ...] = ()
    radius: float | None = None
    half_angle: float | None = None
    poisson: float | None = None
    tip_modulus: float | None = None
    tip_poisson: float | None = None
    spring_constant: float | None = None
    sensitivity: float | None = None

    def replace(self, **changes: Any) -> "Setting":
        """Copy with other values."""
        return replace(self, **changes)

    def with_medium(self, name: str) -> "Setting":
        """With another kind of sample, whose parameters are free or 0 as it says."""
        return self.replace(medium=name, held=self._held_at_first(name), samples=())

    @staticmethod
    def _held_at_first(name: str) -> dict[str, float]:
        kind = MEDIA[name]
        held = {"baseline": 0.0, "tilt": 0.0} | ({"drag": 0.0} if name != "viscous" else {})
        return {each: value for each, value in held.items() if each not in kind.free}

    @property
    def kind(self) -> Kind:
        return MEDIA[self.medium]

    @property
    def missing(self) -> str:
        """What is still to be given before a fit, in words; empty if nothing is."""
        if not self.tip:
            return "the tip"
        if self.tip == "measured" and not self.tip_samples:
            return "the file of the tip"
        for name in TIPS[self.tip].numbers:
            if getattr(self, name) is None:
                return f"the {NUMBERS[name].label} {NUMBERS[name].symbol}"
        return "" if self.medium else "the sample"

    @property
    def profile(self) -> mdr.Profile:
        """The indenter."""
        if self.tip == "measured":
            return mdr.Sampled(*self.tip_samples)
        known = TIPS[self.tip]
        return known.profile(**{name: getattr(self, name) for name in known.numbers})

    def parameters(self, timed: bool) -> list[str]:
        """Names of the parameters of the fit, in their order, with or without the times of the samples."""
        names = [*self.kind.free, "baseline", "tilt", "drag"]
        # Adhesion with a drag is fitted by nobody: the pull-off is a jump.
        return [name for name in dict.fromkeys(names) if timed or name not in IN_TIME]

    def arguments(self, timed: bool) -> dict[str, Any]:
        """Arguments of `mdr.fit_indentation`: None for what is free."""
        given: dict[str, Any] = {name: self.held.get(name) for name in self.parameters(timed)}
        if not self.kind.letter:
            given["q_c"] = inf
        return given

    # Links.

    def query(self) -> str:
        """This as a query, with the name of the file and without what is in it."""
        pairs = {name: value for name in ("file", "tip", "medium") if (value := getattr(self, name))}
        pairs |= {name: repr(value) for name in NUMBERS if (value := getattr(self, name)) is not None}
        if self.curve:
            pairs["curve"] = str(self.curve)
        if self.samples:
            pairs["samples"] = "{}-{}".format(*self.samples)
        if self.medium:
            first = self._held_at_first(self.medium)
            names = [*self.parameters(True)]
            pairs |= {name: "free" for name in names if name in first and name not in self.held}
            pairs |= {name: repr(value) for name, value in self.held.items() if first.get(name) != value}
        pairs |= {name: repr(value) for name, value in self.corrections.items()}
        return urlencode(pairs | told_pairs(self.columns, self.by), safe=",;")

    @classmethod
    def read(cls, query: str) -> "Setting":
        """What a link asks; what is not known or not valid in it is left out."""
        given = dict(parse_qsl(query[:_LINK]))
        found = cls(file=" ".join(given.get("file", "").split())[:_TEXT])
        if given.get("tip") in TIPS:
            found = found.replace(tip=given["tip"])
        if given.get("medium") in MEDIA:
            found = found.with_medium(given["medium"])
        for name, known in NUMBERS.items():
            with suppress(KeyError, ValueError):
                found = found.replace(**{name: known.checked(float(given[name]))})
        with suppress(KeyError, ValueError):
            found = found.replace(curve=max(0, int(given["curve"][:6])))
        with suppress(KeyError, ValueError):
            first, last = (int(each) for each in given["samples"][:20].split("-"))
            if 1 <= first < last:
                found = found.replace(samples=(first, last))
        held, corrections = dict(found.held), {}
        for name in found.parameters(True) if found.medium else ():
            if given.get(name) == "free":
                held.pop(name, None)
            with suppress(KeyError, ValueError):
                held[name] = parameter(name).checked(float(given[name]))
        for name, known in CORRECTIONS.items():
            with suppress(KeyError, ValueError):
                corrections[name] = known.checked(float(given[name]))
        told = {"columns": told_columns(given), "by": told_by(given)}
        return found.replace(held=held, corrections=corrections, **told)
