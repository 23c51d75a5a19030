"""The energy balance of an impact without viscosity: its maximum depth and its restitution.

The indenter meets a medium with an imprint of plastic depth p₀ (0 if virgin). With the penetration
y = d − p₀ the live interval is [p₀ + Δ, p₀ + Δ + ℓ], ℓ = min(y, d_c) and Δ = max(0, y − d_c), and the work
is 2E* [∫(d − s) a ds over it + d_c ∫a ds over [p₀, p₀ + Δ]]: stored, and dissipated by yielding.
"""

import numpy as np

from .._numeric import LONG, broadcast_flat, chunks, increasing_root
from ..closed_forms import closed_forms
from ..superposition import energy_integral, radius_and_energy, radius_integral, tabulated
from ..yielding import LiveInterval


def turning_interval(profile, target, d_c, before):
    """Live interval at the turning point of a dry impact, and the increase Δ (m) of the plastic depth.

    Elementwise for kinetic energies `target` over 2E* (m³), to whose shape the other arguments broadcast.
    The interval is infinite where the turning point is deeper than the known depth.
    """
    forms = closed_forms(profile)
    if forms and not np.any(before):
        interval = forms.turning_interval(target, d_c)
        if interval is not None:
            return interval, interval.lower
    profile, shape = tabulated_for(profile, target.size), target.shape
    unit, *scales = profile.unit or (profile, 1.0, 1.0)
    # Apart from the results, arrays are no longer than a block.
    _, arrays = broadcast_flat(target, d_c, before, *scales)
    result = np.empty((4, target.size))
    for rows in chunks(target.size, LONG):
        target, d_c, before, radius, depth = (array[rows] for array in arrays)
        target, d_c, before = target / (radius * depth**2), d_c / depth, before / depth
        y = _penetration(unit.flat_entries(rows, shape), target, d_c, before)
        interval, increase = loading_interval(np.where(np.isinf(y), 0.0, y), d_c, before)
        upper = np.where(np.isinf(y), np.inf, interval.upper)
        result[:, rows] = depth * np.array([interval.lower, upper, interval.length, increase])
    *interval, increase = result.reshape(4, *shape)
    return LiveInterval(*interval), increase


def tabulated_for(profile, count):
    """The profile to solve `count` impacts with: a table if they are many and the known depth is finite."""
    many = count > 16 and np.all(profile.known_depth < np.inf)
    return tabulated(profile, profile.known_depth) if many else profile


def loading_interval(y, d_c, before):
    """Live interval and increase of the plastic depth (m) at a penetration y ≥ 0 (m) into an imprint."""
    increase = np.maximum(y - d_c, 0.0)
    lower, length = before + increase, np.minimum(y, d_c)
    return LiveInterval(lower, np.maximum(before + y, lower), length), increase


def plastic_integral(profile, interval, d_c, increase):
    """Plastic work over 2E* (m³): d_c ∫ a ds over the increase of the plastic depth."""
    integral = radius_integral(profile, LiveInterval(interval.lower - increase, interval.lower, increase))
    with np.errstate(invalid="ignore"):
        return np.where(increase > 0, d_c * integral, 0.0)


def dry_restitution(profile, interval, d_c, increase):
    """Coefficient of restitution e = √(U/(U + W_p)) of an impact without viscosity."""
    profile = tabulated_for(profile, np.size(interval.length))
    stored = energy_integral(profile, interval)
    # U over the sum instead of U over the kinetic energy: never above 1.
    return np.sqrt(stored / (stored + plastic_integral(profile, interval, d_c, increase)))


def _penetration(profile, target, d_c, before):
    """y = d − p₀ (m) at which the work over 2E* is `target` (m³); infinite below the known depth.

    The work grows about as a power of y: Newton's method on their logarithms.
    """

    def work(y, rows):
        interval, increase = loading_interval(y, d_c[rows], before[rows])
        entries = profile.entries(rows, target.shape)
        force, stored = radius_and_energy(entries, interval)
        return stored + plastic_integral(entries, interval, d_c[rows], increase), force

    highest = np.broadcast_to(profile.known_depth - before, target.shape)
    with np.errstate(all="ignore"):
        y = np.minimum(_first_guess(profile, target, d_c, before), highest)
        rows = np.arange(y.size)
        for _ in range(12):
            value, slope = work(y[rows], rows)
            step = np.log(target[rows] / value) * value / (slope * y[rows])
            new = np.minimum(y[rows] * np.exp(step), highest[rows])
            # At the known depth the work is still less than the energy.
            y[rows] = np.where((y[rows] == highest[rows]) & (step > 1e-13), np.inf, new)
            # After a step of 10⁻⁷ the next one would be its square, which is rounding.
            rows = rows[~(np.abs(step) < 1e-7) & (y[rows] < np.inf)]
            if not rows.size:
                return y
        # The first guess was poor, or left double precision: in a bracket.
        y[rows] = increasing_root(lambda y: work(y, rows), target[rows], 1.0, highest[rows])
    return y


def _first_guess(profile, target, d_c, before):
    """Penetration (m) to about 10⁻⁴ from the table of a profile, else d_c."""
    if profile.unit is None:
        return np.where(np.isinf(d_c), 1.0, d_c)
    table, imprint = profile.table, before.any()
    elastic = table.depth_of_volume(target)
    # The mean of a force that goes as the power 3/2 of the depth is nearly that in the middle.
    middle = table.depth_of_area(target / d_c + (table.area(before) if imprint else 0.0))
    yielding = middle - d_c * d_c / (48 * middle) + d_c / 2 - before
    if imprint:
        # Not deeper than a flat punch of the plastic radius.
        punch = np.sqrt(2 * target / table.radius(before))
        elastic = np.where(before > 0, np.minimum(elastic, punch), elastic)
    return np.where(elastic > d_c, np.maximum(yielding, d_c), elastic)
