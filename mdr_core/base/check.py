"""Argument checks. Their errors name the quantity, its value, the bound and the remedy."""

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
        """A quantity: an array, or for one state a NumPy scalar, which has the methods of an array."""

        def __round__(self, ndigits: int = ...) -> float: ...

    class _WithUnit(Protocol):
        """A quantity of pint, astropy or unyt."""

        def to(self, unit: Any, /) -> Any: ...

    _Number = float | np.floating[Any] | np.integer[Any]
    _Numbers = _Number | NDArray[np.floating[Any]] | NDArray[np.integer[Any]] | _WithUnit
    #: A number or an array of numbers. NumPy's `ArrayLike` and a recursive type would also accept strings.
    ArrayLike = _Numbers | Sequence[_Numbers] | Sequence[Sequence[_Numbers]]
    #: A stored parameter of a profile, a medium or a structure.
    Parameter = float | NDArray[np.float64]

else:
    Array, ArrayLike, Parameter = np.ndarray, Any, Any

#: Bounds of lengths, forces and moduli (SI), and of slopes.
SHORTEST, LONGEST = 1e-25, 1e25

#: Bounds of all other quantities (SI).
SMALLEST, LARGEST = 1e-60, 1e60

# Bound of radii: their squares stay in double precision. A contact may be far wider than deep.
FARTHEST = 1e140

# NumPy broadcasts up to 32 dimensions; this package adds a few internally.
_MOST_DIMENSIONS = 16


def one_of(quantity, value, known):
    """Return `value` if it is one of the `known` names; otherwise raise an error."""
    if not isinstance(value, str) or value not in known:
        bound = f"must be one of {', '.join(map(repr, known))}"
        raise InvalidArgument(f"{quantity} = {shown(value)} {bound}", quantity, value, bound)
    return value


def _is_double(value):
    """Whether a value is a double, or an int that a double holds exactly; such values need no array."""
    kind = type(value)
    return kind is float or kind is np.float64 or (kind is int and abs(value) <= 2**53)


def number(quantity, value, unit=""):
    """Return `value` as a float if it is one real number: no bool, no text, no array."""
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
    """Return the error for a value that must be `what`, such as "one real number"."""
    bound = f"must be {what}"
    return InvalidArgument(f"{quantity} {bound}, got {shown(value)}", quantity, value, bound, unit)


