"""The energy balance of an impact without viscosity: how deep it comes, and what it gives back.

The indenter meets a medium with an imprint of plastic depth p₀ (0 if virgin). With y = d − p₀ the
live interval is [p₀ + Δ, p₀ + Δ + ℓ], ℓ = min(y, d_c) and Δ = max(0, y − d_c), and the work is
2E* [∫(d − s) a ds over it + d_c ∫a ds over [p₀, p₀ + Δ]]: stored, and dissipated by yielding.
"""

import numpy as np

from .._numeric import LONG, broadcast_flat, chunks, increasing_root
from ..closed_forms import closed_forms
from ..superposition import energy_integral, radius_and_energy, radius_integral, tabulated
from ..yielding import LiveInterval

#: So many impacts on one tip are worth a table of it.
_FEW = 16
#: Relative length of the last step: the square of it is rounding.
_LAST_STEP = 1e-7


def turning_interval(profile, target, d_c, before):
    """Live interval at which a dry impact has spent its energy, and Δ (m), the growth of the plastic depth.

    Elementwise for energies `target` over 2E* (m³), to whose shape indenters, critical depths d_c (m) and
    plastic depths p₀ (m) `before` the impact broadcast. The interval is infinite where the shape is not
    known as deep; Δ is carried, because p₀ may be much larger.
    """
    forms = closed_forms(profile)
    if forms and not np.any(before):
        interval = forms.turning_interval(target, d_c)
        if interval is not None:
            return interval, interval.lower
    profile, shape = quick(profile, target.size), target.shape
    unit, *scales = profile.unit or (profile, 1.0, 1.0)
    # Beside the results there is no more than a block of anything.
    _, arrays = broadcast_flat(target, d_c, before, *scales)
    found = np.empty((4, target.size))
    for rows in chunks(target.size, LONG):
        target, d_c, before, radius, depth = (part[rows] for part in arrays)
        target, d_c, before = target / (radius * depth**2), d_c / depth, before / depth
        y = _penetration(unit.flat_entries(rows, shape), target, d_c, before)
        interval, increase = loading_interval(np.where(np.isinf(y), 0.0, y), d_c, before)
        upper = np.where(np.isinf(y), np.inf, interval.upper)
        found[:, rows] = depth * np.array([interval.lower, upper, interval.length, increase])
    *interval, increase = found.reshape(4, *shape)
    return LiveInterval(*interval), increase


def quick(profile, count):
    """The shape to solve so many impacts with: that of a tip which ends somewhere as a table of it."""
    many = count > _FEW and np.all(profile.known_depth < np.inf)
    return tabulated(profile, profile.known_depth) if many else profile


def loading_interval(y, d_c, before):
    """Live interval and growth of the plastic depth after pressing by y ≥ 0 (m) into an imprint."""
    increase = np.maximum(y - d_c, 0.0)
    lower, length = before + increase, np.minimum(y, d_c)
    return LiveInterval(lower, np.maximum(before + y, lower), length), increase


def plastic_integral(profile, interval, d_c, increase):
    """d_c ∫ a ds over the depths by which the imprint has grown: plastic work over 2E* (m³)."""
    integral = radius_integral(profile, LiveInterval(interval.lower - increase, interval.lower, increase))
    with np.errstate(invalid="ignore"):
        return np.where(increase > 0, d_c * integral, 0.0)


def dry_restitution(profile, interval, d_c, increase):
    """Coefficient of restitution e = √(U/(U + W_p)) of an impact without viscosity."""
    profile = quick(profile, np.size(interval.length))
    stored = energy_integral(profile, interval)
    # U over the sum instead of U over the kinetic energy: never above 1.
    return np.sqrt(stored / (stored + plastic_integral(profile, interval, d_c, increase)))


def _penetration(profile, target, d_c, before):
    """y = d − p₀ (m) at which the work over 2E* is `target`; infinite beyond the known shape.

    The work grows about as a power of y: Newton's method on their logarithms, until a step says that the
    next one would be less than rounding.
    """

    def work(y, rows):
        interval, increase = loading_interval(y, d_c[rows], before[rows])
        indenters = profile.entries(rows, target.shape)
        force, stored = radius_and_energy(indenters, interval)
        return stored + plastic_integral(indenters, interval, d_c[rows], increase), force

    highest = np.broadcast_to(profile.known_depth - before, target.shape)
    with np.errstate(all="ignore"):
        y = np.minimum(_about(profile, target, d_c, before), highest)
        rows = np.arange(y.size)
        for _ in range(12):
            value, slope = work(y[rows], rows)
            step = np.log(target[rows] / value) * value / (slope * y[rows])
            new = np.minimum(y[rows] * np.exp(step), highest[rows])
            # Short of its energy at the end of the shape.
            y[rows] = np.where((y[rows] == highest[rows]) & (step > 1e-13), np.inf, new)
            rows = rows[~(np.abs(step) < _LAST_STEP) & (y[rows] < np.inf)]
            if not rows.size:
                return y
        # From far away, or out of double precision: in a bracket.
        y[rows] = increasing_root(lambda y: work(y, rows), target[rows], 1.0, highest[rows])
    return y


def _about(profile, target, d_c, before):
    """What `_penetration` begins with."""
    if profile.unit is None:
        return np.where(np.isinf(d_c), 1.0, d_c)
    table, met = profile.table, before.any()
    elastic = table.depth_of_volume(target)
    # As if the force were that in the middle of the live interval, and went as the depth to the power 3/2.
    spent = table.area(before) if met else 0.0
    middle = table.depth_of_area(target / d_c + spent)
    yielding = middle - d_c * d_c / (48 * middle) + d_c / 2 - before
    if met:
        # No deeper than a flat punch of what the imprint is wide.
        punch = np.sqrt(2 * target / table.radius(before))
        elastic = np.where(before > 0, np.minimum(elastic, punch), elastic)
    return np.where(elastic > d_c, np.maximum(yielding, d_c), elastic)
