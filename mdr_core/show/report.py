"""Text, tables and datasets of results.

Every function takes a result. A class of results can register its own `rows` and `limit_rows`.
"""

import html
from functools import singledispatch
from importlib import import_module

import numpy as np

from ..base.results import Presentation
from .quantities import QUANTITIES, described, engineering, unit_of

#: The text of a result with more entries computes no quantities.
_MANY = 1000
#: Largest number of lines in the `repr` of a result.
_MOST_LINES = 12
#: Limits that some tips and media exceed in every scene.
_USUAL = {"slope", "flow"}
#: Prescribed quantities.
_GIVEN = {"depth", "time", "mass", "speed", "tangential_speed", "friction", "tangential_mass"}


def with_error(value, error, unit):
    """Return a number and its standard error as text, with one unit and two digits of the error.

    For an array, return the range of the numbers and the median of their errors, without NaN. The text
    omits an error below 10⁻⁶ of the number, which comes from the arithmetic.
    """
    known = ~np.isnan(value)
    if not np.any(known):
        return "none"
    values, error = np.asarray(value)[known], float(np.median(np.asarray(error)[known]))
    ends = sorted({float(values.min()), float(values.max())})
    if ends[-1] == np.inf:
        return "∞" if len(ends) == 1 else engineering(values, unit)
    fit = unit_of(max(*map(abs, ends), 0.0 if error == np.inf else error), unit)
    ends, error = [end / fit.factor for end in ends], error / fit.factor
    if error == np.inf:
        texts, ending = [f"{float(f'{end:.1g}'):g}" for end in ends], " ± ∞"
    elif error <= 1e-6 * max(map(abs, ends)):
        texts, ending = [f"{end:.6g}" for end in ends], ""
    else:
        digits = max(0, 1 - int(np.floor(np.log10(float(f"{error:.1e}")))))
        texts, ending = [f"{end:.{digits}f}" for end in ends], f" ± {error:.{digits}f}"
    return f"{' … '.join(texts)}{ending} {fit.name}".rstrip()


def imported(name, what, packages=None):
    """Import an optional package; the error for a purpose `what` says how to install the package."""
    try:
        return import_module(name)
    except ImportError:
        install = f"pip install {packages or name}"
        raise ImportError(f"{what} needs {name}, which is not installed: {install}") from None


def table(result):
    """Return a table of all quantities in SI units, one row for each state or impact.

    `attrs` has the model, the indenter and the medium, and "units" and "long_names" by column name.
    Array-valued parameters of the indenter and the medium have separate columns.
    """
    pandas = imported("pandas", "to_pandas()")
    absent = _absent(result)
    values = {name: value for name, value in result.to_dict().items() if name not in absent}
    values |= _parameters(result)
    columns = {name: np.broadcast_to(v, result.shape).ravel() for name, v in values.items()}
    if len(result.shape) > 1:
        index = pandas.MultiIndex.from_product(map(range, result.shape), names=dimensions(result))
    else:
        index = pandas.RangeIndex(len(next(iter(columns.values()))), name=(*dimensions(result), None)[0])
    table = pandas.DataFrame(columns, index=index)
    named = {name: QUANTITIES[name] for name in columns if name in QUANTITIES}
    units = {name: quantity.unit for name, quantity in named.items()}
    names = {name: quantity.long_name for name, quantity in named.items()}
    table.attrs.update(attributes(result), units=units, long_names=names)
    return table


def _absent(result):
    """Return the names of quantities that are 0 without viscosity, adhesion or a structure."""
    source = Presentation(result).source
    if source is None:
        return set()
    names = set() if np.any(source.medium.eta) else {"viscous_work"}
    names |= set() if np.any(source.medium.work_of_adhesion) else {"adhesive_work"}
    if len(owners(source)) < 3:
        names |= {"structure_work", "support_energy", "deflection", "max_deflection"}
    return names


def dataset(result):
    """Return a dataset of all quantities, each with its `units`, `long_name` and symbol as attributes.

    Prescribed quantities (depth, time, mass, speed, array-valued parameters) are coordinates.
    """
    xarray = imported("xarray", "to_xarray()")
    dims, variables = dimensions(result), {}
    for name, value in (result.to_dict() | _parameters(result)).items():
        about = QUANTITIES[name].attributes if name in QUANTITIES else {}
        variables[name] = (dims, np.broadcast_to(value, result.shape), about)
    given = (_GIVEN | set(_parameters(result))) & set(variables)
    given -= {"depth"} if "time" in variables else set()
    return xarray.Dataset(variables, attrs=attributes(result)).set_coords(sorted(given))


def dimensions(result):
    """Return the names of the dimensions; the last dimension counts the states of a path."""
    names, count = Presentation(result).dimensions, len(result.shape)
    if count <= len(names):
        return names[len(names) - count :]
    return (*(f"{names[0]}_{i}" for i in range(count - len(names) + 1)), *names[1:])


