"""Errors of the package, with the fault and the remedy as attributes."""

import reprlib
from typing import Any

import numpy as np

# The argument may be nested too deeply for its own repr, or be very long.
_short = reprlib.Repr()
_short.maxstring = _short.maxother = 80


def shown(value):
    """Return a short text of any argument, for a message."""
    return _short.repr(value)


#: Names of arguments that differ from the last word of their quantity.
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
        The message without Python names, for a page.
    remedy : tuple of Remedy
        Remedies, as in a `Remark`; mostly empty.
    kind : str
        Fault of a measurement, one of the kinds of remarks; else empty.

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
        The invalid value without its unit; for an array, the first invalid entry.
    bound : str
        The requirement, or the fault of the value: "must be finite and positive", "is negative".
    unit, advice : str
        SI unit and remedy, or empty texts.

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
        # In a fit of several curves, the depth of the third curve is depth[2].
        self.argument = _ARGUMENTS.get(quantity, quantity.split()[-1]).partition("[")[0]
        self.value = value
        self.bound = bound
        self.unit = unit
        self.advice = advice
        self.remedy = remedy

    def __str__(self):
        return self.args[0]


class InvalidEntries(InvalidArgument):
    """The error of `raise_if`: `bad` marks the invalid entries of the `values` of a quantity."""

    def __init__(self, quantity, values, bad, bound, unit, advice, remedy=()):
        self.values, self.bad = np.broadcast_arrays(values, bad)
        value = self.values.flat[np.argmax(self.bad)].item()
        super().__init__("", quantity, value, bound, unit, advice, remedy)
        # `__str__` makes the text; a copy of the error is made from these arguments.
        self.args = quantity, values, bad, bound, unit, advice, remedy

    def message(self, entry, index, others=0):
        """Return the text for one entry of the flat values; `index` is the index in the text."""
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
