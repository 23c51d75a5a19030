"""What a person can do about a remark: the label of its button, and what that does on the page."""

from typing import Any

from mdr_core.numerics.remark import Remedy
from mdr_core.show.units import written

from . import words
from .setting import CLASS_NAMES, CORRECTIONS, MEDIA, NUMBERS, OF_CLASS, parameter

#: Names of columns, and what else is chosen of a table.
_COLUMNS = {"depth": "depth", "piezo": "depth", "force": "force", "time": "time", "stiffness": "stiffness"}
_CHOOSE = {"columns": "Choose the columns"}
#: Kinds of samples by classes of hardness.
_MEDIA = OF_CLASS | {"elastic": "gel"}
#: What parts the curves of a table.
_BY = {
    None: "Choose what parts the curves",
    "whole": "Read it as one curve",
    "gaps": "Part the curves at empty lines",
    "restart": "Part the curves where the depth starts anew",
}


def label(remedy: Remedy, page: Any) -> str:
    """What the button of a remedy says; empty for what cannot be done here, or is done already."""
    return _LABELS[remedy.action](remedy, page)


def do(remedy: Remedy, page: Any) -> None:
    """Do what a remedy says: change the setting, or lead to the field where a person can."""
    what, value = remedy.what, remedy.value
    if what == "by" and value:
        page.reread(by=value)
    elif remedy.action == "part":
        page.choose_part(what)
    elif remedy.action == "class":
        page.choose_medium(_MEDIA[what])
    elif remedy.action == "free":
        page.free(what, True)
    elif remedy.action in ("hold", "give") and value is not None:
        page.hold(what, value)
    elif remedy.action == "hold":
        # Where it was found; a person knows another value, perhaps.
        page.free(what, False)
        page.form.focus(what)
    else:
        place = _COLUMNS.get(what, "depth" if what == "columns" else what)
        page.form.focus(f"unit-{place}" if remedy.action == "unit" else place)


def _parameters(page: Any) -> list[str]:
    """Names of the parameters that are shown."""
    if not page.setting.medium:
        return []
    return page.setting.parameters(page.curve is None or page.curve.time is not None)


def _is_free(name: str, page: Any) -> bool:
    return name in _parameters(page) and name not in page.setting.held


def _free(remedy: Remedy, page: Any) -> str:
    held = remedy.what in _parameters(page) and remedy.what in page.setting.held
    return f"Free the {_name(remedy.what)}" if held else ""


def _hold(remedy: Remedy, page: Any) -> str:
    if not _is_free(remedy.what, page):
        return ""
    known, value = parameter(remedy.what), remedy.value
    at = "" if value is None else f" at {written(value, known.kind) if value else '0'}"
    return f"Hold the {known.label}{at}"


def _give(remedy: Remedy, page: Any) -> str:
    what = remedy.what
    if what == "profile":
        return "Choose another tip"
    if what in CORRECTIONS:
        return f"Give the {CORRECTIONS[what].label}"
    if what in NUMBERS:
        return f"Give the {NUMBERS[what].label}"
    # A question about the columns stands where they are chosen.
    if page.table is None or page.is_afm or (what == "columns" and page.question):
        return ""
    if what == "by":
        return _BY[remedy.value]
    return f"Give the column of {_COLUMNS[what]}" if what in _COLUMNS else _CHOOSE.get(what, "")


def _unit(remedy: Remedy, page: Any) -> str:
    has_units = page.table is not None and not page.is_afm and remedy.what in _COLUMNS
    return f"Look at the unit of {_COLUMNS[remedy.what]}" if has_units else ""


def _part(remedy: Remedy, page: Any) -> str:
    another = page.taken is not None and page.part != remedy.what
    return f"Take the {remedy.what}" if another and remedy.what in ("loading", "unloading") else ""


def _class(remedy: Remedy, page: Any) -> str:
    name = _MEDIA.get(remedy.what, "")
    if not name or name == page.setting.medium:
        return ""
    if not (page.setting.kind.letter and MEDIA[name].letter):
        kind = MEDIA[name].label.partition(":")[0]
        return f"Take {kind[:1].lower()}{kind[1:]}"
    misfits = {letter: each.misfit for letter, each in page.fit.classes.items()} if page.fit else {}
    own = page.setting.kind.letter
    # What is clearly better has a button beside the classes.
    beside = words.better(misfits, own) == remedy.what
    better = not misfits or (misfits[remedy.what] < misfits[own] and not beside)
    return f"Take class ({remedy.what}), {CLASS_NAMES[remedy.what]}" if better else ""


def _name(name: str) -> str:
    return parameter(name).label


_LABELS = {"free": _free, "hold": _hold, "give": _give, "unit": _unit, "part": _part, "class": _class}
