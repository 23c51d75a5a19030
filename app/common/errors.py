"""Texts of errors for the page, with their remedies."""

import re
from typing import Any

from mdr_core.base.errors import InvalidArgument, MDRError
from mdr_core.show.units import KINDS, format_quantity

from .quantities import QUANTITIES, unicode_subscripts

#: Largest number of characters of a text, which may quote a file.
_MOST = 2000
#: Numbers with SI units in messages of the core.
_IN_SI = re.compile(rf"(?<![\w.])(\d+\.?\d*(?:e[+-]?\d+)?) ({'|'.join(filter(None, KINDS))})(?![\w/·²³°])")


class Refused(Exception):
    """An error for the user: its text, and remedies of `mdr_core`."""

    def __init__(self, text: str, remedy: tuple[Any, ...] = ()):
        super().__init__(text)
        self.text, self.remedy = text, remedy


def text_and_remedy(error: Exception) -> tuple[str, tuple[Any, ...]]:
    """Return the text of any error without folders, and its remedies."""
    text = error_text(error) if isinstance(error, ValueError) else str(error)
    return without_folders(text[:_MOST]), getattr(error, "remedy", ())


def without_folders(text: str) -> str:
    """Remove the folders of the server from the paths in a text."""
    return re.sub(r"(?<![\w.)])(?:[A-Za-z]:)?[/\\](?:[^/\\\s'\":]+[/\\]+)+", "", text)


def error_text(error: ValueError) -> str:
    """Return the message of an error of the core: for a number its symbol, value with unit, bound, advice.

    Other messages have no names of Python if the error has a text without them.
    """
    if not isinstance(error, InvalidArgument) or not isinstance(error.value, int | float):
        text = getattr(error, "text", str(error))
        return in_fitting_units(text) if isinstance(error, MDRError) else text
    known = QUANTITIES.get(error.argument)
    name = f"{unicode_subscripts(known.symbol)}, {known.label}," if known else error.quantity
    value = format_quantity(float(error.value), KINDS.get(error.unit, "number"))
    advice = f"; {error.advice}" if error.advice and "SI units" not in error.advice else ""
    return f"{name} = {value} {in_fitting_units(error.bound)}{advice}"


def in_fitting_units(text: str) -> str:
    """Convert each number of a message of the core from SI to the unit that fits it."""
    return _IN_SI.sub(lambda found: format_quantity(float(found[1]), KINDS[found[2]]), text)
