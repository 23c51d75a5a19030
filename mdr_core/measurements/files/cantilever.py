"""The constants of a cantilever, given or in the header of a file: those that a curve needs, no others."""

from dataclasses import dataclass
from math import inf

from ...base.remark import MeasurementError, Remark, Remedy
from .names import normal, parted
from .question import CONSTANTS, WORDS_OF_CONSTANTS, constants_needed, lacks_constants
from .table import LONGEST_HEADER
from .units import is_deflection, is_voltage, size_of, unit_alone

#: Names of the constants in the headers of files, and the kinds of their units.
_NAMES = {
    "spring_constant": ({
        "spring constant", "springconstant", "k", "federkonstante", "constante de raideur",
        "constante elastica", "constante de resorte", "costante elastica", "弹簧常数", "弹性常数",
    }, "stiffness"),
    "sensitivity": ({
        "sensitivity", "deflection sensitivity", "invols", "empfindlichkeit", "sensibilité", "sensibilidad",
        "sensibilità", "灵敏度",
    }, "sensitivity"),
}  # fmt: skip
#: Names that stand in JPK's text without a unit, N/m and m/V.
_OF_JPK = "springconstant", "sensitivity"


@dataclass(frozen=True)
class Cantilever:
    """Stiffness (N/m) and sensitivity (m/V) of a cantilever, None if not known, and where they are from."""

    stiffness: float | None = None
    sensitivity: float | None = None
    remarks: tuple[Remark, ...] = ()

    def force_per_deflection(self, unit):
        """Force (N) for a deflection of 1 m, or of 1 V."""
        return self.stiffness * (self.sensitivity if is_voltage(unit) else 1.0)


def constants(table, name, layout, given, asked):
    """The `Cantilever` of a curve with some columns; what lacks is asked for, what nothing uses is refused.

    `asked` is what a question suggests: the arguments that say what the columns are, {} if none do. Raises
    `UnknownColumns` where a constant lacks, and ValueError where one is given for nothing.
    """
    unit = layout["force"][1].lstrip("−")
    deflection = is_deflection(unit)
    needed = constants_needed(layout)
    _refuse_unused(name, given, needed, deflection, unit)
    known, remarks = dict(given), []
    for each, (names, kind) in _NAMES.items():
        own = constant(table.header, kind, names)
        if own is None or (each == "sensitivity" and not needed[each]):
            continue
        text, words = f"{own:.6g} {CONSTANTS[each]}", WORDS_OF_CONSTANTS[each]
        if known.get(each) is None:
            known[each] = own
            if needed[each]:
                remarks.append(Remark(f"{words}, {text}, is taken from the file", "taken"))
        elif known[each] != own:
            value = f"{known[each]:.6g} {CONSTANTS[each]}"
            words = f"{words}, {value}, is taken as given; the file has {text}"
            remarks.append(Remark(words, "taken"))
    lacking = [each for each in needed if needed[each] and known.get(each) is None]
    if lacking:
        raise lacks_constants(table, name, layout, lacking, deflection, asked)
    return Cantilever(known.get("spring_constant"), known.get("sensitivity"), tuple(remarks))


def _refuse_unused(name, given, needed, deflection, unit):
    if given.get("spring_constant") is not None and not needed["spring_constant"]:
        raise MeasurementError(
            f"{name}: nothing uses the spring constant that is given. The depth is that of the tip, and "
            "the force is in units of force: leave it out, or choose the column as the position of a piezo",
            Remedy("give", "columns"),
        )
    if given.get("sensitivity") is not None and not needed["sensitivity"]:
        what = (
            f"the deflection of {name} is already a length, in {unit}"
            if deflection
            else f"the forces of {name} are already in units of force"
        )
        raise MeasurementError(f"{what}: leave out the sensitivity")


def constant(header, kind, names):
    """A constant (SI) in a header, as "Spring constant: 0.05 N/m" or "# springConstant: 0.05", or None."""
    for line in header:
        if len(line) > LONGEST_HEADER:
            continue
        for sign in ("=", ":", "\t", ";", ","):
            left, found, right = line.strip(' "#').partition(sign)
            name, own, unit = parted(left)
            if not found or name not in names:
                continue
            number, text = _number(right)
            if own == "":
                own, unit = (unit_alone(text.strip("()[] ")) if text else None) or ("", "")
            if number is None or not 0 < number < inf:
                continue
            if own == kind:
                return number * size_of(unit)
            if not own and not text and line.startswith("#") and normal(left) in _OF_JPK:
                return number
    return None


def _number(text):
    """Number at the beginning of a text, with a decimal point or comma, and what stands behind it."""
    first, _, rest = text.strip(' \t;:="').replace("\t", " ").replace(";", " ").partition(" ")
    try:
        return float(first.replace(",", ".")), rest.strip(' "')
    except ValueError:
        return None, ""
