"""A contact narrower than an element: its force, energy and works are integrals over the contact itself.

The element without width on the axis knows the history of all those inside the first one: with the profile
there, their plastic parts are max(u_p − g, 0), and their penetrations are less by max(g − u_p, 0), with u_p
on the axis. What has been released counts as relaxed when the indenter comes back to it.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..numerics.gauss import gauss_legendre
from . import element
from .element import Elements


class ViscousLoss(NamedTuple):
    """Energies (J): dissipated by the dashpots so far, and left in springs that relax out of contact."""

    work: float = 0.0
    relaxing: float = 0.0


def was_always_narrow(row):
    """Whether the largest contact of a row so far ends inside the first element."""
    return row.profile.contact_radius(max(row.largest, 0.0)) < row.elements.width[1]


def contact_within_an_element(row):
    """Widths (m) and elastic parts (m) on a side of a contact narrower than an element, else None."""
    elements = row.elements
    if not was_always_narrow(row) and (not elements.contact[0] or elements.contact[2:].any()):
        return None
    rim = _rim(row, min(row.lag, 0.0))
    if not 0 < rim < elements.width[1]:
        return None
    inside = _elements(row, [_imprint(row), rim])
    return inside.width, inside.penetration


def plastic_work(row):
    """W_p = 2E* ∫ u_c c dd_p (J) of the largest contact radius so far, from that at the onset of yield on.

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
    """`ViscousLoss` after the straight move of a row in a time (s) to where it has `moved`."""
    ramp = row.ramp(moved.depth - row.depth, dt, moved.depth)
    before, along = min(row.lag, 0.0), min(ramp.lag, 0.0)
    slower = max(before, along)
    radii = [_imprint(row), _imprint(moved), _rim(row, before), _rim(row, along), _rim(moved, along)]
    start = _elements(row, radii)
    # A slower retreat has the wider contact: it is reached at once by what relaxes.
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
    """Radius (m) of the imprint."""
    plastic = float(row.elements.plastic[0])
    return float(row.profile.contact_radius(plastic)) if plastic > 0 else 0.0


def _rim(row, lag):
    """Radius (m) at which the springs carry as much as the dashpots with a lag (m) that is not positive."""
    elements = row.elements
    penetration = float(elements.penetration[0]) + lag
    depth = float(elements.plastic[0]) + penetration
    return float(row.profile.contact_radius(depth)) if penetration > 0 else 0.0


def _elements(row, radii):
    """Relaxed `Elements` at the nodes of a quadrature from the axis to the largest of some radii (m)."""
    x, width = _nodes(radii)
    axis, g = row.elements, row.profile.reduced(x)
    penetration = axis.penetration[0] - np.maximum(g - axis.plastic[0], 0.0)
    plastic = np.maximum(axis.plastic[0] - g, 0.0)
    return Elements(x, width, g, penetration, np.zeros_like(x), plastic, np.zeros(x.shape, bool))


def _nodes(radii, start=0.0):
    """Radii (m) and weights (m) of a quadrature between a start and all these radii (m)."""
    edges = np.unique([start, *radii])
    node, weight = gauss_legendre(24)
    # From the axis, the edge of the imprint and the onset on, functions may be roots: even in t⁴.
    length = np.diff(edges)[:, None]
    return (edges[:-1, None] + length * node**4).ravel(), (length * (4 * node**3 * weight)).ravel()
