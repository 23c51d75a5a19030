"""Creep at the start of an unloading, from its rate at the end of the hold before."""

from dataclasses import dataclass

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ..common.errors import roughness
from .unloading import last_at_top

#: Smallest force in a hold and largest deviation from its median, as shares; the deviation also in standard
#: deviations of noise.
_HELD, _STILL, _NOISE = 0.99, 1e-3, 4.0
#: Start of the lines next to a hold, below its force, and their end, as shares of this force. Smallest
#: length of a hold, in errors of this length: with 5, tips of triangles had holds of 5 to 9 samples.
_BELOW, _LOWEST, _CERTAIN = 0.05, 0.7, 10.0
#: Smallest number of samples in a hold, and smallest share of constant samples at the largest force.
_FEW, _MOST = 5, 0.5
#: Smallest significant number of standard deviations for a change of the rate or of the force in a hold.
_SIGNIFICANT = 3.0
#: Smallest growth of the depth while the force falls, as a share of the range of depth.
_GROWTH = 1e-4
#: Smallest fall of the depth in a false hold, as a share of the range of depth, and smallest rate of this
#: fall over the rate in the unloading.
_LEAST_FALL, _AS_FAST = 1e-3, 0.3
#: Share of the compliance 1/S above which a remark reports creep.
COUNTS = 0.05


@dataclass(frozen=True)
class Creep:
    """Rate (m/s) of the depth at the end of a hold, its standard error, last sample and length (s)."""

    rate: float
    error: float
    end: int
    length: float

    def without(self, depth, time, deviations=0.0):
        """Return depths (m) without creep after the hold, at the rate plus some standard errors."""
        rate = self.rate + deviations * self.error
        return depth - rate * np.maximum(time - time[self.end], 0.0)


def creep(depth, force, time):
    """Return the `Creep` of an unloading with the hold before it, or None without a hold."""
    held = hold(time, force, depth)
    if held is None:
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
    return Creep(float(rate / scale), float(error / scale), end, float(time[end] - time[held[0]]))


def hold(time, force, depth):
    """Return the samples in the hold of the largest force, or None without a hold or at a sensor limit."""
    held = _held(time, force)
    return None if held is None or _turns(time, force, depth, held) else held


def _turns(time, force, depth, held):
    """Whether the depth falls in a hold as fast as in the unloading, because the force sensor is saturated.

    In a real hold the depth creeps or drifts, at a small share of the rate of the unloading.
    """
    end, top = held[-1], held[np.argmax(depth[held])]
    fall = depth[top] - depth[end]
    after = int(np.argmax(force[end:] < 0.5 * force[end]))
    if not after or fall <= max(_LEAST_FALL * np.ptp(depth), 2 * _NOISE * roughness(depth[None])[0, 0]):
        return False
    unloading = (depth[end] - depth[end + after]) / (time[end + after] - time[end])
    return bool(fall > _AS_FAST * unloading * (time[end] - time[top]))


def _held(time, force):
    """Return the samples in the hold of the largest force, or None.

    Straight lines through the force before and after the hold meet the median of its forces at two times.
    The samples are between these times. At the tip of a triangle, each new median is nearer to the tip,
    until no samples are left.
    """
    if force.max() <= 0:
        return None
    noise = roughness(force[None])[0, 0]
    high = np.flatnonzero(force >= _HELD * force.max() - _NOISE * noise)
    run = slice(high[0], high[-1] + 1)
    level = np.median(force[run])
    still = np.abs(force[run] - level) <= max(_STILL * level, _NOISE * noise)
    held = high[0] + np.flatnonzero(still)
    if held.size < _MOST * still.size:
        return None
    held = np.arange(held[0], held[-1] + 1)
    highest = level - max(_BELOW * level, _NOISE * noise)
    sides = slice(held[0], None, -1), slice(held[-1], None)
    lines = [_branch(time[side], force[side], highest) for side in sides]
    count = 0
    while held.size >= _FEW and held.size != count:
        count, level = held.size, np.median(force[held])
        begin, end = (t + rate * level for t, rate in lines)
        held = held[(time[held] >= begin) & (time[held] <= end)]
    if held.size < _FEW or _moves(time[held], force[held]):
        return None
    # The error of a median is 1.25 σ/√N.
    error = 1.25 * noise / np.sqrt(held.size) * sum(abs(rate) for _, rate in lines)
    return held if np.ptp(time[held]) > _CERTAIN * error else None


