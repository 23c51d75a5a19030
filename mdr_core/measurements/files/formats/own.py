"""Files of this package and its pages, in SI: curves, and other files, which raise `NoCurve`."""

import numpy as np

from ....show.quantities import QUANTITIES
from ..curve import curve_factory
from ..question import NoCurve
from ..split import parts
from ..table import read_table

#: First words of a file of the pages, and contents of files without a curve.
_TITLE = "# mdr_core "
_OTHERS = {
    "state at depth": "the pressure of one state",
    "fit to": "the numbers of a fit; its JSON file has the samples",
    "curves of": "the moduli of a map",
}
#: Names of the rows of a result in `to_pandas`, and largest depth (m) and force (N) of a result. Numbers in
#: nm are larger, so a foreign table with these names raises `UnknownColumns`.
_ROWS = {"state", "sample", "time", "path", "curve"}
_DEEPEST, _STRONGEST = 1e-3, 1e6
#: Units of the quantities of a curve, and the quantities by their headers in both kinds of file.
_CURVE = {"depth": "m", "force": "N", "time": "s", "stiffness": "N/m"}
_HEADS = {
    f"{QUANTITIES[name].long_name} {QUANTITIES[name].symbol} ({unit})": name
    for name, unit in _CURVE.items()
}
_HEADS |= {name: name for name in _CURVE}


def matches(head):
    return head.startswith(_TITLE) or _of_pandas(head.partition("\n")[0])


def _of_pandas(line):
    """Whether a line has only names that `to_pandas().to_csv()` writes."""
    cells = line.strip("\ufeff\r").split(",")
    known = {*cells[1:]} <= _ROWS | QUANTITIES.keys()
    return cells[0] in _ROWS and known and {"depth", "force"} <= {*cells}


def curves(text, file, given):
    """Return the curve of a file, or the curves that the first columns count."""
    title = text.partition("\n")[0].removeprefix(_TITLE).partition(": ")[2]
    for begins, what in _OTHERS.items():
        if text.startswith(_TITLE) and title.startswith(begins):
            raise NoCurve(f"{file} has {what}, not a curve of depth and force")
    table = read_table(text, file)
    found = {}
    for k, head in table.heads.items():
        if head in _HEADS and not (k == 0 and head == "time"):
            found[_HEADS[head]] = k
    if not {"depth", "force"} <= found.keys():
        raise LookupError("no columns of depth and force")
    layout = {each: (found[each], unit) for each, unit in _CURVE.items() if each in found}
    depth, force = (table.values[found[each]] for each in ("depth", "force"))
    written = np.nanmax(np.abs(depth)) < _DEEPEST and np.nanmax(np.abs(force)) < _STRONGEST
    if not (written or text.startswith(_TITLE)):
        raise LookupError("numbers that are not in m and N")
    rows = [k for k, head in table.heads.items() if head in _ROWS - {"time"}]
    by = rows[0] if len(rows) > 1 else None
    return [
        curve_factory(
            part, f"{file}, {label}" if label else file, layout, given, "as this package writes them"
        )
        for label, part in parts(table, by, layout)
    ]
