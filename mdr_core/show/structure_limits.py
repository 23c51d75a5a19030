"""Limits of the models of structures: edges, a second contact, mass of a support, thickness, weight."""

from dataclasses import replace

import numpy as np

from ..base.results import Limit
from ..solver.impacts.impact import impact
from ..solver.medium.structure import Structure
from .quantities import engineering

#: Largest contact time over the time in which bending waves return from the nearest edge. Up to this ratio
#: the restitution is within 1.4 % of that by the modes of a simply supported plate
#: (tests/solver/impacts/test_modes.py).
_EDGES = 1 / 3
#: A bending wave returns from a path of length r after r²/(7.70 √(D/ρh)), when Si(r²/(4 t √(D/ρh))) is π/2.
BACK = 7.70
#: Largest contact radius over the thickness, and shortest contact time over the time of a shear wave
#: through the plate.
_THIN = 0.5
_PERIODS = 6.0
#: All second contacts of 60 random plates with 300 modes are below 1.25 times this bound.
_AGAIN = 2.4
#: Smallest reported excess of the force due to the mass of a support, smallest reported share of the speed
#: that gravity adds, and gravity (m/s²).
_HEAVY, _WEIGHT, _GRAVITY = 0.05, 0.05, 9.81
#: Largest difference between shares of plastic work that count as equal.
_LEAST = 0.01
#: Smallest share of the momentum in the impulse of a contact that counts.
_COUNTS = 0.01
_BY_MODES = "take the modes of the structure, such as those of a supported plate"


def structure_limits(hit):
    """Return the `Limit`s of impacts on a structure, as far as its parameters are known."""
    structure, shape = hit.structure, np.shape(hit.speed)
    if structure.rigid:
        return ()
    plate, support = (np.broadcast_to(each, shape) for each in (structure.is_plate, structure.is_support))
    bends = plate | support | (structure.modes is not None)
    return (
        *_edge_limit(structure, hit, plate), *_second_contact(structure, hit, plate),
        *_support_limit(structure, hit, support), *_thin_limit(structure, hit, bends),
        *_small_limits(structure, hit), *_weight_limit(hit),
    )  # fmt: skip


def _edge_limit(structure, hit, plate):
    """Yield the limit for the contact time over the time in which bending waves return from an edge.

    The contact time is infinite for a body that never leaves.
    """
    time = np.asarray(hit.contact_time)
    endless = np.isinf(time) & plate
    if structure.edge is None and not endless.any():
        return
    if endless.any():
        text = (
            "The body never leaves a plate without edges. A real plate has edges, and the waves from them "
            f"lift the body: {_BY_MODES}."
        )
        yield Limit("edges", np.inf, _EDGES, True, text)
        return
    if structure.wave_spread is None:
        text = (
            "Without wave_spread the time in which waves return from the edge is unknown: "
            "make the plate by Structure.plate or Structure.laminate."
        )
        yield Limit("edges", np.inf, _EDGES, True, text, severe=False)
        return
    back = (2 * np.asarray(structure.edge)) ** 2 / (BACK * structure.wave_spread)
    ratio = np.where(plate, time / back, 0.0)
    first = np.unravel_index(np.argmax(ratio), ratio.shape)
    value = float(ratio[first])
    back = float(np.broadcast_to(back, ratio.shape)[first])
    text = f"The contact lasts {value:.3g} times as long as bending waves take to the edge and back"
    text += f", {engineering(back, 's')}"
    exceeded = value > _EDGES
    if exceeded:
        text += f": the restitution of a plate without edges is accurate up to a third; {_BY_MODES}"
    yield Limit("edges", value, _EDGES, exceeded, f"{text}.", severe=value > 2 * _EDGES)


def _second_contact(structure, hit, plate):
    """Yield the limit for a plate that swings back and hits the body again before the body is gone."""
    e = np.asarray(hit.restitution)
    plate = plate & (e > 0)
    if structure.edge is None or structure.wave_spread is None or not plate.any():
        return
    back = (2 * np.asarray(structure.edge)) ** 2 / (BACK * structure.wave_spread)
    with np.errstate(divide="ignore"):
        ratio = np.where(plate, _AGAIN * hit.mass / (structure.impedance * back) * (1 + e) / e, 0.0)
    value = float(ratio.max())
    text = f"The remaining deflection is {value:.3g} times that from which a plate hits the body again"
    if value > 1:
        text += f": there is a second contact, and the restitution of one contact is not final; {_BY_MODES}"
    yield Limit("second contact", value, 1.0, value > 1, f"{text}.")


