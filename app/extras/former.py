"""Links as they come: those of version 0.6, which open for good, and what others append to links."""

import re

from ..extra import Extra

#: Names of version 0.6 with those of today.
NAMES = {
    "hold": "held.scenes",
    "log": "log.plots",
    "section": "section.stress",
    "swept": "sweep.swept",
    "against": "sweep.against",
    "pattern": "path.pattern",
    "ramp_time": "path.ramp_time",
    "incoming_speed": "oblique.incoming_speed",
    "attack": "oblique.attack",
    "friction": "oblique.friction",
    "body": "oblique.body",
}
#: What version 0.6 had and is gone: left out in silence, in lists too.
_GONE = {"frame_compliance", "loglog"}
#: Presets of version 0.6 that had a paraboloid for a ball, and what else their links do not say.
_PRESETS = {"striker-glass_epoxy": "ball-glass_epoxy", "striker-epoxy-elastic": "ball-epoxy-elastic"}
_BALL = {"shape": "paraboloid", "paraboloid_radius": "0.008", "mass": "1"}
#: Names that mail programs, search engines and other sites append to links.
_APPENDED = re.compile(
    r"utm_.*|\w*clk?id|gclsrc|[gw]braid|igsh(id)?|mc_[ce]id|_ga|_gl|_hs\w+|li_fat_id|srsltid|bokeh-.*"
    r"|mkt_tok|mibextid|si|vero_id|ref",
    re.IGNORECASE,
)


def translated(pairs: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """Names and values of a link with those of today."""
    given = dict(pairs)
    if given.get("preset") in _PRESETS:
        pairs = [*pairs, *((name, text) for name, text in _BALL.items() if name not in given)]
    known = [(name, text) for name, text in pairs if name not in _GONE and not _APPENDED.fullmatch(name)]
    return [(NAMES.get(name, name), _value(name, text)) for name, text in known]


def _value(name: str, text: str) -> str:
    if name in ("tiles", "fixed"):
        return " ".join(each for each in text.split() if each not in _GONE)
    return _PRESETS.get(text, text) if name == "preset" else text


EXTRA = Extra("former", translated=translated)
