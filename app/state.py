"""The state of the page: a frozen set of numbers (SI) and choices, and its presets."""

from dataclasses import dataclass, field, fields, replace
from math import inf, isclose
from typing import Any

import mdr_core as mdr
from mdr_core.results.units import written

from .quantities import (
    ASSETS,
    CHOICES,
    OF_DRIVE,
    QUANTITIES,
    SHAPES,
    USED,
    lowered,
    read_data,
    shape_quantities,
)


@dataclass(frozen=True)
class Preset:
    """A preset: its choices, values (SI), and sources of values, by name."""

    label: str
    choices: dict[str, str]
    values: dict[str, float]
    sources: dict[str, str]


def _preset(scene: dict, media: dict, indenters: dict) -> Preset:
    """A scene with all that its medium and its indenter have."""
    given = media[scene["medium"]] | indenters[scene["indenter"]] | scene
    numbers = {name: each for name, each in given.items() if name in QUANTITIES}
    values = {name: each["value"] for name, each in numbers.items()}
    bodies = mdr.Medium.from_bodies(*(values[name] for name in USED["elasticity"]["bodies"]))
    return Preset(
        scene["label"],
        {"elasticity": "bodies", "damping": "none", "adhesion": "none"}
        | {name: given[name] for name in ("shape", "plasticity", "drive")},
        values | {"E_star": bodies.E_star, "plastic_depth": 0.0},
        {name: each["source"] for name, each in numbers.items()},
    )


_DATA = read_data(ASSETS / "presets.json")
#: By their keys, as in links.
PRESETS = {
    key: _preset(scene, _DATA["media"], _DATA["indenters"]) for key, scene in _DATA["scenes"].items()
}
CHOICES["preset"] = {key: preset.label for key, preset in PRESETS.items()}

#: Choices about the medium.
MEDIUM_CHOICES = ("elasticity", "plasticity", "damping", "adhesion")
#: What the page opens on.
OPENING = next(iter(PRESETS))

#: Progress at the end: 0 first contact, 1 largest depth, 2 loss of contact, 2.2 indenter at the
#: height of the undeformed surface.
LAST_PROGRESS = 2.2
#: What the view is like rather than the scene: undo leaves it alone. Extras add names of theirs.
VIEW = ["progress", "tiles", "dark"]
#: Values of extras by their names, as in "sweep.swept", with their defaults.
OF_EXTRAS: dict[str, Any] = {}


@dataclass(frozen=True)
class State:
    """Everything set on the page; `replace` returns a copy with other values.

    A number of a shape that has not been looked at is None: it is sized when it is. `samples` has radii and
    heights of a measured tip, `tiles` the optional plots that are shown, `extras` the values of extras that
    are not at their defaults: `state["sweep.swept"]` is one of them.
    """

    preset: str = OPENING
    progress: float = 1.0
    tiles: tuple[str, ...] = ()
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

    def __getitem__(self, name: str) -> Any:
        return self.extras.get(name, OF_EXTRAS[name]) if "." in name else getattr(self, name)

    def replace(self, **changes: Any) -> "State":
        """Copy with other values."""
        own = {name: changes.pop(name) for name in list(changes) if name in OF_EXTRAS}
        kept = {name: value for name, value in (self.extras | own).items() if value != OF_EXTRAS[name]}
        return replace(self, extras=kept, **changes)

    @property
    def scene_values(self) -> dict[str, Any]:
        """Values that undo restores."""
        names = [each.name for each in fields(self) if each.name != "extras"]
        return {name: self[name] for name in (*names, *OF_EXTRAS) if name not in VIEW}


def preset_state(key: str = OPENING, **view: Any) -> State:
    """State of a preset, with a view."""
    preset = PRESETS[key]
    return with_derived(State(preset=key, **preset.choices, **preset.values).replace(**view))


