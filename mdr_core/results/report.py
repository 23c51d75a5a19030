"""Base class of results: how they are shown, and how they become dicts, tables and datasets."""

import html
from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from .._check import no_attribute
from .limits import Limit
from .quantities import QUANTITIES, described, engineering

if TYPE_CHECKING:
    import pandas
    import xarray
    from numpy.typing import NDArray

#: Quantities of results with more entries are not computed in order to be shown.
_MANY = 1000
#: Lines of a result's `repr`.
_MOST_LINES = 12
#: Quantities that are given, not computed.
_GIVEN = {"depth", "time", "mass", "speed", "tangential_speed", "friction", "tangential_mass"}


def imported(name, what, packages=None):
    """An optional package, or an error that names what is to be installed for a purpose `what`."""
    try:
        return import_module(name)
    except ImportError:
        install = f"pip install {packages or name}"
        raise ImportError(f"{what} needs {name}, which is not installed: {install}") from None


class Report:
    """Base class of results: their text, and their conversion to dicts, tables and datasets."""

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
            raise TypeError(f"this {self._name} is a single one and has no length; .shape is ()")
        return self.shape[0]

    def __bool__(self) -> bool:
        return 0 not in self.shape

    def __iter__(self) -> Iterator[Self]:
        if not self.shape:
            name = self._name
            raise TypeError(f"this {name} is a single one: there is nothing to iterate over")
        return (self[i] for i in range(self.shape[0]))

    if not TYPE_CHECKING:

        def __getattr__(self, name):
            names = {*dir(type(self)), *type(self).__dataclass_fields__}
            known = sorted(each for each in names if not each.startswith("_"))
            raise no_attribute(f"this {self._name}", name, known)

    def __array__(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(
            f"a result ({self._name}) is many quantities, not one array: take one, as in result."
            f"{self._shown[0]}, or all by to_pandas() or to_xarray()"
        )

    def to_dict(self) -> "dict[str, float | NDArray[np.float64]]":
        """All quantities by name, in SI units: floats, or arrays of one shape.

        Examples
        --------
        >>> from mdr_core import Cone, Medium, indent
        >>> indent(Cone(slope=1.0), Medium(E_star=1.0), [0.0, 1.0]).to_dict()["force"].round(4).tolist()
        [0.0, 0.6366]
        """
        values = {name: np.asarray(getattr(self, name)) for name in self._quantities}
        return {name: value if value.ndim else float(value) for name, value in values.items()}

    def to_pandas(self) -> "pandas.DataFrame":
        """A table of all quantities in SI units, one row for each state or impact.

        `attrs` has the model, the indenter and the medium, and "units" and "long_names" by the names of the
        columns. Array-valued parameters of indenter and medium have columns of their own.
        """
        pandas = imported("pandas", "to_pandas()")
        values = self.to_dict() | self._parameters()
        columns = {name: np.broadcast_to(v, self.shape).ravel() for name, v in values.items()}
        if len(self.shape) > 1:
            index = pandas.MultiIndex.from_product(map(range, self.shape), names=self._dims())
        else:
            index = pandas.RangeIndex(len(next(iter(columns.values()))), name=(*self._dims(), None)[0])
        table = pandas.DataFrame(columns, index=index)
        named = {name: QUANTITIES[name] for name in columns if name in QUANTITIES}
        units = {name: quantity.unit for name, quantity in named.items()}
        names = {name: quantity.long_name for name, quantity in named.items()}
        table.attrs.update(self._attributes(), units=units, long_names=names)
        return table

    def to_xarray(self) -> "xarray.Dataset":
        """A dataset of all quantities, each with its `units`, `long_name` and symbol as attributes.

        Prescribed quantities (depth, time, mass, speed, array-valued parameters) are coordinates.
        """
        xarray = imported("xarray", "to_xarray()")
        dims, variables = self._dims(), {}
        for name, value in (self.to_dict() | self._parameters()).items():
            about = QUANTITIES[name].attributes if name in QUANTITIES else {}
            variables[name] = (dims, np.broadcast_to(value, self.shape), about)
        given = (_GIVEN | set(self._parameters())) & set(variables)
        given -= {"depth"} if "time" in variables else set()
        return xarray.Dataset(variables, attrs=self._attributes()).set_coords(sorted(given))

    def _dims(self):
        """Names of the dimensions; the last one counts the states of a path."""
        names, count = self._dimensions, len(self.shape)
        if count <= len(names):
            return names[len(names) - count :]
        return (*(f"{names[0]}_{i}" for i in range(count - len(names) + 1)), *names[1:])

    @property
    def _noun(self):
        """Noun for one entry."""
        last = self._dimensions[-1]
        return "instant" if last == "time" else last

    def _one(self, what):
        """Refuses a result of several entries where a single one is needed."""
        if self.shape:
            raise ValueError(
                f"{what} is that of one {self._noun}, but these are of shape {self.shape}; pick one first, "
                f"as in result[-1].{what}(…)"
            )

    def _source(self) -> Any:
        """The result with the profile, the medium and the model; None where there is none."""
        return None

    def _limits(self) -> tuple[Limit, ...]:
        """Limits of the model for this result."""
        return ()

    def _parameters(self):
        """Array-valued parameters of profile and medium, by name."""
        source, parameters = self._source(), {}
        for owner in (source.profile, source.medium) if source else ():
            values = {name: getattr(owner, name) for name in owner.__dataclass_fields__}
            parameters |= {name: value for name, value in values.items() if isinstance(value, np.ndarray)}
        return parameters

    def _attributes(self):
        """Attributes of a table or a dataset, all of them texts."""
        source, texts = self._source(), {"result": self._name}
        if source:
            texts |= {"model": str(source.model), "indenter": described(source.profile)}
            texts["medium"] = described(source.medium)
        exceeded = [limit.sentence for limit in self._limits() if limit.exceeded]
        return texts | ({"limits": " ".join(exceeded)} if exceeded else {})

    def _title(self):
        source = self._source()
        noun = self._noun if np.prod(self.shape) == 1 else f"{self._noun}s"
        size = f"{' × '.join(map(str, self.shape)) or 'one'} {noun}"
        return f"{self._name}: {size}{f', {source.model}' if source else ''}"

    def _rows(self):
        """Pairs of a label and a text, one for each line of the `repr`."""
        source, many = self._source(), np.prod(self.shape) > _MANY
        if source:
            yield "indenter", described(source.profile)
            yield "medium", described(source.medium)
        for name in self._shown:
            quantity, label = QUANTITIES[name], name.replace("_", " ")
            # Quantities of a large ensemble are shown if they are there already.
            stored = name in _GIVEN or name in vars(self)
            text = engineering(getattr(self, name), quantity.unit) if stored or not many else f".{name}"
            yield f"{label} {quantity.symbol}", text

    def _limit_rows(self, most):
        """Rows on the limits that are exceeded, `most` at the most; none for a large ensemble."""
        if np.prod(self.shape) > _MANY:
            return
        limits = [x for x in self._limits() if x.exceeded and x.concerns == "result"]
        first = limits if len(limits) <= most else limits[: max(most - 1, 0)]
        yield from (("limit", limit.sentence) for limit in first)
        if others := limits[len(first) :]:
            yield "limits", f"{', '.join(limit.what for limit in others)}: see .limits"

    def __getitem__(self, index: Any) -> Self:
        raise TypeError(f"this {self._name} is a single one: it has no entries")

    def __repr__(self) -> str:
        rows = [(label, f"{text:.140}") for label, text in self._rows()]
        rows += self._limit_rows(_MOST_LINES - 1 - len(rows))
        return "\n".join([self._title(), *(f"  {label:<24} {text}" for label, text in rows)])

    def _repr_html_(self) -> str:
        cells = "".join(
            f"<tr><th style='text-align:left'>{html.escape(label)}</th>"
            f"<td style='text-align:left'>{html.escape(text)}</td></tr>"
            for label, text in (*self._rows(), *self._limit_rows(_MOST_LINES))
        )
        return f"<table><caption>{html.escape(self._title())}</caption>{cells}</table>"
