"""Presets: media and indenters that exist, each number with where it comes from."""

import json
from dataclasses import dataclass

import mdr_core as mdr

from .quantities import ASSETS, QUANTITIES, USED
from .units import written


@dataclass(frozen=True)
class Preset:
    """What the page can open on.

    `choices` and `values` are what the page sets (SI); `sources` says for each number, by its name, what
    it is, how large, and where it comes from.
    """

    label: str
    choices: dict[str, str]
    values: dict[str, float]
    sources: dict[str, tuple[str, str, str]]


def _preset(scene, media, indenters):
    medium, indenter = media[scene["medium"]], indenters[scene["indenter"]]
    shape, drive = indenter["shape"], "depth" if "depth" in scene else "impact"
    # Symbol, owner, name and number of everything that has a source.
    given = [
        *(("E", medium, "E_1", medium["E"]), ("ν", medium, "nu_1", medium["nu"])),
        *((QUANTITIES[name].symbol, medium, name, medium[name]) for name in ("q_c", "density")),
        *(
            (QUANTITIES[f"{shape}_{name}"].symbol, indenter, f"{shape}_{name}", number)
            for name, number in indenter["parameters"].items()
        ),
        *(("E", indenter, "E_2", indenter["E"]), ("ν", indenter, "nu_2", indenter["nu"])),
    ]
    impact = {"label": "the impact"}
    given += [(QUANTITIES[n].symbol, impact, n, scene[n]) for n in USED["drive"]["impact"] if n in scene]
    values = {name: number["value"] for _, _, name, number in given}
    bodies = (values[name] for name in USED["elasticity"]["bodies"])
    made = mdr.Medium.from_bodies(*bodies, q_c=values["q_c"])
    values["E_star"] = made.E_star
    if drive == "depth":
        values["max_depth"] = float(scene["depth"] * made.critical_depth)
    choices = {"shape": shape, "elasticity": "bodies", "plasticity": "q_c", "damping": "none"}
    choices |= {"drive": drive, "inertia": "density", "surface": "virgin"}
    sources = {
        name: (f"{symbol} of {owner['label']}", written(n["value"], QUANTITIES[name].kind, 3), n["source"])
        for symbol, owner, name, n in given
    }
    if drive == "depth":
        times = f"{scene['depth']:g} times the depth at which yield begins"
        sources["max_depth"] = ("d_max", written(values["max_depth"], "length", 3), times)
    remark = f", {scene['remark']}" if "remark" in scene else ""
    label = f"{indenter['label']} on {medium['label']}{remark}"
    return Preset(label[0].upper() + label[1:], choices, values, sources)


_DATA = json.loads((ASSETS / "presets.json").read_text(encoding="utf-8"))
_MADE = (_preset(scene, _DATA["media"], _DATA["indenters"]) for scene in _DATA["scenes"])
PRESETS = {preset.label: preset for preset in _MADE}

#: What the page opens on.
OPENING = next(iter(PRESETS))
