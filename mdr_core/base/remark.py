"""Remarks: doubts about a number as values, with a kind, a text and remedies."""

from dataclasses import dataclass
from typing import Any, Self

from .errors import MDRError

#: Kinds of a `Remark` and their meanings, the most important kind first.
KINDS = {
    "invalid": "the input cannot be read, fitted or evaluated",
    "deflection": "the depth includes the deflection of the cantilever, whose stiffness is not known",
    "units": "numbers that no material or tip can have: wrong unit, wrong sign, or exchanged columns",
    "order": "samples are not in the order in which they were measured",
    "no contact": "the record shows no contact",
    "no unloading": "there is no unloading that can be evaluated",
    "adhesion": "adhesion is left out, hardly determined, or ends at another depth",
    "undetermined": "the data do not determine a parameter: it is at a bound, or others fit as well",
    "tilt": "a slope of the baseline is left out",
    "drag": "the drag of a liquid is left out",
    "drift": "a drift of the depth, or a relaxation of the medium",
    "misfit": "the model does not fit: another class of hardness, medium or tip",
    "noise": "noise of the depth that counts as loading, or residuals above the given noise",
    "unloading": "another force on unloading: creep or hysteresis",
    "outliers": "single samples far from their neighbours",
    "vague": "the modulus has a large error",
    "constant": "a constant of the medium may as well be 0: no yield, no viscosity, one class of hardness",
    "creep": "the depth creeps while the force is held, or at the start of the unloading",
    "errors": "standard errors are uncertain: few samples, or correlated residuals",
    "zero": "the depth is 0 where the force is not",
    "tip": "an ideal tip at depths at which real tips are blunt",
    "changed": "the input was changed: a reversed sign, a corrected depth, a tip",
    "taken": "a choice was made: one of several curves or unloadings, first contact, a hold, a constant",
    "left out": "samples, columns, tables, unloadings or quantities are left out",
}
#: Actions of a `Remedy`, as in its docstring.
ACTIONS = "free", "hold", "give", "unit", "part", "class", "subtract"


#: Python for remedies that their names do not determine: classes of hardness, parts and units.
_IN_PYTHON = {
    ("class", "a"): "give hardness=None",
    ("class", "b"): "give q_c=None",
    ("class", "c"): "give f_c=None",
    ("class", "elastic"): "give q_c=np.inf",
    ("part", "all"): "give the whole record",
    ("give", "spring_constant"): "give spring_constant= (N/m)",
    ("give", "sensitivity"): "give sensitivity= (m/V)",
    ("give", "profile"): "give its area function by Sampled.from_area_function",
    ("unit", "depth"): "give depth in m",
    ("unit", "radius"): "give radius in m",
    ("unit", "force"): "give force in N",
    ("unit", "E_star"): "give E_star in Pa",
    ("unit", "mean_pressure"): "give mean_pressure in Pa",
}


@dataclass(frozen=True)
class Remedy:
    """A remedy for a `Remark`.

    Attributes
    ----------
    action : str
        "free" or "hold" a parameter, "give" missing input, check a "unit", evaluate a "part" of the
        curve, choose another "class" of hardness, or "subtract" a drift (m/s).
    what : str
        A name of the public interface: a parameter or argument such as "drag" or "spring_constant", a
        column such as "depth", a part of the curve such as "loading", or a class such as "a".
    value : optional
        The value to hold or to give.

    Examples
    --------
    >>> from mdr_core import Remedy
    >>> Remedy("hold", "eta", 0.0)
    Remedy(action='hold', what='eta', value=0.0)
    """

    action: str
    what: str
    value: Any = None

    def __post_init__(self):
        if self.action not in ACTIONS:
            raise MDRError(f"action = {self.action!r} must be one of {', '.join(ACTIONS)}")

    @property
    def in_python(self) -> str:
        """The remedy in Python, for example "hold eta = 0"."""
        if known := _IN_PYTHON.get((self.action, self.what)):
            return known
        if self.action == "free":
            return f"give {self.what}=None"
        if self.action == "hold":
            return f"hold {self.what}" + ("" if self.value is None else f" = {self.value:g}")
        if self.action == "part":
            return f"fit the {self.what} alone"
        if self.action == "subtract":
            return f"give curve.minus_drift({self.value:.3g})"
        return f"give {self.what}=" + ("…" if self.value is None else f"{self.value!r}")


class Remark(str):
    """A doubt about a number of a fit, an unloading or a file, with remedies in Python.

    Parameters
    ----------
    text : str
        The doubt, without Python names.
    kind : str
        Kind of the doubt, one of `KINDS`.
    *remedy : Remedy
        Remedies: one of them is enough, or all are needed `together`.

    Attributes
    ----------
    text, kind : str
        As given.
    remedy : tuple of Remedy
        Remedies; empty if there is none.

    Examples
    --------
    >>> from mdr_core import Remark, Remedy
    >>> remark = Remark("q_c is at its bound", "undetermined", Remedy("hold", "q_c"))
    >>> print(remark, remark.kind, remark.remedy[0].action, sep=" | ")
    q_c is at its bound; hold q_c | undetermined | hold
    """

    __slots__ = ("kind", "remedy", "text", "together")

    kind: str
    text: str
    remedy: tuple[Remedy, ...]
    together: bool

    def __new__(cls, text: str, kind: str, *remedy: Remedy, together: bool = False) -> Self:
        if kind not in KINDS:
            raise MDRError(f"kind = {kind!r} must be one of {', '.join(KINDS)}")
        cures = (" and " if together else " or ").join(each.in_python for each in remedy)
        if cures:
            ended = text.endswith((".", "?"))
            cures = f" {cures[0].upper()}{cures[1:]}" if ended else f"; {cures}"
        remark = super().__new__(cls, f"{text}{cures}")
        remark.text, remark.kind, remark.remedy, remark.together = str(text), kind, remedy, together
        return remark

    def __getnewargs_ex__(self):
        return (self.text, self.kind, *self.remedy), {"together": self.together}

    @classmethod
    def of(cls, error: ValueError, kind: str, prefix: str = "") -> Self:
        """Return an error as a remark, with its text and its remedies if it has any."""
        return cls(f"{prefix}{getattr(error, 'text', error)}", kind, *getattr(error, "remedy", ()))

    def after(self, prefix: str) -> Self:
        """Return the remark with a prefix before its text."""
        return type(self)(f"{prefix}{self.text}", self.kind, *self.remedy, together=self.together)

    def to_dict(self) -> dict[str, Any]:
        """Return kind, text and remedies as in JSON files."""
        remedy = [{"action": each.action, "what": each.what, "value": each.value} for each in self.remedy]
        return {"kind": self.kind, "text": self.text, "remedy": remedy}


class MeasurementError(MDRError):
    """Error for a measurement that cannot be read, fitted or evaluated.

    The message is the given `Remark`, or a `Remark` made of a text and remedies.
    """

    def __init__(self, text: str, *remedy: Remedy):
        remark = text if isinstance(text, Remark) else Remark(text, "invalid", *remedy)
        super().__init__(remark)
        self.kind, self.remedy = remark.kind, remark.remedy

    @property
    def text(self) -> str:
        return self.args[0].text
