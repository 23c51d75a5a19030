"""Export of several tests by Anton Paar's Indentation software: "X_name_1_Time_[s]", "Y_name_1_Pd_[nm]"."""

from ..curve import curve_factory, trimmed
from ..names import parted
from ..table import read_table

_QUANTITIES = {"Time": "time", "Fn": "force", "Pd": "depth"}


def matches(head):
    line = next((line for line in head.splitlines() if line.strip()), "").lstrip('"')
    return line.startswith(("X_", "Y_")) and "_Pd_[" in line


def curves(text, file, given):
    """Return one curve for each name between X_ or Y_ and the quantity."""
    table = read_table(text, file)
    tests = {}
    for column, head in table.heads.items():
        test, _, quantity = head[2:].rpartition("_[")[0].rpartition("_")
        unit = parted(head)[2]
        if quantity in _QUANTITIES and unit:
            tests.setdefault(test, {}).setdefault(_QUANTITIES[quantity], (column, unit))
    layouts = {test: layout for test, layout in tests.items() if {"depth", "force"} <= layout.keys()}
    if not layouts:
        raise LookupError("no test has depth and force")
    source = "as Anton Paar's export has them"
    return [
        curve_factory(trimmed(table, layout), f"{file}, {test}", layout, given, source)
        for test, layout in layouts.items()
    ]  # fmt: skip
