"""Checks of arguments, with errors that name the quantity, its value, the bound and what to do."""

import difflib
from collections.abc import Callable, Sequence
from dataclasses import fields
from functools import cached_property, lru_cache, wraps
from inspect import signature
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ParamSpec, Protocol, Self, TypeVar
from warnings import warn

import numpy as np

from . import lazy
from .errors import InvalidArgument, InvalidEntries, MDRError, shown

if TYPE_CHECKING:
    from numpy.typing import NDArray

    class Array(np.ndarray[tuple[Any, ...], np.dtype[np.float64]]):
        """A quantity: an array, or NumPy's scalar for one state, which has the methods of an array."""

        def __round__(self, ndigits: int = ...) -> float: ...

    class _WithUnit(Protocol):
        """A quantity of pint, astropy or unyt."""

        def to(self, unit: Any, /) -> Any: ...

    _Number = float | np.floating[Any] | np.integer[Any]
    _Numbers = _Number | NDArray[np.floating[Any]] | NDArray[np.integer[Any]] | _WithUnit
    #: A number or an array of numbers. NumPy's `ArrayLike` has text in it, and so has a recursive type.
    ArrayLike = _Numbers | Sequence[_Numbers] | Sequence[Sequence[_Numbers]]
    #: A parameter of a profile, a medium or a structure, as it is stored.
    Parameter = float | NDArray[np.float64]

else:
    Array, ArrayLike, Parameter = np.ndarray, Any, Any

#: Bounds of lengths, forces and moduli (SI), and of slopes.
SHORTEST, LONGEST = 1e-25, 1e25

#: Bounds of all other quantities (SI).
SMALLEST, LARGEST = 1e-60, 1e60

# Bound of radii, whose squares stay in double precision: a contact may be far wider than it is deep.
FARTHEST = 1e140

# NumPy broadcasts up to 32 dimensions, and a few are added internally.
_MOST_DIMENSIONS = 16


def one_of(quantity, value, known):
    """`value`, if it is one of the `known` names."""
    if not isinstance(value, str) or value not in known:
        bound = f"must be one of {', '.join(map(repr, known))}"
        raise InvalidArgument(f"{quantity} = {shown(value)} {bound}", quantity, value, bound)
    return value


def _is_double(value):
    """Whether a value is one double, or an int that is one exactly: no array is needed to look at it."""
    kind = type(value)
    return kind is float or kind is np.float64 or (kind is int and abs(value) <= 2**53)


def number(quantity, value, unit=""):
    """`value` as a float, if it is one real number: no bool, no text, no array."""
    if _is_double(value):
        return float(value)
    value = in_unit(quantity, value, unit)
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf" or array.ndim:
            raise TypeError
    except (TypeError, ValueError):
        raise _no_number(quantity, value, "one real number", unit) from None
    return float(array)


def _no_number(quantity, value, what, unit):
    """The error of a value that is not `what` it must be."""
    bound = f"must be {what}"
    return InvalidArgument(f"{quantity} {bound}, got {shown(value)}", quantity, value, bound, unit)


def in_unit(quantity, value, unit):
    """`value` converted to a unit and without it; a value without a unit is returned unchanged.

    Quantities of pint, astropy and unyt have `unit` or `units`, and `to`. Arrays with labelled axes
    (xarray) are refused because arrays broadcast by the order of their axes here, and lazy arrays (dask)
    because they would be loaded into memory as a whole.
    """
    if hasattr(value, "dims") and hasattr(value, "coords"):
        bound = (
            f"has dimensions with names, {shown(value.dims)}, which would be lost: arrays broadcast by the "
            "order of their axes"
        )
        advice = "give its .values, transposed as needed"
        raise InvalidArgument(f"{quantity} {bound}; {advice}", quantity, value, bound, unit, advice)
    if hasattr(type(value), "__dask_graph__") and not _carries_unit(value):
        bound = "is a lazy array, which would be loaded into memory as a whole"
        advice = ".compute() it, or give it to mdr_core.sweep, which keeps it lazy"
        raise InvalidArgument(f"{quantity} {bound}: {advice}", quantity, value, bound, unit, advice)
    if isinstance(value, list | tuple) and any(map(_carries_unit, value)):
        return [in_unit(quantity, part, unit) for part in value]
    if not _carries_unit(value):
        return value
    wanted = (unit or "").replace("·", "*").replace("³", "**3").replace("²", "**2")
    try:
        # The unit of a plain number is "" in astropy, and "dimensionless" in pint and unyt.
        value = value.to(wanted if wanted or hasattr(value, "unit") else "dimensionless")
        bare = value.magnitude if hasattr(value, "magnitude") else value.value
    except Exception as error:
        bound = f"cannot be converted to {unit or 'a number without a unit'} ({type(error).__name__})"
        message = f"{quantity} = {value!s:.80} {bound}"
        raise InvalidArgument(message, quantity, value, bound, unit) from None
    return np.asarray(in_unit(quantity, bare, ""))[()]


