"""Results of a fit as HTML: the number to quote, tables, remarks; and its report as plain text."""

import re
from collections.abc import Iterator
from math import floor, log10
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup, escape

from mdr_core.measurements.fit.parameters import PARAMETERS
from mdr_core.measurements.unloading.oliver_pharr_result import OLIVER_PHARR, texts_of
from mdr_core.show.quantities import unit_of
from mdr_core.show.report import with_error
from mdr_core.show.units import KINDS, digits, fitting, format_quantity, with_unit

from ..common.ui import html_subscripts, own_html
from .choices import CLASS_NAMES, FITTED, MEDIA, NUMBERS

#: The page without a curve; and assumptions of every number, which no remark repeats.
WELCOME, HELP = (own_html(Path(__file__).with_name(name)) for name in ("welcome.html", "help.html"))
#: Smallest ratio of misfits for which another class fits clearly better.
_CLEARLY = 5.0
#: Relative error below which only the arithmetic has an error.
_EXACT = 1e-6
_SOURCES = {"unloading": "from the unloading, by Oliver and Pharr", "fit": "from the fit"}
_LARGE = Markup('<p class="big">E* = <output>{}</output></p><p class="of">Effective modulus, {}.{}</p>')
_SECOND = Markup('<p class="second">{} = <output>{}</output>{}, {}</p>')
_TO_DO = Markup('<p class="big none">{}</p><p class="of">{}</p>')
_WAITING = Markup('<p class="waiting" role="status">{} …</p>')
_TABLE, _ROW = Markup("<table>{}</table>"), Markup("<tr class='{}'><th>{}</th>{}</tr>")
_CELL, _MORE = Markup("<td>{}</td>"), Markup("<p>{} more are in the CSV.</p>")
#: Largest number of listed curves of a file.
_LISTED = 300
GIVE_POISSON = Markup('<p class="of">Give ν on the left for Young’s modulus E of the sample.</p>')
_NOT_QUOTED = Markup(
    "<p>The model’s own {} not to be quoted: it assumes the radius of an elastic contact.</p>"
)


def sentence(text: str, file: str = "") -> Markup:
    """Return a remark as a sentence, with a capital letter, indices in symbols and true minus signs.

    The name of a file in the remark, which may look like a symbol, stays unchanged.
    """
    first = text.partition(" ")[0]
    if first == "a" or (first[1:].isalpha() and not (file and text.startswith(file))):
        text = text[:1].upper() + text[1:]
    text = text if text.endswith("?") else text.rstrip(".") + "."
    parts = text.split(file) if file else [text]
    return escape(file).join(html_subscripts(_minus(part)) for part in parts)


def _minus(text: str) -> str:
    return re.sub(r"(?<![\w/])-(?=[\d.])", "−", text)


def amount(value: float, error: float | None, unit: str) -> str:
    """Return a number with its error, one unit and a true minus."""
    exact = near(float(value), KINDS.get(unit, "number"))
    return _minus(exact if error is None else with_error(value, error, unit))


def short(value: float, error: float | None, unit: str) -> tuple[str, str]:
    """Return a number of at most four digits, and its error with one digit or "", both with the unit."""
    size = unit_of(abs(value), unit)
    if error is None or error <= _EXACT * abs(value):
        return with_unit(_minus(f"{value / size.factor:.4g}"), size.name), ""
    count = min(max(floor(log10(abs(value))) - floor(log10(error)) + 2, 1), 4)
    number, noise = digits(value / size.factor, count), digits(error / size.factor, 1)
    return with_unit(number, size.name), with_unit(noise, size.name)


def near(value: float, kind: str, like: float = 0.0) -> str:
    """Return a value with its unit; 0 has the unit of the value `like`."""
    return format_quantity(value, kind) if value else with_unit("0", fitting(0.0, kind, like).name)


def value_of(fit: Any, name: str) -> str:
    """Return a fitted parameter with its error, or a held parameter."""
    if name in ("hardness", "q_c", "f_c") and name in fit.standard_errors and np.isinf(fit.medium.q_c):
        return "∞: nothing has yielded"
    return amount(fit.to_dict()[name], fit.standard_errors.get(name), PARAMETERS[name].quantity.unit)


def waiting(text: str) -> Markup:
    """Return the headline while a job runs."""
    return _WAITING.format(text)


def to_do(what: str, how: str = "Then the fit runs at once.") -> Markup:
    """Return the headline with the missing input."""
    return _TO_DO.format(what, how)


