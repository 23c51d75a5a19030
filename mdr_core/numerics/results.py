"""Base classes of results: quantities by name, entries, iteration; limits as data; names of the models.

How a result is shown (text, tables, limits in words, plots) stands above the physics, and is imported
when it is asked for.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from .._check import no_attribute
from .._door import above
from .._errors import Refusal

if TYPE_CHECKING:
    import pandas
    import xarray
    from numpy.typing import NDArray


class Model(str):
    """Name of a model, with the reason for choosing it in `reason`.

    Examples
    --------
    >>> from mdr_core.numerics.results import CLOSED_FORM
    >>> CLOSED_FORM == "closed form"
    True
    """

    __slots__ = ("reason",)

    def __new__(cls, name, reason):
        model = super().__new__(cls, name)
        model.reason = reason
        return model

    def __getnewargs__(self):
        return str(self), self.reason


CLOSED_FORM = Model(
    "closed form",
    "without viscosity, or infinitely slowly, the plastic depth is the only memory of the medium, and "
    "every result is an integral over the live interval",
)
SCALAR_ODE = Model(
    "scalar ODE",
    "a single viscous impact obeys one scalar equation of motion, because elements are released from the "
    "outside inward and do not come into contact again",
)
CREEP_LAW = Model(
    "scalar ODE",
    "while an indenter goes deeper, and while it recedes afterwards, its depth under a force obeys one "
    "scalar equation, because no element that was released comes into contact again",
)
CHAIN = Model(
    "chain",
    "on a viscous path released elements may come into contact again while they relax, so that each "
    "element has a memory of its own",
)


class Entries:
    """Base class of dataclasses whose fields all have one entry, or one row, for each impact."""

    def __getitem__(self, index: Any) -> Self:
        return type(self)(**{field.name: getattr(self, field.name)[index] for field in fields(self)})


@dataclass(frozen=True)
class Limit:
    """An assumption of the model, and how near a result is to its end; an entry of `result.limits`.

    Attributes
    ----------
    what : str
        Quantity that is bounded: "slope", "contact radius", "modulus" below 1 kPa or above 10 TPa,
        "critical depth" below 0.1 nm, "Poisson ratio", "viscosity", "speed", "fast limit", "Tabor's
        parameter", which must be larger than its bound, "facets" of samples with adhesion, for friction
        "coupling" and "slip direction", and where elements stick "tolerance", "depth" over the elastic
        compression at the turning point (d_c of a hardness q_c/a) and "mass" over the tangential one; with
        a constant hardness "flow", the area of a contact that flows over that of the model; the length (m)
        of a "jump" of a path given by force; and on a plate "edges", the contact time over that in which
        waves are back from the nearest edge, and "thin", the contact radius over half of the thickness, or
        6 thicknesses over the speed of shear waves and the contact time.
    value, bound : float
        Its largest value over all states, and the largest one for which the assumption is good.
    exceeded : bool
        Whether the value is larger than the bound.
    sentence : str
        The same in words, and a remedy.
    concerns : str
        "result", or the formula of the paper that is concerned while the result itself is exact.
    severe : bool
        Whether the result is only an estimate where the bound is exceeded.
    """

    what: str
    value: float
    bound: float
    exceeded: bool
    sentence: str
    concerns: str = "result"
    severe: bool = True

    @property
    def holds(self) -> bool:
        """Whether the value is within the bound."""
        return not self.exceeded

    @property
    def level(self) -> str:
        """One word: "good", "note" where the result hardly changes, else "beyond"."""
        if self.holds:
            return "good"
        return "beyond" if self.severe and self.concerns == "result" else "note"


#: Kinds of a `Remark`, the most important first, and what each says.
KINDS = {
    "invalid": "a curve of a map is not fitted, and why",
    "refused": "what is given cannot be read or fitted",
    "deflection": "the depth includes the deflection of the cantilever, whose stiffness is not known",
    "units": "numbers that no material or tip has: a unit, a sign, or columns that are exchanged",
    "order": "samples are not in the order in which they were measured",
    "no contact": "the record shows no contact",
    "no unloading": "there is no unloading that can be evaluated",
    "adhesion": "the forces hardly determine the work of adhesion",
    "bound": "a parameter is at the bound of its range",
    "second minimum": "other values of the parameters fit about as well",
    "undetermined": "the data do not determine a parameter: the residuals have no minimum",
    "tilt": "a slope of the baseline that is left out",
    "drag": "a drag of a liquid that is left out",
    "drift": "a drift of the depth, or a relaxation of the medium",
    "misfit": "the model does not fit: another class of hardness, medium or tip",
    "jitter": "noise of the depth that is taken for new largest depths",
    "unloading": "another force on unloading: creep or hysteresis",
    "outliers": "single samples far from their neighbours",
    "blocks": "residuals that are correlated over a large part of the curve",
    "few": "too few samples for standard errors",
    "loading": "loading alone hardly determines the modulus",
    "vague": "the modulus has a large error",
    "contact": "contact is lost at another depth than in the model",
    "constants": "the data do not distinguish the constants of the hardness",
    "elastic": "no yield is seen beyond the noise",
    "noisy": "residuals are larger than the noise that was given",
    "rest": "a change of the depth while the force is held, by creep or a drift",
    "inviscid": "the viscosity is 0 within the noise",
    "medium": "the unloading of a medium that is viscous or adhesive is not evaluated",
    "held": "the modulus is held, and not a result",
    "creep": "the depth creeps at the start of the unloading",
    "missing": "samples without a number, contact or stiffness",
    "sign": "a sign is reversed",
    "cantilever": "from where a constant of the cantilever is taken",
    "time": "times that do not ascend are left out",
    "left out": "columns, tables, unloadings or measurements that are left out",
    "several": "which one of several curves or unloadings was taken",
    "corrected": "what is subtracted from the depth",
    "zero": "the depth is 0 where the force is not",
    "first contact": "from where depth and force of an unloading count",
    "hold": "the hold of the force before the unloading, which shows its creep",
    "area": "where a tip is another one than that of its area function",
    "tip": "an ideal tip at depths at which real ones are blunt",
}
#: What a `Remedy` does: fit a parameter, hold one, give what is missing, look at a unit, take a part of the
#: curve, choose another class of hardness.
ACTIONS = "free", "hold", "give", "unit", "part", "class"


@dataclass(frozen=True)
class Remedy:
    """What one can do about a `Remark`.

    Attributes
    ----------
    action : str
        "free" or "hold" a parameter, "give" what is missing, look at a "unit", evaluate a "part" of the
        curve, or choose another "class" of hardness.
    what : str
        A name of the public interface: a parameter or argument, as "drag" or "spring_constant", a column,
        as "depth", a part of the curve, as "loading", or a class, as "a".
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
            raise ValueError(f"action is {self.action!r}, but a remedy is one of {', '.join(ACTIONS)}")


