"""What results say of themselves, and how they become tables: names, symbols and units, once."""

import html
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from . import _check

if TYPE_CHECKING:
    import pandas
    import xarray
    from numpy.typing import NDArray

#: Results of more entries than this show what they have, and compute nothing to be shown.
_MANY = 1000
#: Lines of a result's `repr`.
_MOST_LINES = 12
_PREFIXES = dict(zip(range(-15, 13, 3), "fpnµm kMGT", strict=True)) | {0: ""}


@dataclass(frozen=True)
class Quantity:
    """Symbol, unit and long name of a quantity."""

    symbol: str
    unit: str
    long_name: str

    @property
    def attributes(self):
        """What it is called in an xarray.Dataset."""
        return {"units": self.unit or "1", "long_name": self.long_name, "symbol": self.symbol}


QUANTITIES = {
    name: Quantity(*rest)
    for name, *rest in (
        ("time", "t", "s", "time"),
        ("depth", "d", "m", "indentation depth"),
        ("velocity", "v", "m/s", "indentation rate"),
        ("force", "F", "N", "normal force"),
        ("stiffness", "dF/dd", "N/m", "contact stiffness"),
        ("contact_radius", "a", "m", "contact radius"),
        ("plastic_radius", "c", "m", "radius of the plastic zone"),
        ("plastic_depth", "d_p", "m", "plastic depth"),
        ("live_depth", "ℓ", "m", "live depth"),
        ("mean_pressure", "p_m", "Pa", "mean contact pressure"),
        ("kinetic_energy", "W_k", "J", "kinetic energy"),
        ("stored_energy", "U", "J", "stored elastic energy"),
        ("plastic_work", "W_p", "J", "plastic work"),
        ("viscous_work", "W_v", "J", "viscous work"),
        ("mass", "m", "kg", "mass"),
        ("speed", "v₀", "m/s", "impact speed"),
        ("restitution", "e", "", "coefficient of restitution"),
        ("rebound_speed", "v_r", "m/s", "rebound speed"),
        ("tangential_speed", "W₀", "m/s", "tangential speed"),
        ("friction", "μ", "", "coefficient of friction"),
        ("tangential_mass", "m_t", "kg", "tangential mass"),
        ("tangential_velocity", "W", "m/s", "tangential velocity"),
        ("tangential_restitution", "e_t", "", "tangential restitution"),
        ("rebound_angle", "β", "rad", "rebound angle"),
        ("tangential_force", "F_x", "N", "tangential force"),
        ("max_tangential_force", "F_x,max", "N", "largest tangential force"),
        ("friction_work", "W_f", "J", "friction work"),
        ("stick_radius", "r_o", "m", "outer radius of stick"),
        ("slip_radius", "r_i", "m", "inner radius of stick"),
        ("contact_time", "T", "s", "contact time"),
        ("max_depth", "d_max", "m", "largest depth"),
        ("max_force", "F_max", "N", "largest force"),
        ("damaged_area", "A", "m²", "damaged area"),
        ("contact_area", "A", "m²", "contact area"),
        ("max_depth_error", "Δd/d", "", "relative error of the largest depth"),
        ("contact_area_error", "ΔA/A", "", "relative error of the contact area"),
        ("restitution_error", "Δe/e", "", "relative error of the restitution"),
        # Parameters of media and shapes.
        ("E_star", "E*", "Pa", "effective modulus"),
        ("q_c", "q_c", "N/m", "yield constant"),
        ("eta", "η", "Pa·s", "viscosity"),
        ("poisson", "ν", "", "Poisson ratio"),
        ("slope", "s", "", "slope"),
        ("exponent", "n", "", "exponent"),
        ("coefficient", "c", "m^(1-n)", "coefficient"),
        *((name, symbol, "m", name.replace("_", " ")) for name, symbol in (
            ("radius", "R"), ("tip_radius", "R"), ("cylinder_radius", "b"), ("flat_radius", "b"),
            ("edge_radius", "R"), ("r", "r"), ("z", "z"),
        )),
    )
}  # fmt: skip


