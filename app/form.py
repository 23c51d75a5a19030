"""The controls as data: what the page shows of the state, and what its slider steps stand for."""

from math import log

from .presets import PRESETS
from .quantities import (
    CHOICES,
    DAMPING,
    DRIVE,
    ELASTICITY,
    INERTIA,
    PLASTICITY,
    QUANTITIES,
    SURFACE,
    USED,
    shape_quantities,
)
from .units import entry, written

_LABELS = {
    "shape": "Shape",
    ELASTICITY: "Elasticity",
    PLASTICITY: "Yield",
    DAMPING: "Viscosity",
    DRIVE: "Press",
    INERTIA: "Density",
    SURFACE: "Surface",
}


class Scale:
    """The steps of a slider and the values they stand for."""

    STEPS = 400

    def __init__(self, quantity, reset, value):
        low, high = quantity.bounds
        self.logarithmic = quantity.span > 0
        if self.logarithmic:
            # A value typed beyond the slider's reach becomes its new middle.
            middle = reset if reset / quantity.span <= value <= reset * quantity.span else value
            low, high = max(low, middle / quantity.span), min(high, middle * quantity.span)
        self.low, self.high = low, high

    def position(self, value):
        """The step nearest to a value."""
        if self.logarithmic:
            share = log(value / self.low) / log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return round(self.STEPS * min(max(share, 0.0), 1.0))

    def value(self, position):
        """The value of a step, with three digits."""
        share = min(max(position, 0), self.STEPS) / self.STEPS
        if self.logarithmic:
            value = self.low * (self.high / self.low) ** share
        else:
            value = self.low + (self.high - self.low) * share
        return min(max(float(f"{value:.3g}"), self.low), self.high)


def scale(state, name):
    """The slider of one number as it stands."""
    value = state.numbers[name]
    return Scale(QUANTITIES[name], state.resets.get(name, value), value)


def form(state, made):
    """All controls of the page, group by group, with the medium `made` of them; units stay here."""
    choices = state.choices
    shape = _choice(state, "shape")
    if state.samples is None:
        del shape["options"]["sampled"]
    medium = [_choice(state, ELASTICITY), *_numbers(state, USED[ELASTICITY][choices[ELASTICITY]])]
    if choices[ELASTICITY] != "modulus":
        medium.append({"note": f"E* = {written(made.E_star, 'pressure')} (2)"})
    medium += [_choice(state, PLASTICITY), *_numbers(state, USED[PLASTICITY][choices[PLASTICITY]])]
    medium.append({"note": _yield(state, made)})
    medium += [_choice(state, DAMPING), *_numbers(state, USED[DAMPING][choices[DAMPING]])]
    if choices[DAMPING] != "none":
        medium.append({"note": _damping(state, made)})
    drive = [_choice(state, DRIVE), *_numbers(state, USED[DRIVE][choices[DRIVE]])]
    if choices[DRIVE] == "impact":
        drive += [_choice(state, SURFACE), *_numbers(state, USED[SURFACE][choices[SURFACE]])]
        drive.append(
            {"act": "again", "text": "Hit again", "title": "Hit the imprint that this impact leaves"}
        )
        drive += [_choice(state, INERTIA), *_numbers(state, USED[INERTIA][choices[INERTIA]])]
    return {
        "preset": {
            "label": "Preset",
            "options": list(PRESETS),
            "value": state.preset,
            "altered": state.altered,
        },
        "steps": Scale.STEPS,
        "groups": [
            {"title": "Indenter", "rows": [shape, {"sketch": True}, *_shape(state)]},
            {"title": "Medium", "rows": medium},
            {"title": "Drive", "rows": drive},
        ],
    }


def _shape(state):
    if state.shape == "sampled":
        r, z = state.samples
        text = f"{len(r)} samples, to r = {written(r[-1], 'length', 3)}, z = {written(z[-1], 'length', 3)}"
        return [{"note": text}]
    return _numbers(state, [name for name, _ in shape_quantities(state.shape)])


def _choice(state, name):
    options = dict(CHOICES[name])
    return {"choice": name, "label": _LABELS[name], "options": options, "value": state.choices[name]}


def _numbers(state, names):
    rows = []
    for name in names:
        quantity, value = QUANTITIES[name], state.numbers[name]
        rows.append(
            {
                "number": name,
                "symbol": quantity.symbol,
                "label": quantity.label,
                "text": entry(value, quantity.kind),
                "position": scale(state, name).position(value),
            }
        )
    return rows


def _yield(state, medium):
    if state.choices[PLASTICITY] == "none":
        return "Nothing yields: q_c = ∞"
    depth = written(medium.critical_depth, "length")
    if state.choices[PLASTICITY] == "hardness":
        q_c = written(medium.q_c, "yield constant")
        return f"q_c = σ_c a_c = {q_c} (11); d_c = π q_c/(2E*) = {depth} (19)"
    return f"Yield starts at d_c = π q_c/(2E*) = {depth} (19)"


def _damping(state, medium):
    if state.choices[DAMPING] == "tau":
        text = f"η = {written(medium.eta, 'viscosity')}"
    else:
        text = f"τ = 4η/E* = {written(medium.relaxation_time, 'time')} (1)"
    slow = "; no effect here: pressing is infinitely slow" if state.choices[DRIVE] != "impact" else ""
    return text + slow
