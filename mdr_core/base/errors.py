"""Errors of refused arguments and measurements, with what is wrong and what to do as attributes."""

import reprlib

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


class Refusal(ValueError):
    """A measurement is refused. The message is a `Remark`, and `str(error)` its sentence.

    A page that shows refusals takes `text` and `remedy` of those that have them, and `str` of others:
    ``getattr(error, "text", str(error))``, ``getattr(error, "remedy", ())``. `InvalidArgument` has both.

    Attributes
    ----------
    kind : str
        What is wrong, one of the kinds of remarks.
    text : str
        The message without names of Python.
    remedy : tuple of Remedy
        What one can do; empty for nothing.
    """

    def __init__(self, remark):
        super().__init__(remark)
        self.kind, self.text, self.remedy = remark.kind, remark.text, remark.remedy


class InvalidArgument(ValueError):
    """An argument is refused.

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
    text : str
        The message without the index of the entry.
    remedy : tuple of Remedy
        What one can do on the page for measurements, as of a `Remark`; mostly empty.

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

    @property
    def text(self):
        return str(self)

    def __str__(self):
        return self.args[0]


class InvalidEntries(InvalidArgument):
    """The error of `refuse`: `bad` says which entries of the `values` of a quantity are invalid."""

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
