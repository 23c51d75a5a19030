"""Text export of NanoScope Analysis of Bruker: approach (Ex) and retract (Rt) side by side."""

from ..curve import curve_factory
from ..split import joined
from ..table import read_table

#: Names of the columns for "Ex" and "Rt": depths, positions of the piezo, and forces with their units.
_DEPTHS = ("Sep_nm_{}",)
_POSITIONS = "Height_Sensor_nm_{}", "Calc_Ramp_{}_nm"
_FORCES = {"Defl_pN_{}": "pN", "Defl_nN_{}": "nN", "Defl_nm_{}": "nm", "Defl_V_{}": "V"}


def matches(head):
    line = next((line for line in head.splitlines() if line.strip()), "")
    return "_Ex" in line and "_Rt" in line and "Defl_" in line


def curves(text, file, given):
    """Return the single curve, with approach and retract as its parts."""
    table = read_table(text, file)
    columns = {head: k for k, head in table.heads.items()}

    def of(names):
        return next(
            (name for name in names if {name.format("Ex"), name.format("Rt")} <= columns.keys()), None
        )

    force = of(_FORCES)
    depth, position = of(_DEPTHS), of(_POSITIONS)
    place = depth or position
    if force is None or place is None:
        raise LookupError("no pair of columns of a position and a deflection")
    key = "depth" if depth else "piezo"
    layouts = [
        {key: (columns[place.format(end)], "nm"), "force": (columns[force.format(end)], _FORCES[force])}
        for end in ("Ex", "Rt")
    ]
    table, layout = joined(table, layouts, file)
    return [curve_factory(table, file, layout, given, "as NanoScope Analysis exports them")]
