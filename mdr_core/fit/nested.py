"""Tests whether a tilt, a drag, a drift of the depth or another force on unloading fits a curve better.

Each is one more linear parameter. With residuals r, their derivatives J by the fitted parameters and c by
another one, v, the least squares of r + J δ + c v give v and the change δ of the parameters. It is said
where it is significant and lowers the misfit clearly, or changes E* by more than its error: then the error
that the fit states is too small. The misfit is the root mean square of the residuals in contact, which a
long baseline does not hide. A drift v (m/s) makes the depth z − v t.

In a medium that yields a slow drift changes E* and hardly the residuals. Its rate is that of the depth in
a hold, where the force is constant.
"""

import numpy as np

from ..show.quantities import engineering
from .errors import SIGNIFICANT, SINGULAR, block_length, roughness

#: Words for each, its unit, the factor by which the misfit falls clearly, and what follows. The misfit of
#: measured curves without a tilt falls up to 1.2 times by one.
_TESTS = {
    "tilt": ("a tilt of {}", "N/m", 1.5, "give tilt=None and baseline=None"),
    "drag": ("a drag of {}", "N·s/m", 1.3, "give drag=None"),
    "drift": (
        "a drift of {}",
        "m/s",
        1.6,
        "the force changes at rest: the depth drifts, or the medium relaxes",
    ),
    "unloading": (
        "a force that changes by {} on unloading",
        "%",
        np.inf,
        "creep or hysteresis of the scanner or the medium, or a drag; compare with a fit of the "
        "loading alone",
    ),
}
#: Standard deviations from which on one of them is significant, and change of E* in its errors beyond which
#: these do not cover what is left out.
_SIGNIFICANT, _UNCOVERED = 3.3, 1.0
#: Least number of samples in contact and without, and least misfit as a share of the range of force.
_FEW, _SMALL = 10, 1e-5
#: Least share of the samples in contact before and after the depth is within a share of the largest one.
_TURNS, _REACHED = 0.1, 0.02
#: Deviation of the force in a hold, its least force and duration, as shares of those of the curve.
_HOLD_FORCE, _LEAST_FORCE, _HOLD_TIME = 0.005, 0.05, 0.05
#: Standard deviations of noise that the force deviates by in a hold.
_HOLD_NOISE = 5.0
#: Least change of ln E* by a drift that is said, and a drift that is common (m/s).
_LEAST_CHANGE, _COMMON = 0.005, 1e-10


def nested_tests(solved, i):
    """Remarks on what a tilt, a drag or a drift changes in curve i of a `Solution`."""
    curves, minimum, (_, state) = solved.curves, solved.minimum, solved.values_and_states
    contact, noise = state.live_interval.length[i] > 0, solved.noise[i]
    if "E_star" not in curves.free or minimum.at_bound[i, 0] or curves.adhesive:
        return
    if np.count_nonzero(contact) < _FEW:
        return
    yields = not (curves.held_elastic or solved.elastic[i])
    jacobian, before = minimum.jacobian[i][:, ~minimum.at_bound[i]], minimum.residual[i]
    small = _rms((before * noise)[contact]) < _SMALL * curves.load[i, 0]
    columns = {} if small else dict(_columns(curves, state, i, contact))
    while columns:
        trials = {}
        for name, column in columns.items():
            matrix = np.column_stack([jacobian, column / noise[:, None]])
            step = _step(matrix, minimum.residual[i])
            remainder = minimum.residual[i] + matrix @ step
            factor = _rms(before[contact]) / _rms(remainder[contact])
            gain = (before @ before - remainder @ remainder) / _rms(remainder) ** 2
            independent = gain / block_length(remainder[solved.orders[i]])
            change = step[0] / solved.errors(i)["E_star"]
            clear = factor > _TESTS[name][2] and gain > SIGNIFICANT**2
            if clear or (independent > _SIGNIFICANT**2 and abs(change) > _UNCOVERED):
                # The first of those that are clear, else the best one.
                rank = np.inf if clear else gain
                trials[name] = rank, matrix, remainder, _sentence(name, step[-1], factor, change)
        if not trials:
            break
        # The others are tested beside it.
        best = max(trials, key=lambda name: trials[name][0])
        del columns[best]
        _, jacobian, before, text = trials[best]
        yield best, text
    if yields and _increases(curves, i):
        drift = _drift(curves, state, i, contact) / noise
        change = _step(minimum.jacobian[i], drift)[0]
        yield from _in_a_hold(curves, state, i, contact, change)


def _sentence(name, size, factor, change):
    what, unit, _, follows = _TESTS[name]
    return (
        f"{what.format(engineering(size, unit))} would lower the misfit in contact by a factor of "
        f"{factor:.3g} and change E* by {change:+.1f} standard errors: {follows}"
    )


