"""States as links: defaults are left out, and links are read as hostile input."""

from math import inf, isfinite
from typing import Any
from urllib.parse import parse_qsl, urlencode

from . import LAST_PROGRESS, OPENING, PRESETS, State, checked, preset_state, used, with_derived
from .files import FITTED, MAX_SAMPLES
from .quantities import CHOICES, QUANTITIES, SHAPES, USED

#: Limits of a link: characters, values, held scenes, plots.
MAX_LENGTH, _MAX_VALUES, MAX_HELD, _MAX_TILES = 8000, 100, 4, 12
_OPTIONS = {"shape": SHAPES} | CHOICES
_FLAGS, _LISTS = ("dark", "keep"), ("hold", "tiles", "fixed")
#: Names of version 0.3 with their present names, and names that are ignored.
_RENAMED, _IGNORED = (
    {"plots": "tiles"},
    ("called", "sweep_low", "sweep_high", "references", "axes", "heights"),
)


def write(state: State, form: tuple[str, ...]) -> str:
    """State as a query; `form` has the choices of the drive. Raises ValueError if it is too long."""
    start = preset_state(state.preset)
    numbers = [*used(state, form), *FITTED[2:], *USED["noise"][state.noise]]
    changed = {n for n in (*_OPTIONS, *numbers, *_FLAGS, *_LISTS, "fit_note") if state[n] != start[n]}
    pairs = {"preset": state.preset} if state.preset != OPENING else {}
    pairs |= {name: state[name] for name in _OPTIONS if name in changed}
    pairs |= {name: repr(state[name]) for name in numbers if name in changed and state[name] is not None}
    pairs |= {"at": f"{state.progress:.6g}"} if state.progress != 1 else {}
    if state.shape == "sampled":
        pairs["samples"] = " ".join(f"{r!r},{z!r}" for r, z in zip(*state.samples, strict=True))
    pairs |= {name: " ".join(state[name]) for name in _LISTS if name in changed}
    pairs |= {name: "1" for name in _FLAGS if name in changed}
    pairs |= {"fit_note": state.fit_note} if "fit_note" in changed else {}
    query = urlencode(pairs, safe=",*")
    if len(query) > MAX_LENGTH:
        raise ValueError("there are too many samples in this scene for a link")
    return query


def read(query: str) -> State:
    """State of a query, of this version or an earlier one; ValueError if it is invalid."""
    values = parse_qsl(query[: 3 * MAX_LENGTH + 1], keep_blank_values=True)
    if len(values) > _MAX_VALUES or sum(len(text) for _, text in values) > MAX_LENGTH:
        raise ValueError("this link is too long")
    pairs = {_RENAMED.get(name, name): text for name, text in values}
    if len(pairs) < len(values):
        raise ValueError("this link sets a value twice")
    state = preset_state(_preset(pairs.pop("preset", OPENING)))
    state = state.replace(**dict(_value(*pair) for pair in pairs.items() if not _is_ignored(pair[0])))
    missing = [name for name in used(state, ()) if state[name] is None]
    for wrong, message in (
        (
            not 0 <= state.progress <= LAST_PROGRESS,
            f"at in this link is not in 0 to {LAST_PROGRESS}",
        ),
        (len(state.hold) > MAX_HELD, f"more than {MAX_HELD} scenes are held in this link"),
        (not set(state.fixed) <= set(FITTED), "what a fit leaves as it is, in this link, is not known"),
        (state.shape == "sampled" and not state.samples, "this link has a measured tip without samples"),
        (missing, "this link has a shape without its numbers"),
    ):
        if wrong:
            raise ValueError(message)
    return with_derived(state)


def _is_ignored(name: str) -> bool:
    # Version 0.3 had a range for each number that can be swept.
    return name in _IGNORED or name.endswith(("_from", "_to"))


def _preset(text: str) -> str:
    """Key of a preset; version 0.3 used labels."""
    key = {preset.label: key for key, preset in PRESETS.items()}.get(text, text)
    if not key:
        raise ValueError("a scene that version 0.3 took from a file has to be set anew")
    if key not in PRESETS:
        raise ValueError("this link names no preset that is known")
    return key


def _value(name: str, text: str) -> tuple[str, Any]:
    """Name and value of a state from a pair of a link."""
    if name in _OPTIONS and text in _OPTIONS[name]:
        return name, text
    if name in QUANTITIES:
        return name, checked(name, _number(name, text))
    if name in _LISTS:
        return name, tuple(text.split()[:_MAX_TILES])
    if name in _FLAGS:
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
        value = float(text) if len(text) <= 40 else inf
    except ValueError:
        value = inf
    if not isfinite(value):
        raise ValueError(f"{name:.40} = {text:.40} in this link is not a number")
    return value