def in_unit(quantity, value, unit):
    """Return `value` as plain numbers in a unit; values without a unit are unchanged.

    Quantities of pint, astropy and unyt have `unit` or `units`, and `to`. Arrays with labelled axes
    (xarray) raise an error because arrays broadcast by the order of their axes here. Lazy arrays (dask)
    raise an error because they would be loaded into memory as a whole.
    """
    if hasattr(value, "dims") and hasattr(value, "coords"):
        bound = (
            f"has named dimensions, {shown(value.dims)}, which would be lost: arrays broadcast by the "
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
    """Return `value` as a float or a read-only array if it is positive (or zero, or infinite, if allowed).

    Finite numbers must lie `within` two bounds, by default the bounds of quantities with their unit.
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
    """Return the bounds of finite positive numbers of a unit; `zero` is whether they may be 0."""
    if unit not in ("m", "N", "Pa"):
        return SMALLEST, LARGEST
    # If 0 is meant, rounding may leave a number smaller than any length.
    return SMALLEST if zero else SHORTEST, LONGEST


def positive_number(quantity, value, *, unit="", **allowed):
    """Return `value` as a float if it is one `positive` number."""
    return positive(quantity, number(quantity, value, unit), unit=unit, **allowed)


def store(thing, **values):
    """Set fields of a frozen dataclass to checked values, in its `__post_init__`."""
    for name, value in values.items():
        object.__setattr__(thing, name, value)


def set_positive(profile, **units):
    """Replace each named field of a frozen profile by its checked value, a float or an array."""
    for name, unit in units.items():
        quantity = f"{type(profile).__name__} {name}"
        # The coefficient of a power law may have any size within double precision.
        within = (1e-300, 1e300) if unit == "m^(1-n)" else (SHORTEST, LONGEST)
        value = positive(quantity, getattr(profile, name), unit=unit, within=within)
        store(profile, **{name: value})
    common_shape(type(profile).__name__, **{name: getattr(profile, name) for name in units})


def _real_array(quantity, value, what="real numbers", unit=""):
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf" or array.ndim > _MOST_DIMENSIONS or np.ma.is_masked(value):
            raise TypeError
        # Numbers of longer types that overflow become infinite; the caller's check rejects them.
        with np.errstate(over="ignore"):
            return array.astype(float, copy=False)
    except (TypeError, ValueError):
        raise _no_number(quantity, value, what, unit) from None


def finite_array(quantity, value, *, unit="", most=FARTHEST, missing=False):
    """Return a copy of `value` as a float array, with numbers up to `most`; NaN is valid if `missing`."""
    if _is_double(value) and -most <= value <= most:
        return np.array(value, float)
    # A result may keep the array, and must not change with the argument.
    array = _real_array(quantity, in_unit(quantity, value, unit), unit=unit).copy()
    large = np.isfinite(array) & (np.abs(array) > most)
    raise_if(quantity, array, large, f"is beyond {most:g}", unit=unit, advice="give it in SI units")
    advice = "leave it out, or correct the data it comes from"
    bad = np.isinf(array) if missing else ~np.isfinite(array)
    return raise_if(quantity, array, bad, "must be finite", unit=unit, advice=advice)


def force(quantity, value):
    """Return `value` as a float array of normal forces, which must not be negative."""
    array = finite_array(quantity, value, unit="N", most=LONGEST)
    raise_if(
        quantity, array, array < 0, "is negative", unit="N", advice="a tension needs work_of_adhesion > 0"
    )
    tiny = (array > 0) & (array < SMALLEST)
    return raise_if(quantity, array, tiny, f"must be 0 or at least {SMALLEST:g}", unit="N")


def raise_if(quantity, array, bad, bound, *, unit="", advice="", remedy=()):
    """Return `array` if no entry is `bad`; else raise an error with the first bad entry and the count."""
    # For one entry it takes a third of the time of np.any.
    if np.count_nonzero(bad):
        raise InvalidEntries(quantity, array, bad, bound, unit, advice, remedy)
    return array


def numbers_of(name, function, argument, refused):
    """Return a user's function of an array of radii, as an array of numbers.

    If the function fails, or returns anything else, `refused(fault, remedy)` makes the error.
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
    """Return the `numbers_of` an array of radii; raise an error unless there is one for each radius."""
    value = numbers_of(name, function, argument, refused)
    try:
        return np.broadcast_to(value, argument.shape)
    except ValueError:
        what = f"{name} has the shape {value.shape} for radii of shape {argument.shape}"
        raise refused(what, "give one value for each radius") from None


def doubles(name, value, refused):
    """Return a value of a user's function as an array of double precision; errors as in `numbers_of`."""
    array = np.asarray(value)
    if hasattr(value, "units") or hasattr(value, "unit") or array.dtype.kind not in "biuf":
        kind = "complex numbers" if array.dtype.kind == "c" else shown(value)
        raise refused(f"{name} gives {kind}", "give plain numbers in SI units")
    if array.dtype.kind == "f" and array.dtype.itemsize < np.dtype(float).itemsize:
        what = f"{name} gives {array.dtype}, which has {np.finfo(array.dtype).precision} digits"
        raise refused(what, "compute it in double precision, float64")
    return array.astype(float, copy=False)


def common_shape(what, **values):
    """Return the shape to which the values broadcast; raise an error with their shapes if they do not."""
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
    """Return `values` as a scalar or a read-only array."""
    values = np.asarray(values)
    values.setflags(write=False)
    return values[()]


def frozen_property(function: "Callable[[Any], Any]") -> "cached_property[Array]":
    """Make a property that is computed once and is `frozen`."""
    return cached_property(wraps(function)(lambda self: frozen(function(self))))


_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


@lru_cache
def _parameters(function):
    """Return the names of the parameters of a function, or None if it takes any keyword."""
    parameters = signature(function).parameters
    return None if any(each.kind == each.VAR_KEYWORD for each in parameters.values()) else list(parameters)


def _refuse_keywords(name, keywords, parameters):
    """Raise an error that names the parameters if a keyword is not one of them."""
    for keyword in keywords:
        if parameters is not None and keyword not in parameters:
            hint = lazy.hints.keyword_hint(name, keyword)
            said = f"{name} has no parameter {keyword!r}; it has {', '.join(parameters)}"
            raise TypeError(f"{said}. {hint}" if hint else said)


def keywords_explained(function: "Callable[_Arguments, _Result]") -> "Callable[_Arguments, _Result]":
    """Decorate a function: errors on unknown keywords name its parameters and suggest one.

    On a class method, write it below `classmethod`.
    """

    @wraps(function)
    def checked(*arguments: _Arguments.args, **keywords: _Arguments.kwargs) -> _Result:
        parameters = _parameters(function)
        if parameters and parameters[0] == "cls":
            parameters = parameters[1:]
        _refuse_keywords(function.__qualname__, keywords, parameters)
        return function(*arguments, **keywords)

    return checked


#: Last words of quantity names that a result uses several times.
_SHARED = ("depth", "energy", "work", "speed", "velocity")


def _is_misspelled(name, nearest):
    """Whether a name is a misspelling of the nearest one, and not another energy, depth or velocity."""
    (first, _, last), (other, _, same) = name.rpartition("_"), nearest.rpartition("_")
    if same not in _SHARED and not difflib.get_close_matches(last, _SHARED, 1, 0.8):
        return True
    return all(difflib.get_close_matches(one, [two], 1, 0.8) for one, two in ((last, same), (first, other)))


def no_attribute(owner, name, known):
    """Return the AttributeError for an unknown name of a result or the package, with a suggestion.

    It suggests the name in this package of a term of the field, or else the most similar name.
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
    # With `name` given, Python adds no other suggestion.
    return AttributeError(f"{owner} has no {name!r}{suggestion}", name=name)


def former(old, new):
    """Make a property with the old name of an attribute, which warns; `new` may be a dotted name."""

    def value(self):
        warn(f"{type(self).__name__}.{old} is {new} now", DeprecationWarning, stacklevel=2)
        return attrgetter(new)(self)

    return property(value)


class Parameters:
    """A hashable frozen dataclass whose parameters may be arrays: equal if all their entries are equal."""

    def __new__(cls, *positional: Any, **keywords: Any) -> Self:
        if keywords and (parameters := _parameters(cls.__init__)):
            _refuse_keywords(cls.__name__, keywords, parameters[1:])
        if len(positional) > 1:
            cls._refuse_positional(len(positional))
        return super().__new__(cls)

    @classmethod
    def _refuse_positional(cls, count):
        """Raise an error if more values are given by position than allowed; name the other parameters."""
        by_name = [each.name for each in fields(cls) if each.kw_only]
        by_position = [each.name for each in fields(cls) if not each.kw_only]
        if by_name and count > len(by_position):
            alone = ", ".join(by_position)
            raise TypeError(
                f"{cls.__name__} takes {alone} by position, and {count} values are given so; give the "
                f"others by name: {', '.join(by_name)}"
            )

    def __str__(self) -> str:
        """Return parameters other than the defaults, with six digits; `repr` has all digits."""
        with np.printoptions(precision=6, threshold=10):
            texts = []
            for each in fields(self):
                value = getattr(self, each.name)
                # A default of None means 0, for example a hardness constant that the medium does not have.
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
        """Shape to which array-valued parameters broadcast, () for single numbers."""
        # A tuple, for example of vertices, is one parameter.
        values = self.__getstate__().values()
        arrays = (value for value in values if isinstance(value, np.ndarray | Parameters))
        return np.broadcast_shapes(*(value.shape for value in arrays))

    def entries(self, index: Any, shape: tuple[int, ...] | None = None) -> Self:
        """Return the profiles or media at an index, with parameters broadcast to `shape` first.

        Parameters
        ----------
        index : int, slice, tuple or array_like
            Index of a NumPy array with the shape of the parameters.
        shape : tuple of int, optional
            Shape of the ensemble, if it differs from the shape of the parameters.

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
        """Return the same profile or medium with other values of the parameters."""
        return type(self)(**values)

    def flat_entries(self, rows: Any, shape: tuple[int, ...]) -> Self:
        """Return the profiles or media at rows of the flattened `shape` of an ensemble."""
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
    """Whether two parameters are equal; they may be arrays or have parameters themselves."""
    # The default comparison of a dataclass fails for arrays.
    if isinstance(one, Parameters):
        return Parameters.__eq__(one, other) is True
    return np.array_equal(one, other)


def _hashable(value):
    """Return a hashable form of a parameter."""
    if isinstance(value, Parameters):
        return Parameters.__hash__(value)
    return (value.shape, *value.ravel().tolist()) if isinstance(value, np.ndarray) else value
