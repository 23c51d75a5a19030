"""Numbers of a scene with their symbols, and a scene in one line."""

import re

from ..common.units import in_full
from ..quantities import CHOICES, QUANTITIES
from ..state import PRESETS, State, altered, formed, regions, used, used_by

#: Letters of the name of a file, without what is in it: of 255 bytes, of which some letters take two.
_LONGEST = 100


def with_symbol(name: str, value: float) -> str:
    """A number of the page with its symbol, in full."""
    return f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}"


def file_name(state: State, what: str) -> str:
    """Name of a file of a scene: its preset, what differs from that, and what is in the file.

    Examples
    --------
    >>> from app.state import preset_state
    >>> file_name(preset_state("berkovich-gold").replace(max_depth=5e-9), "curves.csv")
    'berkovich-gold_d_max=5nm_curves.csv'
    """
    known, preset = altered(state), PRESETS[state.preset].values
    told = [state.preset, *(state[name] for name in known if name in CHOICES)]
    changed = (name for name in used(state) if name in known or name not in preset)
    told += [with_symbol(name, state[name]).replace("/", "-") for name in changed]
    return re.sub(r"[^\w.=+-]+", "", "_".join(told))[:_LONGEST] + f"_{what}"


def summary(state: State) -> str:
    """Shape, medium and drive of a scene in one line."""
    parts = regions(state)
    names = [*parts["shape"], *parts["medium"], *used_by(state, "drive", "damping", "adhesion")]
    numbers = [with_symbol(name, state[name]) for name in names if state[name]]
    chosen = [state.chosen(name).label for name in formed(state)]
    return ", ".join([state.chosen("shape").label, *numbers, *chosen])