def engineering(values, unit):
    """A number, or the range of an array, with four digits and a prefix of its unit.

    Examples
    --------
    >>> engineering(1.33472e-5, "N"), engineering([0.0, 2e-13], "m²"), engineering(1e-12, "kg")
    ('13.35 µN', '0 … 0.2 µm²', '1 ng')
    """
    values = np.asarray(values, dtype=float)
    if not values.size:
        return "none"
    ends = [float(np.min(values)), float(np.max(values))] if values.ndim else [float(values)]
    if unit == "kg":
        ends, unit = [1e3 * end for end in ends], "g"
    factor, unit = prefixed(max(map(abs, ends)), unit)
    written = [_digits(end / factor) for end in ends]
    text = written[0] if len(written) == 1 or written[0] == written[1] else " … ".join(written)
    return f"{text} {unit}".rstrip()


def prefixed(largest, unit):
    """Size and name of the unit with the prefix in which a value has one to three digits before the point.

    Examples
    --------
    >>> prefixed(2e-8, "m")
    (1e-09, 'nm')
    """
    if unit in ("", "m^(1-n)") or not 0 < largest < np.inf:
        return 1.0, unit
    # A little more than 999.95 is a thousand as it is written.
    # Of areas a prefix spans six decades, from 0.1 on.
    power = 2 if unit == "m²" else 1
    exponent = 3 * int(np.floor((np.log10(largest * 1.00005) + power - 1) / 3 / power))
    exponent = min(max(exponent, -15), 12)
    return float(f"1e{power * exponent}"), f"{_PREFIXES[exponent]}{unit}"


def _digits(value):
    """Four digits, without a power of ten up to a million."""
    text = f"{value:.4g}"
    return f"{float(text):.0f}" if "e+05" in text or "e+04" in text else text


def described(thing):
    """A shape or a medium in a line: its name, and its parameters with their units, but for defaults."""
    parts = [type(thing).__name__]
    for name, field in getattr(thing, "__dataclass_fields__", {}).items():
        known, value = QUANTITIES.get(name), getattr(thing, name)
        if np.ndim(value) == 0 and value == field.default:
            continue
        try:
            text = engineering(value, known.unit if known else "")
            count = f" ({np.size(value)})" if np.ndim(value) else ""
        except (TypeError, ValueError):
            text, count = _check.shown(value), ""
        parts.append(f"{known.symbol if known else name} {text}{count}")
    return ", ".join(parts)


def imported(name, what, packages=None):
    """A package that is not needed otherwise, or an error that says what to install for something."""
    try:
        return import_module(name)
    except ImportError:
        install = f"pip install {packages or name}"
        raise ImportError(f"{what} needs {name}, which is not installed: {install}") from None


