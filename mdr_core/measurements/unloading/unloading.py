"""Unloadings of a curve, and their power law: force, stiffness and exponent at the largest depth."""

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from ...base.remark import MeasurementError, Remark, Remedy
from ...show.quantities import engineering
from ..common.errors import roughness
from ..common.least_squares import least_squares

#: Bounds of force and stiffness, in units of those of the samples, and of the exponent.
_LOWER, _UPPER = np.array([[0.1, 1e-3, 0.5]]), np.array([[10.0, 1e3, 50.0]])
#: Shares of the largest force at the start and the end of the fitted part: first for the result, then for
#: other parts.
_SHARES = (0.99, 0.5), (0.99, 0.4), (0.99, 0.3), (0.95, 0.5), (0.95, 0.4), (0.95, 0.3)
#: Further parts. They count if m is above a number and more than a share of the largest depth remains.
_FURTHER, _BENT, _REMAINS = ((0.99, 0.2), (0.95, 0.2)), 1.5, 0.25
#: Smallest fall and rise of the force between two unloadings, as a share of the peak before. Smallest peak,
#: as a share of the largest force. Standard deviations of noise that both must exceed.
_FALL, _PEAK, _NOISE = 0.1, 0.01, 6.0


def parts_of(force):
    """Return the parts of a curve that end with an unloading, one after the other, as slices."""
    least = max(_PEAK * force.max(), _NOISE * roughness(force[None])[0, 0])
    parts, begin, peak, lowest = [], 0, 0, None
    for i, value in enumerate(force):
        step = max(_FALL * force[peak], least)
        if lowest is None:
            if value >= force[peak]:
                peak = i
            elif force[peak] > least and value < force[peak] - step:
                lowest = i
        elif value <= force[lowest]:
            lowest = i
        elif value > force[lowest] + step:
            parts.append(slice(begin, lowest + 1))
            begin, peak, lowest = lowest, i, None
    return parts if lowest is None else [*parts, slice(begin, force.size)]


def last_at_top(depth):
    """Return the index of the last sample at the largest depth."""
    return int(np.flatnonzero(depth == depth.max())[-1])


@dataclass(frozen=True)
class Laws:
    """Force (N), stiffness (N/m) and exponent of an unloading at its largest depth.

    `deviations` (3, 3) are independent deviations due to the scatter about the power law. `others` and
    `further` are force, stiffness and exponent of other parts of the unloading.
    """

    solution: np.ndarray
    deviations: np.ndarray
    others: list
    further: list

    @property
    def exponent(self):
        """Exponent m."""
        return float(self.solution[2])

    @property
    def scatter(self):
        """Standard deviation of m due to the scatter about the power law."""
        return float(np.linalg.norm(self.deviations[2]))

    @property
    def exponents(self):
        """Smallest and largest m of the parts."""
        all_of = [self.exponent, *(float(m) for _, _, m in self.others)]
        return min(all_of), max(all_of)

    def remaining(self, depth):
        """Return the share of the largest depth (m) that remains after the unloading, by the power law."""
        force, stiffness, m = self.solution
        return 1 - float(m * force / stiffness / depth) if depth > 0 else 0.0

    def bends(self, depth):
        """Whether m is too large for an unloading after which a part of the largest depth (m) remains."""
        return self.exponent > _BENT and self.remaining(depth) > _REMAINS


def laws_of(depth, force):
    """Return the `Laws` of an unloading."""
    solution, deviations = _power_law(*_part(depth, force, *_SHARES[0]))
    further = _FURTHER if solution[2] > _BENT else ()
    others = [list(_laws_of_parts(depth, force, parts)) for parts in (_SHARES[1:], further)]
    return Laws(solution, deviations, *others)


def _laws_of_parts(depth, force, parts):
    """Yield force, stiffness and exponent of the parts of an unloading that follow a power law."""
    for shares in parts:
        with suppress(ValueError):
            yield _power_law(*_part(depth, force, *shares))[0]


def _part(depth, force, upper, lower):
    """Return depths (m) minus the largest, and forces (N), of the unloading between shares of the force."""
    start = last_at_top(depth)
    h, F = depth[start:] - depth[start], force[start:]
    share = F / (np.abs(F).max() or 1.0)
    below = np.flatnonzero(share < lower)
    end = below[0] if below.size else np.argmin(F) + 1
    first = np.flatnonzero(share[:end] >= upper)
    h, F = (values[first[-1] if first.size else end : end] for values in (h, F))
    if h.size < 5 or h.min() == 0:
        largest = engineering(depth[start], "m")
        text = (
            f"the upper half of an unloading has {h.size} samples, 5 or more are needed: after the largest "
            f"depth, {largest} (sample {start + 1} of {depth.size}), depth and force must decrease"
        )
        raise MeasurementError(Remark(text, "no unloading", Remedy("part", "all")))
    return h, F


def _power_law(h, force):
    """Fit force, stiffness and exponent at h = 0 of F (1 + S h/(m F))^m, with independent deviations."""
    size = np.array([force[0], force[0] / -h.min(), 1.0])
    x, y = h / -h.min(), force / force[0]

    def function(parameters, _):
        F, S, m = parameters.T[:, :, None]
        u = np.maximum(1 + S * x / (m * F), 1e-9)
        power = u ** (m - 1)
        columns = power * (u - S * x / F), power * x, F * power * (u * np.log(u) + 1 - u)
        return F * u * power - y, np.stack(columns, axis=-1)

    start = np.array([[1.0, np.polyfit(x, y, 1)[0], 1.5]])
    minimum = least_squares(function, start, _LOWER, _UPPER)
    if minimum.at_bound.any():
        text = (
            "the upper half of the unloading does not follow a power law: the depth creeps, or the force "
            "is not that of a contact"
        )
        raise MeasurementError(Remark(text, "no unloading"))
    _, s, vt = np.linalg.svd(minimum.jacobian[0], full_matrices=False)
    scatter = np.sqrt(minimum.sum_of_squares[0] / (h.size - 3))
    return minimum.x[0] * size, size[:, None] * vt.T * scatter / s
