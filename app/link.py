"""States as links: defaults are left out, and links are read as hostile input."""

import re
from collections.abc import Callable
from math import isfinite, isinf, nan
from typing import Any
from urllib.parse import parse_qsl, urlencode

from .plots import PLOTS
from .quantities import CHOICES, QUANTITIES
from .state import (
    LAST_PROGRESS,
    OF_EXTRAS,
    OPENING,
    PRESETS,
    State,
    checked,
    preset_state,
    used,
    with_derived,
)
from .tip import MAX_SAMPLES

#: Limits of a link: characters, values, names in a list, characters of a text.
MAX_LENGTH, _MAX_VALUES, _MAX_NAMES, _MAX_TEXT = 8000, 100, 12, 300
_LISTS = ("tiles",)
#: Names of version 0.6 for values of extras, which add theirs, with their present names.
FORMER: dict[str, str] = {}
#: What version 0.6 had and is gone: left out in silence.
_GONE = {"frame_compliance", "loglog"}
#: Names that mail programs and search engines append to links.
_APPENDED = re.compile(
    r"utm_.*|\w*clk?id|gclsrc|[gw]braid|igsh(id)?|mc_[ce]id|_ga|_gl|_hs\w+|li_fat_id|srsltid|bokeh-.*"
    r"|mkt_tok|mibextid|si|vero_id|ref",
    re.IGNORECASE,
)
#: Presets of version 0.6 that had a paraboloid for a ball, and what else their links do not say.
_FORMER_PRESETS = {"striker-glass_epoxy": "ball-glass_epoxy", "striker-epoxy-elastic": "ball-epoxy-elastic"}
_FORMER_BALL = {"shape": "paraboloid", "paraboloid_radius": "0.008", "mass": "1"}


def write(state: State) -> str:
    """State as a query. Raises ValueError if it is too long."""
    start = preset_state(state.preset)
    others = [name for name, default in OF_EXTRAS.items() if default is not None and name not in CHOICES]
    names = [*CHOICES, *dict.fromkeys([*used(state), *others]), *_LISTS]
    pairs = {"preset": state.preset} if state.preset != OPENING else {}
    pairs |= {name: _text(state[name]) for name in names if state[name] not in (start[name], None)}
    pairs |= {"at": f"{state.progress:.6g}"} if state.progress != 1 else {}
    if state.shape == "sampled":
        pairs["samples"] = " ".join(f"{r!r},{z!r}" for r, z in zip(*state.samples, strict=True))
    pairs |= {"dark": "1"} if state.dark else {}
    query = urlencode(pairs, safe=",*")
    if len(query) > MAX_LENGTH:
        raise ValueError("there are too many samples in this scene for a link")
    return query


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return " ".join(value)
    return value if isinstance(value, str) else repr(value)


def _known(name: str) -> bool:
    return name in (*CHOICES, *QUANTITIES, *OF_EXTRAS, *FORMER, *_GONE, *_LISTS, "samples", "at", "dark")


def unknown(query: str) -> list[str]:
    """Names in a query that no version has, without those that are appended to links on their way."""
    pairs = dict(parse_qsl(query, keep_blank_values=True))
    names = [name for name in pairs if not (_known(name) or _APPENDED.fullmatch(name))]
    names += [tile for tile in pairs.get("tiles", "").split() if tile not in (*PLOTS, *_GONE)]
    held = pairs.get("held.scenes", pairs.get("hold", ""))
    return names + [name for query in held.split() for name in unknown(query)]


def read(query: str) -> State:
    """State of a query, of this version or 0.6; ValueError if it is invalid.

    What is not known is left out.
    """
    values = [pair for pair in parse_qsl(query, keep_blank_values=True) if _known(pair[0])]
    if len(values) > _MAX_VALUES or sum(len(text) for _, text in values) > MAX_LENGTH:
        raise ValueError("this link is too long")
    pairs = dict(values)
    if len(pairs) < len(values):
        raise ValueError("this link sets a value twice")
    key = pairs.pop("preset", OPENING)
    if key in _FORMER_PRESETS:
        pairs = _FORMER_BALL | pairs
        key = _FORMER_PRESETS[key]
    if key not in PRESETS:
        raise ValueError("this link names no preset that is known")
    changes = dict(
        _value(FORMER.get(name, name), text) for name, text in pairs.items() if name not in _GONE
    )
    state = preset_state(key).replace(**changes)
    for reason in (check(state) for check in CHECKS):
        if reason:
            raise ValueError(reason)
    return with_derived(state)


def _wrong(state: State) -> str:
    if not 0 <= state.progress <= LAST_PROGRESS:
        return f"at in this link is not in 0 to {LAST_PROGRESS}"
    if state.shape == "sampled" and not state.samples:
        return "this link has a measured tip without samples"
    missing = any(state[name] is None for name in used(state))
    return "this link has a shape without its numbers" * missing


#: Reasons to refuse a state, or none; extras add theirs.
CHECKS: list[Callable[[State], str]] = [_wrong]


def _value(name: str, text: str) -> tuple[str, Any]:
    """Name and value of a state from a pair of a link."""
    if not text.strip() and name in (*CHOICES, *QUANTITIES, "at"):
        raise ValueError(f"{name:.40} in this link has no value")
    if name in CHOICES and text in CHOICES[name]:
        return name, text
    if name in QUANTITIES:
        return name, checked(name, _number(name, text))
    if name in _LISTS:
        return name, tuple(plot for plot in text.split()[:_MAX_NAMES] if plot in PLOTS)
    if isinstance(OF_EXTRAS.get(name), tuple):
        return name, tuple(each for each in text.split()[:_MAX_NAMES] if each not in _GONE)
    if name == "dark":
        return name, text == "1"
    if name == "samples":
        return name, _samples(text)
    if name == "at":
        return "progress", _number(name, text)
    if name in OF_EXTRAS and name not in CHOICES:
        return name, text[:_MAX_TEXT]
    raise ValueError(f"{name:.40} = {text:.40} in this link is not known")


def _samples(text: str) -> tuple[tuple[float, ...], ...]:
    rows = [
        [_number("samples", cell) for cell in row.split(",")] for row in text.split()[: MAX_SAMPLES + 1]
    ]
    if len(rows) > MAX_SAMPLES or {len(row) for row in rows} != {2}:
        raise ValueError(f"the samples in this link are not at most {MAX_SAMPLES} pairs")
    return tuple(zip(*rows, strict=True))


def _number(name: str, text: str) -> float:
    try:
        value = float(text) if len(text) <= 40 else nan
    except ValueError:
        value = nan
    if not isfinite(value):
        wrong = "too large" if isinf(value) else "not a number"
        raise ValueError(f"{name:.40} = {text:.40} in this link is {wrong}")
    return value
