"""Changes of a state: functions that return another state or raise ValueError."""

from collections.abc import Callable
from typing import Any

import mdr_core as mdr

from .drives import DRIVES, follow, turning_point
from .quantities import CHOICES, QUANTITIES, SHAPES, shape_quantities
from .state import PRESETS, YIELD_CONSTANT, State, altered, checked, medium, preset_state, with_derived

#: Options of a choice that apply to a state, the default first, where these are not all; extras add theirs.
OFFERED: dict[str, Callable[[State], list[str]]] = {
    "shape": lambda state: [shape for shape in SHAPES if shape != "sampled" or state.samples],
}
#: The power of the contact radius in the constants of the hardness.
_POWER = {"volume_hardness": 0, "q_c": 1, "f_c": 2}


def options(state: State, name: str) -> list[str]:
    """Applicable options of a choice, the default first."""
    return OFFERED[name](state) if name in OFFERED else list(CHOICES[name])


def option(state: State, name: str) -> str:
    """Option of a choice; the first one if the chosen one does not apply."""
    chosen, known = state[name], options(state, name)
    return chosen if chosen in known else known[0]


def choose(state: State, name: str, wanted: str) -> State:
    """Take another option of a choice, with numbers converted to keep their meaning."""
    known = options(state, name)
    if wanted not in known:
        raise ValueError(f"{wanted!r:.40} is not one of {', '.join(known)}")
    if name == "preset" and (wanted != state.preset or altered(state)):
        return _preset(state, wanted)
    if wanted == option(state, name):
        return state
    numbers = CONVERT[name](state, wanted) if name in CONVERT else {}
    numbers = {k: checked(k, shown(v)) if k in QUANTITIES else v for k, v in numbers.items()}
    changed, made = state.replace(**{name: wanted}, **numbers), medium(state)
    if name == "elasticity":
        return put(changed, "E_star", made.E_star)
    if name == "plasticity" and wanted != "none":
        return _same_hardness(state, changed)
    return with_derived(changed)


def shown(value: float) -> float:
    """A number that is found, with the five digits that its field shows: the one that is used."""
    return float(f"{value:.5g}")


def put(state: State, name: str, value: float) -> State:
    """Set a number; E* of two bodies through their moduli, q_c of a hardness through the hardness."""
    value = checked(name, value)
    if name == "E_star" and state.elasticity != "modulus":
        moduli = {each: checked(each, modulus) for each, modulus in _moduli(state, value).items()}
        return with_derived(state.replace(**moduli))
    if name == "q_c" and state.plasticity == "hardness":
        name, value = "hardness", checked("hardness", value / state.hardness_radius)
    return with_derived(state.replace(**{name: value}))


def _moduli(state: State, E_star: float) -> dict[str, float]:
    """Moduli with an effective modulus, Popov (2015), Eq. (2)."""
    other = (1 - state.nu_2**2) / state.E_2 if state.elasticity == "bodies" else 0.0
    compliance = 1 / E_star - other
    if compliance > 0.01 / E_star:
        return {"E_1": (1 - state.nu_1**2) / compliance}
    return {"E_1": 2 * E_star * (1 - state.nu_1**2), "E_2": 2 * E_star * (1 - state.nu_2**2)}


def take_tip(state: State, samples: tuple[Any, Any], note: str) -> State:
    """Use samples of a measured tip as the indenter; the depth is limited to their range."""
    tip, more = mdr.Sampled(*samples), {}
    if state.max_depth > tip.known_depth:
        more["max_depth"] = float(f"{tip.known_depth / 2:.3g}")
    return state.replace(samples=(tip.r, tip.z), tip_note=note, shape="sampled", **more)


def hit_again(state: State, hit: mdr.Impact) -> State:
    """Let the body hit its own imprint."""
    if not hit.plastic_depth_increase > 0:
        raise ValueError("nothing has yielded further: the next impact is the same as this one")
    return state.replace(plastic_depth=checked("plastic_depth", float(hit.plastic_depth)))


def _preset(state: State, key: str) -> State:
    return preset_state(key, tiles=state.tiles, dark=state.dark, **state.extras)


# Numbers that keep their meaning under another option of a choice.


def _shape(state: State, shape: str) -> dict[str, Any]:
    """Initial numbers of a shape: those of the present one, or multiples of the contact radius."""
    if all(state[name] is not None for name, _ in shape_quantities(shape)):
        return {}
    present = {q.name: state[name] for name, q in shape_quantities(state.shape)}
    radius = float(turning_point(state).contact_radius)
    return {
        name: present.get(q.name)
        or q.bounded(float(f"{q.default * radius:.2g}") if q.kind == "length" else q.default)
        for name, q in shape_quantities(shape)
    }


def _same_hardness(state: State, changed: State) -> State:
    """With the constant of its class that gives the hardness of a state at its contact radius.

    Where nothing yields in the state that is the hardness of the class of its preset.
    """
    if state.plasticity == "none":
        state = state.replace(plasticity=PRESETS[state.preset].choices["plasticity"])
    made, (name,) = medium(state), YIELD_CONSTANT[changed.plasticity]
    if name in YIELD_CONSTANT[state.plasticity]:
        return put(changed, name, state[name])
    a = float(turning_point(state).contact_radius)
    return put(changed, name, shown(float(made.hardness_at(a)) * a ** _POWER[name]))


def _plasticity(state: State, wanted: str) -> dict[str, Any]:
    """A hardness is measured at about the present contact radius."""
    if wanted != "hardness":
        return {}
    return {"hardness_radius": float(f"{float(turning_point(state).contact_radius):.1g}")}


def _damping(state: State, wanted: str) -> dict[str, Any]:
    """Viscosity with a relaxation time that shows, and does not rule, over the course."""
    if wanted != "eta":
        return {}
    course = follow(state)
    tau = float(course.motion.time[-1]) / 30 if course.motion is not None else 1e-4
    return {"eta": float(f"{tau * medium(state).E_star / 4:.2g}")}


#: Extras add conversions of their choices.
CONVERT: dict[str, Callable[[State, str], dict[str, Any]]] = {
    "shape": _shape,
    "plasticity": _plasticity,
    "damping": _damping,
    "drive": lambda state, wanted: DRIVES[wanted].equivalent(state, turning_point(state)),
}
