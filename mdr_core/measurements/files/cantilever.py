"""Constants of a cantilever, from arguments or from the header of a file, as far as a curve needs them."""

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
#: Names in JPK's text without their units, N/m and m/V.
_OF_JPK = "springconstant", "sensitivity"


@dataclass(frozen=True)
class Cantilever:
    """Stiffness (N/m) and sensitivity (m/V) of a cantilever, None if unknown, and remarks on the source."""

    stiffness: float | None = None
    sensitivity: float | None = None
    remarks: tuple[Remark, ...] = ()

    def force_per_deflection(self, unit):
        """Return the force (N) for a deflection of 1 m, or of 1 V."""
        return self.stiffness * (self.sensitivity if is_voltage(unit) else 1.0)


def constants(table, name, layout, given, asked):
    """Return the `Cantilever` of a curve with the columns of `layout`.

    `asked` has the arguments that determine the columns, {} if there are none; an error suggests them.
    Raises `UnknownColumns` if a constant is missing, and MeasurementError for an unused constant.
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
            f"{name}: the given spring constant is not used, because the depth is that of the tip, and the "
            "force is in units of force: leave it out, or choose the column as the position of a piezo",
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
    """Return a constant (SI) from a header, or None.

    Forms: "Spring constant: 0.05 N/m", "# springConstant: 0.05".
    """
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
    """Return the number at the beginning of a text, with a decimal point or comma, and the rest."""
    first, _, rest = text.strip(' \t;:="').replace("\t", " ").replace(";", " ").partition(" ")
    try:
        return float(first.replace(",", ".")), rest.strip(' "')
    except ValueError:
        return None, ""
