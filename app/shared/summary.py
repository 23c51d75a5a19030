"""A scene in one line."""

from ..quantities import CHOICES, OF_DRIVE, SHAPES, with_symbol
from ..state import State, regions, used_by


def summary(state: State) -> str:
    """Shape, medium and drive of a scene in one line."""
    parts, choices = regions(state), OF_DRIVE[state.drive]["form"]
    names = [*parts["shape"], *parts["medium"], *parts["drive"], *used_by(state, "damping", "adhesion")]
    numbers = [with_symbol(name, state[name]) for name in names if state[name]]
    return ", ".join(
        [SHAPES[state.shape].label, *numbers, *(CHOICES[name][state[name]] for name in choices)]
    )