def _carries_unit(value):
    return (hasattr(value, "units") or hasattr(value, "unit")) and hasattr(value, "to")


def positive(quantity, value, *, unit="", infinite=False, zero=False, within=None):
    """`value` as a float or a read-only array, if positive (or zero, or infinite, where allowed).

    Finite numbers must lie `within` two bounds, by default those of quantities of their unit.
    """
    least, most = within or _bounds(unit, zero)
    if _is_double(value) and (
        least <= value <= most or (zero and value == 0) or (infinite and value == np.inf)
    ):
        return float(value)
    value = in_unit(quantity, value, unit)
    many = isinstance(value, list | tuple | np.ndarray)
    what = "real numbers" if many else "one real number"
    values = _real_array(quantity, value, what, unit).copy()
    values.setflags(write=False)
    with np.errstate(invalid="ignore"):
        bad = ~(values >= 0) if zero else ~(values > 0)
    if not infinite:
        bad = bad | (values == np.inf)
    bound = f"must be {'' if infinite else 'finite and '}{'not negative' if zero else 'positive'}"
    advice = f"give it in SI units ({unit})" if unit else "check it"
    raise_if(quantity, values, bad, bound, unit=unit, advice=advice)
    outside = (values > 0) & (values < least) | (values > most) & (values < np.inf)
    bound = f"must {'be 0 or ' if zero else ''}lie between {least:g} and {most:g}"
    raise_if(quantity, values, outside, bound, unit=unit, advice=advice)
    return values if values.ndim else float(values)


def _bounds(unit, zero):
    """Bounds of finite positive numbers of a unit, if they may be `zero` or not."""
    if unit not in ("m", "N", "Pa"):
        return SMALLEST, LARGEST
    # Where 0 is meant, rounding may leave less than any length.
    return SMALLEST if zero else SHORTEST, LONGEST


def positive_number(quantity, value, *, unit="", **allowed):
    """`value` as a float, if it is one number that is `positive`."""
    return positive(quantity, number(quantity, value, unit), unit=unit, **allowed)


def store(thing, **values):
    """Set fields of a frozen dataclass from its `__post_init__`, to values that have been checked."""
    for name, value in values.items():
        object.__setattr__(thing, name, value)


def set_positive(profile, **units):
    """Replace each named field of a frozen profile by its checked value, a float or an array."""
    for name, unit in units.items():
        quantity = f"{type(profile).__name__} {name}"
        # The coefficient of a power law may have any size that double precision has.
        within = (1e-300, 1e300) if unit == "m^(1-n)" else (SHORTEST, LONGEST)
        value = positive(quantity, getattr(profile, name), unit=unit, within=within)
        store(profile, **{name: value})
    common_shape(type(profile).__name__, **{name: getattr(profile, name) for name in units})


def _real_array(quantity, value, what="real numbers", unit=""):
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf" or array.ndim > _MOST_DIMENSIONS or np.ma.is_masked(value):
            raise TypeError
        # Numbers of longer types that overflow become infinite, and are refused.
        with np.errstate(over="ignore"):
            return array.astype(float, copy=False)
    except (TypeError, ValueError):
        raise _no_number(quantity, value, what, unit) from None


def finite_array(quantity, value, *, unit="", most=FARTHEST, missing=False):
    """A copy of `value` as a float array of numbers up to `most`, without infinity; NaN where `missing`."""
    if _is_double(value) and -most <= value <= most:
        return np.array(value, float)
    # A result that keeps the array must not change with the argument.
    array = _real_array(quantity, in_unit(quantity, value, unit), unit=unit).copy()
    large = np.isfinite(array) & (np.abs(array) > most)
    raise_if(quantity, array, large, f"is beyond {most:g}", unit=unit, advice="give it in SI units")
    advice = "leave it out, or correct the data it comes from"
    bad = np.isinf(array) if missing else ~np.isfinite(array)
    return raise_if(quantity, array, bad, "must be finite", unit=unit, advice=advice)


def force(quantity, value):
    """`value` as a float array of normal forces, which are not negative."""
    array = finite_array(quantity, value, unit="N", most=LONGEST)
    raise_if(
        quantity, array, array < 0, "is negative", unit="N", advice="a tension needs work_of_adhesion > 0"
    )
    tiny = (array > 0) & (array < SMALLEST)
    return raise_if(quantity, array, tiny, f"must be 0 or at least {SMALLEST:g}", unit="N")


