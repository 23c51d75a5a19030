"""States as links: defaults are left out, and links are read as hostile input."""

from math import inf, isfinite
from typing import Any
from urllib.parse import parse_qs, quote, unquote, urlencode

import mdr_core as mdr

from ..drives.path import checked as checked_path
from . import LAST_PROGRESS, OPENING, PRESETS, State, checked, preset_state, used, with_derived
from .files import FITTED, MAX_SAMPLES
from .quantities import CHOICES, QUANTITIES, SHAPES, USED

#: Limits of a link: characters, held scenes, characters of a name.
MAX_LENGTH, MAX_HELD, MAX_NAME = 8000, 4, 60
_NAME = "&called="
#: Plots of version 0.3 that no longer exist; they are ignored in links.
_DROPPED_TILES = {"map", "speed", "hodograph"}


def write(state: State, form: tuple[str, ...], view: bool = True) -> str:
    """State as a query; without `view` the scene alone. Raises ValueError if it is too long."""
    start = preset_state(state.preset)
    pairs = {} if state.preset == OPENING else {"preset": state.preset}
    choices = (
        "shape",
        *(each for each in CHOICES if view or each not in ("heights", "references", "axes")),
    )
    pairs |= {name: state[name] for name in choices if state[name] != start[name]}
    numbers = used(state, form)
    if view:
        numbers += [*FITTED[2:], *USED["noise"][state.noise], "sweep_low", "sweep_high"]
    pairs |= {name: repr(state[name]) for name in numbers if state[name] not in (None, start[name])}
    if state.progress != 1:
        pairs["at"] = f"{state.progress:.6g}"
    if state.shape == "sampled":
        pairs["samples"] = " ".join(f"{x!r},{y!r}" for x, y in zip(*state.samples, strict=True))
    if state.drive == "path":
        pairs["path"] = " ".join(",".join(map(repr, row)) for row in state.path)
    if view:
        pairs |= {name: " ".join(state[name]) for name in ("tiles", "hold") if state[name]}
        pairs |= {name: "1" for name in ("dark", "keep") if state[name]}
        pairs |= {"fixed": " ".join(state.fixed)} if state.fixed != start.fixed else {}
        pairs |= {"fit_note": state.fit_note} if state.fit_note else {}
    text = urlencode(pairs, safe=",*")
    if len(text) > MAX_LENGTH:
        raise ValueError("there are too many samples in this scene for a link")
    return text


def with_name(query: str, name: str) -> str:
    """Link of a scene with a name."""
    return query.partition(_NAME)[0] + _NAME + quote(name.strip()[:MAX_NAME], safe="")


def split_name(query: str) -> tuple[str, str]:
    """Link without name, and name."""
    scene, _, name = query.partition(_NAME)
    return scene, unquote(name)[:MAX_NAME]


def arguments(text: str) -> dict[str, list[bytes]]:
    """Query as a request gives it: lists of bytes by name."""
    return {name: [value.encode() for value in values] for name, values in parse_qs(text, True).items()}


def read(arguments: dict[str, list[bytes]]) -> State:
    """State from the arguments of a request, of this version or of 0.3; ValueError if they are invalid."""
    length = sum(len(text) for texts in arguments.values() for text in texts)
    if len(arguments) > 100 or length > MAX_LENGTH:
        raise ValueError("this link is too long")
    if any(len(values) != 1 for values in arguments.values()):
        raise ValueError("this link says the same thing twice")
    pairs = {name: values[0].decode("utf-8", "replace") for name, values in arguments.items()}
    state = preset_state(_preset(pairs.pop("preset", OPENING)))
    changes = _view(pairs) | _scene(pairs)
    known = {"shape": SHAPES} | CHOICES
    for name in known.keys() & pairs.keys():
        changes[name] = wanted = pairs.pop(name)
        if wanted not in known[name] or (wanted == "sampled" and "samples" not in changes):
            raise ValueError(f"{name} = {wanted:.40} in this link is not known")
    if "path" in changes:
        changes["path"] = checked_path(changes["path"], changes.get("prescribed", state.prescribed))
    elif changes.get("drive") == "path":
        raise ValueError("this link has a path without vertices")
    swept = changes.get("swept", state.swept)
    state = state.replace(**changes)
    for name, value in pairs.items():
        # Version 0.3 had a range for each number that can be swept.
        name = {f"{swept}_from": "sweep_low", f"{swept}_to": "sweep_high"}.get(name, name)
        if name.removesuffix("_from").removesuffix("_to") != name:
            continue
        if name not in QUANTITIES and name not in ("sweep_low", "sweep_high"):
            raise ValueError(f"this link sets {name:.40}, which is not known")
        state = state.replace(**{name: checked(state, name, _number(name, value))})
    if any(state[name] is None for name in used(state, ())):
        raise ValueError("this link has a shape without its numbers")
    return with_derived(state)


def _preset(text: str) -> str:
    """Key of a preset; version 0.3 used labels."""
    labels = {preset.label: key for key, preset in PRESETS.items()}
    key = labels.get(text, text)
    if key not in PRESETS:
        raise ValueError(
            "this link names no preset that is known"
            if key
            else "a scene that version 0.3 took from a file has to be set anew"
        )
    return key


def _view(pairs: dict[str, str]) -> dict[str, Any]:
    """Values of the view, removed from the pairs."""
    held = tuple(pairs.pop("hold", "").split())
    if len(held) > MAX_HELD:
        raise ValueError(f"more than {MAX_HELD} scenes are held in this link")
    plots = pairs.pop("plots", "")
    tiles = tuple(t for t in (pairs.pop("tiles", "") or plots).split() if t not in _DROPPED_TILES)
    changes: dict[str, Any] = {"hold": held, "tiles": tiles[:12]}
    changes |= {name: pairs.pop(name, "0") == "1" for name in ("dark", "keep")}
    fixed = tuple(pairs.pop("fixed", "baseline frame_compliance").split())
    if not set(fixed) <= set(FITTED):
        raise ValueError("what a fit leaves as it is, in this link, is not known")
    return changes | {"fixed": fixed, "fit_note": pairs.pop("fit_note", "")[:300]}


def _scene(pairs: dict[str, str]) -> dict[str, Any]:
    """Samples, path and progress, removed from the pairs."""
    changes: dict[str, Any] = {}
    if "samples" in pairs:
        points = _rows("samples", pairs.pop("samples"))
        if any(len(point) != 2 for point in points):
            raise ValueError("the samples in this link are not pairs")
        tip = mdr.Sampled(*zip(*points, strict=True))
        changes["samples"] = (tip.r, tip.z)
    if path := _rows("path", pairs.pop("path", "")):
        changes["path"] = path
    changes["progress"] = _number("at", pairs.pop("at", "1"))
    if not 0 <= changes["progress"] <= LAST_PROGRESS:
        raise ValueError(f"at in this link is out of bounds: 0 to {LAST_PROGRESS}")
    return changes


def _number(name: str, text: str) -> float:
    try:
        value = float(text) if len(text) <= 40 else inf
    except ValueError:
        value = inf
    if not isfinite(value):
        raise ValueError(f"{name:.40} = {text:.40} in this link is not a number")
    return value


def _rows(name: str, text: str) -> tuple:
    rows = [row.split(",") for row in text.split()]
    if len(rows) > MAX_SAMPLES or any(len(row) > 2 for row in rows):
        raise ValueError(f"the {name} in this link are not pairs")
    return tuple(tuple(_number(name, each) for each in row) for row in rows)