def _rms(values):
    return np.sqrt(np.mean(values**2))


def _step(matrix, residual):
    """Change of the parameters to the least squares of the residual."""
    scale = np.maximum(np.linalg.norm(matrix, axis=0), 1e-300)
    return np.linalg.lstsq(matrix / scale, -residual, rcond=SINGULAR)[0] / scale


def _columns(curves, state, i, contact):
    """Yields each name with the derivatives (N, K) of measured minus modelled force."""
    depth, free = curves.depth[i], curves.free
    baseline = np.count_nonzero(~contact) >= _FEW
    if baseline and "tilt" not in free:
        yield "tilt", -np.column_stack([np.ones_like(depth), depth - depth.mean()])
    inside = depth[contact]
    before = np.argmax(inside > inside.max() - _REACHED * np.ptp(inside))
    turns = min(before, inside.size - before) >= max(_FEW, _TURNS * inside.size)
    if not turns:
        return
    if _increases(curves, i):
        if baseline and "drag" not in free:
            steps = np.gradient(curves.time[i])
            yield "drag", -(np.gradient(depth) / np.maximum(steps, 1e-3 * steps.mean()))[:, None]
        yield "drift", _drift(curves, state, i, contact)[:, None]
    after = np.arange(depth.size) > np.argmax(depth)
    yield "unloading", np.where(after, -state.force[i] / 100, 0.0)[:, None]


def _increases(curves, i):
    """Whether there are times that increase, of single samples perhaps not."""
    return curves.time is not None and 0 <= np.diff(curves.time[i]).min() < np.ptp(curves.time[i])


def _drift(curves, state, i, contact):
    """Derivative (N·s/m) of measured minus modelled force by a drift from first contact on."""
    depth, time = curves.depth[i], curves.time[i] - curves.time[i][np.argmax(contact)]
    reached = np.where(depth >= np.maximum.accumulate(depth), np.arange(depth.size), 0)
    return state.slope[i] * time + state.memory_slope[i] * time[np.maximum.accumulate(reached)]


def _in_a_hold(curves, state, i, contact, change):
    """Remark on the drift in a hold, else on a common one; `change` is that of ln E* by 1 m/s."""
    depth, time = curves.depth[i], curves.time[i]
    duration, hold = time[-1] - time[np.argmax(contact)], _longest_hold(curves, state, i)
    if hold.stop - hold.start < _FEW or time[hold][-1] - time[hold][0] < _HOLD_TIME * duration:
        if abs(change) * _COMMON > _LEAST_CHANGE:
            yield (
                "rest",
                f"no hold shows the drift of the depth: a drift of {engineering(_COMMON, 'm/s')} over the "
                f"{engineering(duration, 's')} after first contact would change E* by "
                f"{100 * change * _COMMON:+.2g} %",
            )
        return
    rate = np.polyfit(time[hold], depth[hold], 1)[0]
    if abs(rate * change) > _LEAST_CHANGE:
        yield (
            "rest",
            f"in the hold at {engineering(curves.force[i][hold.start], 'N')} the depth changes by "
            f"{engineering(rate, 'm/s')}: this is creep, or a drift that since first contact would "
            f"change E* by {100 * change * rate:+.2g} %",
        )


def _longest_hold(curves, state, i):
    """The longest part of a curve in contact at one force, as a slice.

    Compared are means over as many samples that their noise is within the deviation of a hold.
    """
    time, limit = curves.time[i], _HOLD_FORCE * curves.load[i, 0]
    noise = _HOLD_NOISE * roughness(curves.force[[i]])[0, 0]
    width = int(np.clip(np.ceil((noise / limit) ** 2), 1, max(_FEW, time.size // 50)))
    limit = np.clip(noise / np.sqrt(width), limit, 4 * limit)
    force = np.convolve(curves.force[i], np.full(width, 1 / width), "valid")
    pressed, longest = state.force[i][: force.size] > _LEAST_FORCE * curves.load[i, 0], slice(0, 1)
    for start in range(0, force.size - _FEW, max(1, force.size // 100)):
        if abs(force[start + _FEW] - force[start]) < limit:
            away = ~pressed[start:] | (np.abs(force[start:] - force[start]) > limit)
            stop = start + int(np.argmax(away)) if away.any() else force.size
            # Without the samples that are averaged with those before and after the hold.
            part = slice(start + width - 1, stop)
            if part.stop - part.start < 2 or np.ptp(time[part]) <= np.ptp(time[longest]):
                continue
            # A slow ramp is within the noise sample by sample, but its trend is not.
            trend = np.polyfit(time[part], curves.force[i][part], 1)[0] * np.ptp(time[part])
            if abs(trend) < 2 * _HOLD_FORCE * curves.load[i, 0]:
                longest = part
    return longest
