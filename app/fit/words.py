"""What is said of a measurement: the number to quote, parameters, classes, remarks, refusals."""

import re

import numpy as np
from markupsafe import Markup, escape

from mdr_core.fit.indentation import IndentationFit
from mdr_core.fit.parameters import PARAMETERS
from mdr_core.fit.report import with_error
from mdr_core.show.units import KINDS, written

from ..ui import marked
from .measurement import Told
from .setting import CLASS_NAMES, CORRECTIONS, Number, Setting, parameter

#: Ratio of misfits from which another class is taken to fit clearly better.
CLEARLY = 5.0
#: Most characters of a message that is shown; those of packages may quote a file.
_MOST = 2000
#: Words for what is code in messages of the reader and of the fit.
_WORDS = {
    r"give columns=\{.*?\}, numbers and units": "choose its columns and their units below",
    r"spring_constant=": "the spring constant",
    r"sensitivity=": "the sensitivity",
    r"give cycles=True for each of them": "choose another one by the range",
    r"\bspring_constant\b": "spring constant",
    r"\bcontact_point\b": "contact point",
    r"\bdepth_noise\b": "noise of the depth",
    r"\bforce_noise\b": "noise of the force",
    r"\bwork_of_adhesion\b": "work of adhesion",
    r"or free baseline": "or free the baseline",
    r"\bE_star\b": "E*",
    r"\beta\b": "η",
    r"\bq_c=np\.inf\b|q_c = inf": "an elastic sample",
    r"give time=": "give a column of times",
}


def in_page_words(text: str) -> str:
    """A report, remark or refusal of the core with symbols and words for its names of parameters."""
    for code, words in _WORDS.items():
        text = re.sub(code, words, text)
    return _true_minus(text)


def _true_minus(text: str) -> str:
    return re.sub(r"(?<![\w/])-(?=[\d.])", "−", text)


def amount(value: float, error: float | None, unit: str) -> str:
    """A number with its error, one unit and a true minus."""
    text = written(value, KINDS.get(unit, "number")) if error is None else with_error(value, error, unit)
    return _true_minus(text)


def value_of(fit: IndentationFit, name: str) -> str:
    """A parameter of a fit with its error, or as it was held."""
    values = fit.to_dict()
    unit = PARAMETERS[name].quantity.unit
    if name in ("hardness", "q_c", "f_c") and name in fit.standard_errors and np.isinf(fit.medium.q_c):
        return "∞: nothing has yielded"
    return amount(float(values[name]), fit.standard_errors.get(name), unit)


_LARGE = Markup('<p class="big">E* = <output>{}</output></p><p class="of">Effective modulus, {}.</p>')
_NONE = Markup('<p class="big none">No E* to quote</p><p class="of">{}.</p>')
_YOUNG = Markup('<p class="second">E = <output>{}</output>, Young’s modulus of the sample</p>')
_HARDNESS = Markup('<p class="second">H = <output>{}</output>, hardness by Oliver and Pharr</p>')


def headline(fit: IndentationFit, told: Told, E: tuple[float, float] | None) -> Markup:
    """The number to quote, large, and of what it is (HTML)."""
    quoted = fit.quoted
    if quoted.source is None:
        reason = in_page_words(quoted.reason)
        return _NONE.format(marked(reason[:1].upper() + reason[1:]))
    number = amount(quoted.value, quoted.standard_error, "Pa")
    source = {"unloading": "from the unloading, by Oliver and Pharr", "fit": "from the fit"}[quoted.source]
    found = _LARGE.format(number, source)
    if E is not None:
        found += _YOUNG.format(amount(*E, "Pa"))
    if (result := told.unloading) is not None:
        H = amount(float(result.hardness), float(result.standard_errors["hardness"]), "Pa")
        found += _HARDNESS.format(H)
    return found


def why(fit: IndentationFit) -> Markup:
    """One sentence on the E* of the model where another one is quoted (HTML)."""
    if fit.quoted.source != "unloading":
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


def remarks(fit: IndentationFit, remarked: tuple[str, ...]) -> list[Markup]:
    """Remarks on the fit and on the reading of the file, and assumptions that are exceeded (HTML)."""
    texts = [*remarked, *(each.sentence for each in fit.path.limits if each.exceeded)]
    told = [in_page_words(text) for text in texts]
    return [marked(text[:1].upper() + text[1:]) for text in told]


def report(setting: Setting, fit: IndentationFit, told: Told, E: tuple[float, float] | None) -> str:
    """A fit as lines of text, to be pasted into a report."""
    lines = [f"{setting.file}: {_plain(headline(fit, told, E))}"]
    for name in setting.parameters(fit.time is not None):
        known = parameter(name)
        state = "" if name in fit.standard_errors else " (held)"
        lines.append(f"{known.label} {known.symbol}\t{value_of(fit, name)}{state}")
    for name, value in setting.corrections.items():
        known = CORRECTIONS[name]
        lines.append(f"{known.label} {known.symbol}\t{written(value, known.kind)}")
    text, misfits = verdict(fit, told)
    if misfits:
        each = ", ".join(f"({letter}) {100 * misfit:.2g} %" for letter, misfit in misfits.items())
        lines.append(f"{text} Misfits: {each} of the largest force.")
    lines += [in_page_words(remark) for remark in told.remarks]
    return "\n".join(lines)


def _plain(html: Markup) -> str:
    return html.replace(Markup("</p>"), "; ").striptags().strip("; ")


def refused(text: str, name: str = "") -> Markup:
    """A refusal (HTML); the name of a file in it stays as it is."""
    parts = text[:_MOST].split(name) if name else [text[:_MOST]]
    said = escape(name).join(marked(in_page_words(part)) for part in parts)
    return Markup('<p class="refused" role="alert">{}</p>').format(said) if text else said


def name_html(known: Number) -> Markup:
    """Symbol and name of a number (HTML)."""
    return Markup("<i>{}</i> {}").format(marked(known.symbol), known.label)