class Report:
    """What results share: how they are shown, counted, and turned into dicts, tables and datasets."""

    #: Names of the quantities that it has, of those its `repr` shows, of its dimensions.
    _quantities: ClassVar[tuple[str, ...]] = ()
    _shown: ClassVar[tuple[str, ...]] = ()
    _dimensions: ClassVar[tuple[str, ...]] = ("state",)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape that all quantities have: () for one state or impact."""
        return np.shape(getattr(self, self._quantities[0]))

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError(f"this {type(self).__name__} is a single one and has no length; .shape is ()")
        return self.shape[0]

    def __bool__(self) -> bool:
        return 0 not in self.shape

    def __iter__(self) -> Iterator[Self]:
        if not self.shape:
            name = type(self).__name__
            raise TypeError(f"this {name} is a single one: there is nothing to iterate over")
        return (self[i] for i in range(self.shape[0]))

    def __array__(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(
            f"a result ({type(self).__name__}) is many quantities, not one array: take one, as in result."
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

        `attrs` has what was modelled, and "units" and "long_names" by the names of the columns. Parameters
        of many indenters or media have columns of their own.
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

        What was prescribed (depth, time, mass and speed, parameters of many) are coordinates.
        """
        xarray = imported("xarray", "to_xarray()")
        dims, variables = self._dims(), {}
        for name, value in (self.to_dict() | self._parameters()).items():
            about = QUANTITIES[name].attributes if name in QUANTITIES else {}
            variables[name] = (dims, np.broadcast_to(value, self.shape), about)
        given = {"depth", "time", "mass", "speed", "tangential_speed", "friction", "tangential_mass"}
        given = (given | set(self._parameters())) & set(variables)
        given -= {"depth"} if "time" in variables else set()
        return xarray.Dataset(variables, attrs=self._attributes()).set_coords(sorted(given))

    def _dims(self):
        """Names of the dimensions: of paths the last one counts their states."""
        names, count = self._dimensions, len(self.shape)
        if count <= len(names):
            return names[len(names) - count :]
        return (*(f"{names[0]}_{i}" for i in range(count - len(names) + 1)), *names[1:])

    @property
    def _noun(self):
        """What an entry is."""
        last = self._dimensions[-1]
        return "instant" if last == "time" else last

    def _one(self, what):
        """Refuses several of what has to be a single one."""
        if self.shape:
            raise ValueError(
                f"{what} is that of one {self._noun}, but these are of shape {self.shape}; pick one first, "
                f"as in result[-1].{what}(…)"
            )

    def _source(self):
        """What has the profile and the medium: the result itself."""
        return self

    def _parameters(self):
        """Parameters of shape and medium that are arrays, by name."""
        source, found = self._source(), {}
        for thing in (getattr(source, "profile", None), getattr(source, "medium", None)):
            if thing is not None and thing.shape:
                values = {name: getattr(thing, name) for name in thing.__dataclass_fields__}
                found |= {name: value for name, value in values.items() if np.ndim(value)}
        return found

    def _attributes(self):
        source, texts = self._source(), {"result": type(self).__name__}
        if hasattr(source, "profile"):
            texts |= {"model": str(source.model), "indenter": described(source.profile)}
            texts["medium"] = described(source.medium)
        exceeded = [limit.sentence for limit in getattr(self, "limits", ()) if limit.exceeded]
        return texts | ({"limits": " ".join(exceeded)} if exceeded else {})

    def _title(self):
        shape, source = self.shape, self._source()
        size = f"{' × '.join(map(str, shape))} {self._noun}s" if shape else f"one {self._noun}"
        model = f", {source.model}" if hasattr(source, "model") else ""
        return f"{type(self).__name__}: {size}{model}"

    def _rows(self):
        """Pairs of a label and a text: what is shown of a result."""
        source, many = self._source(), np.prod(self.shape) > _MANY
        if hasattr(source, "profile"):
            yield "indenter", described(source.profile)
            yield "medium", described(source.medium)
        for name in self._shown:
            quantity, label = QUANTITIES[name], name.replace("_", " ")
            # What is only read costs nothing, whatever the size.
            given = name in getattr(self, "__dataclass_fields__", {}) or name in vars(self)
            text = engineering(getattr(self, name), quantity.unit) if given or not many else f".{name}"
            yield f"{label} {quantity.symbol}", text

    def _limit_rows(self, most):
        """The limits that are exceeded in at most so many rows, of a few results."""
        if np.prod(self.shape) > _MANY:
            return
        limits = [x for x in getattr(self, "limits", ()) if x.exceeded and x.concerns == "result"]
        first = limits if len(limits) <= most else limits[: most - 1]
        yield from (("limit", limit.sentence) for limit in first)
        if rest := limits[len(first) :]:
            yield "limits", f"{', '.join(limit.what for limit in rest)}: see .limits"

    def __getitem__(self, index: Any) -> Self:
        raise TypeError(f"this {type(self).__name__} is a single one: it has no parts")

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
        return f"<table><caption>{html.escape(self._title())}</caption>{cells}</table>{self._sketch()}"

    def _sketch(self):
        """A small force–depth curve of a path as SVG, where it is cheap."""
        if not {"depth", "force"} <= set(self._quantities) or not 1 < np.prod(self.shape) <= _MANY:
            return ""
        points = []
        for values, size in ((self.depth, 160), (self.force, -80)):
            low, high = float(np.min(values)), float(np.max(values))
            share = (np.ravel(values) - low) / ((high - low) or 1.0)
            points.append(2 + size * share + (80 if size < 0 else 0))
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(*points, strict=True))
        return (
            "<svg width='164' height='84' role='img' aria-label='force over depth'>"
            f"<polyline points='{line}' fill='none' stroke='currentColor'/></svg>"
        )
