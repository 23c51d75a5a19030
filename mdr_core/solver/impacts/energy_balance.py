"""Impacts without viscosity by the energy balance: maximum depth and restitution, without time stepping.

The indenter meets a medium with an imprint of plastic depth p₀ (0 if virgin). Up to the penetration
y = d − p₀ its work is the energy U = 2E* ∫(d − s) a ds stored over the live interval, plus the plastic work
W_p. A support of stiffness K additionally takes up F²/2K. The kinetic energy is spent when

    U + W_p + F²/2K = m v₀²/2

On the way back, U and F²/2K are returned. With F = 2E* Φ and κ = 2E*/K, the last term over 2E* is κ Φ²/2.
"""

from dataclasses import dataclass, replace

import numpy as np

from ...base import check
from ..contact.indentation import Indentation
from ..contact.integrals import integrals, tabulated_for
from ..contact.live_interval import LiveInterval
from ..contact.yielding import yield_rule
from ..medium.structure import RIGID
from ..numerics.blocks import LONG, broadcast_flat, chunks
from ..numerics.roots import increasing_root, largest_value
from .contact_time import contact_time
from .result import Impact
from .snap import depth_before_snap


@dataclass(frozen=True, eq=False, repr=False)
class DryImpact(Impact):
    """Impacts on a medium without viscosity and adhesion, on a support or without one."""

    @check.frozen_property
    def restitution(self):
        """e = √(R/(R + W_p)), R = U + F²/2K; with this sum as the kinetic energy, e is never above 1."""
        profile, modulus = self._rule.profile, 2 * self.medium.E_star
        returned = modulus * integrals(profile).energy_integral(self.turning_point.live_interval)
        if np.any(self.structure.is_support):
            returned = returned + self.turning_point.force**2 / (2 * self.structure.stiffness)
        return np.sqrt(returned / (returned + self.plastic_work))

    @check.frozen_property
    def max_force(self):
        """Largest force (N): at the turning point, or before it if the force falls with depth."""
        return largest_force(self._rule, self.turning_point, self.plastic_depth_increase)

    @check.frozen_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact."""
        inertia = self.mass / (2 * self.medium.E_star)
        rule, interval = yield_rule(self.profile, self.medium), self.turning_point.live_interval
        support_compliance = _support_compliance(self.medium, self.structure)
        return contact_time(
            rule, inertia, self.speed, interval, self.plastic_depth_increase, support_compliance
        )


def dry_impact(profile, medium, mass, speed, imprint_depth, structure=RIGID):
    """Solve impacts over imprints of given plastic depth (m), without the losses to plates."""
    energy = mass * speed**2 / (4 * medium.E_star)
    rule, support_compliance = yield_rule(profile, medium), _support_compliance(medium, structure)
    interval, increase = turning_interval(rule, energy, imprint_depth)
    if support_compliance is not None:
        deepest = depth_before_snap(
            rule, imprint_depth, interval, increase, energy, support_compliance, structure
        )
        interval, increase = turning_interval(rule, energy, imprint_depth, support_compliance, deepest)
    turning_point = Indentation(profile, medium, interval.upper, interval, in_time=True)
    return DryImpact(mass[()], speed[()], turning_point, increase, structure=structure)


def _support_compliance(medium, structure):
    """Return κ = 2E*/K (1/m) of supports, or None without supports."""
    return 2 * medium.E_star / structure.stiffness if np.any(structure.is_support) else None


def largest_force(rule, turning_point, increase):
    """Return the largest force (N) of the springs, at the turning point or before it.

    It is before the turning point if the force falls with depth. `increase` (m) is the increase of the
    plastic depth.
    """
    force, interval, shape = turning_point.force, turning_point.live_interval, np.shape(increase)
    if not rule.may_fall(turning_point.depth):
        return force
    rule = rule.flat_entries(slice(None), shape).entries((slice(None), None), (np.size(force),))
    imprint = np.reshape(interval.lower - increase, (-1, 1))
    largest = _largest_area(rule, imprint, np.reshape(interval.length + increase, (-1, 1)))
    return np.fmax(force, 2 * turning_point.medium.E_star * largest.reshape(shape))


def _largest_area(rule, imprint, penetration):
    """Return the largest ∫ a ds (m²) from the onset of yield to penetrations (m), one per row of (N, 1)."""
    start = np.minimum(rule.penetration(imprint, imprint), penetration)

    def area(share):
        interval, _ = rule.loading(start + (penetration - start) * share**3, imprint)
        return integrals(rule.profile).radius_integral(interval)

    # The last grid has 10⁵ places: at the onset there is no parabola.
    return largest_value(area, np.zeros_like(start), np.ones_like(start), grids=5)


def turning_interval(rule, target, before, support_compliance=None, deepest=np.inf):
    """Return the live interval at the turning point of a dry impact, and the increase Δ (m) of d_p.

    It is elementwise for kinetic energies `target` over 2E* (m³). The imprint's depth `before` (m) and the
    parameters of the `YieldRule` broadcast to the shape of `target`. `support_compliance` is κ = 2E*/K
    (1/m) of a support, and `deepest` (m) an upper bound of the penetration. The interval is infinite if the
    turning point is deeper than the known depth.
    """
    interval = None if np.any(before) or support_compliance is not None else rule.turning_interval(target)
    if interval is not None:
        return interval, interval.lower
    shape = target.shape
    given = rule

    def largest_depth():
        """Return the depth (m) of the largest energy; deeper impacts are beyond the table, and slower."""
        row = np.unravel_index(np.argmax(target), shape)
        imprint = np.broadcast_to(before, shape)[row]
        energy = np.array([target[row]])
        return imprint + _penetration(given.entries(row, shape), energy, np.array([imprint]), 0.1)[0]

    rule = replace(rule, profile=tabulated_for(rule.profile, target.size, largest_depth))
    unit, *scales = integrals(rule.profile).unit
    rule = rule.flat_entries(slice(None), shape)
    # Except for results and arguments, arrays are no longer than a block.
    _, arrays = broadcast_flat(
        target, before, *scales, 0.0 if support_compliance is None else support_compliance, deepest
    )
    result = np.empty((4, target.size))
    for rows in chunks(target.size, LONG):
        energy, imprint, length, depth, own_compliance, end = (array[rows] for array in arrays)
        part = rule.flat_entries(rows, (target.size,))
        part = part.in_units_of(unit.flat_entries(rows, shape), length, depth)
        imprint = imprint / depth
        own_compliance = None if support_compliance is None else own_compliance * length
        energy = energy / (length * depth**2)
        y = _penetration(part, energy, imprint, support_compliance=own_compliance, deepest=end / depth)
        interval, increase = part.turning(y, imprint)
        result[:, rows] = depth * np.array([interval.lower, interval.upper, interval.length, increase])
    *interval, increase = result.reshape(4, *shape)
    return LiveInterval(*interval), increase


def _penetration(rule, target, before, close=1e-7, support_compliance=None, deepest=np.inf):
    """Return y = d − p₀ (m) at which the work over 2E* is `target` (m³); infinite below the known depth.

    With κ (1/m) of a support, `support_compliance`, the support's energy κ Φ²/2 is a part of the work. The
    work grows up to the penetration `deepest` (m).

    The work grows approximately as a power of y, so that Newton's method solves for their logarithms. After
    a step smaller than `close`, the next step would be about its square: for 10⁻⁷ this is rounding.
    """

    def work(y, rows):
        part = rule.flat_entries(rows, target.shape)
        return part.work(y, before[rows], None if support_compliance is None else support_compliance[rows])

    highest = np.minimum(np.broadcast_to(rule.profile.known_depth - before, target.shape), deepest)
    y = np.minimum(_first_guess(rule, target, before), highest)
    rows = np.arange(y.size)
    for _ in range(12):
        value, slope = work(y[rows], rows)
        # Far from the root, powers may overflow.
        with np.errstate(all="ignore"):
            # If the force has almost no slope, as past the onset on a soft support, steps are too long.
            step = np.clip(np.log(target[rows] / value) * value / (slope * y[rows]), -60.0, 60.0)
            new = np.minimum(y[rows] * np.exp(step), highest[rows])
        # At the known depth the work is still less than the energy.
        y[rows] = np.where((y[rows] == highest[rows]) & (step > 1e-13), np.inf, new)
        rows = rows[~(np.abs(step) < close) & (y[rows] < np.inf)]
        if not rows.size:
            return y
    # The first guess was poor, or overflowed: search in a bracket.
    y[rows] = increasing_root(lambda y: work(y, rows), target[rows], 1.0, highest[rows])
    return y


def _first_guess(rule, target, before):
    """Return the penetration (m) to about 10⁻⁴ from the table of a profile, else at the onset of yield."""
    # Compared with the onset: 1.4 times as fast for 300 impacts of samples, 1.6 for 10⁵ of a rounded cone.
    onset = rule.penetration(before, before)
    table, imprint = integrals(rule.profile).table, before.any()
    if table is None:
        return np.where((onset > 0) & (onset < np.inf), onset, 1.0)
    elastic = table.depth_of_volume(target)
    if imprint:
        # Not deeper than a flat punch of the plastic radius.
        with np.errstate(divide="ignore"):
            punch = np.sqrt(2 * target / table.radius(before))
        elastic = np.where(before > 0, np.minimum(elastic, punch), elastic)
    # The mean of a force ∝ depth^(3/2) is nearly its value in the middle.
    cap = rule.cap(before + elastic)
    # If the cap is 0 or infinite, the other guess is used.
    with np.errstate(divide="ignore", invalid="ignore"):
        middle = table.depth_of_area(target / cap + (table.area(before) if imprint else 0.0))
        yielding = middle - cap * cap / (48 * middle) + cap / 2 - before
    return np.where(elastic > onset, np.maximum(yielding, onset), elastic)