def profile(state: Any) -> mdr.Profile:
    if state.shape != "sampled":
        values = {q.name: getattr(state, name) for name, q in shape_quantities(state.shape)}
        return SHAPES[state.shape].build(**values)
    if not state.samples:
        raise ValueError("load a tip first: a CSV file with radii r and heights z")
    return mdr.Sampled(*state.samples)


#: Hardness of the medium by the options of the choice "plasticity", as arguments of `mdr.Medium`.
_HARDNESS = {
    "q_c": lambda state: {"q_c": state.q_c},
    "hardness": lambda state: {"q_c": state.hardness * state.hardness_radius},
    "constant": lambda state: {"q_c": 0.0, "hardness": state.volume_hardness},
    "line": lambda state: {"q_c": 0.0, "f_c": state.f_c},
    "none": lambda state: {"q_c": inf},
}
#: The constant of the hardness by the same options; q_c also of a hardness at a radius.
YIELD_CONSTANT = USED["plasticity"] | {"hardness": ["q_c"]}


def refuse_other_classes(state: Any, what: str, instead: str) -> None:
    """Refuses what is modelled for a hardness ∝ 1/a only, with what else to choose."""
    if state.plasticity in ("constant", "line"):
        raise ValueError(f"{what} is modelled for a hardness ∝ 1/a only: choose that or {instead} first")


def medium(state: Any) -> mdr.Medium:
    numbers = [getattr(state, name) for name in USED["elasticity"][state.elasticity]]
    make = mdr.Medium if state.elasticity == "modulus" else mdr.Medium.from_bodies
    made = make(*numbers)
    eta = state.eta if state.damping == "eta" else 0.0
    w = state.work_of_adhesion if state.adhesion == "work" else 0.0
    if w:
        refuse_other_classes(state, "adhesion", "yield none")
    return replace(made, eta=eta, work_of_adhesion=w, **_HARDNESS[state.plasticity](state))


def with_derived(state: State) -> State:
    """With E* and q_c derived from two bodies or a hardness."""
    made = medium(state)
    q_c = {"q_c": float(made.q_c)} if "q_c" in YIELD_CONSTANT[state.plasticity] else {}
    return state.replace(E_star=float(made.E_star), **q_c)


def used(state: State) -> list[str]:
    """Names of the numbers in use."""
    names = [name for name, _ in shape_quantities(state.shape)]
    return names + used_by(state, *MEDIUM_CHOICES, "drive", *OF_DRIVE[state.drive]["form"])


def used_by(state: State, *choices: str) -> list[str]:
    """Names of the numbers that the options of some choices use."""
    return [name for choice in choices for name in USED[choice][state[choice]]]


def regions(state: State) -> dict[str, list[str]]:
    """Names of the numbers in the form, by its regions."""
    medium, drive = used_by(state, *MEDIUM_CHOICES), used_by(state, "drive", *OF_DRIVE[state.drive]["form"])
    main = ["E_star", *YIELD_CONSTANT[state.plasticity]]
    return {
        "shape": [name for name, _ in shape_quantities(state.shape)],
        "drive": [name for name in drive if name != "density"],
        "medium": main,
        "more": [n for n in medium if n not in main] + ["density"] * ("density" in drive),
    }


def checked(name: str, value: float) -> float:
    """Value (SI) of a number if it is within bounds; else ValueError."""
    known = QUANTITIES[name]
    if abs(known.bounded(value) - value) > 1e-12 * abs(value):
        shown, low, high = (written(v, known.kind) for v in (value, *known.bounds))
        raise ValueError(f"{lowered(known.symbol)} = {shown} is out of bounds: {low} to {high}")
    return float(known.bounded(value))


def altered(state: State) -> list[str]:
    """Names of choices and numbers that differ from the preset."""
    preset = PRESETS[state.preset]
    loaded = preset.choices | preset.values
    return [
        name
        for name, value in loaded.items()
        if state[name] != value and not (name in QUANTITIES and isclose(state[name], value, rel_tol=1e-9))
    ]
