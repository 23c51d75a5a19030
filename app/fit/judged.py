"""Whether the modulus of a fit is one to quote for the kind of sample that was chosen, and what doubts it.

An elastic sample has one modulus, that of its loading and of its unloading; and glass, metals and ceramics
have others than gels. What a fit alone can tell is among its own remarks.
"""

from dataclasses import replace

import numpy as np

import mdr_core as mdr
from mdr_core.fit.quoted import Quoted
from mdr_core.numerics.remark import Remark, Remedy
from mdr_core.show.units import written

from .asked import Asked

#: E* (Pa): nothing of constant hardness has less than the first one, polymers have more than the second
#: one, and rubber has less than the third one.
_NONE, _SOFT, _STIFF = 1e6, 1e8, 1e9
#: Ratio of E* of loading and unloading of an elastic sample from which on it is said, and from which on it
#: is none. Gels that do not stick have up to 1.25, those that do about 2, steel 45.
_SAID, _NOT_ELASTIC = 1.5, 10.0
#: Least number of samples of the other half, and largest relative error of its E*.
_FEW, _VAGUE = 20, 0.5
#: A unit is mistaken for one of a thousand times the size.
_THOUSAND = 1e3
#: Names of the kinds of samples, of which E* is plausible or not.
_CONSTANT, _ELASTIC = "constant", "gel"


def judged(quoted: Quoted, asked: Asked) -> tuple[Quoted, tuple[Remark, ...], tuple[Remark, ...]]:
    """The number to quote, questions that stand above it, and what is said below it."""
    if quoted.value is None:
        return quoted, (), ()
    other = _of_other_half(asked) if quoted.source == "fit" else None
    ratio = max(other / quoted.value, quoted.value / other) if other else np.inf
    if other and ratio >= _NOT_ELASTIC:
        return _withheld(quoted, _not_elastic()), (), ()
    below = ()
    if other and ratio >= _SAID:
        below = (_differs(asked.part, other, ratio),)
    if asked.medium == _CONSTANT and quoted.value < _NONE:
        return _withheld(quoted, _too_soft(asked, quoted.value)), (), ()
    if asked.medium == _CONSTANT and quoted.value < _SOFT:
        return quoted, (_is_soft(asked, quoted.value),), below
    if asked.medium == _ELASTIC and quoted.value > _STIFF and ratio >= _SAID:
        return quoted, (_is_stiff(asked, quoted.value),), below
    return quoted, (), below


def _withheld(quoted: Quoted, doubt: Remark) -> Quoted:
    """What is quoted in doubt: nothing, and why."""
    nothing = {"value": None, "standard_error": None, "source": None}
    return replace(quoted, **nothing, reason=doubt.text, kind=doubt.kind, remedy=doubt.remedy)


def _of_other_half(asked: Asked) -> float | None:
    """E* (Pa) of the other segment by the same fit, with a first contact of its own; None for others.

    Of a range that a person has chosen, or of a contact that is held, there is no other half.
    """
    free = {"E_star", "contact_point", "baseline"}
    given, other = asked.arguments, asked.other
    if asked.medium != _ELASTIC or any(given.get(name, 0.0) is not None for name in free):
        return None
    if other is None or np.count_nonzero(other) < _FEW:
        return None
    try:
        time = asked.time[other] if asked.needs_time else None
        found = mdr.fit_indentation(
            asked.profile, asked.depth[other], asked.force[other], time=time, **given
        )
    except ValueError:
        return None
    E, error = float(found.medium.E_star), float(found.standard_errors["E_star"])
    return E if error <= _VAGUE * E else None


def _differs(part: str, other: float, ratio: float) -> Remark:
    rest = {"loading": "unloading", "unloading": "loading"}[part]
    text = f"of the {part}; the {rest} alone gives {written(other, 'pressure', 2)}, {ratio:.2g} times: "
    return Remark(f"{text}the sample yields, sticks or loses energy", "unloading")


def _not_elastic() -> Remark:
    text = "loading and unloading differ by a factor of ten or more in E*, and an elastic sample has one: "
    remedy = (Remedy("class", "a"),)
    return Remark(f"{text}choose the kind of a sample that yields", "unloading", remedy=remedy)


def _too_soft(asked: Asked, E: float) -> Remark:
    text = "E* comes out below 1 MPa, which no glass, metal or ceramic has: "
    units, remedy = _units(asked, E, _SOFT, 2e12)
    return Remark(f"{text}{units}, or choose another kind of sample", "units", remedy=remedy)


def _is_soft(asked: Asked, E: float) -> Remark:
    units, remedy = _units(asked, E, _SOFT, 2e12)
    return Remark(f"few samples of constant hardness are so soft: {units}", "units", remedy=remedy)


def _is_stiff(asked: Asked, E: float) -> Remark:
    units, remedy = _units(asked, E, 0.0, _STIFF)
    return Remark(f"few gels, cells and rubbers are so stiff: {units}", "units", remedy=remedy)


def _units(asked: Asked, E: float, least: float, most: float) -> tuple[str, tuple[Remedy, ...]]:
    """Which unit to look at, in words and as remedies: that with which E* would be plausible."""
    too_soft = least > 0
    size = 1 / _THOUSAND if too_soft else _THOUSAND
    # The tip alone tells how E* depends on a depth in another unit.
    depth = float(np.ptp(asked.depth[asked.used]))
    depths = np.minimum([depth, size * depth], asked.profile.known_depth)
    forces = mdr.indent(asked.profile, mdr.Medium(1.0), depths).force
    of_depth, of_force = E * forces[0] / forces[1], E / size
    likely = {"depth": of_depth, "force": of_force}
    names = [name for name, value in likely.items() if least <= value <= most] or list(likely)
    units = dict(zip(("depth", "force"), asked.units, strict=True))
    told = " and ".join(f"{name} in {units[name]}" if units[name] else name for name in names)
    text = f"look at the unit{'s' * (len(names) > 1)} of {' and '.join(names)}"
    if any(units[name] for name in names):
        text = f"the file is read with {told}; {text}"
    return text, tuple(Remedy("unit", name) for name in names)