def _support_limit(structure, hit, support):
    """Yield the limit for the excess of the largest force due to the mass of a support.

    If the excess may be large, one mode of the support estimates it.
    """
    if not support.any():
        return
    if structure.mass is None:
        text = "The mass of the support is neglected; with a mass of the structure its effect is estimated."
        yield Limit("support", 0.0, _HEAVY, False, text)
        return
    own = np.broadcast_to(structure.mass, support.shape)
    # First the body hits the free mass of the support.
    reduced = hit.mass * own / (hit.mass + own)
    dry = replace(hit.medium, eta=0.0)
    alone = impact(hit.profile, dry, reduced, hit.speed).max_force
    ratio = np.where(support, alone / np.asarray(hit.max_force), 0.0)
    value, what = float(ratio.max()), "at most"
    if value > _HEAVY:
        # Yield hides the effect of the mass: also take the worst of the impacts with the least yield.
        share = np.where(ratio > _HEAVY, hit.plastic_work / (hit.mass * hit.speed**2 / 2), np.inf)
        least = np.where(share <= share.min() + _LEAST, ratio, 0.0)
        worst = {np.unravel_index(np.argmax(each), ratio.shape) for each in (ratio, least)}
        value, what = max(_by_one_mode(hit, own, index, dry) for index in worst), "about"
    text = f"The mass of the support adds {what} {100 * max(value, 0.0):.2g} % to the largest force"
    text += f"; {_BY_MODES}." if value > _HEAVY else "."
    yield Limit("support", value, _HEAVY, value > _HEAVY, text)


def _by_one_mode(hit, own, worst, medium):
    """Return the relative excess of the largest force of one impact, by one mode of the support."""
    shape = own.shape
    imprint = hit.plastic_depth - getattr(hit, "plastic_depth_increase", hit.plastic_depth)
    given = hit.mass, hit.speed, imprint, hit.max_force
    mass, speed, imprint, force = (float(np.broadcast_to(each, shape)[worst]) for each in given)
    K = float(np.broadcast_to(hit.structure.stiffness, shape)[worst])
    mode = Structure.modal(np.sqrt(K / own[worst]) / (2 * np.pi), own[worst])
    profile, medium = hit.profile.entries(worst, shape), medium.entries(worst, shape)
    by_mode = impact(profile, medium, mass, speed, plastic_depth=imprint, structure=mode)
    return float(by_mode.max_force) / force - 1


def _small_limits(structure, hit):
    """Yield the limits for the deflection and the dent over half the thickness."""
    if structure.thickness is None:
        return
    half = np.asarray(structure.thickness) / 2
    for what, length, remedy in (
        ("deflection", hit.max_deflection, "the plate stretches, and the force is larger"),
        ("dent", hit.plastic_depth, "the plate is too thin to be a half-space"),
    ):
        value = float(np.max(length / half, initial=0.0))
        text = f"The {what} reaches {value / 2:.3g} times the thickness of the plate"
        yield Limit(what, value, 1.0, value > 1, f"{text}{': ' + remedy if value > 1 else ''}.")


def _weight_limit(hit):
    """Yield the limit for the speed that gravity adds in the contact time, over the impact speed."""
    time = np.asarray(hit.contact_time)
    ratio = np.where(np.isfinite(time), _GRAVITY * time / hit.speed, 0.0)
    value = float(np.max(ratio, initial=0.0))
    text = f"Gravity adds g T = {100 * value:.2g} % to the speed during the contact"
    if value > _WEIGHT:
        yield Limit("weight", value, _WEIGHT, True, f"{text}: the model neglects it.", severe=False)


def _shortest_contact(hit):
    """Return the duration (s) of the shortest contact that has at least 1 % of the momentum."""
    if hit.structure.modes is None:
        return np.asarray(hit.contact_time)
    shape, momentum = np.shape(hit.speed), np.asarray(hit.mass * hit.speed)
    shortest = np.empty(shape)
    for index in np.ndindex(*shape):
        hits = hit.hits[index] if shape else hit.hits
        shortest[index] = min(
            each.end - each.start for each in hits if each.impulse >= _COUNTS * momentum[index]
        )
    return shortest


def _thin_limit(structure, hit, plate):
    """Yield the limit for a thin plate.

    The value is the larger of two ratios: contact radius to half the thickness, and six times the time of a
    shear wave through the plate to the contact time.
    """
    if structure.thickness is None or not plate.any():
        return
    wide = np.where(plate, hit.contact_radius / (_THIN * np.asarray(structure.thickness)), 0.0)
    short = np.zeros_like(wide)
    if structure.shear_speed is not None:
        through = _PERIODS * np.asarray(structure.thickness) / structure.shear_speed
        short = np.where(plate, through / _shortest_contact(hit), 0.0)
    value = float(max(np.max(wide, initial=0.0), np.max(short, initial=0.0)))
    if np.max(wide, initial=0.0) >= np.max(short, initial=0.0):
        text = f"The contact radius reaches {_THIN * value:.3g} times the thickness of the plate"
        remedy = ", which is then not a half-space: E* is too small."
    else:
        text = f"The contact lasts {_PERIODS / value:.3g} times as long as a shear wave through the plate"
        remedy = ", but the theory of thin plates needs at least six times."
    yield Limit("thin", value, 1.0, value > 1, text + (remedy if value > 1 else "."))
