"""States as links: defaults are left out, and links are read as hostile input."""

import re
from math import atan2, hypot, isfinite, isinf, nan
from typing import Any
from urllib.parse import parse_qsl, urlencode

from . import LAST_PROGRESS, OPENING, PRESETS, State, checked, medium, preset_state, used, with_derived
from .files import FITTED, MAX_SAMPLES
from .quantities import CHOICES, QUANTITIES

#: Limits of a link: characters, values, held scenes, plots.
MAX_LENGTH, _MAX_VALUES, MAX_HELD, _MAX_TILES = 8000, 100, 4, 12
_LISTS = ("hold", "tiles", "fixed")
#: Names and options of earlier versions with their present names, and names that are ignored.
_RENAMED = {"plots": "tiles", "tau": "eta", "rigid_tip": "modulus", "tangential_speed": "incoming_speed"}
_IGNORED = re.compile(
    "called|references|axes|heights|keep|inertia|surface|noise|sweep_.*|.*_(from|to|compliance)"
)
#: Names that mail programs and search engines append to links.
_APPENDED = re.compile(
    r"utm_.*|\w*clk?id|gclsrc|[gw]braid|igsh(id)?|mc_[ce]id|_ga|_gl|_hs\w+|li_fat_id|srsltid|bokeh-.*"
    r"|mkt_tok|mibextid|si|vero_id|ref",
    re.IGNORECASE,
)
#: Presets of version 0.6 that had a paraboloid for a ball, and what else their links do not say.
_FORMER_PRESETS = {"striker-glass_epoxy": "ball-glass_epoxy", "striker-epoxy-elastic": "ball-epoxy-elastic"}
_FORMER_BALL = {"shape": "paraboloid", "paraboloid_radius": "0.008", "mass": "1"}
#: Choices and options of earlier versions, with the number that they had and its default.
_FORMER = {
    ("damping", "tau"): ("tau", "0.001"), ("aim", "components"): ("tangential_speed", "1"),
    ("surface", "imprint"): ("plastic_depth", "1e-06"), ("noise", "given"): ("depth_noise", "1e-10"),
}  # fmt: skip
_FORMER_NUMBERS = ("aim", "tau", "tangential_speed")


def write(state: State) -> str:
    """State as a query. Raises ValueError if it is too long."""
    start = preset_state(state.preset)
    numbers = [*used(state), *FITTED[2:], "depth_noise"]
    changed = {n for n in (*CHOICES, *numbers, *_LISTS, "dark", "fit_note") if state[n] != start[n]}
    pairs = {"preset": state.preset} if state.preset != OPENING else {}
    pairs |= {name: state[name] for name in CHOICES if name in changed}
    pairs |= {name: repr(state[name]) for name in numbers if name in changed and state[name] is not None}
    pairs |= {"at": f"{state.progress:.6g}"} if state.progress != 1 else {}
    if state.shape == "sampled":
        pairs["samples"] = " ".join(f"{r!r},{z!r}" for r, z in zip(*state.samples, strict=True))
    pairs |= {name: " ".join(state[name]) for name in _LISTS if name in changed}
    pairs |= {"dark": "1"} if "dark" in changed else {}
    pairs |= {"fit_note": state.fit_note} if "fit_note" in changed else {}
    query = urlencode(pairs, safe=",*")
    if len(query) > MAX_LENGTH:
        raise ValueError("there are too many samples in this scene for a link")
    return query


def _known(name: str) -> bool:
    former = name in _RENAMED or name in _FORMER_NUMBERS or _IGNORED.fullmatch(name)
    own = (*CHOICES, *QUANTITIES, *_LISTS, "samples", "at", "dark", "fit_note")
    return bool(former) or name in own


def unknown(query: str) -> list[str]:
    """Names in a query that no version has, without those that are appended to links on their way."""
    pairs = dict(parse_qsl(query, keep_blank_values=True))
    names = [name for name in pairs if not (_known(name) or _APPENDED.fullmatch(name))]
    return names + [name for held in pairs.get("hold", "").split() for name in unknown(held)]


