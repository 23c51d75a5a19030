"""States as links: defaults are left out, and links are read as hostile input."""

from math import isfinite, isinf, nan
from typing import Any
from urllib.parse import parse_qsl, urlencode

from .extra import EXTRAS, Pairs
from .plots import PLOTS
from .quantities import CHOICES, QUANTITIES
from .state import (
    OF_EXTRAS,
    OPENING,
    PRESETS,
    State,
    checked,
    preset_state,
    used,
)
from .tip import MAX_SAMPLES

#: Progress at the end: 0 first contact, 1 largest depth, 2 loss of contact, 2.2 indenter at the
#: height of the undeformed surface.
LAST_PROGRESS = 2.2
#: Most characters of a link and of a text in it, and most names in a list.
MAX_LENGTH, _MAX_TEXT, _MAX_NAMES = 8000, 300, 12


def write(state: State) -> str:
    """State as a query. Raises ValueError if it is too long."""
    start = preset_state(state.preset)
    of_extras = [name for name, default in OF_EXTRAS.items() if default is not None]
    names = dict.fromkeys([*CHOICES, *used(state), *of_extras, "tiles", "dark"])
    pairs = {"preset": state.preset} if state.preset != OPENING else {}
    pairs |= {name: _text(state[name]) for name in names if state[name] not in (start[name], None)}
    pairs |= {"at": f"{state.progress:.6g}"} if state.progress != 1 else {}
    if state.shape == "sampled":
        pairs["samples"] = " ".join(f"{r!r},{z!r}" for r, z in zip(*state.samples, strict=True))
    query = urlencode(pairs, safe=",*")
    if len(query) > MAX_LENGTH:
        raise ValueError("there are too many samples in this scene for a link")
    return query


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return " ".join(value)
    if isinstance(value, bool):
        return str(int(value))
    return value if isinstance(value, str) else repr(value)


def translated(query: str) -> Pairs:
    """Names and values of a link, in the names of today."""
    found = parse_qsl(query, keep_blank_values=True)
    for extra in EXTRAS.values():
        found = extra.translated(found)
    return found


def _known(name: str) -> bool:
    others = name in ("tiles", "samples", "at", "dark") or OF_EXTRAS.get(name) is not None
    return others or name in CHOICES or name in QUANTITIES


def unknown(query: str) -> list[str]:
    """Names in a link that no version has."""
    pairs = dict(translated(query))
    tiles = pairs.get("tiles", "").split()
    return [name for name in pairs if not _known(name)] + [tile for tile in tiles if tile not in PLOTS]


def read(query: str) -> State:
    """State of a link, without what is not known in it. Raises ValueError if a value is invalid."""
    values = [(name, text) for name, text in translated(query) if _known(name)]
    if sum(len(text) for _, text in values) > MAX_LENGTH:
        raise ValueError("this link is too long")
    pairs = dict(values)
    if len(pairs) < len(values):
        raise ValueError("this link sets a value twice")
    key = pairs.pop("preset", OPENING)
    if key not in PRESETS:
        raise ValueError("this link names no preset that is known")
    state = preset_state(key).replace(**dict(_value(*pair) for pair in pairs.items()))
    for reason in (_wrong(state), *(extra.check(state) for extra in EXTRAS.values())):
        if reason:
            raise ValueError(reason)
    return state


def _wrong(state: State) -> str:
    if not 0 <= state.progress <= LAST_PROGRESS:
        return f"at in this link is not in 0 to {LAST_PROGRESS}"
    if state.shape == "sampled" and not state.samples:
        return "this link has a measured tip without samples"
    missing = any(state[name] is None for name in used(state))
    return "this link has a shape without its numbers" * missing


def _value(name: str, text: str) -> tuple[str, Any]:
    """Name and value of a state from a pair of a link."""
    if not text.strip() and name in (*CHOICES, *QUANTITIES, "at"):
        raise ValueError(f"{name:.40} in this link has no value")
    if name in QUANTITIES:
        return name, checked(name, _number(name, text))
    if name == "at":
        return "progress", _number(name, text)
    if name == "samples":
        return name, _samples(text)
    if name in CHOICES and text not in CHOICES[name].options:
        raise ValueError(f"{name:.40} = {text:.40} in this link is not known")
    default = State()[name]
    if isinstance(default, bool):
        return name, text == "1"
    if isinstance(default, tuple):
        names = text.split()[:_MAX_NAMES]
        return name, tuple(each for each in names if name != "tiles" or each in PLOTS)
    return name, text[:_MAX_TEXT]


def _samples(text: str) -> tuple[tuple[float, ...], ...]:
    rows = [
        [_number("samples", cell) for cell in row.split(",")] for row in text.split()[: MAX_SAMPLES + 1]
    ]
    if len(rows) > MAX_SAMPLES or {len(row) for row in rows} != {2}:
        raise ValueError(f"the samples in this link are not at most {MAX_SAMPLES} pairs")
    return tuple(zip(*rows, strict=True))


def _number(name: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not isfinite(value):
        wrong = "too large" if isinf(value) else "not a number"
        raise ValueError(f"{name:.40} = {text:.40} in this link is {wrong}")
    return value
