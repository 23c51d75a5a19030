"""Layouts that an instrument or this package writes, known exactly: a module each.

`matches(head)` gets the first 4,000 characters of a text. `curves(text, file, given)` returns functions
that make the curves; `given` has "spring_constant" and "sensitivity", None where they are not given. It
raises a LookupError where the text is not as the format has it: it is read as a table then. `body(text)`,
if there is one, is the part of the text that `columns=` tells of. A new format is a module here, its name
in `FORMATS`, and a sample in the tests, with the public file or the specification in which it was seen.
"""

from . import anton_paar, jpk, nanoscope, own, piuma

FORMATS = own, jpk, nanoscope, anton_paar, piuma
#: Number of characters by which a format is known.
_HEAD = 4_000


def format_of(text):
    """The format of a text, or None for a table of any other origin."""
    head = text[:_HEAD]
    return next((each for each in FORMATS if each.matches(head)), None)
