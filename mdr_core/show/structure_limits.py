"""Limits of the model of a structure: the edges of a plate, and its thickness."""

import numpy as np

from ..base.results import Limit
from .quantities import engineering

#: Contact time over the time after which bending waves are back from the nearest edge, up to which the
#: restitution of a simply supported plate by its modes is within 1.4 %
#: (tests/solver/impacts/test_modes.py).
_EDGES = 1 / 3
#: A wave of bending is back from a way r after r²/(7.70 √(D/ρh)), where Si(r²/(4 t √(D/ρh))) is π/2.
_BACK = 7.70
#: Contact radius over the thickness, and contact time over the way of shear waves through it.
_THIN = 0.5
_PERIODS = 6.0


def structure_limits(hit):
    """`Limit`s of impacts on a structure by what it was told; none without one."""
    structure, shape = hit.structure, np.shape(hit.speed)
    plate = np.broadcast_to(structure.is_plate, shape)
    if not plate.any():
        return ()
    return (*_edge_limit(structure, hit, plate), *_thin_limit(structure, hit, plate))


def _edge_limit(structure, hit, plate):
    """Contact time over the time in which bending waves are back; a body that never leaves has all time."""
    time = np.asarray(hit.contact_time)
    endless = np.isinf(time) & plate
    if structure.edge is None and not endless.any():
        return
    if endless.any():
        text = (
            "The body never leaves a plate without edges. A plate has edges, from which waves come back "
            "and lift it. For a body as heavy as the plate or more, take a support with its stiffness."
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
    back = (2 * np.asarray(structure.edge)) ** 2 / (_BACK * structure.wave_spread)
    ratio = np.where(plate, time / back, 0.0)
    first = np.unravel_index(np.argmax(ratio), ratio.shape)
    value = float(ratio[first])
    back = float(np.broadcast_to(back, ratio.shape)[first])
    text = f"The contact lasts {value:.3g} times as long as bending waves take to the edge and back"
    text += f", {engineering(back, 's')}"
    exceeded = value > _EDGES
    text += (
        ": the restitution of a plate without edges is good up to a third. For a body at least as heavy as "
        "the plate take a support with its stiffness; for lighter ones neither holds."
        if exceeded
        else "."
    )
    yield Limit("edges", value, _EDGES, exceeded, text, severe=value > 2 * _EDGES)


def _thin_limit(structure, hit, plate):
    """Contact radius over half of the thickness, or shear waves over the contact time: the larger one."""
    if structure.thickness is None:
        return
    wide = np.where(plate, hit.contact_radius / (_THIN * np.asarray(structure.thickness)), 0.0)
    short = np.zeros_like(wide)
    if structure.shear_speed is not None:
        through = _PERIODS * np.asarray(structure.thickness) / structure.shear_speed
        short = np.where(plate, through / np.asarray(hit.contact_time), 0.0)
    value = float(max(np.max(wide, initial=0.0), np.max(short, initial=0.0)))
    if np.max(wide, initial=0.0) >= np.max(short, initial=0.0):
        text = f"The contact radius reaches {_THIN * value:.3g} times the thickness of the plate"
        remedy = ", which is no half-space for it: E* is too small."
    else:
        text = f"The contact lasts {_PERIODS / value:.3g} times as long as a shear wave through the plate"
        remedy = ", too short for the theory of thin plates, which needs six times."
    yield Limit("thin", value, 1.0, value > 1, text + (remedy if value > 1 else "."))
