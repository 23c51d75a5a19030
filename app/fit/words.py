"""What is said of a measurement: the number to quote, parameters, classes, remarks, refusals."""

import re

import numpy as np
from markupsafe import Markup, escape

from mdr_core.fit.indentation import IndentationFit
from mdr_core.fit.oliver_pharr_result import OLIVER_PHARR, OliverPharr, texts_of
from mdr_core.fit.parameters import PARAMETERS
from mdr_core.fit.report import with_error
from mdr_core.show.units import KINDS, fitting, with_unit, written

from ..ui import marked
from .measurement import Told
from .refusals import Message
from .setting import CLASS_NAMES, CORRECTIONS, Number, Setting, parameter

#: Ratio of misfits from which another class is taken to fit clearly better.
CLEARLY = 5.0


def sentence(text: str, name: str = "") -> Markup:
    """A text, of a remark without names of Python, as a sentence (HTML).

    It begins with a capital and has symbols with their indices and true minus signs; the name of a file in
    it, which may look like a symbol, stays as it is.
    """
    first = text.partition(" ")[0]
    if first == "a" or (first[1:].isalpha() and not (name and text.startswith(name))):
        text = text[:1].upper() + text[1:]
    text = text if text.endswith("?") else text.rstrip(".") + "."
    parts = text.split(name) if name else [text]
    return escape(name).join(marked(_true_minus(part)) for part in parts)


def _true_minus(text: str) -> str:
    return re.sub(r"(?<![\w/])-(?=[\d.])", "−", text)


def quantity(value: float, kind: str, like: float = 0.0) -> str:
    """A value (SI) with its unit, as in `written`; 0 has that of the value `like`."""
    return written(value, kind) if value else with_unit("0", fitting(0.0, kind, like).name)


def amount(value: float, error: float | None, unit: str) -> str:
    """A number with its error, one unit and a true minus."""
    text = quantity(value, KINDS.get(unit, "number")) if error is None else with_error(value, error, unit)
    return _true_minus(text)


def value_of(fit: IndentationFit, name: str) -> str:
    """A parameter of a fit with its error, or as it was held."""
    values = fit.to_dict()
    unit = PARAMETERS[name].quantity.unit
    if name in ("hardness", "q_c", "f_c") and name in fit.standard_errors and np.isinf(fit.medium.q_c):
        return "∞: nothing has yielded"
    return amount(float(values[name]), fit.standard_errors.get(name), unit)


_LARGE = Markup('<p class="big">E* = <output>{}</output></p><p class="of">Effective modulus, {}.{}</p>')
_NONE = Markup('<p class="big none">No E* to quote</p>')
_YOUNG = Markup('<p class="second">E = <output>{}</output>, Young’s modulus of the sample</p>')
_HARDNESS = Markup('<p class="second">H = <output>{}</output>, hardness by Oliver and Pharr</p>')
_SOURCES = {"unloading": "from the unloading, by Oliver and Pharr", "fit": "from the fit"}


def headline(told: Told, E: tuple[float, float] | None, assumed: str) -> Markup:
    """The number to quote, large, and of what it is (HTML); `assumed` is what its error leaves out."""
    quoted = told.quoted
    if quoted.source is None:
        return _NONE
    number = amount(quoted.value, quoted.standard_error, "Pa")
    found = _LARGE.format(number, _SOURCES[quoted.source], f" {assumed}" if "±" in number else "")
    if E is not None:
        found += _YOUNG.format(amount(*E, "Pa"))
    if (result := told.unloading) is not None:
        H = amount(float(result.hardness), float(result.standard_errors["hardness"]), "Pa")
        found += _HARDNESS.format(H)
    return found


def assumed(setting: Setting) -> str:
    """What the error of a number does not have in it."""
    tip = "" if setting.tip == "measured" else "an ideal tip"
    frame = "" if setting.corrections.get("frame") else "a rigid frame"
    parts = [each for each in (tip, frame) if each]
    verb = "are" if len(parts) > 1 else "is"
    return f"± of the noise; {' and '.join(parts)} {verb} assumed." if parts else "± of the noise."


_UNLOADING = Markup("<table>{}</table>")
_QUANTITY = Markup("<tr><th><i>{}</i> {}</th><td>{}</td></tr>")


def unloading_table(result: OliverPharr) -> Markup:
    """Numbers of Oliver and Pharr and of ISO 14577 (HTML), those that the record has."""
    rows = (
        _QUANTITY.format(marked(OLIVER_PHARR[name].symbol), OLIVER_PHARR[name].long_name, _true_minus(text))
        for name, text in texts_of(result).items()
    )
    return _UNLOADING.format(Markup("").join(rows))


