"""Changes of a state: functions that return another state or raise ValueError."""

from collections.abc import Callable
from typing import Any

import numpy as np

import mdr_core as mdr

from ..common.quantities import CHOICES, QUANTITIES
from .drives import DRIVES, follow, turning_point
from .plots import PLOTS
from .state import PRESETS, VIEW, State, checked, kept_extras, medium, preset_state, yield_constant

#: Constants of the hardness; the index is the power of the contact radius in the constant.
CONSTANTS = ("volume_hardness", "q_c", "f_c")
#: Points of a grid in the search for a change of sign.
_GRID = 81


def options(state: State, name: str) -> list[str]:
    """Return the applicable options of a choice, with the default first."""
    for plot in PLOTS.values():
        if name in plot.controls:
            return plot.options_of(state, name)
    # The user must load a measured tip first.
    return [each for each in CHOICES[name].options if each != "sampled" or state.samples]


def option(state: State, name: str) -> str:
    """Return the chosen option of a choice, or the first option if the chosen option does not apply."""
    chosen, known = state[name], options(state, name)
    return chosen if chosen in known else known[0]


def choose(state: State, name: str, wanted: str) -> State:
    """Change the option of a choice, and convert numbers so that they keep their meaning."""
    known = options(state, name)
    if wanted not in known:
        raise ValueError(f"{wanted!r:.40} is not one of {', '.join(known)}")
    if name == "preset":
        return preset_state(wanted, tiles=state.tiles, dark=state.dark, **kept_extras(state))
    if wanted == option(state, name):
        return state
    # Another drive opens at its largest depth: a state after unloading has no contact.
    view = {"at": VIEW["at"]} if name == "drive" else {}
    changed = state.replace(**{name: wanted}, **view)
    convert = _CONVERT.get(name)
    numbers = convert(state, wanted) if convert else DRIVES[state.drive].converted(state, name, wanted)
    for number, value in numbers.items():
        changed = set_value(changed, number, value)
    return changed


def set_value(state: State, name: str, value: float) -> State:
    """Set a number: E* of two bodies by their moduli, q_c of a hardness at a radius by the hardness."""
    given = {name: checked(name, value)}
    if name == "E_star" and state.elasticity == "bodies":
        given = _moduli(state, value)
    elif name == "q_c" and state.plasticity == "hardness":
        given = {"hardness": value / state.hardness_radius}
    return state.replace(**{each: checked(each, number) for each, number in given.items()})


def _moduli(state: State, E_star: float) -> dict[str, float]:
    """Return moduli of two bodies with an effective modulus, Popov (2015), Eq. (2)."""
    compliance = 1 / E_star - (1 - state.nu_2**2) / state.E_2
    if compliance > 0.01 / E_star:
        return {"E_1": (1 - state.nu_1**2) / compliance}
    return {"E_1": 2 * E_star * (1 - state.nu_1**2), "E_2": 2 * E_star * (1 - state.nu_2**2)}


def with_tile(state: State, name: str) -> State:
    """Replace the optional plot by another plot, or by none; the new plot is large if a plot is large."""
    shown = "" if state.large in state.tiles else state.large
    return state.replace(tiles=(name,) if name else (), large=name if name and state.large else shown)


def take_tip(state: State, samples: tuple[Any, Any], note: str) -> State:
    """Use samples of a measured tip as the indenter; the depth is at most half their range."""
    tip = mdr.Sampled(*samples)
    depth = min(state.max_depth, float(f"{tip.known_depth / 2:.3g}"))
    return state.replace(samples=(tip.r, tip.z), tip_note=note, shape="sampled", max_depth=depth)


def repeat_impact(state: State) -> State:
    """Let the body hit its own imprint."""
    hit = follow(state).hit
    if hit is None or not hit.plastic_depth_increase > 0:
        raise ValueError("nothing has yielded further: the next impact equals this impact")
    return set_value(state, "plastic_depth", float(hit.plastic_depth))


# Numbers that keep their meaning under another option of a choice.


def shown(value: float) -> float:
    """Round a computed number to the five digits of its field, so that the page uses the shown number."""
    return float(f"{value:.5g}")


def equivalent(state: State, drive: str) -> dict[str, float]:
    """Return numbers of a drive that lead to the present largest depth."""
    numbers = DRIVES[drive].equivalent(state, turning_point(state))
    return {name: shown(value) for name, value in numbers.items()}


def _shape(state: State, shape: str) -> dict[str, float]:
    """Return missing numbers of a shape, from the present shape or as multiples of the contact radius."""
    numbers = {}
    radius = float(turning_point(state).contact_radius)
    for name in (each for each in CHOICES["shape"].options[shape].uses if state[each] is None):
        known = QUANTITIES[name]
        size = known.default * radius if known.kind == "length" else known.default
        present = getattr(state, state.shape + name.removeprefix(shape), None)
        numbers[name] = present or known.bounded(float(f"{size:.2g}"))
    return numbers


def _plasticity(state: State, wanted: str) -> dict[str, float]:
    """Return the constant (and the radius of a hardness) that keep the hardness at the contact radius.

    If nothing yields, the hardness comes from the class of the preset.
    """
    if wanted == "none":
        return {}
    if state.plasticity == "none":
        state = state.replace(plasticity=PRESETS[state.preset].values["plasticity"])
    a = float(turning_point(state).contact_radius)
    (name,) = yield_constant(state.replace(plasticity=wanted))
    value = state[name]
    if name not in yield_constant(state):
        value = shown(float(medium(state).hardness_at(a)) * a ** CONSTANTS.index(name))
    radius = {"hardness_radius": float(f"{a:.1g}")} if wanted == "hardness" else {}
    return radius | {name: value}


def _damping(state: State, wanted: str) -> dict[str, float]:
    """Return a viscosity with a relaxation time of 1/30 of the course: visible, but not dominant."""
    if wanted != "eta":
        return {}
    course = follow(state)
    tau = float(course.motion.time[-1]) / 30 if course.motion is not None else 1e-4
    return {"eta": float(f"{tau * state.E_star / 4:.2g}")}


#: Conversions by choices of the page; a drive converts its choices itself.
_CONVERT: dict[str, Callable[[State, str], dict[str, float]]] = {
    "shape": _shape,
    "elasticity": lambda state, wanted: {"E_star": state.E_star},
    "plasticity": _plasticity,
    "damping": _damping,
    "drive": equivalent,
}


def crossing(function, low, high):
    """Return the smallest number between two positive bounds at which a function changes sign, or None.

    Two grids of equal ratios leave an error of 10⁻³, and a chord then leaves 10⁻⁶. Calls with arrays are
    much faster than calls with single numbers.
    """
    for _ in range(2):
        numbers = np.geomspace(low, high, _GRID)
        values = function(numbers)
        changes = np.flatnonzero(values[:-1] * values[1:] < 0)
        if not changes.size:
            return None
        first = changes[0]
        low, high = numbers[first : first + 2]
    return low + (high - low) * values[first] / (values[first] - values[first + 1])
