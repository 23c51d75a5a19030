"""Numbers that mean the same under another option of a choice, so that looking at it changes no result."""

from math import inf

from .drives import DRIVES, oblique, path
from .quantities import shape_quantities


def _shape(state, shape):
    """Numbers with which another shape has the size of the present contact."""
    radius = float(state.solved().contact_radius)
    return {
        name: q.bounded(float(f"{q.default * radius:.2g}") if q.kind == "length" else q.default)
        for name, q in shape_quantities(shape)
    }


def _elasticity(state, option):
    """Numbers with which the effective modulus stays as it is, Popov (2015), Eq. (2)."""
    modulus = state.medium().E_star
    if option == "modulus":
        return {"E_star": modulus}
    other = (1 - state.nu_2**2) / state.E_2 if option == "bodies" else 0.0
    compliance = 1 / modulus - other
    if compliance > 0.01 / modulus:
        return {"E_1": (1 - state.nu_1**2) / compliance}
    return {"E_1": 2 * modulus * (1 - state.nu_1**2), "E_2": 2 * modulus * (1 - state.nu_2**2)}


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
    if state.damping == "none":
        # A relaxation time that shows, and does not rule, at the time scale of an impact.
        tau = float(f"{(DRIVES[state.drive].duration(state) or 1e-3) / 10:.1g}")
        return {"tau": tau, "eta": tau * medium.E_star / 4}
    return {"eta": medium.eta, "tau": medium.relaxation_time} if option != "none" else {}


def _drive(state, option):
    """Numbers with which the deepest state stays as it is."""
    return DRIVES[option].alike(state, state.solved())


def _surface(state, option):
    """The imprint that the present impact leaves; a shallow one where it leaves none."""
    if option == "virgin" or state.drive != "impact":
        return {}
    deepest = state.solved()
    return {"plastic_depth": float(deepest.plastic_depth) or float(f"{0.1 * float(deepest.depth):.2g}")}


CONVERT = {
    "shape": _shape,
    "elasticity": _elasticity,
    "plasticity": _plasticity,
    "damping": _damping,
    "drive": _drive,
    "surface": _surface,
    "aim": oblique.aim,
    "pattern": path.pattern,
    "prescribed": path.prescribed,
}
