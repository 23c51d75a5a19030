"""Base classes of results: quantities by name, entries, iteration; limits as data; names of the models.

The modules that show a result (text, tables, limits in words, plots) are above the physics; they are
imported at their first use.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from . import lazy
from .check import no_attribute
from .errors import MDRError

if TYPE_CHECKING:
    import pandas
    import xarray
    from numpy.typing import NDArray


class Model(str):
    """Name of a model, with the reason for choosing it in `reason`.

    Examples
    --------
    >>> from mdr_core.base.results import CLOSED_FORM
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
    "scalar equation, because released elements do not come into contact again",
)
MODES = Model(
    "modes",
    "on a structure with modes, waves come back and the body may hit several times: body and modes are "
    "linear oscillators under the contact force",
)
CHAIN = Model(
    "chain",
    "on a viscous path, released elements may come into contact again while they relax, so that each "
    "element needs its own memory",
)


class Entries:
    """Base class of dataclasses; each of their fields has one entry, or one row, per impact."""

    def __getitem__(self, index: Any) -> Self:
        return type(self)(**{field.name: getattr(self, field.name)[index] for field in fields(self)})


@dataclass(frozen=True)
class Limit:
    """An assumption of the model, and how near a result is to its bound; an entry of `result.limits`.

    Attributes
    ----------
    what : str
        Bounded quantity. Any result may have "slope", "contact radius", "modulus" below 1 kPa or above
        10 TPa, "critical depth" below 0.1 nm, "Poisson ratio", "viscosity", "speed" and "fast limit".

        With adhesion:

        - "Tabor's parameter", which must exceed its bound
        - "facets" of samples

        With friction:

        - "coupling" and "slip direction"
        - "tolerance", if elements stick, like the next two
        - "depth" over the elastic compression at the turning point (d_c of a hardness q_c/a)
        - "mass" over the tangential mass

        With a constant hardness:

        - "flow": the area of a flowing contact over its area in the model

        On a path given by force:

        - the length (m) of a "jump"

        On a structure:

        - "edges": the contact time over the time in which waves return from the nearest edge
        - "second contact": its bound on the restitution over the restitution of the impact
        - "support": the force that the mass of a support adds
        - "thin": the contact radius over half of the thickness, or 6 thicknesses over the speed of shear
          waves and the contact time
        - "deflection" and "dent" over half of the thickness
        - "weight": the speed that gravity adds
    value, bound : float
        Largest value of the quantity over all states, and the largest value at which the assumption holds.
    exceeded : bool
        Whether the value is larger than the bound.
    sentence : str
        The limit in words, with a remedy.
    concerns : str
        "result", or the concerned formula of the paper if the result itself is exact.
    severe : bool
        Whether the result is only an estimate if the bound is exceeded.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, indent
    >>> slope = indent(Cone(slope=1.0), Medium(E_star=1e9), 1e-9).limits[0]
    >>> print(slope.what, slope.value, slope.exceeded)
    slope 1.0 True
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
        """One word: "good", "note" if the result hardly changes, else "beyond"."""
        if self.holds:
            return "good"
        return "beyond" if self.severe and self.concerns == "result" else "note"


class Limits(tuple[Limit, ...]):
    """Limits of a result: a tuple that prints one line per limit."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "\n".join(f"{each.what} ({each.level}): {each.sentence}" for each in self)

    def _repr_html_(self) -> str:
        return lazy.report.limits_as_html(self)


class Record:
    """Base class of results with named quantities, which are arrays of one shape.

    A derived class gives the names below, and the origin and the limits for tables. Other modules read
    them through `Presentation` and `quantities_of`.
    """

    #: Names of all quantities, of the quantities in its `repr`, and of the dimensions.
    _quantities: ClassVar[tuple[str, ...]] = ()
    _shown: ClassVar[tuple[str, ...]] = ()
    _dimensions: ClassVar[tuple[str, ...]] = ("state",)

    @property
    def _name(self) -> str:
        """Displayed name."""
        return type(self).__name__

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of all quantities: () for one state or impact."""
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
        """Return all quantities except None by name, in SI units: floats, or arrays of one shape.

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
        """Return a table of all quantities in SI units, one row for each state or impact.

        `attrs` has the model, the indenter and the medium, and the "units" and "long_names" of the
        columns. Array-valued parameters of indenter and medium are additional columns.
        """
        return lazy.report.table(self)

    def to_xarray(self) -> "xarray.Dataset":
        """Return a dataset of all quantities, each with its `units`, `long_name` and symbol as attributes.

        Prescribed quantities (depth, time, mass, speed, array-valued parameters) are coordinates.
        """
        return lazy.report.dataset(self)

    def _source(self) -> Any:
        """Return the result with the profile, the medium and the model, or None."""
        return None

    def _limits(self) -> tuple[Limit, ...]:
        """Return the limits of the model for this result."""
        return ()

    def __getitem__(self, index: Any) -> Self:
        raise TypeError(f"this {self._name} is a single result: it has no entries")

    def __repr__(self) -> str:
        return lazy.report.text(self)

    def _repr_html_(self) -> str:
        return lazy.report.table_of_text(self)


def quantities_of(kind: type[Record] | Record) -> tuple[str, ...]:
    """Return the names of all quantities of a class of results, or of a result."""
    return kind._quantities  # noqa: SLF001


def check_single(result: Record, what: str) -> None:
    """Raise an error if a result has several entries, for `what`, which needs a single one."""
    if result.shape:
        raise MDRError(
            f"{what} needs a single {Presentation(result).noun}, but this result has shape {result.shape}; "
            f"select one first, as in result[-1].{what}(…)"
        )


@dataclass(frozen=True)
class Presentation:
    """Facts about a result, other than its quantities, for texts, tables and plots."""

    result: Record

    @property
    def name(self) -> str:
        """Displayed name, such as "Impact"."""
        return self.result._name  # noqa: SLF001

    @property
    def noun(self) -> str:
        """Noun for one entry, such as "state" or "instant"."""
        last = self.dimensions[-1]
        return "instant" if last == "time" else last

    @property
    def shown(self) -> tuple[str, ...]:
        """Names of the quantities in its `repr`."""
        return self.result._shown  # noqa: SLF001

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Names of the dimensions that its class may have; the last counts the states of a path."""
        return self.result._dimensions  # noqa: SLF001

    @property
    def source(self) -> Any:
        """The result with the profile, the medium and the model, or None."""
        return self.result._source()  # noqa: SLF001

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model, found at each access."""
        return self.result._limits()  # noqa: SLF001


class Result(Record):
    """Base class of results of one profile on one medium: states of a path or over time, or impacts."""

    def plot(self, quantity: str = "force", over: str = "depth") -> Any:
        """Plot one quantity over another as HoloViews elements, by default the force–depth curve.

        A path is shown in parts: loaded elastically, yielding, unloaded. Axes have names and units. Areas
        of a force–depth curve are the plastic work of the path and the energy stored in its last state.

        Parameters
        ----------
        quantity, over : str
            Names of two quantities of this result, as in `to_dict()`.

        Raises
        ------
        ValueError
            If a name is unknown, or the result does not have exactly one dimension.
        """
        return lazy.plots.plot_curve(self, quantity, over)

    def _source(self):
        return self

    def _limits(self):
        return self.limits