def raise_if(quantity, array, bad, bound, *, unit="", advice="", remedy=()):
    """`array`, if no entry is `bad`; else an error that names the first one and counts the others."""
    # Of one entry it takes a third of the time of np.any.
    if np.count_nonzero(bad):
        raise InvalidEntries(quantity, array, bad, bound, unit, advice, remedy)
    return array


def numbers_of(name, function, argument, refused):
    """What a user's function of an array of radii gives, as an array of numbers.

    If it fails, or gives anything else, the error is `refused` of what is wrong and of what to do.
    """
    try:
        with np.errstate(all="ignore"):
            value = function(argument)
    except InvalidArgument:
        raise
    except (TypeError, ValueError, ArithmeticError) as error:
        what = f"{name} fails for an array of radii ({type(error).__name__}: {error})"
        raise refused(what, "write it for arrays, with NumPy's functions") from error
    return doubles(name, value, refused)


def values_of(name, function, argument, refused):
    """`numbers_of` an array of radii, refused unless there is one for each."""
    value = numbers_of(name, function, argument, refused)
    try:
        return np.broadcast_to(value, argument.shape)
    except ValueError:
        what = f"{name} has the shape {value.shape} for radii of shape {argument.shape}"
        raise refused(what, "give one value for each radius") from None


def doubles(name, value, refused):
    """A value of a user's function as an array of double precision, else `refused` as by `numbers_of`."""
    array = np.asarray(value)
    if hasattr(value, "units") or hasattr(value, "unit") or array.dtype.kind not in "biuf":
        kind = "complex numbers" if array.dtype.kind == "c" else shown(value)
        raise refused(f"{name} gives {kind}", "give plain numbers in SI units")
    if array.dtype.kind == "f" and array.dtype.itemsize < np.dtype(float).itemsize:
        what = f"{name} gives {array.dtype}, which has {np.finfo(array.dtype).precision} digits"
        raise refused(what, "compute it in double precision, float64")
    return array.astype(float, copy=False)


