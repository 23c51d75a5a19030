"""Samples of a profile, such as a measured tip, from a text file."""

from pathlib import Path

from ...base import check
from ...solver.profiles.samples import LENGTHS
from .table import decoded, read_table
from .units import unit_named


def samples_in(path, unit, limit):
    """Return at most `limit` radii and heights (m) of a text file; `unit` if its header has no unit."""
    return samples_of(decoded(Path(path).read_bytes()), str(path), unit, limit, "; or give unit='nm'")


def samples_of(text, name, unit, limit, remedy=""):
    """Return at most `limit` radii and heights (m) of a text; `unit` if its header has no unit.

    The message about a missing unit ends with `remedy`, an alternative for the caller.
    """
    if unit is not None:
        check.one_of("unit", unit, (*LENGTHS, "um"))
    table = read_table(text, name, limit)
    count = len(table.heads)
    unnamed = count > 2 and bool(table.header) and not any(table.heads.values())
    if table.odd or count < 2 or unnamed:
        number = min(table.odd, default=table.lines[0])
        expected = "two numbers r, z" if count <= 2 or unnamed else f"{count} numbers, r and z first"
        line = f", found {table.odd[number].strip()!r:.60}" if table.odd else ""
        raise check.MDRError(f"{name}, line {number}: expected {expected}{line}")
    columns = list(table.heads)[:2]
    named = [u if u in LENGTHS else None for u in map(table.unit, columns)]
    if unit is None and None in named:
        raise check.MDRError(
            f"{name}: the header must name the units of r and z, as in 'r (nm), z (nm)', from "
            f"{', '.join(LENGTHS)}{remedy}"
        )
    units = named if unit is None else [unit_named(unit)] * 2
    if any(named) and named != units:
        given = ", ".join(filter(None, named))
        raise check.MDRError(f"{name}: unit={unit!r} was given, but the header says {given}")
    r, z = map(table.values.get, columns)
    return r * LENGTHS[units[0]], z * LENGTHS[units[1]]
