"""Creep at the start of an unloading: its rate at the end of the hold before."""

from dataclasses import dataclass

import numpy as np

from ..show.quantities import engineering
from .errors import roughness
from .unloading import last_at_top

#: Least force in a hold and largest deviation from its median, as shares, in standard deviations of noise.
_HELD, _STILL, _NOISE = 0.99, 1e-3, 4.0
#: Least number of samples in a hold, and least share of those at the largest force that are still.
_FEW, _MOST = 5, 0.5
#: Standard deviations from which on the rate changes in the hold, and the depth grows.
_SIGNIFICANT = 3.0
#: Least growth of depth, as a share of the largest depth, while the force falls.
_GROWTH = 1e-4
#: Share of the compliance 1/S above which creep is said.
COUNTS = 0.05


@dataclass(frozen=True)
class Creep:
    """Rate (m/s) of the depth at the end of a hold, its standard error, and the last sample of the hold."""

    rate: float
    error: float
    end: int

    def without(self, depth, time, deviations=0.0):
        """Depths (m) without creep after the hold, at the rate or some errors more."""
        rate = self.rate + deviations * self.error
        return depth - rate * np.maximum(time - time[self.end], 0.0)


def creep(depth, force, time):
    """`Creep` of one unloading with the hold before it, None where the force is not held."""
    noise = roughness(force[None])[0, 0]
    high = np.flatnonzero(force >= _HELD * force.max() - _NOISE * noise)
    run = slice(high[0], high[-1] + 1)
    middle = np.median(force[run])
    still = np.abs(force[run] - middle) <= max(_STILL * middle, _NOISE * noise)
    held = high[0] + np.flatnonzero(still)
    if held.size < _FEW or held.size < _MOST * still.size:
        return None
    end = int(held[-1])
    used = held[-max(held.size // 2, _FEW) :]
    t, h = time[used] - time[end], depth[used]
    scale = max(-t[0], 1e-300)
    (rate, _), (error, _) = _line(np.vander(t / scale, 2), h)
    if used.size >= 2 * _FEW:
        columns = np.vander(t / scale, 3)
        coefficients, errors = _line(columns, h)
        if abs(coefficients[0]) > _SIGNIFICANT * errors[0]:
            rate, error = coefficients[1], errors[1]
    return Creep(float(rate / scale), float(error / scale), end)


def _line(columns, values):
    """Coefficients of a linear least-squares fit, and their standard errors."""
    coefficients = np.linalg.lstsq(columns, values, rcond=None)[0]
    squares = np.sum((values - columns @ coefficients) ** 2) / max(values.size - columns.shape[1], 1)
    return coefficients, np.sqrt(np.diag(np.linalg.pinv(columns.T @ columns)) * squares)


def share_of_compliance(rate, stiffness, force, time, end):
    """ḣ/|Ṗ| over 1/S, where Ṗ is the rate of force at the start of the unloading after sample `end`."""
    after = force[end:]
    upper = int(np.argmax(after < 0.5 * force[end])) or after.size
    t, F = time[end : end + upper], after[:upper]
    if F.size < _FEW:
        return 0.0
    unloading = -np.polyfit((t - t[0]) / np.ptp(t), F, 2)[1] / np.ptp(t)
    return float(rate * stiffness / max(unloading, 1e-300))


def rise_of_depth(depth, force):
    """How far (m) the depth grows while the force falls, 0 where it does not beyond its noise."""
    noise = roughness(force[None])[0, 0]
    last = int(np.flatnonzero(force >= _HELD * force.max() - _NOISE * noise)[-1])
    top = last_at_top(depth)
    # Where more than half of the force is lost it is the force that has the wrong sign.
    if top <= last or not force[last] / 2 < force[top] < force[last] - _NOISE * noise:
        return 0.0
    rise = depth[top] - depth[last]
    least = max(_GROWTH * np.ptp(depth), 2 * _NOISE * roughness(depth[None])[0, 0])
    return float(rise) if rise > least else 0.0


def sentence(share):
    """A remark on creep that is not small."""
    return (
        f"the depth creeps at the start of the unloading: ḣ/|Ṗ| at the end of the hold is "
        f"{100 * share:.2g} % of 1/S; the stiffness is corrected for it (Feng and Ngan)"
    )


def sentence_of_rise(rise):
    """A remark on a depth that grows while the force falls."""
    return (
        f"the depth creeps: it grows by {engineering(rise, 'm')} while the force falls, so that the "
        "stiffness is too large; give time=, hold the force longer, or unload faster"
    )
