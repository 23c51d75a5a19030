"""What a person has set: numbers in SI within bounds, and choices; gives a `mdr.Scene`. No plotting."""

import json
from dataclasses import dataclass
from math import inf, isclose

import mdr_core as mdr

from .presets import OPENING, PRESETS
from .quantities import (
    CHOICES,
    DAMPING,
    DRIVE,
    ELASTICITY,
    INERTIA,
    PLASTICITY,
    QUANTITIES,
    SURFACE,
    shape_quantities,
    used,
)
from .shapes import SHAPES
from .tip import MOST_SAMPLES
from .units import written

#: From first contact (0) over the deepest state (1) to the loss of contact (2) and the tip back at the
#: height of the undeformed surface.
LAST_PROGRESS = 2.2
#: Most samples of a measured tip whose impact is followed without keeping everybody waiting.
MOST_IN_IMPACT = 60


@dataclass(frozen=True)
class Snapshot:
    """All that is set, at one moment: what undo goes back to."""

    choices: dict[str, str]
    numbers: dict[str, float]
    progress: float
    samples: tuple | None
    resets: dict[str, float]
    preset: str


class Explorer:
    """The state of one person's page.

    `numbers` has one value for every quantity, those of the shapes named as in "cone_slope", so that a
    shape keeps its values while another one is looked at. `choices` says which of them are used.
    `progress` is where on the way from first contact (0) over the deepest state (1) to the loss of
    contact (2) the page stands; `samples` are radii and heights (m) of an uploaded tip.
    """

    def __init__(self, preset=OPENING):
        self.choices = {name: next(iter(options)) for name, options in CHOICES.items()}
        self.numbers = {name: quantity.start for name, quantity in QUANTITIES.items()}
        self.samples, self.resets = None, {}
        self.load(preset)

    @property
    def shape(self):
        """Key of the shape, one of `SHAPES`, or "sampled"."""
        return self.choices["shape"]

    def snapshot(self):
        """All that is set, to go back to by `restore`."""
        return Snapshot(
            dict(self.choices), dict(self.numbers), self.progress, self.samples, self.resets, self.preset
        )

    def restore(self, snapshot):
        """Set everything to what it was."""
        self.choices, self.numbers = dict(snapshot.choices), dict(snapshot.numbers)
        self.progress, self.samples = snapshot.progress, snapshot.samples
        self.resets, self.preset = snapshot.resets, snapshot.preset

    def load(self, label):
        """Set everything to a preset, given by its label."""
        preset = PRESETS[label]
        self.preset, self.progress = label, 1.0
        self.resets = dict(preset.values)
        self.choices |= preset.choices
        self.numbers |= preset.values

    @property
    def altered(self):
        """Whether the preset has been altered."""
        preset = PRESETS[self.preset]
        numbers = (isclose(self.numbers[name], value) for name, value in preset.values.items())
        choices = (self.choices[name] == option for name, option in preset.choices.items())
        return not (all(numbers) and all(choices))

    def set(self, name, value):
        """Set one number, in SI, or refuse it.

        Raises
        ------
        ValueError
            If the value is out of bounds.
        """
        quantity = QUANTITIES[name]
        low, high = quantity.bounds
        if not low <= value <= high:
            shown, low, high = (written(v, quantity.kind) for v in (value, low, high))
            raise ValueError(f"{quantity.symbol} = {shown} is out of bounds: {low} to {high}")
        self.numbers[name] = float(value)

    def choose(self, name, option):
        """Take another option of a choice, with the numbers that mean the same where there are such."""
        if option not in CHOICES[name]:
            raise ValueError(f"{option!r:.40} is not one of {', '.join(CHOICES[name])}")
        if name == "shape" and option == "sampled" and self.samples is None:
            raise ValueError("load the samples of a tip first: a CSV file with r and z")
        if option != self.choices[name]:
            converted = {key: float(value) for key, value in _CONVERT[name](self, option).items()}
            self.choices[name] = option
            self.numbers |= converted
            self.resets = self.resets | converted

    def move(self, progress):
        """Stand somewhere else on the way."""
        if not 0 <= progress <= LAST_PROGRESS:
            raise ValueError(f"the position {progress:g} is out of bounds: 0 to {LAST_PROGRESS}")
        self.progress = float(progress)

    def upload(self, samples):
        """Take the samples of a tip as the indenter; what is deeper than they reach is refused later."""
        deepest = float(self.solved().depth)
        tip = mdr.Sampled(*samples)
        self.samples = (tip.r, tip.z)
        self.choices["shape"] = "sampled"
        if self.choices["drive"] == "depth" and deepest > tip.deepest:
            value = float(f"{tip.deepest / 2:.3g}")
            self.numbers["max_depth"] = value
            self.resets = self.resets | {"max_depth": value}

    def profile(self):
        """The indenter."""
        if self.shape == "sampled":
            return mdr.Sampled(*self.samples)
        values = {q.name: self.numbers[name] for name, q in shape_quantities(self.shape)}
        return SHAPES[self.shape].build(**values)

    def medium(self):
        """The medium."""
        n, elasticity = self.numbers, self.choices["elasticity"]
        if elasticity == "modulus":
            medium = mdr.Medium(n["E_star"])
        elif elasticity == "rigid_tip":
            medium = mdr.Medium.from_bodies(n["E_1"], n["nu_1"])
        else:
            medium = mdr.Medium.from_bodies(n["E_1"], n["nu_1"], n["E_2"], n["nu_2"])
        plasticity, damping = self.choices["plasticity"], self.choices["damping"]
        q_c = {"q_c": n["q_c"], "hardness": n["hardness"] * n["hardness_radius"], "none": inf}[plasticity]
        eta = {"none": 0.0, "eta": n["eta"], "tau": n["tau"] * medium.E_star / 4}[damping]
        return mdr.Medium(medium.E_star, q_c, eta)

    def drive(self):
        """What is done with the indenter, up to the deepest state."""
        n = self.numbers
        before = n["plastic_depth"] if self.choices[SURFACE] == "imprint" else 0.0
        return {
            "depth": mdr.DepthPath(n["max_depth"]),
            "force": mdr.ForcePath(n["max_force"]),
            "impact": mdr.FreeImpact(n["mass"], n["speed"], before),
        }[self.choices["drive"]]

    def hit_again(self, left):
        """Let the body hit the imprint, of a plastic depth (m), that it has left itself."""
        self.set("plastic_depth", left)
        self.choices[SURFACE] = "imprint"
        self.resets = self.resets | {"plastic_depth": left}

    def scene(self):
        """What is to be modelled: pressed once, or hit once."""
        drive = self.drive()
        if self.shape == "sampled":
            most = MOST_IN_IMPACT if isinstance(drive, mdr.FreeImpact) else MOST_SAMPLES
            if len(self.samples[0]) > most:
                raise ValueError(
                    f"a measured tip of {len(self.samples[0])} samples is too much for this page: at most "
                    f"{MOST_SAMPLES}, or {MOST_IN_IMPACT} for an impact; mdr_core itself takes any number"
                )
        return mdr.Scene(self.profile(), self.medium(), drive)

    def described(self):
        """The scene as JSON; if it cannot be made, what it would be made of."""
        try:
            return self.scene().to_json()
        except Exception as error:
            values = {name: self.numbers[name] for name in used(self.choices)}
            return json.dumps({"choices": self.choices, "numbers": values, "error": str(error)})

    def solved(self):
        """The deepest state of the present scene, without its way there."""
        result = self.scene().solve()
        return result.deepest if isinstance(result, mdr.Impact) else result