def _parameters(result):
    """Return the array-valued parameters of profile, medium and structure by name."""
    source, parameters = Presentation(result).source, {}
    for owner in owners(source) if source else ():
        values = {name: getattr(owner, name) for name in owner.__dataclass_fields__}
        parameters |= {name: value for name, value in values.items() if isinstance(value, np.ndarray)}
    return parameters


def owners(source):
    """Return the objects with parameters: profile, medium and, if there is one, the structure."""
    structure = getattr(source, "structure", None)
    given = () if structure is None or structure.rigid else (structure,)
    return source.profile, source.medium, *given


def attributes(result):
    """Return the attributes of a table or a dataset, all as text."""
    about = Presentation(result)
    source, texts = about.source, {"result": about.name}
    if source:
        texts |= {"model": str(source.model), "indenter": described(source.profile)}
        texts |= dict(zip(("medium", "structure"), map(described, owners(source)[1:]), strict=False))
    exceeded = [limit.sentence for limit in about.limits if limit.exceeded]
    return texts | ({"limits": " ".join(exceeded)} if exceeded else {})


def title(result):
    """Return the first line of the `repr`: the name, the number of entries and the model."""
    about = Presentation(result)
    noun = about.noun if np.prod(result.shape) == 1 else f"{about.noun}s"
    size = f"{' × '.join(map(str, result.shape)) or 'one'} {noun}"
    return f"{about.name}: {size}{f', {about.source.model}' if about.source else ''}"


@singledispatch
def rows(result):
    """Yield pairs of a label and a text, one for each line of the `repr`."""
    about, many = Presentation(result), np.prod(result.shape) > _MANY
    if source := about.source:
        names = "indenter", "medium", "structure"
        yield from zip(names, map(described, owners(source)), strict=False)
    for name in about.shown:
        quantity, label = QUANTITIES[name], name.replace("_", " ")
        # Show quantities of a large ensemble only if they are already computed.
        stored = name in _GIVEN or name in vars(result)
        text = engineering(getattr(result, name), quantity.unit) if stored or not many else f".{name}"
        yield f"{label} {quantity.symbol}", text


@singledispatch
def limit_rows(result, most):
    """Yield up to `most` rows on exceeded limits, and no rows for a large ensemble."""
    if np.prod(result.shape) > _MANY:
        return
    limits = [x for x in Presentation(result).limits if x.exceeded and x.concerns == "result"]
    # A pyramid always exceeds the usual limits: list the other limits first.
    rare = [limit for limit in limits if limit.severe or limit.what not in _USUAL]
    first = rare if len(rare) <= most - (len(rare) < len(limits)) else rare[: max(most - 1, 0)]
    yield from (("limit", limit.sentence) for limit in first)
    if others := [limit.what for limit in limits if limit not in first]:
        yield "limits", f"{', '.join(others)}: see .limits"


def text(result):
    """Return the `repr` of a result."""
    lines = [(label, f"{text:.140}") for label, text in rows(result)]
    lines += limit_rows(result, _MOST_LINES - 1 - len(lines))
    return lines_of(title(result), lines)


def lines_of(title, rows):
    """Format a title and rows of a label and a text."""
    return "\n".join([title, *(f"  {label:<24} {text}" for label, text in rows)])


def table_of_text(result):
    """Return the content of `text` as an HTML table."""
    cells = "".join(
        f"<tr><th style='text-align:left'>{html.escape(label)}</th>"
        f"<td style='text-align:left'>{html.escape(text)}</td></tr>"
        for label, text in (*rows(result), *limit_rows(result, _MOST_LINES))
    )
    return f"<table><caption>{html.escape(title(result))}</caption>{cells}</table>"


def parameters_as_html(thing):
    """Return the parameters of a profile, a medium or a structure, except defaults, as an HTML table."""
    kind, *given = described(thing).split(", ")
    cells = "".join(f"<tr><td style='text-align:left'>{html.escape(each)}</td></tr>" for each in given)
    return f"<table><caption>{html.escape(kind)}</caption>{cells}</table>"


def limits_as_html(limits):
    """Return the limits of a result as an HTML table."""
    cells = "".join(
        f"<tr><th style='text-align:left'>{html.escape(each.what)}</th><td>{each.level}</td>"
        f"<td style='text-align:left'>{html.escape(each.sentence)}</td></tr>"
        for each in limits
    )
    return f"<table><caption>Limits</caption>{cells}</table>"


def foundation_text(foundation):
    """Return the `repr` of a `Foundation`."""
    width, moves = engineering(foundation.half_width, "m"), len(foundation.history)
    title = f"Foundation: {foundation.n} elements to ±{width}, after {moves} moves"
    return lines_of(
        title,
        [
            ("indenter", described(foundation.profile)),
            ("medium", described(foundation.medium)),
            ("depth d", engineering(foundation.depth, "m")),
            ("force F", engineering(foundation.force, "N")),
        ],
    )