def headline(found: Any, E: tuple[float, float] | None, assumed: list[str], others: str = "") -> Markup:
    """Return the number to quote, large, with its source, error and assumptions, and other curves."""
    quoted = found.quoted
    if quoted.source is None:
        return _TO_DO.format("No E* to quote", "")
    number, noise = short(quoted.value, quoted.standard_error, "Pa")
    notes = [f"± {noise} of noise"] * bool(noise)
    notes += [f"{' and '.join(assumed)} {'are' if len(assumed) > 1 else 'is'} assumed"] * bool(
        noise and assumed
    )
    notes += [others] * bool(others)
    html = _LARGE.format(number, _SOURCES[quoted.source], f" {'; '.join(notes)}." * bool(notes))
    for symbol, value, error, name in _beside(found, E):
        number, noise = short(value, error, "Pa")
        html += _SECOND.format(symbol, number, f" ± {noise}" * bool(noise), name)
    return html


def _beside(found: Any, E: tuple[float, float] | None) -> Iterator[tuple[str, float, float, str]]:
    """Yield symbols, values, errors and names of E and H."""
    if E is not None:
        yield "E", *E, "Young’s modulus of the sample"
    if (result := found.unloading) is not None:
        H, error = float(result.hardness), float(result.standard_errors["hardness"])
        yield "H", H, error, "hardness by Oliver and Pharr"


def of_curves(rows: list[Any], what: str) -> str:
    """Return the range of E* of the curves of a file or a set, or an empty text for one curve."""
    known = [row.E for row in rows if row.E is not None]
    if len(known) < 2:
        return ""
    low, high = min(known), max(known)
    size = unit_of(high, "Pa")
    ends = " to ".join(digits(end / size.factor, 2) for end in (low, high))
    return f"the {what} {len(known)} curves: {ends} {size.name}"


def why(found: Any) -> Markup:
    """Return a sentence on the model's own E* if another E* is quoted."""
    if found.quoted.source != "unloading":
        return Markup("")
    E = f"E*, {value_of(found.fit, 'E_star')},"
    with_H = "hardness" in found.fit.standard_errors
    return _NOT_QUOTED.format(f"{E} and H, {value_of(found.fit, 'hardness')}, are" if with_H else f"{E} is")


def _table(*rows: tuple[Any, ...], own: Any = None) -> Markup:
    """Return rows as a table, and emphasize the row with the heading `own`."""
    cells = ((row[0], Markup("").join(map(_CELL.format, row[1:]))) for row in rows)
    return _TABLE.format(
        Markup("").join(_ROW.format("own" * (head == own), head, rest) for head, rest in cells)
    )


def unloading_table(result: Any) -> Markup:
    """Return the numbers of Oliver and Pharr and of ISO 14577 as a table."""
    named = ((OLIVER_PHARR[name], text) for name, text in texts_of(result).items())
    return _table(*((html_subscripts(f"{q.symbol} {q.long_name}"), _minus(text)) for q, text in named))


def verdict(found: Any) -> str:
    """Return a sentence on the class of hardness of the curve."""
    if found.verdict is None:
        return ""
    if len(found.verdict.possible) > 1:
        return "This curve does not determine the class of hardness."
    best = f"({found.verdict.best}), {CLASS_NAMES[found.verdict.best]}."
    if found.verdict.describes:
        return f"The curve is of class {best}"
    return f"No class describes the curve within 1 %; the nearest is {best}"


def misfits(found: Any) -> dict[str, float]:
    """Return the misfit of each class over the largest force, or nothing without a verdict."""
    known = found.fit.classes.items() if found.verdict else ()
    return {letter: float(each.misfit) for letter, each in known}


def better(found: Any, own: str) -> str:
    """Return the class that fits clearly better than the fitted class, or an empty text."""
    known = misfits(found)
    best = min(known, key=known.__getitem__, default="")
    return best if best != own and _CLEARLY * known[best] <= known.get(own, np.inf) else ""


def classes_table(found: Any, own: str) -> Markup:
    """Return a table with the misfit of each class, and the class of the curve."""
    heads = {letter: f"({letter}) {CLASS_NAMES[letter]}" for letter in misfits(found)}
    rows = (
        (heads[letter], f"{100 * misfit:.2g} %", "fitted" * (letter == own))
        for letter, misfit in misfits(found).items()
    )
    table = _table(("class of hardness", "misfit, of the largest force", ""), *rows, own=heads.get(own))
    return table + Markup("<p>{}</p>").format(verdict(found))