def read(query: str) -> State:
    """State of a query, of this version or an earlier one; ValueError if it is invalid.

    What is not known is left out.
    """
    values = [pair for pair in parse_qsl(query, keep_blank_values=True) if _known(pair[0])]
    if len(values) > _MAX_VALUES or sum(len(text) for _, text in values) > MAX_LENGTH:
        raise ValueError("this link is too long")
    pairs = dict(values)
    if len(pairs) < len(values):
        raise ValueError("this link sets a value twice")
    key = _preset(pairs.pop("preset", OPENING))
    if key in _FORMER_PRESETS:
        pairs = _FORMER_BALL | pairs
    state = preset_state(_FORMER_PRESETS.get(key, key))
    for (name, option), (number, default) in _FORMER.items():
        if pairs.get(name) == option:
            pairs.setdefault(number, default)
    former = {name: pairs.pop(name, "") for name in _FORMER_NUMBERS}
    changes = dict(_value(*pair) for pair in pairs.items() if not _IGNORED.fullmatch(pair[0]))
    state = _converted(state.replace(**changes), pairs, former)
    missing = [name for name in used(state) if state[name] is None]
    for wrong, message in (
        (not 0 <= state.progress <= LAST_PROGRESS, f"at in this link is not in 0 to {LAST_PROGRESS}"),
        (len(state.hold) > MAX_HELD, f"more than {MAX_HELD} scenes are held in this link"),
        (not set(state.fixed) <= set(FITTED), "what a fit leaves as it is, in this link, is not known"),
        (state.shape == "sampled" and not state.samples, "this link has a measured tip without samples"),
        (missing, "this link has a shape without its numbers"),
    ):
        if wrong:
            raise ValueError(message)
    return with_derived(state)


def _converted(state: State, pairs: dict[str, str], former: dict[str, str]) -> State:
    """State with numbers of earlier versions: a relaxation time, a rigid tip, components of a speed."""
    if pairs.get("elasticity") == "rigid_tip":
        state = state.replace(E_star=state.E_1 / (1 - state.nu_1**2))
    if pairs.get("damping") == "tau":
        tau = _number("tau", former["tau"])
        state = state.replace(eta=checked("eta", tau * medium(state).E_star / 4))
    if former["aim"] == "components":
        along = _number("tangential_speed", former["tangential_speed"])
        state = state.replace(incoming_speed=checked("incoming_speed", hypot(state.speed, along)))
        state = state.replace(attack=checked("attack", atan2(state.speed, along)))
    return state


def _preset(text: str) -> str:
    """Key of a preset; version 0.3 used labels."""
    key = {preset.label: key for key, preset in PRESETS.items()}.get(text, text)
    if not key:
        raise ValueError("a scene that version 0.3 took from a file has to be set anew")
    if key not in PRESETS and key not in _FORMER_PRESETS:
        raise ValueError("this link names no preset that is known")
    return key


def _value(name: str, text: str) -> tuple[str, Any]:
    """Name and value of a state from a pair of a link."""
    name = _RENAMED.get(name, name)
    if name in CHOICES and _RENAMED.get(text, text) in CHOICES[name]:
        return name, _RENAMED.get(text, text)
    if not text.strip() and name in (*CHOICES, *QUANTITIES, "at"):
        raise ValueError(f"{name:.40} in this link has no value")
    if name in QUANTITIES:
        return name, checked(name, _number(name, text))
    if name in _LISTS:
        return name, tuple(n for n in text.split()[:_MAX_TILES] if not _IGNORED.fullmatch(n))
    if name == "dark":
        return name, text == "1"
    if name == "samples":
        rows = [[_number(name, cell) for cell in row.split(",")] for row in text.split()[: MAX_SAMPLES + 1]]
        if len(rows) > MAX_SAMPLES or {len(row) for row in rows} != {2}:
            raise ValueError(f"the samples in this link are not at most {MAX_SAMPLES} pairs")
        return name, tuple(zip(*rows, strict=True))
    if name == "at":
        return "progress", _number(name, text)
    if name == "fit_note":
        return name, text[:300]
    raise ValueError(f"{name:.40} = {text:.40} in this link is not known")


def _number(name: str, text: str) -> float:
    try:
        value = float(text) if len(text) <= 40 else nan
    except ValueError:
        value = nan
    if not isfinite(value):
        wrong = "too large" if isinf(value) else "not a number"
        raise ValueError(f"{name:.40} = {text:.40} in this link is {wrong}")
    return value