class Remark(str):
    """A doubt about a number of a fit, an unloading or a file, as a sentence.

    Attributes
    ----------
    kind : str
        What is doubted, one of `KINDS`.
    text : str
        The same without names of Python.
    remedy : tuple of Remedy
        What one can do; empty for nothing.

    Examples
    --------
    >>> from mdr_core import Remark, Remedy
    >>> hold = Remedy("hold", "q_c")
    >>> remark = Remark("q_c is at its bound: hold q_c", "bound", "q_c is at its bound", (hold,))
    >>> remark.startswith("q_c"), remark.kind, remark.remedy[0].action
    (True, 'bound', 'hold')
    """

    __slots__ = ("kind", "remedy", "text")

    kind: str
    text: str
    remedy: tuple[Remedy, ...]

    def __new__(
        cls, sentence: str, kind: str, text: str | None = None, remedy: tuple[Remedy, ...] = ()
    ) -> Self:
        if kind not in KINDS:
            raise ValueError(f"kind is {kind!r}, but a remark is one of {', '.join(KINDS)}")
        remark = super().__new__(cls, sentence)
        remark.kind = kind
        remark.text = str(sentence) if text is None else text
        remark.remedy = tuple(remedy)
        return remark

    def __getnewargs__(self):
        return str(self), self.kind, self.text, self.remedy

    @classmethod
    def of(cls, error: ValueError, kind: str, prefix: str = "") -> Self:
        """A refusal as a remark, with its text and remedies where it has them, as a `Refusal` has."""
        text = getattr(error, "text", str(error))
        return cls(f"{prefix}{error}", kind, f"{prefix}{text}", getattr(error, "remedy", ()))

    def after(self, prefix: str) -> Self:
        """The same behind a prefix."""
        return type(self)(f"{prefix}{self}", self.kind, f"{prefix}{self.text}", self.remedy)

    def to_dict(self) -> dict[str, Any]:
        """Kind, text and remedies, as in files of JSON."""
        remedy = [{"action": each.action, "what": each.what, "value": each.value} for each in self.remedy]
        return {"kind": self.kind, "text": self.text, "remedy": remedy}


def refused(sentence: str, text: str, *remedy: Remedy) -> Refusal:
    """The refusal of what is given, as a sentence for users of the library, and without names of Python."""
    return Refusal(Remark(sentence, "refused", text, remedy))