def _shape(state, shape):
    """Numbers with which another shape has the size of the present contact."""
    if shape == "sampled":
        return {}
    radius = float(state.solved().contact_radius)
    values = {}
    for name, quantity in shape_quantities(shape):
        is_length = quantity.kind == "length"
        value = float(f"{quantity.default * radius:.2g}") if is_length else quantity.default
        values[name] = min(max(value, quantity.bounds[0]), quantity.bounds[1])
    return values


def _elasticity(state, option):
    """Numbers with which the effective modulus stays as it is, Popov (2015), Eq. (2)."""
    modulus, n = state.medium().E_star, state.numbers
    if option == "modulus":
        return {"E_star": modulus}
    other = (1 - n["nu_2"] ** 2) / n["E_2"] if option == "bodies" else 0.0
    compliance = 1 / modulus - other
    if compliance > 0.01 / modulus:
        return {"E_1": (1 - n["nu_1"] ** 2) / compliance}
    return {"E_1": 2 * modulus * (1 - n["nu_1"] ** 2), "E_2": 2 * modulus * (1 - n["nu_2"] ** 2)}


def _plasticity(state, option):
    """Numbers with which the yield constant stays as it is; none is remembered from before."""
    q_c = state.medium().q_c
    if q_c == inf:
        return {}
    if option == "q_c":
        return {"q_c": q_c}
    radius = float(f"{float(state.solved().contact_radius):.1g}")
    return {"hardness": q_c / radius, "hardness_radius": radius} if option == "hardness" else {}


def _damping(state, option):
    """Numbers with which viscosity and relaxation time mean the same."""
    medium = state.medium()
    if state.choices["damping"] == "none":
        # A relaxation time that shows, and does not rule, at the time scale of an impact.
        tau = float(f"{_time_scale(state) / 10:.1g}")
        return {"tau": tau, "eta": tau * medium.E_star / 4}
    return {"eta": medium.eta, "tau": medium.relaxation_time} if option != "none" else {}


def _time_scale(state):
    if state.choices["drive"] == "impact":
        return float(state.solved().depth) / state.numbers["speed"]
    return 1e-3


def _drive(state, option):
    """Numbers with which the deepest state stays as it is."""
    deepest = state.solved()
    if option == "depth":
        return {"max_depth": float(deepest.depth)}
    if option == "force":
        return {"max_force": float(deepest.force)}
    # A body as heavy as a ball of the contact's size times ten, of steel.
    mass = float(f"{4.2 * 7800 * (10 * float(deepest.contact_radius)) ** 3:.1g}")
    work = float(deepest.stored_energy + deepest.plastic_work)
    return {"mass": mass, "speed": (2 * work / mass) ** 0.5}


def _surface(state, option):
    """The imprint that the present impact leaves; a shallow one where it leaves none."""
    if option == "virgin" or state.choices["drive"] != "impact":
        return {}
    deepest = state.solved()
    return {"plastic_depth": float(deepest.live.lower) or float(f"{0.1 * float(deepest.depth):.2g}")}


_CONVERT = {
    "shape": _shape,
    ELASTICITY: _elasticity,
    PLASTICITY: _plasticity,
    DAMPING: _damping,
    DRIVE: _drive,
    INERTIA: lambda state, option: {},
    SURFACE: _surface,
}
