"""Errors of the package, with what is wrong and what to do as attributes."""

import reprlib
from typing import Any

import numpy as np

# The argument may be nested too deeply for its own repr, or be very long.
_short = reprlib.Repr()
_short.maxstring = _short.maxother = 80


def shown(value):
    """Short text of any argument, for a message."""
    return _short.repr(value)


#: Names of the arguments that are not the last word of their quantity.
_ARGUMENTS = {
    "half-angle": "degrees",
    "radius of the hardness": "radius",
    "critical depth": "critical_depth",
    "coordinate": "x",
    "area A(h)": "coefficients",
}


class MDRError(ValueError):
    """Base class of the errors of this package. It is a ValueError.

    Attributes
    ----------
    text : str
        The message without names of Python, as a page shows it.
    remedy : tuple of Remedy
        What one can do, as of a `Remark`; mostly empty.
    kind : str
        What is wrong with a measurement, one of the kinds of remarks; else empty.

    Examples
    --------
    >>> import mdr_core as mdr
    >>> try:
    ...     mdr.Cone(slope=-0.3)
    ... except mdr.MDRError as error:
    ...     print(error.text)
    Cone slope = -0.3 must be finite and positive; check it
    """

    remedy: tuple[Any, ...] = ()
    kind = ""

    @property
    def text(self) -> str:
        return str(self)


class InvalidArgument(MDRError):
    """An argument is not valid.

    Attributes
    ----------
    quantity : str
        The argument in the words of the message: "effective modulus E_star", "Cone slope".
    argument : str
        Its name in the call: "E_star", "slope".
    value : object
        The value that is refused, without its unit; of an array, its first invalid entry.
    bound : str
        The requirement, or what is wrong with the value: "must be finite and positive", "is negative".
    unit, advice : str
        SI unit, and what to do; empty where there is none.

    Examples
    --------
    >>> from mdr_core import Cone
    >>> try:
    ...     Cone(slope=-0.3)
    ... except ValueError as error:
    ...     print(error.argument, error.value, error.bound, error.advice, sep="; ")
    slope; -0.3; must be finite and positive; check it
    """

    def __init__(self, message, quantity, value, bound, unit="", advice="", remedy=()):
        super().__init__(message, quantity, value, bound, unit, advice, remedy)
        self.quantity = quantity
        # The depth of the third of several curves is depth[2].
        self.argument = _ARGUMENTS.get(quantity, quantity.split()[-1]).partition("[")[0]
        self.value = value
        self.bound = bound
        self.unit = unit
        self.advice = advice
        self.remedy = remedy

    def __str__(self):
        return self.args[0]


class InvalidEntries(InvalidArgument):
    """The error of `raise_if`: `bad` says which entries of the `values` of a quantity are invalid."""

    def __init__(self, quantity, values, bad, bound, unit, advice, remedy=()):
        self.values, self.bad = np.broadcast_arrays(values, bad)
        value = self.values.flat[np.argmax(self.bad)].item()
        super().__init__("", quantity, value, bound, unit, advice, remedy)
        # The text is composed when it is asked for; these make a copy of the error.
        self.args = quantity, values, bad, bound, unit, advice, remedy

    def message(self, entry, index, others=0):
        """Text on one entry of the flat values, at an index by which it is known."""
        where = f"[{', '.join(map(str, index))}]" if len(index) else ""
        more = f" (and {others} more of {self.values.size} entries)" if others else ""
        unit = f" {self.unit}" if self.unit else ""
        advice = f"; {self.advice}" if self.advice else ""
        return f"{self.quantity}{where} = {self.values.flat[entry]:g}{unit} {self.bound}{more}{advice}"

    @property
    def text(self):
        return self.message(np.argmax(self.bad), ())

    def __str__(self):
        entry = np.argmax(self.bad)
        return self.message(entry, np.unravel_index(entry, self.bad.shape), np.count_nonzero(self.bad) - 1)
