"""Units, and SI numbers as text in the unit that fits."""

from dataclasses import dataclass
from math import floor, isfinite, log10, pi


@dataclass(frozen=True)
class Unit:
    """Unit and its size in SI."""

    name: str
    factor: float

    def fits(self, value: float) -> bool:
        """Whether a value (SI) in this unit needs no power of ten."""
        return value == 0 or 1e-3 <= abs(value) / self.factor < 1e5


#: Units of each kind of quantity, smallest first; the SI unit has factor 1.
UNITS = {
    kind: tuple(Unit(name, size) for name, size in sizes.items())
    for kind, sizes in {
        "number": {"": 1.0},
        "length": {"pm": 1e-12, "nm": 1e-9, "µm": 1e-6, "mm": 1e-3, "m": 1.0},
        "force": {
            "fN": 1e-15, "pN": 1e-12, "nN": 1e-9, "µN": 1e-6, "mN": 1e-3, "N": 1.0, "kN": 1e3, "MN": 1e6,
            "GN": 1e9,
        },
        "pressure": {"mPa": 1e-3, "Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "TPa": 1e12},
        "energy": {
            "yJ": 1e-24, "zJ": 1e-21, "aJ": 1e-18, "fJ": 1e-15, "pJ": 1e-12, "nJ": 1e-9, "µJ": 1e-6,
            "mJ": 1e-3, "J": 1.0, "kJ": 1e3, "MJ": 1e6,
        },
        "yield constant": {
            "µN/m": 1e-6, "mN/m": 1e-3, "N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "GN/m": 1e9,
        },
        "bending stiffness": {
            "nN·m": 1e-9, "µN·m": 1e-6, "mN·m": 1e-3, "N·m": 1.0, "kN·m": 1e3, "MN·m": 1e6,
        },
        "mass per area": {"g/m²": 1e-3, "kg/m²": 1.0, "t/m²": 1e3},
        "mass": {
            "pg": 1e-15, "ng": 1e-12, "µg": 1e-9, "mg": 1e-6, "g": 1e-3, "kg": 1.0, "t": 1e3,
        },
        "speed": {"pm/s": 1e-12, "nm/s": 1e-9, "µm/s": 1e-6, "mm/s": 1e-3, "m/s": 1.0, "km/s": 1e3},
        "time": {"ps": 1e-12, "ns": 1e-9, "µs": 1e-6, "ms": 1e-3, "s": 1.0},
        "drag": {"nN·s/m": 1e-9, "µN·s/m": 1e-6, "mN·s/m": 1e-3, "N·s/m": 1.0, "kN·s/m": 1e3},
        "compliance": {"pm/N": 1e-12, "nm/N": 1e-9, "nm/mN": 1e-6, "µm/mN": 1e-3, "m/N": 1.0},
        "viscosity": {
            "nPa·s": 1e-9, "µPa·s": 1e-6, "mPa·s": 1e-3, "Pa·s": 1.0, "kPa·s": 1e3, "MPa·s": 1e6,
        },
        "density": {"kg/m³": 1.0},
        "angle": {"°": pi / 180},
        "slope": {"": 1.0},
        "surface energy": {"µJ/m²": 1e-6, "mJ/m²": 1e-3, "J/m²": 1.0, "kJ/m²": 1e3},
        "spin": {"rad/s": 1.0, "krad/s": 1e3, "Mrad/s": 1e6},
        "area": {"nm²": 1e-18, "µm²": 1e-12, "mm²": 1e-6, "m²": 1.0},
    }.items()
}  # fmt: skip
#: Kinds by the names of their SI units: "N" is a force.
KINDS = {unit.name: kind for kind, units in UNITS.items() for unit in units if unit.factor == 1}
KINDS |= {"": "number", "rad": "angle"}


def fitting(value: float, kind: str, like: float = 0.0) -> Unit:
    """Return the unit in which a value (SI) has one to three digits before the point, areas up to four.

    Zero gets the unit of the value `like`.

    Examples
    --------
    >>> from mdr_core.show.units import fitting
    >>> fitting(2e-8, "length").name
    'nm'
    """
    units = UNITS[kind]
    size = abs(value) if isfinite(value) and value else abs(like)
    if size == 0:
        return next((unit for unit in units if unit.factor == 1), units[0])
    # A value just below the next unit, by a rounding error, gets this next unit: 1 mm, not 1000 µm.
    pairs = zip(units[:0:-1], units[-2::-1], strict=True)
    fits = (unit for unit, below in pairs if min(unit.factor, 1e4 * below.factor) <= size * (1 + 1e-9))
    return next(fits, units[0])


def digits(value: float, count: int = 4) -> str:
    """Return a number with significant digits as text; very large and small numbers are a × 10ⁿ."""
    if not isfinite(value):
        return "∞" if value > 0 else "–"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        value = float(f"{value:.{count - 1}e}")
        return f"{value:.{max(count - 1 - floor(log10(abs(value))), 0)}f}".replace("-", "−")
    mantissa, exponent = f"{value:.{count - 1}e}".split("e")
    power = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa} × 10{power}".replace("-", "−")


def format_quantity(value: float, kind: str, count: int = 4) -> str:
    """Return a value (SI) as text with its unit.

    Examples
    --------
    >>> from mdr_core.show.units import format_quantity
    >>> format_quantity(4.5136e-6, "force"), format_quantity(2e-30, "force")
    ('4.514 µN', '2.000 × 10⁻¹⁵ fN')
    """
    if value == 0 or not isfinite(value):
        return digits(value)
    unit = fitting(value, kind)
    return with_unit(digits(value / unit.factor, count), unit.name)


def with_unit(number: str, unit: str) -> str:
    """Join a number and its unit with a space, except before a degree sign."""
    return f"{number}{'' if unit == '°' else ' '}{unit}".strip()
