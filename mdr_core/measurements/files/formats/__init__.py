"""Exactly known layouts of instruments and of this package, one module for each layout.

`matches(head)` gets the first 4,000 characters of a text. `curves(text, file, given)` returns functions
that make the curves; `given` has "spring_constant" and "sensitivity", None if they are not given. It raises
a LookupError if the text deviates from the format; the text is then read as a table. `body(text)` is
optional and returns the part of the text to which `columns=` applies. A new format needs a module here, its
name in `FORMATS`, and a sample in the tests with its source, a public file or a specification.
"""

from . import anton_paar, jpk, nanoscope, own, piuma

FORMATS = own, jpk, nanoscope, anton_paar, piuma
#: Number of characters for recognizing a format.
_HEAD = 4_000


def format_of(text):
    """Return the format of a text, or None for any other table."""
    head = text[:_HEAD]
    return next((each for each in FORMATS if each.matches(head)), None)