def curves_table(rows: list[Any], file: str) -> Markup:
    """Return a table of the curves of a file or a set; curves without a number come first."""
    ordered = sorted(rows, key=lambda row: row.E is not None)
    cells = (
        (row.name, *(_found(*pair) for pair in ((row.E, row.E_error), (row.H, row.H_error))),
         sentence(row.reason, file))
        for row in ordered[:_LISTED]
    )  # fmt: skip
    beyond = _MORE.format(len(rows) - _LISTED) if len(rows) > _LISTED else ""
    return _table(("curve", "E*", "H", "source, or why there is no number"), *cells) + beyond


def _found(value: float | None, error: float | None) -> str:
    return "–" if value is None else amount(value, error, "Pa")


def curves_summary(count: str, table: Any) -> str:
    """Return the number of fitted curves, and mean, standard deviation and median of E*, E and H."""
    parts, summary = [count], table.summary().to_dict("index")
    for name, symbol in {"E*": "E*", "E": "E", "hardness": "H"}.items():
        if known := summary.get(name):
            deviation = known["standard deviation"]
            mean = amount(known["mean"], deviation if np.isfinite(deviation) else None, "Pa")
            text = (
                f"mean ± standard deviation of {known['n']:g}, median {amount(known['median'], None, 'Pa')}"
            )
            parts.append(f"{symbol} = {mean}, {text}")
    lost = int(np.isnan(table.E_star).sum())
    return "; ".join((*parts, f"{lost} without a number to quote")) + "."


def limits(found: Any, tip: str, medium: str) -> list[str]:
    """Return exceeded assumptions, except assumptions that every such tip or sample exceeds."""
    known = {"slope"} if tip in ("berkovich", "cube_corner", "cone") else set()
    known |= {"flow"} if MEDIA[medium].letter == "a" else set()
    return [each.sentence for each in found.fit.path.limits if each.exceeded and each.what not in known]


def range_text(curve: Any, ends: tuple[int, int], fitted: bool) -> str:
    """Return the range of the fitted samples, with depth and force at both ends."""
    deepest, largest = (float(np.max(np.abs(each))) for each in (curve.depth, curve.force))
    places = [
        f"{k} ({near(float(curve.depth[k - 1]), 'length', deepest)}, "
        f"{near(float(curve.force[k - 1]), 'force', largest)})"
        for k in ends
    ]
    return f"{'Fitted: s' if fitted else 'S'}amples {' to '.join(places)} of {len(curve)}"


def caption(found: Any, E: tuple[float, float] | None, file: str) -> str:
    """Return the name of a file with the numbers of its fit in one line."""
    quoted = found.quoted
    if quoted.source is None:
        return f"{file}: no E* to quote"
    value = amount(quoted.value, quoted.standard_error, "Pa")
    numbers = [f"E* = {value}, effective modulus {_SOURCES[quoted.source]}"]
    numbers += [
        f"{s} = {amount(value, error, 'Pa')}, {name}" for s, value, error, name in _beside(found, E)
    ]
    return f"{file}: {'; '.join(numbers)}"


def report(
    found: Any, E: tuple[float, float] | None, file: str, shown: list[str], corrections: dict[str, float]
) -> str:
    """Return a fit as lines of text for a report."""
    lines = [
        caption(found, E, file) if found.quoted.source else f"{file}: No E* to quote: {found.quoted.reason}"
    ]
    lines += [each.text for each in (*found.above, *found.below)]
    for name in shown:
        held = "" if name in found.fit.standard_errors else " (held)"
        lines.append(f"{FITTED[name].label} {FITTED[name].symbol}\t{value_of(found.fit, name)}{held}")
    for name, value in corrections.items():
        lines.append(
            f"{NUMBERS[name].label} {NUMBERS[name].symbol}\t{format_quantity(value, NUMBERS[name].kind)}"
        )
    for name, text in texts_of(found.unloading).items() if found.unloading is not None else ():
        lines.append(f"{OLIVER_PHARR[name].long_name} {OLIVER_PHARR[name].symbol}\t{text}")
    if known := misfits(found):
        each = ", ".join(f"({letter}) {100 * misfit:.2g} %" for letter, misfit in known.items())
        lines.append(f"{verdict(found)} Misfits: {each} of the largest force.")
    lines += [each.text for each in found.remarks if each not in found.below]
    return "\n".join(lines)