def common_shape(what, **values):
    """Shape to which the values broadcast; else an error that names their shapes."""
    if all(map(_is_double, values.values())):
        return ()
    for name, value in values.items():
        if not _carries_unit(value):
            _real_array(name, value)
    try:
        return np.broadcast_shapes(*map(np.shape, values.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(value)}" for name, value in values.items() if np.ndim(value))
        raise MDRError(f"{what}: arrays of shapes {shapes} do not broadcast") from None


def frozen(values):
    """`values` as a scalar, or as an array that cannot be written to."""
    values = np.asarray(values)
    values.setflags(write=False)
    return values[()]


def frozen_property(function: "Callable[[Any], Any]") -> "cached_property[Array]":
    """A property that is computed once, and `frozen`."""
    return cached_property(wraps(function)(lambda self: frozen(function(self))))


_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


@lru_cache
def _parameters(function):
    """Names of the parameters of a function; None if it takes any keyword."""
    parameters = signature(function).parameters
    return None if any(each.kind == each.VAR_KEYWORD for each in parameters.values()) else list(parameters)


def _refuse_keywords(name, keywords, parameters):
    """Refuses keywords that are no parameters, and names the parameters."""
    for keyword in keywords:
        if parameters is not None and keyword not in parameters:
            hint = lazy.hints.keyword_hint(name, keyword)
            said = f"{name} has no parameter {keyword!r}; it has {', '.join(parameters)}"
            raise TypeError(f"{said}. {hint}" if hint else said)


def keywords_explained(function: "Callable[_Arguments, _Result]") -> "Callable[_Arguments, _Result]":
    """The function with errors on unknown keywords that name its parameters and suggest one.

    Of a class method, below `classmethod`.
    """

    @wraps(function)
    def checked(*arguments: _Arguments.args, **keywords: _Arguments.kwargs) -> _Result:
        parameters = _parameters(function)
        if parameters and parameters[0] == "cls":
            parameters = parameters[1:]
        _refuse_keywords(function.__qualname__, keywords, parameters)
        return function(*arguments, **keywords)

    return checked


#: Last words of names of quantities of which a result has several.
_SHARED = ("depth", "energy", "work", "speed", "velocity")


def _is_misspelled(name, nearest):
    """Whether a name is a misspelling of the nearest one, and not another energy, depth or velocity."""
    (first, _, last), (other, _, same) = name.rpartition("_"), nearest.rpartition("_")
    if same not in _SHARED and not difflib.get_close_matches(last, _SHARED, 1, 0.8):
        return True
    return all(difflib.get_close_matches(one, [two], 1, 0.8) for one, two in ((last, same), (first, other)))


def no_attribute(owner, name, known):
    """AttributeError on an unknown name of a result or the package, which says what may be meant.

    That is the name that is known for what the field calls so, else the nearest one.
    """
    if owner == "mdr_core":
        hint = lazy.hints.model_hint(name) or None
        suggestion = f": {hint}" if hint else ""
    else:
        hint = lazy.hints.quantity_hint(name, known)
        suggestion = f"; {hint}" if hint else ""
    nearest = difflib.get_close_matches(name, known, 1, 0.7)
    if nearest and hint is None and _is_misspelled(name, nearest[0]):
        suggestion = f"; did you mean {nearest[0]!r}?"
    # With its name, Python does not add a suggestion of its own.
    return AttributeError(f"{owner} has no {name!r}{suggestion}", name=name)


def former(old, new):
    """Property with the old name of an attribute, which warns; `new` may go over several attributes."""

    def value(self):
        warn(f"{type(self).__name__}.{old} is {new} now", DeprecationWarning, stacklevel=2)
        return attrgetter(new)(self)

    return property(value)


class Parameters:
    """A frozen dataclass whose parameters may be arrays: equal where all entries are, and hashable."""

    def __new__(cls, *positional: Any, **keywords: Any) -> Self:
        if keywords and (parameters := _parameters(cls.__init__)):
            _refuse_keywords(cls.__name__, keywords, parameters[1:])
        if len(positional) > 1:
            cls._refuse_positional(len(positional))
        return super().__new__(cls)

    @classmethod
    def _refuse_positional(cls, count):
        """Refuses more values than there are parameters by position, with the names of the others."""
        by_name = [each.name for each in fields(cls) if each.kw_only]
        by_position = [each.name for each in fields(cls) if not each.kw_only]
        if by_name and count > len(by_position):
            alone = ", ".join(by_position)
            raise TypeError(
                f"{cls.__name__} takes {alone} by position, and {count} values are given so; give the "
                f"others by name: {', '.join(by_name)}"
            )

    def __str__(self) -> str:
        """Parameters that are not defaults, with six digits; `repr` has all digits."""
        with np.printoptions(precision=6, threshold=10):
            texts = []
            for each in fields(self):
                value = getattr(self, each.name)
                # None as a default stands for 0, as of a hardness that a medium does not have.
                if value is not None and not np.array_equal(value, each.default or 0.0):
                    text = f"{value:.6g}" if isinstance(value, float) else str(value)
                    texts.append(f"{each.name}={text}")
        return f"{type(self).__name__}({', '.join(texts)})"

    def _repr_html_(self) -> str:
        return lazy.report.parameters_as_html(self)

    def __getstate__(self):
        # Cached results are not pickled; some hold functions.
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Shape to which array-valued parameters broadcast, () for a single one."""
        # A tuple, as of vertices, is one parameter.
        values = self.__getstate__().values()
        arrays = (value for value in values if isinstance(value, np.ndarray | Parameters))
        return np.broadcast_shapes(*(value.shape for value in arrays))

    def entries(self, index: Any, shape: tuple[int, ...] | None = None) -> Self:
        """The profiles or media at an index, with parameters broadcast to `shape` first.

        Parameters
        ----------
        index : int, slice, tuple or array_like
            An index of a NumPy array of the shape of the parameters.
        shape : tuple of int, optional
            The shape, where it is not that of the parameters alone.

        Examples
        --------
        >>> from mdr_core import Medium
        >>> Medium(E_star=[1e9, 2e9], q_c=[10.0, 20.0]).entries(1).E_star
        2000000000.0
        """
        if not self.shape:
            return self
        shape = self.shape if shape is None else shape
        values = self.__getstate__()
        for name, value in values.items():
            if isinstance(value, np.ndarray):
                values[name] = np.broadcast_to(value, shape)[index]
            elif isinstance(value, Parameters):
                values[name] = value.entries(index, shape)
        return self._with(values)

    def _with(self, values):
        """The same with other values of the parameters."""
        return type(self)(**values)

    def flat_entries(self, rows: Any, shape: tuple[int, ...]) -> Self:
        """The profiles or media at rows of the flattened `shape` of an ensemble."""
        if not self.shape:
            return self
        if isinstance(rows, slice):
            rows = np.arange(*rows.indices(np.prod(shape, dtype=int)))
        return self.entries(np.unravel_index(rows, shape), shape)

    def __eq__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        own, others = self.__getstate__(), other.__getstate__()
        return all(_equal(own[name], others[name]) for name in own)

    def __hash__(self):
        return hash((type(self), *map(_hashable, self.__getstate__().values())))


def _equal(one, other):
    """Whether two parameters are equal, which may have parameters, or be arrays."""
    # A dataclass has its own comparison, by default, which fails for arrays.
    if isinstance(one, Parameters):
        return Parameters.__eq__(one, other) is True
    return np.array_equal(one, other)


def _hashable(value):
    """A parameter as something that can be hashed."""
    if isinstance(value, Parameters):
        return Parameters.__hash__(value)
    return (value.shape, *value.ravel().tolist()) if isinstance(value, np.ndarray) else value
