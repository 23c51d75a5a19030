"""Presets: media and indenters that exist, each number with where it comes from."""

import json
from dataclasses import dataclass
from pathlib import Path

import mdr_core as mdr

from .shapes import SHAPES
from .units import written

ASSETS = Path(__file__).parent.parent / "assets"


@dataclass(frozen=True)
class Preset:
    """What the page can open on.

    `choices` and `values` are what the page sets (SI); `sources` says for each number what it is,
    how large, and where it comes from.
    """

    label: str
    choices: dict[str, str]
    values: dict[str, float]
    sources: tuple[tuple[str, str, str], ...]


def _preset(scene, media, indenters):
    medium, indenter = media[scene["medium"]], indenters[scene["indenter"]]
    shape = indenter["shape"]
    bodies = ((1, medium), (2, indenter))
    built = mdr.Medium.from_bodies(
        *(body[key]["value"] for _, body in bodies for key in ("E", "nu")),
        q_c=medium["q_c"]["value"],
    )
    values = {f"{shape}_{name}": number["value"] for name, number in indenter["parameters"].items()}
    values |= {f"{key}_{i}": body[key]["value"] for i, body in bodies for key in ("E", "nu")}
    values |= {"q_c": built.q_c, "E_star": built.E_star, "density": medium["density"]["value"]}
    if "depth" in scene:
        values["max_depth"] = float(scene["depth"] * built.critical_depth)
    else:
        values |= {name: scene[name]["value"] for name in ("mass", "speed")}
    choices = {
        "shape": shape,
        "elasticity": "bodies",
        "plasticity": "q_c",
        "damping": "none",
        "drive": "depth" if "depth" in scene else "impact",
        "inertia": "density",
        "surface": "virgin",
    }
    kinds = {
        "E": ("E", "pressure"),
        "nu": ("ν", "number"),
        "q_c": ("q_c", "yield constant"),
        "density": ("ρ", "density"),
    }
    shown = [(kinds[key], medium["label"], medium[key]) for key in ("E", "nu", "q_c", "density")]
    shown += [
        ((q.symbol, q.kind), indenter["label"], indenter["parameters"][q.name])
        for q in SHAPES[shape].quantities
    ]
    shown += [(kinds[key], indenter["label"], indenter[key]) for key in ("E", "nu")]
    shown += [
        ((symbol, name), "the impact", scene[name])
        for symbol, name in (("m", "mass"), ("v_0", "speed"))
        if name in scene
    ]
    sources = tuple(
        (f"{symbol} of {owner}", f"{written(number['value'], kind, 3)}", number["source"])
        for (symbol, kind), owner, number in shown
    )
    remark = f", {scene['remark']}" if "remark" in scene else ""
    label = f"{indenter['label']} on {medium['label']}{remark}"
    return Preset(label[0].upper() + label[1:], choices, values, sources)


def _load(path):
    data = json.loads(path.read_text(encoding="utf-8"))
    presets = (_preset(scene, data["media"], data["indenters"]) for scene in data["scenes"])
    return {preset.label: preset for preset in presets}


PRESETS = _load(ASSETS / "presets.json")

#: What the page opens on.
OPENING = next(iter(PRESETS))
