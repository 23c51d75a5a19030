"""Text of Optics11's Piuma: settings, and a table that begins with time, load and indentation."""

from dataclasses import replace

from ..curve import curve_factory
from ..table import read_table

_TABLE = "Time (s)\tLoad (uN)\tIndentation (nm)"


def matches(head):
    return _TABLE in head and "k (N/m)\t" in head


def body(text):
    """Return the part of the text that is a table."""
    return text[text.index(_TABLE) :]


def curves(text, file, given):
    """Return the single curve. Its depth is the indentation; the settings have the cantilever stiffness."""
    header, _, _ = text.partition(_TABLE)
    table = read_table(body(text), file)
    above = header.count("\n")
    table = replace(table, header=tuple(header.splitlines()), lines=table.lines + above)
    table = replace(table, odd={number + above: line for number, line in table.odd.items()})
    layout = {"depth": (2, "nm"), "force": (1, "µN"), "time": (0, "s")}
    return [curve_factory(table, file, layout, given, "as Optics11's Piuma writes them")]
