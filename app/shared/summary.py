"""Numbers of a scene with their symbols, and a scene in one line."""

from mdr_core.results.units import in_full

from ..quantities import CHOICES, OF_DRIVE, QUANTITIES, SHAPES
from ..state import State, regions, used_by


def with_symbol(name: str, value: float) -> str:
    """A number of the page with its symbol, in full."""
    return f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}"


def summary(state: State) -> str:
    """Shape, medium and drive of a scene in one line."""
    parts, choices = regions(state), OF_DRIVE[state.drive]["form"]
    names = [*parts["shape"], *parts["medium"], *parts["drive"], *used_by(state, "damping", "adhesion")]
    numbers = [with_symbol(name, state[name]) for name in names if state[name]]
    return ", ".join(
        [SHAPES[state.shape].label, *numbers, *(CHOICES[name][state[name]] for name in choices)]
    )
