"""Numbers of a scene with their symbols, and a scene in one line."""

from ..quantities import QUANTITIES
from ..state import State, formed, regions, used_by
from ..units import in_full


def with_symbol(name: str, value: float) -> str:
    """A number of the page with its symbol, in full."""
    return f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}"


def summary(state: State) -> str:
    """Shape, medium and drive of a scene in one line."""
    parts = regions(state)
    names = [*parts["shape"], *parts["medium"], *used_by(state, "drive", "damping", "adhesion")]
    numbers = [with_symbol(name, state[name]) for name in names if state[name]]
    chosen = [state.chosen(name).label for name in formed(state)]
    return ", ".join([state.chosen("shape").label, *numbers, *chosen])
