"""Limits of the model of a structure: edges, a second contact, mass of a support, thickness, weight."""

from dataclasses import replace

import numpy as np

from ..base.results import Limit
from ..solver.impacts.impact import impact
from ..solver.medium.structure import Structure
from .quantities import engineering

#: Contact time over the time after which bending waves are back from the nearest edge, up to which the
#: restitution of a simply supported plate by its modes is within 1.4 %
#: (tests/solver/impacts/test_modes.py).
_EDGES = 1 / 3
#: A wave of bending is back from a way r after r²/(7.70 √(D/ρh)), where Si(r²/(4 t √(D/ρh))) is π/2.
BACK = 7.70
#: Contact radius over the thickness, and contact time over the way of shear waves through it.
_THIN = 0.5
_PERIODS = 6.0
#: Of 60 random plates with 300 modes all second contacts lie below 1.25 times this bound.
_AGAIN = 2.4
#: Excess of the force by the mass of a support, and share of the speed that gravity adds, which are told.
_HEAVY, _WEIGHT, _GRAVITY = 0.05, 0.05, 9.81
#: Shares of the energy that yielding takes, which count as equal.
_LEAST = 0.01
#: Share of the impulse from which on a contact counts.
_COUNTS = 0.01
_BY_MODES = "take the structure by its modes, as Structure.supported_plate"


def structure_limits(hit):
    """`Limit`s of impacts on a structure by what it was told; none without one."""
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
    """Contact time over the time in which bending waves are back; a body that never leaves has all time."""
    time = np.asarray(hit.contact_time)
    endless = np.isinf(time) & plate
    if structure.edge is None and not endless.any():
        return
    if endless.any():
        text = (
            "The body never leaves a plate without edges. A plate has edges, from which waves come back "
            f"and lift it: {_BY_MODES}."
        )
        yield Limit("edges", np.inf, _EDGES, True, text)
        return
    if structure.wave_spread is None:
        text = (
            "The time in which waves are back from the edge is not known without wave_spread: "
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
        text += f": the restitution of a plate without edges is good up to a third; {_BY_MODES}"
    yield Limit("edges", value, _EDGES, exceeded, f"{text}.", severe=value > 2 * _EDGES)


def _second_contact(structure, hit, plate):
    """Whether the plate swings back and hits the body again, before it is gone."""
    e = np.asarray(hit.restitution)
    plate = plate & (e > 0)
    if structure.edge is None or structure.wave_spread is None or not plate.any():
        return
    back = (2 * np.asarray(structure.edge)) ** 2 / (BACK * structure.wave_spread)
    with np.errstate(divide="ignore"):
        ratio = np.where(plate, _AGAIN * hit.mass / (structure.impedance * back) * (1 + e) / e, 0.0)
    value = float(ratio.max())
    text = f"The deflection that stays, over that from which a plate hits the body again, is {value:.3g}"
    if value > 1:
        text += f": there is a second contact, and the restitution of one contact is no result; {_BY_MODES}"
    yield Limit("second contact", value, 1.0, value > 1, f"{text}.")


def _support_limit(structure, hit, support):
    """Excess of the largest force by the mass of a support, estimated by one mode where it may be large."""
    if not support.any():
        return
    if structure.mass is None:
        text = "A support has no mass of its own here. With Structure(stiffness=K, mass=…) it is estimated."
        yield Limit("support", 0.0, _HEAVY, False, text)
        return
    own = np.broadcast_to(structure.mass, support.shape)
    # The light mass of the support alone meets the body.
    reduced = hit.mass * own / (hit.mass + own)
    dry = replace(hit.medium, eta=0.0)
    alone = impact(hit.profile, dry, reduced, hit.speed).max_force
    ratio = np.where(support, alone / np.asarray(hit.max_force), 0.0)
    value, what = float(ratio.max()), "at most"
    if value > _HEAVY:
        # Yield hides the mass: of many impacts also the worst one of those that yield least counts.
        share = np.where(ratio > _HEAVY, hit.plastic_work / (hit.mass * hit.speed**2 / 2), np.inf)
        least = np.where(share <= share.min() + _LEAST, ratio, 0.0)
        worst = {np.unravel_index(np.argmax(each), ratio.shape) for each in (ratio, least)}
        value, what = max(_by_one_mode(hit, own, index, dry) for index in worst), "about"
    text = f"The mass of the support adds {what} {100 * max(value, 0.0):.2g} % to the largest force"
    text += f"; {_BY_MODES}." if value > _HEAVY else "."
    yield Limit("support", value, _HEAVY, value > _HEAVY, text)


def _by_one_mode(hit, own, worst, medium):
    """Excess of the largest force of one impact, of all at an index, by one mode of the support."""
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
    """Deflection and dent over half of the thickness."""
    if structure.thickness is None:
        return
    half = np.asarray(structure.thickness) / 2
    for what, length, remedy in (
        ("deflection", hit.max_deflection, "the plate stretches, and the force is larger"),
        ("dent", hit.plastic_depth, "the plate is no half-space for it"),
    ):
        value = float(np.max(length / half, initial=0.0))
        text = f"The {what} reaches {value / 2:.3g} times the thickness of the plate"
        yield Limit(what, value, 1.0, value > 1, f"{text}{': ' + remedy if value > 1 else ''}.")


def _weight_limit(hit):
    """Speed that gravity adds in the contact time over the speed."""
    time = np.asarray(hit.contact_time)
    ratio = np.where(np.isfinite(time), _GRAVITY * time / hit.speed, 0.0)
    value = float(np.max(ratio, initial=0.0))
    text = f"Gravity adds g T = {100 * value:.2g} % to the speed during the contact"
    if value > _WEIGHT:
        yield Limit("weight", value, _WEIGHT, True, f"{text}: it is left out here.", severe=False)


def _shortest_contact(hit):
    """Duration (s) of the shortest contact that has more than 1 % of the momentum."""
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
    """Contact radius over half of the thickness, or shear waves over the contact time: the larger one."""
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
        remedy = ", which is no half-space for it: E* is too small."
    else:
        text = f"The contact lasts {_PERIODS / value:.3g} times as long as a shear wave through the plate"
        remedy = ", too short for the theory of thin plates, which needs six times."
    yield Limit("thin", value, 1.0, value > 1, text + (remedy if value > 1 else "."))
