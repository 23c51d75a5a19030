"""A contact narrower than an element: its force, energy and works are integrals over the contact itself.

The element of width 0 on the axis, with the profile, determines the history of all points inside the first
element. With u_p on the axis, their plastic parts are max(u_p − g, 0). Their penetrations are smaller by
max(g − u_p, 0). Released points count as relaxed when the indenter returns to them.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..numerics.gauss import gauss_legendre
from . import element
from .element import Elements


class ViscousLoss(NamedTuple):
    """Energies (J) dissipated by the dashpots so far, and left in springs that relax out of contact."""

    work: float = 0.0
    relaxing: float = 0.0


def was_always_narrow(row):
    """Whether the largest contact of a row so far ends inside the first element."""
    return row.profile.contact_radius(max(row.largest, 0.0)) < row.elements.width[1]


def contact_within_an_element(row):
    """Return widths and elastic parts (m) on one side of a contact narrower than an element, or None."""
    elements = row.elements
    if not was_always_narrow(row) and (not elements.contact[0] or elements.contact[2:].any()):
        return None
    rim = _rim(row, min(row.lag, 0.0))
    if not 0 < rim < elements.width[1]:
        return None
    inside = _elements(row, [_imprint(row), rim])
    return inside.width, inside.penetration


def plastic_work(row):
    """Return W_p = 2E* ∫ u_c c dd_p (J), from the contact radius at the onset of yield to the largest one.

    c is the radius of the imprint of depth d_p = g(a) − u_c(a).
    """
    if row.largest <= row.onset:
        return 0.0
    profile = row.profile
    first, last = (float(profile.contact_radius(depth)) for depth in (row.onset, row.largest))
    a, width = _nodes([first, last], first)
    law = row.medium.law.scaled(np.pi / (2 * row.medium.E_star), 1.0)
    limit = law.line_load(a)
    depth = np.maximum(profile.reduced(a) - limit, 0.0)
    increase = width * (profile.reduced_slope(a) - law.line_load_rate(a))
    return float(2 * row.medium.E_star * np.sum(limit * profile.contact_radius(depth) * increase))


def viscous_loss(loss, row, moved, dt):
    """Return the `ViscousLoss` after the straight move of a row in a time (s) to the row `moved`."""
    ramp = row.ramp(moved.depth - row.depth, dt, moved.depth)
    before, along = min(row.lag, 0.0), min(ramp.lag, 0.0)
    slower = max(before, along)
    radii = [_imprint(row), _imprint(moved), _rim(row, before), _rim(row, along), _rim(moved, along)]
    start = _elements(row, radii)
    # A slower retreat has a wider contact, which relaxing points reach at once.
    contact, former = start.penetration > -slower, start.penetration > -before
    start = replace(start, elastic=np.where(contact, start.penetration, 0.0), contact=contact)
    end, exchange = element.advance(start, ramp)

    def total(values):
        return float(2 * row.medium.E_star * (values @ start.width))

    caught = total(np.where(contact & ~former, start.elastic**2 / 2, 0.0))
    released = total(np.where(end.contact, 0.0, end.elastic**2 / 2))
    left = max(loss.relaxing - caught, 0.0) * ramp.decay**2
    work = total(exchange.viscous) + loss.relaxing - caught - left
    return ViscousLoss(loss.work + work, left + released)


def _imprint(row):
    """Return the radius (m) of the imprint."""
    plastic = float(row.elements.plastic[0])
    return float(row.profile.contact_radius(plastic)) if plastic > 0 else 0.0


def _rim(row, lag):
    """Return the radius (m) at which springs and dashpots carry the same load, for a lag ≤ 0 (m)."""
    elements = row.elements
    penetration = float(elements.penetration[0]) + lag
    depth = float(elements.plastic[0]) + penetration
    return float(row.profile.contact_radius(depth)) if penetration > 0 else 0.0


def _elements(row, radii):
    """Return relaxed `Elements` at the nodes of a quadrature from the axis to the largest of radii (m)."""
    x, width = _nodes(radii)
    axis, g = row.elements, row.profile.reduced(x)
    penetration = axis.penetration[0] - np.maximum(g - axis.plastic[0], 0.0)
    plastic = np.maximum(axis.plastic[0] - g, 0.0)
    return Elements(x, width, g, penetration, np.zeros_like(x), plastic, np.zeros(x.shape, bool))


def _nodes(radii, start=0.0):
    """Return radii (m) and weights (m) of a quadrature between a start and all these radii (m)."""
    edges = np.unique([start, *radii])
    node, weight = gauss_legendre(24)
    # Functions may begin as roots at the axis, the edge of the imprint and the onset: nodes in t⁴.
    length = np.diff(edges)[:, None]
    return (edges[:-1, None] + length * node**4).ravel(), (length * (4 * node**3 * weight)).ravel()