def _branch(time, force, highest):
    """Fit a line through forces below `highest`, away from a hold; return its time at force 0 and dt/dF.

    If the record has fewer than two such samples, the line is at the first time.
    """
    low = force < _LOWEST * highest
    part = slice(0, int(np.argmax(low)) if low.any() else force.size)
    t, F = time[part][force[part] < highest], force[part][force[part] < highest]
    if F.size < 2:
        return time[0], 0.0
    slope, start = np.polyfit(t - time[0], F, 1)
    return time[0] - start / slope, 1 / slope


def _moves(time, force):
    """Whether a force rises or falls beyond its noise, or first rises and then falls."""
    t = (time - time[0]) / max(np.ptp(time), 1e-300)
    for degree in (1, 2):
        coefficients, errors = _line(np.vander(t, degree + 1), force)
        # Change of the force between the ends, and height of the parabola above its chord.
        change = abs(coefficients[0]) / (1, 4)[degree - 1]
        if abs(coefficients[0]) > _SIGNIFICANT * errors[0] and change > _STILL * np.median(force):
            return True
    return False


def _line(columns, values):
    """Return the coefficients of a linear least-squares fit, and their standard errors."""
    coefficients = np.linalg.lstsq(columns, values, rcond=None)[0]
    sum_of_squares = np.sum((values - columns @ coefficients) ** 2) / max(values.size - columns.shape[1], 1)
    return coefficients, np.sqrt(np.diag(np.linalg.pinv(columns.T @ columns)) * sum_of_squares)


def share_of_compliance(rate, stiffness, force, time, end):
    """Return ḣ/|Ṗ| over 1/S, with the rate of force Ṗ at the start of the unloading after sample `end`."""
    after = force[end:]
    upper = int(np.argmax(after < 0.5 * force[end])) or after.size
    t, F = time[end : end + upper], after[:upper]
    if F.size < _FEW:
        return 0.0
    unloading = -np.polyfit((t - t[0]) / np.ptp(t), F, 2)[1] / np.ptp(t)
    return float(rate * stiffness / max(unloading, 1e-300))


def rise_of_depth(depth, force):
    """Return the growth (m) of the depth while the force falls, 0 within the noise."""
    if force.max() <= 0:
        return 0.0
    noise = roughness(force[None])[0, 0]
    last = int(np.flatnonzero(force >= _HELD * force.max() - _NOISE * noise)[-1])
    top = last_at_top(depth)
    # If more than half of the force is lost, the force has the wrong sign.
    if top <= last or not force[last] / 2 < force[top] < force[last] - _NOISE * noise:
        return 0.0
    rise = depth[top] - depth[last]
    least = max(_GROWTH * np.ptp(depth), 2 * _NOISE * roughness(depth[None])[0, 0])
    return float(rise) if rise > least else 0.0


def no_hold(depth, force, time):
    """Return a remark on a record without a hold."""
    text = "no hold of the force before the unloading shows its creep"
    if _held(time, force) is not None:
        text = (
            "the force is constant while the depth grows and comes back, like the force of a sensor at the "
            "end of its range, so this is not a hold"
        )
    return Remark(f"{text}: creep is not corrected", "taken")


def of_share(share):
    """Return a remark on creep that is not small."""
    return Remark(
        f"the depth creeps at the start of the unloading: ḣ/|Ṗ| at the end of the hold is "
        f"{100 * share:.2g} % of 1/S; the stiffness is corrected for it (Feng and Ngan)",
        "creep",
    )


def of_hold(length):
    """Return a remark on the hold whose end gives the rate."""
    return Remark(f"the force is held for {engineering(length, 's')} before the unloading", "taken")


def of_rise(rise, in_time):
    """Return a remark on a depth that grows while the force falls; `in_time` is true with given times."""
    text = (
        f"the depth creeps: it grows by {engineering(rise, 'm')} while the force falls, so the stiffness "
        "is too large; hold the force longer, or unload faster"
    )
    return Remark(text, "creep", *[Remedy("give", "time")] * (not in_time))
