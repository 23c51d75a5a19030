"""States as links: links omit defaults, and the reader does not trust its input."""

import re
from contextlib import suppress
from math import isfinite
from typing import Any
from urllib.parse import parse_qsl, urlencode

from ..common.quantities import CHOICES, QUANTITIES
from ..common.units import in_full
from ..common.upload import MAX_SAMPLES
from .changes import equivalent, set_value
from .courses import LAST_PROGRESS
from .state import (
    LISTS,
    OF_EXTRAS,
    OPENING,
    PRESETS,
    State,
    changed_from_preset,
    checked,
    form_choices,
    numbers_of,
    preset_state,
    regions,
    used,
)

#: Largest numbers of characters of a link, and of a text in it.
MAX_LENGTH, _MAX_TEXT = 8000, 300
#: Names that mail programs, search engines and other sites append to links.
APPENDED = re.compile(
    r"utm_.*|\w*clk?id|gclsrc|[gw]braid|igsh(id)?|mc_[ce]id|_ga|_gl|_hs\w+|li_fat_id|srsltid|bokeh-.*"
    r"|mkt_tok|mibextid|si|vero_id|ref",
    re.IGNORECASE,
)


def write(state: State) -> str:
    """Encode a state as a query, without the browser's theme. Raises ValueError if it is too long."""
    start, sizes = preset_state(state.preset).replace(preset=OPENING), _sizes(state)
    names = dict.fromkeys(["preset", *CHOICES, *used(state), *OF_EXTRAS, "tiles", "at"])
    given = {
        name: _text(state[name])
        for name in names
        if _known(name) and (name in sizes or state[name] != start[name])
    }
    if state.shape == "sampled":
        given["samples"] = " ".join(f"{r},{z}" for r, z in zip(*state.samples, strict=True))
    query = urlencode(given, safe=",*")
    if len(query) > MAX_LENGTH:
        raise ValueError("there are too many samples in this scene for a link")
    return query


def _sizes(state: State) -> set[str]:
    """Return necessary numbers of a drive other than the preset's: they determine the size of the scene."""
    if state.drive == preset_state(state.preset).drive:
        return set()
    return {"mass", "max_depth", "max_force"} & {*numbers_of(state, "drive")}


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return " ".join(value)
    return str(int(value) if isinstance(value, bool) else value)


def pairs(query: str) -> list[tuple[str, str]]:
    """Return names and values of a link, without names that other programs append."""
    given = parse_qsl(query, keep_blank_values=True)
    return [(name, text) for name, text in given if not APPENDED.fullmatch(name)]


def _known(name: str) -> bool:
    others = name in ("tiles", "dark", "samples", "at") or OF_EXTRAS.get(name) is not None
    return others or name in CHOICES or name in QUANTITIES


def unknown(query: str) -> list[str]:
    """Return names in a link that this version does not know, and invalid entries of its lists."""
    found = []
    for name, text in pairs(query):
        if not _known(name):
            found.append(name)
        elif name in LISTS:
            found += [f"{name}={each}" for each in text.split() if not LISTS[name].known(each)]
    return list(dict.fromkeys(found))


def asks_for_theme(query: str) -> bool:
    """Whether a link sets the theme."""
    return "dark" in dict(pairs(query))


def read(query: str) -> State:
    """Decode the state of a link, without its unknown names. Raises ValueError if a value is invalid."""
    known = [(name, text) for name, text in pairs(query) if _known(name)]
    if sum(len(text) for _, text in known) > MAX_LENGTH:
        raise ValueError("this link is too long")
    texts = dict(known)
    if len(texts) < len(known):
        raise ValueError("this link sets a value twice")
    values = {name: _value(name, text) for name, text in texts.items()}
    state = preset_state(values.pop("preset", OPENING)).replace(**values)
    needed = [state[name] for name in used(state)] + [state.samples] * (state.shape == "sampled")
    if any(value in (None, ()) for value in needed):
        raise ValueError("this link has a shape without its numbers")
    if _sizes(state) - values.keys():
        # Set missing numbers like the button of this drive, which keeps the depth.
        before = state.replace(drive=preset_state(state.preset).drive)
        for name, number in equivalent(before, state.drive).items():
            if name not in values:
                state = set_value(state, name, number)
    return state


def _value(name: str, text: str) -> Any:
    """Decode a value of a link by the type of its default. Raises ValueError."""
    if name in CHOICES and text not in CHOICES[name].options:
        raise ValueError(f"{name} = “{text:.40}” in this link is not known")
    if name == "samples":
        return _samples(text)
    default = State()[name]
    if isinstance(default, str):
        return text[:_MAX_TEXT]
    if isinstance(default, bool):
        return text == "1"
    if name in LISTS:
        return _entries(name, text)
    value = _number(name, text)
    if name == "at" and not 0 <= value <= LAST_PROGRESS:
        raise ValueError(f"at = “{text:.40}” in this link must be between 0 and {LAST_PROGRESS}")
    return value if name == "at" else checked(name, value)


def _entries(name: str, text: str) -> tuple[str, ...]:
    known, most = LISTS[name].known, LISTS[name].most
    entries = text.split()
    if len(entries) > most:
        raise ValueError(f"this link has more than {most} entries of {name}")
    return tuple(dict.fromkeys(each for each in entries if known(each)))


def _samples(text: str) -> tuple[tuple[float, ...], ...]:
    rows = [row.split(",") for row in text.split()]
    if len(rows) > MAX_SAMPLES or any(len(row) != 2 for row in rows):
        raise ValueError(f"the samples in this link are not at most {MAX_SAMPLES} pairs")
    return tuple(tuple(_number("samples", cell) for cell in column) for column in zip(*rows, strict=True))


def _number(name: str, text: str) -> float:
    with suppress(ValueError):
        if isfinite(value := float(text)):
            return value
    raise ValueError(f"{name} = “{text:.40}” in this link is not a finite number")


#: Largest number of letters of a file name before its last part; some letters take two of 255 bytes.
_LONGEST = 100


def with_symbol(name: str, value: float) -> str:
    """Format a number of the page with its symbol and all digits."""
    return f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}"


def file_name(state: State, what: str) -> str:
    """Return the file name of a scene: its preset, differences from the preset, and the content.

    Examples
    --------
    >>> from app.explorer.state import preset_state
    >>> file_name(preset_state("berkovich-gold").replace(max_depth=5e-9), "curves.csv")
    'berkovich-gold_d_max=5nm_curves.csv'
    """
    known, preset = changed_from_preset(state), PRESETS[state.preset].values
    parts = [state.preset, *(state[name] for name in known if name in CHOICES)]
    changed = (name for name in used(state) if name in known or name not in preset)
    parts += [with_symbol(name, state[name]).replace("/", "-") for name in changed]
    return re.sub(r"[^\w.=+-]+", "", "_".join(parts))[:_LONGEST] + f"_{what}"


def summary(state: State) -> str:
    """Describe shape, medium and drive of a scene in one line."""
    parts = regions(state)
    names = [*parts["shape"], *parts["medium"], *numbers_of(state, "drive", "damping", "adhesion")]
    numbers = [with_symbol(name, state[name]) for name in names if state[name]]
    chosen = [state.chosen(name).label for name in form_choices(state)]
    return ", ".join([state.chosen("shape").label, *numbers, *chosen])