def why(fit: IndentationFit, told: Told) -> Markup:
    """One sentence on the E* of the model where another one is quoted (HTML)."""
    if told.quoted.source != "unloading":
        return Markup("")
    numbers = f"E*, {value_of(fit, 'E_star')}, is"
    if "hardness" in fit.standard_errors:
        numbers = f"E*, {value_of(fit, 'E_star')}, and H, {value_of(fit, 'hardness')}, are"
    return Markup(
        "<p>The model’s own {} not to be quoted: its contact radius is that of an elastic contact.</p>"
    ).format(numbers)


def verdict(fit: IndentationFit, told: Told) -> tuple[str, dict[str, float]]:
    """What the samples say of the class of hardness, in a sentence, and the misfit of each class."""
    misfits = {letter: float(each.misfit) for letter, each in fit.classes.items()}
    if told.of_class is None:
        return "", {}
    found = told.of_class
    if len(found.possible) > 1:
        return "This curve does not determine the class of hardness.", misfits
    best = found.best
    text = f"The curve is of class ({best}), {CLASS_NAMES[best]}."
    if not found.describes:
        text = f"No class describes the curve within 1 %; the nearest is ({best}), {CLASS_NAMES[best]}."
    return text, misfits


def better(misfits: dict[str, float], own: str) -> str:
    """The class that fits clearly better than the one that was fitted, or nothing."""
    best = min(misfits, key=misfits.__getitem__, default="")
    clearly = best and best != own and CLEARLY * misfits[best] <= misfits.get(own, np.inf)
    return best if clearly else ""


_CLASS = Markup("<tr class='{}'><th>({}) {}</th><td>{:.2g} %</td><td>{}</td></tr>")
_CLASSES = Markup(
    "<table><tr><th>class of hardness</th><td>misfit, of the largest force</td><td></td></tr>{}</table>"
)


def classes_table(misfits: dict[str, float], own: str) -> Markup:
    """Misfit of each class (HTML)."""
    rows = []
    for letter, misfit in misfits.items():
        look, mark = ("own", "fitted") if letter == own else ("", "")
        rows.append(_CLASS.format(look, letter, CLASS_NAMES[letter], 100 * misfit, mark))
    return _CLASSES.format(Markup("").join(rows))


def limits(setting: Setting, fit: IndentationFit) -> list[Message]:
    """Assumptions of the model that are exceeded, but for those of every such measurement."""
    known = _in_help(setting)
    exceeded = [each for each in fit.path.limits if each.exceeded and each.what not in known]
    return [Message(each.sentence) for each in exceeded]


def _in_help(setting: Setting) -> set[str]:
    """Limits that are exceeded whatever was measured: with a tip of one angle, with constant hardness."""
    slopes = {"slope"} if setting.tip in ("berkovich", "cube_corner", "cone") else set()
    return slopes | ({"flow"} if setting.kind.letter == "a" else set())


def report(setting: Setting, fit: IndentationFit, told: Told, E: tuple[float, float] | None) -> str:
    """A fit as lines of text, to be pasted into a report."""
    quoted = told.quoted
    number = _plain(headline(told, E, assumed(setting)))
    lines = [f"{setting.file}: {number if quoted.source else f'{number}: {quoted.reason}'}"]
    lines += [each.text for each in (*told.above, *told.below)]
    for name in setting.parameters(fit.time is not None):
        known = parameter(name)
        state = "" if name in fit.standard_errors else " (held)"
        lines.append(f"{known.label} {known.symbol}\t{value_of(fit, name)}{state}")
    for name, value in setting.corrections.items():
        known = CORRECTIONS[name]
        lines.append(f"{known.label} {known.symbol}\t{written(value, known.kind)}")
    if told.unloading is not None:
        for name, number in texts_of(told.unloading).items():
            lines.append(f"{OLIVER_PHARR[name].long_name} {OLIVER_PHARR[name].symbol}\t{number}")
    text, misfits = verdict(fit, told)
    if misfits:
        each = ", ".join(f"({letter}) {100 * misfit:.2g} %" for letter, misfit in misfits.items())
        lines.append(f"{text} Misfits: {each} of the largest force.")
    lines += [each.text for each in told.remarks if each not in told.below]
    return "\n".join(lines)


def _plain(html: Markup) -> str:
    return html.replace(Markup("</p>"), "; ").striptags().strip("; ")


def name_html(known: Number) -> Markup:
    """Symbol and name of a number (HTML)."""
    return Markup("<i>{}</i> {}").format(marked(known.symbol), known.label)