class Record:
    """Base class of results with quantities by name, which are arrays of one shape.

    A class of results gives the names below, and what a table says of its origin and limits. Others read
    them by `Presentation` and `quantities_of`.
    """

    #: Names of all quantities, of those in its `repr`, and of the dimensions.
    _quantities: ClassVar[tuple[str, ...]] = ()
    _shown: ClassVar[tuple[str, ...]] = ()
    _dimensions: ClassVar[tuple[str, ...]] = ("state",)

    @property
    def _name(self) -> str:
        """The name under which it is shown."""
        return type(self).__name__

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape that all quantities have: () for one state or impact."""
        return np.shape(getattr(self, self._quantities[0]))

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError(f"this {self._name} is a single result and has no length; .shape is ()")
        return self.shape[0]

    def __bool__(self) -> bool:
        return 0 not in self.shape

    def __iter__(self) -> Iterator[Self]:
        if not self.shape:
            name = self._name
            raise TypeError(f"this {name} is a single result: there is nothing to iterate over")
        return (self[i] for i in range(self.shape[0]))

    if not TYPE_CHECKING:

        def __getattr__(self, name):
            names = {*dir(type(self)), *type(self).__dataclass_fields__}
            known = sorted(each for each in names if not each.startswith("_"))
            raise no_attribute(f"this {self._name}", name, known)

    def __array__(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(
            f"a result ({self._name}) has many quantities and is not one array: take one, as in result."
            f"{self._shown[0]}, or all by to_pandas() or to_xarray()"
        )

    def to_dict(self) -> "dict[str, float | NDArray[np.float64]]":
        """All quantities by name, in SI units: floats, or arrays of one shape. Those that are None are not.

        Examples
        --------
        >>> from mdr_core import Cone, Medium, indent
        >>> indent(Cone(slope=1.0), Medium(E_star=1.0), [0.0, 1.0]).to_dict()["force"].round(4).tolist()
        [0.0, 0.6366]
        """
        values = {name: getattr(self, name) for name in self._quantities}
        values = {name: np.asarray(value) for name, value in values.items() if value is not None}
        return {name: value if value.ndim else float(value) for name, value in values.items()}

    def to_pandas(self) -> "pandas.DataFrame":
        """A table of all quantities in SI units, one row for each state or impact.

        `attrs` has the model, the indenter and the medium, and "units" and "long_names" by the names of the
        columns. Array-valued parameters of indenter and medium have columns of their own.
        """
        return above("show.report").table(self)

    def to_xarray(self) -> "xarray.Dataset":
        """A dataset of all quantities, each with its `units`, `long_name` and symbol as attributes.

        Prescribed quantities (depth, time, mass, speed, array-valued parameters) are coordinates.
        """
        return above("show.report").dataset(self)

    def _source(self) -> Any:
        """The result with the profile, the medium and the model; None where there is none."""
        return None

    def _limits(self) -> tuple[Limit, ...]:
        """Limits of the model for this result."""
        return ()

    def __getitem__(self, index: Any) -> Self:
        raise TypeError(f"this {self._name} is a single result: it has no entries")

    def __repr__(self) -> str:
        return above("show.report").text(self)

    def _repr_html_(self) -> str:
        return above("show.report").table_of_text(self)


def quantities_of(kind: type[Record] | Record) -> tuple[str, ...]:
    """Names of all quantities of a class of results, or of a result."""
    return kind._quantities


def check_single(result: Record, what: str) -> None:
    """Refuses a result of several entries for something, `what`, that needs a single one."""
    if result.shape:
        raise ValueError(
            f"{what} needs a single {Presentation(result).noun}, but this result has shape {result.shape}; "
            f"select one first, as in result[-1].{what}(…)"
        )


@dataclass(frozen=True)
class Presentation:
    """What texts, tables and plots are told about a result beside its quantities."""

    result: Record

    @property
    def name(self) -> str:
        """The name under which it is shown, as "Impact"."""
        return self.result._name

    @property
    def noun(self) -> str:
        """Noun for one entry, as "state" or "instant"."""
        last = self.dimensions[-1]
        return "instant" if last == "time" else last

    @property
    def shown(self) -> tuple[str, ...]:
        """Names of the quantities in its `repr`."""
        return self.result._shown

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Names of the dimensions that its class may have; the last one counts the states of a path."""
        return self.result._dimensions

    @property
    def source(self) -> Any:
        """The result with the profile, the medium and the model; None where there is none."""
        return self.result._source()

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model; found when they are asked for."""
        return self.result._limits()


class Result(Record):
    """Base class of results of one profile on one medium, along a path, over time or of impacts."""

    def plot(self, quantity: str = "force", over: str = "depth") -> Any:
        """One quantity over another as HoloViews elements, by default the force–depth curve.

        A path is shown in parts: loaded elastically, yielding, unloaded. Axes have names and units. Areas
        of a force–depth curve are the plastic work of the path and what its last state stores.

        Parameters
        ----------
        quantity, over : str
            Names of two quantities of this result, as in `to_dict()`.

        Raises
        ------
        ValueError
            If a name is unknown, or the result has other than one dimension.
        """
        return above("show.plots").plot_curve(self, quantity, over)

    def _source(self):
        return self

    def _limits(self):
        return self.limits
