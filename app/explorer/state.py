"""State of the page: a frozen set of numbers (SI) and choices; and presets."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isclose
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.show.units import fitting, format_quantity

from ..common.quantities import ASSETS, CHOICES, QUANTITIES, Option, read_data, unicode_subscripts
from ..common.units import entry, read

_DATA = read_data(ASSETS / "presets.json")
#: Preset of the opening page.
OPENING = next(iter(_DATA["scenes"]))
#: Choices about the medium, and those in the fold of the form.
MEDIUM_CHOICES = ("elasticity", "plasticity", "damping", "adhesion")
FOLDED_CHOICES = ("elasticity", "damping", "adhesion")
#: Values of the view with their defaults, which undo does not change; extras add values.
VIEW: dict[str, Any] = {"at": 1.0, "tiles": (), "large": "", "dark": False}


@dataclass(frozen=True)
class Entries:
    """Bounds of a list of names in a state: valid entries, and their largest number."""

    known: Callable[[str], bool]
    most: int


#: Lists in the state by name; extras add lists.
LISTS: dict[str, Entries] = {}
#: Defaults of the values of extras by name; the names contain a point.
OF_EXTRAS: dict[str, Any] = {}


@dataclass(frozen=True)
class State:
    """Everything that the user sets on the page; `replace` returns a copy with other values.

    E* of two bodies, and q_c of a hardness at a radius, follow from the other values. Numbers of a shape
    are None before the user first chooses the shape. `at` is the progress of the visible state, `tiles` the
    visible optional plots, `large` the plot that fills the page, `samples` radii and heights of a measured
    tip, `extras` the values of extras that differ from their defaults.
    """

    preset: str = OPENING
    at: float = 1.0
    tiles: tuple[str, ...] = ()
    large: str = ""
    dark: bool = False
    shape: str = "cone"
    elasticity: str = "modulus"
    plasticity: str = "q_c"
    damping: str = "none"
    adhesion: str = "none"
    drive: str = "depth"
    E_star: float = 1e9
    E_1: float = 1e9
    nu_1: float = 0.3
    E_2: float = 1e11
    nu_2: float = 0.3
    q_c: float = 1.0
    hardness: float = 1e9
    hardness_radius: float = 1e-6
    volume_hardness: float = 1e9
    f_c: float = 1e-6
    eta: float = 1.0
    work_of_adhesion: float = 0.05
    density: float = 2000.0
    max_depth: float = 1e-6
    max_force: float = 1.0
    mass: float = 1.0
    speed: float = 1.0
    plastic_depth: float = 0.0
    cone_slope: float | None = None
    paraboloid_radius: float | None = None
    sphere_radius: float | None = None
    flat_punch_radius: float | None = None
    power_law_exponent: float | None = None
    power_law_height: float | None = None
    power_law_width: float | None = None
    hyperboloid_slope: float | None = None
    hyperboloid_tip_radius: float | None = None
    rounded_cone_tip_radius: float | None = None
    rounded_cone_slope: float | None = None
    truncated_cone_flat_radius: float | None = None
    truncated_cone_slope: float | None = None
    truncated_paraboloid_flat_radius: float | None = None
    truncated_paraboloid_radius: float | None = None
    rounded_punch_flat_radius: float | None = None
    rounded_punch_edge_radius: float | None = None
    parabolic_punch_radius: float | None = None
    parabolic_punch_cylinder_radius: float | None = None
    samples: tuple[tuple[float, ...], ...] = ()
    tip_note: str = ""
    extras: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.elasticity == "bodies":
            bodies = mdr.Medium.from_bodies(self.E_1, self.nu_1, self.E_2, self.nu_2)
            object.__setattr__(self, "E_star", bodies.E_star)
        if self.plasticity == "hardness":
            object.__setattr__(self, "q_c", self.hardness * self.hardness_radius)

    def __getitem__(self, name: str) -> Any:
        return self.extras.get(name, OF_EXTRAS[name]) if "." in name else getattr(self, name)

    def replace(self, **changes: Any) -> "State":
        """Return a copy with other values."""
        own = {name: changes.pop(name) for name in list(changes) if name in OF_EXTRAS}
        # Values of a sweep are arrays.
        values = (self.extras | own).items()
        kept = {name: value for name, value in values if np.any(value != OF_EXTRAS[name])}
        return replace(self, extras=kept, **changes)

    def chosen(self, choice: str) -> Option:
        """Return the chosen option of a choice."""
        return CHOICES[choice].options[self[choice]]

    @cached_property
    def scene_values(self) -> "State":
        """Values that undo restores: the state with the default view."""
        return self.replace(**VIEW)


@dataclass(frozen=True)
class Preset:
    """Preset: its options and numbers (SI), and sources of numbers, by name."""

    label: str
    values: dict[str, Any]
    sources: dict[str, str]


#: Presets by their keys in links; extras add presets.
PRESETS: dict[str, Preset] = {}
#: Media and indenters of the presets, by name.
_PARTS: dict[str, dict[str, Any]] = {"media": {}, "indenters": {}}


def include_presets(data: dict[str, Any]) -> None:
    """Add the presets of the page or of an extra, which may have further media and indenters."""
    for name, known in _PARTS.items():
        known |= data.get(name, {})
    for key, scene in data.get("scenes", {}).items():
        PRESETS[key] = _preset(scene)
        CHOICES["preset"].options[key] = Option(scene["label"])


def _preset(scene: dict[str, Any]) -> Preset:
    """Return the preset of a scene: values of its medium, indenter and drive on a virgin surface."""
    given = _PARTS["media"][scene["medium"]] | _PARTS["indenters"][scene["indenter"]] | scene
    numbers = {name: each for name, each in given.items() if name in QUANTITIES}
    values = {"elasticity": "bodies", "damping": "none", "adhesion": "none", "plastic_depth": 0.0}
    values |= {name: each for name, each in given.items() if name in CHOICES}
    values |= {name: each["value"] for name, each in numbers.items()}
    values["E_star"] = State().replace(**values).E_star
    return Preset(scene["label"], values, {name: each["source"] for name, each in numbers.items()})


include_presets(_DATA)


def preset_values(key: str) -> dict[str, Any]:
    """Return all values that a preset sets, including the other choices in the form of its drive."""
    values = PRESETS[key].values
    form = CHOICES["drive"].options[values["drive"]].form
    return {name: OF_EXTRAS[name] for name in form} | values


def kept_extras(state: State) -> dict[str, Any]:
    """Return values of extras that no preset sets; a change of the preset keeps them."""
    of_presets = {name for key in PRESETS for name in preset_values(key)}
    return {name: value for name, value in state.extras.items() if name not in of_presets}


def preset_state(key: str = OPENING, **view: Any) -> State:
    """Return the state of a preset, with a view."""
    return State(preset=key).replace(**preset_values(key) | view)


def changed_from_preset(state: State) -> list[str]:
    """Return the names of choices and numbers that differ from the preset by more than rounding."""
    values = preset_values(state.preset)
    changed = [name for name in values if state[name] != values[name]]
    return [each for each in changed if each in CHOICES or not isclose(state[each], values[each])]


def numbers_of(state: State, *choices: str) -> list[str]:
    """Return the names of the numbers that the chosen options of choices, and their choices, use."""
    chosen = map(state.chosen, choices)
    return [
        name for option in chosen for name in (*option.uses, *option.fold, *numbers_of(state, *option.form))
    ]


def form_choices(state: State, choice: str = "drive") -> list[str]:
    """Return the choices in the form of the chosen option of a choice, each with its further choices."""
    return [each for name in state.chosen(choice).form for each in (name, *form_choices(state, name))]


def folded(state: State) -> list[str]:
    """Return the names of the folded numbers of the drive."""
    return [name for choice in ("drive", *form_choices(state)) for name in state.chosen(choice).fold]


def yield_constant(state: State) -> list[str]:
    """Return the name of the constant of the hardness; nothing if the medium does not yield."""
    return ["q_c"] if state.plasticity == "hardness" else numbers_of(state, "plasticity")


def regions(state: State) -> dict[str, list[str]]:
    """Return the names of the numbers in the form, by its regions."""
    main = ["E_star", *yield_constant(state)]
    measured = [name for name in numbers_of(state, "plasticity") if name not in main]
    return {
        "shape": numbers_of(state, "shape"),
        "drive": state.chosen("drive").uses,
        "medium": main,
        "hardness": measured,
        "more": [
            *(name for name in numbers_of(state, *MEDIUM_CHOICES) if name not in (*main, *measured)),
            *folded(state),
        ],
    }


def used(state: State) -> list[str]:
    """Return the names of the numbers in use."""
    return numbers_of(state, "shape", *MEDIUM_CHOICES, "drive")


def checked(name: str, value: float) -> float:
    """Return the value (SI) of a number. Raises ValueError if it is out of bounds."""
    known = QUANTITIES[name]
    if not isclose(known.bounded(value), value, rel_tol=1e-12):
        shown, low, high = (format_quantity(v, known.kind) for v in (value, *known.bounds))
        raise ValueError(f"{unicode_subscripts(known.symbol)} = {shown} is out of bounds: {low} to {high}")
    return float(known.bounded(value))


def rounded_to_display(state: State) -> State:
    """Round the numbers of a state to the digits of their fields, except angles: their SI digits differ."""
    preset = PRESETS[state.preset].values
    changed = [name for name in used(state) if state[name] is not None and state[name] != preset.get(name)]
    digits = {name: state[name] for name in changed if QUANTITIES[name].kind != "angle"}
    return state.replace(**{name: _shown(QUANTITIES[name].kind, value) for name, value in digits.items()})


def _shown(kind: str, value: float) -> float:
    unit = fitting(value, kind)
    found, _ = read(entry(value, unit), kind, unit)
    return value if isclose(found, value, rel_tol=1e-13) else found


def profile(state: State) -> mdr.Profile:
    """Return the shape of the indenter."""
    if state.shape == "sampled":
        return mdr.Sampled(*state.samples)
    if state.shape == "power_law":
        coefficient = state.power_law_height / state.power_law_width**state.power_law_exponent
        return mdr.PowerLaw(coefficient, state.power_law_exponent)
    make = getattr(mdr, state.shape.title().replace("_", ""))
    return make(
        **{name.removeprefix(f"{state.shape}_"): state[name] for name in numbers_of(state, "shape")}
    )


def refuse_other_classes(state: State, what: str, instead: str) -> None:
    """Raise ValueError for a model that requires a hardness ∝ 1/a, with the alternatives."""
    if state.plasticity in ("constant", "line"):
        raise ValueError(f"{what} is modelled for a hardness ∝ 1/a only: choose this or {instead} first")


def medium(state: State) -> mdr.Medium:
    """Return the medium under the indenter."""
    if state.adhesion == "work":
        refuse_other_classes(state, "adhesion", "no yield")
    names = [*yield_constant(state), *numbers_of(state, "damping", "adhesion")]
    # The core calls the constant hardness `hardness`, which is another number of the page.
    given = {name.removeprefix("volume_"): state[name] for name in names}
    poisson = state.nu_1 if state.elasticity == "bodies" else 0.5
    return mdr.Medium(state.E_star, poisson=poisson, **given)
