"""Buttons for the remedies of remarks."""

from functools import partial
from typing import Any

from mdr_core.base.remark import Remedy
from mdr_core.measurements.reading import SIZES
from mdr_core.show.units import format_quantity

from ..common.ui import button, call
from . import texts
from .choices import CLASS_NAMES, FITTED, MEDIA, NUMBERS, OF_CLASS

#: Labels of the buttons that part the curves of a table.
_BY = {
    "whole": "Read it as one curve",
    "gaps": "Part the curves at empty lines",
    "restart": "Part the curves where the depth starts anew",
}


def remedy_button(remedy: Remedy, page: Any) -> Any:
    """Return the button of a remedy, or None if it is done already or impossible on the page."""
    what, value, form = remedy.what, remedy.value, page.form
    shown = form.parameters(page.curve is None or page.curve.time is not None)
    is_fitted = what in shown and form.value(what) is None
    name = FITTED[what].label if what in FITTED else ""
    set_number = form.numbers[what].param.update if what in form.numbers else None
    match remedy.action:
        case "free" if what == "work_of_adhesion" and form.medium.value == "gel":
            take = partial(form.medium.param.update, value="sticky")
            return button("Take an elastic sample with adhesion", take)
        case "free" if what in shown and not is_fitted:
            return button(f"Free the {name}", partial(set_number, si=None))
        case "hold" if is_fitted and value is None:
            # Hold the fitted value unless the user knows another value.
            found = page.found and float(page.found.fit.to_dict()[what])
            return _leading(
                page, f"Hold the {name}", what, *([partial(set_number, si=found)] if found else [])
            )
        case "hold" if is_fitted:
            at = format_quantity(value, FITTED[what].kind) if value else "0"
            return button(f"Hold the {name} at {at}", partial(set_number, si=value))
        case "give" if what in NUMBERS and value is not None:
            return button(f"Give the {NUMBERS[what].label}", partial(set_number, si=value))
        case "give" if what in NUMBERS:
            return _leading(page, f"Give the {NUMBERS[what].label}", what)
        case "subtract" if page.curve is not None and page.curve.time is not None:
            drift = format_quantity(value, "speed", 3)
            return button(f"Subtract a drift of {drift}", partial(set_number, si=value))
        case "give" if what == "profile":
            return _leading(page, "Choose another tip", "profile")
        case "give" | "unit" if page.table is not None and not page.form.is_afm:
            return _of_table(remedy, page)
        case "part" if page.curve is not None and page.part != what and what in ("loading", "unloading"):
            return button(f"Take the {what}", partial(page.do, page.part_chosen, what))
        case "class" if _is_better(what, page):
            return button(*_class(what, page))
    return None


def _of_table(remedy: Remedy, page: Any) -> Any:
    """Return the button for a unit, a column, or the option `by` of a table."""
    what = {"piezo": "depth"}.get(remedy.what, remedy.what)
    if what == "by" and remedy.value:
        options = {"by": remedy.value}
        return button(_BY[remedy.value], partial(page.do, page.read_with, options))
    if what == "by":
        return _leading(page, "Choose what parts the curves", "by")
    if remedy.action == "unit" and what in SIZES:
        return _leading(page, f"Look at the unit of {what}", f"unit-{what}")
    if what in SIZES:
        return _leading(page, f"Give the column of {what}", what)
    # A question about the columns is next to their choosers.
    if what == "columns" and page.question is None:
        return _leading(page, "Choose the columns", "depth")
    return None


def _is_better(letter: str, page: Any) -> bool:
    """Whether a class of hardness fits better, and has no button next to the classes yet."""
    own = MEDIA[page.form.medium.value].letter if page.form.medium.value else ""
    known = texts.misfits(page.found) if page.found and own else {}
    if letter not in known:
        return letter != (own or "elastic")
    return known[letter] < known[own] and texts.better(page.found, own) != letter


def _class(letter: str, page: Any) -> tuple[str, Any]:
    """Return label and action of the button for another class of hardness, or for an elastic sample."""
    name = (OF_CLASS | {"elastic": "gel"})[letter]
    label = MEDIA[name].label.partition(":")[0]
    label = f"{label[:1].lower()}{label[1:]}"
    if MEDIA[page.form.medium.value].letter and MEDIA[name].letter:
        label = f"class ({letter}), {CLASS_NAMES[letter]}"
    return f"Take {label}", partial(page.form.medium.param.update, value=name)


def _leading(page: Any, label: str, name: str, *acts: Any) -> Any:
    """Return a button that leads to a field, also in a fold."""

    def lead() -> None:
        page.form.reader.collapsed = False
        for act in acts:
            act()

    made = button(label, lead)
    made.js_on_click(args={"name": f"to-{name}"}, code=call("lead", "name"))
    return made
