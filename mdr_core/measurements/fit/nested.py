"""Tests whether a tilt, a drag, a drift of the depth or another force on unloading fits a curve better.

Each of them is an additional linear parameter v. With residuals r, their derivatives J by the fitted
parameters and c by v, the least squares of r + J δ + c v give v and the change δ of the parameters. A
remark reports v if it is significant and clearly lowers the misfit. It also reports v if E* changes by more
than its error, because the error of the fit is then too small. The misfit is the root mean square of the
residuals in contact, which a long baseline does not hide. A drift v (m/s) makes the depth z − v t.

In a medium that yields, a slow drift changes E* but hardly the residuals. The rate of the drift is the rate
of the depth in a hold, where the force is constant.
"""

from typing import NamedTuple

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ..common.errors import SIGNIFICANT, SINGULAR, block_length, roughness


class _Test(NamedTuple):
    """Kind of a remark, text, unit, smallest factor of a clear decrease of the misfit, and remedies."""

    kind: str
    what: str
    unit: str
    clearly: float
    remedy: tuple[Remedy, ...] = ()


_CAUSES = "creep or hysteresis of the scanner or the medium, or a drag"
_LOADING = (Remedy("part", "loading"),)
#: With a tilt, the misfit of measured curves without a tilt decreases by a factor of up to 1.2.
_TESTS = {
    "tilt": _Test(
        "tilt", "a tilt of {}", "N/m", 1.5, (Remedy("free", "tilt"), Remedy("free", "baseline"))
    ),
    "drag": _Test("drag", "a drag of {}", "N·s/m", 1.3, (Remedy("free", "drag"),)),
    # A medium that yields is too stiff for the drag of a liquid.
    "rate": _Test(
        "unloading", f"a force that depends on the rate ({{}}), by {_CAUSES},", "N·s/m", 1.3, _LOADING
    ),
    "drift": _Test("drift", "a drift of {}, or a relaxation of the medium,", "m/s", 1.6),
    "unloading": _Test(
        "unloading", f"a force that changes by {{}} on unloading, by {_CAUSES},", "%", np.inf, _LOADING
    ),
}  # fmt: skip
#: Smallest significant number of standard deviations, and largest change of E*, in its errors, that these
#: errors cover.
_SIGNIFICANT, _UNCOVERED = 3.3, 1.0
#: Smallest factor of the misfit for a remark.
_LOWERED = 1.005
#: Smallest number of samples with and without contact, and smallest misfit as a share of the range of
#: force.
_FEW, _SMALL = 10, 1e-5
#: Smallest share of the samples in contact before and after the depth almost reaches its largest value, and
#: the remaining distance as a share of the range of depth.
_TURNS, _REACHED = 0.1, 0.02
#: Largest deviation of the force in a hold, its smallest force and its duration, as shares of the curve.
_HOLD_FORCE, _LEAST_FORCE, _HOLD_TIME = 0.005, 0.05, 0.05
#: Standard deviations of noise for the deviation of the force in a hold.
_HOLD_NOISE = 5.0
#: Smallest change of ln E* by a drift for a remark.
_LEAST_CHANGE = 0.005


def nested_tests(solved, i):
    """Yield remarks on the effect of a tilt, a drag or a drift on curve i of a `Solution`."""
    curves, (_, state) = solved.curves, solved.values_and_states
    contact = state.live_interval.length[i] > 0
    if "E_star" not in curves.free or solved.minimum.at_bound[i, 0] or curves.adhesive:
        return
    if np.count_nonzero(contact) < _FEW:
        return
    yield from _left_out(solved, i, contact)
    yields = not (curves.held_elastic or solved.elastic[i])
    if yields and _increases(curves, i):
        drift = _drift(curves, state, i, contact) / solved.noise[i]
        change = _step(solved.minimum.jacobian[i], drift)[0]
        yield from _in_a_hold(curves, state, i, contact, change)


def _left_out(solved, i, contact):
    """Yield remarks on parameters with which a curve fits better.

    The first clearly better parameter in the order of `_TESTS` comes first, or else the best parameter.
    Each later parameter is tried together with those before it.
    """
    curves, minimum, noise = solved.curves, solved.minimum, solved.noise[i]
    _, state = solved.values_and_states
    if _rms((minimum.residual[i] * noise)[contact]) < _SMALL * curves.load[i, 0]:
        return
    columns = dict(_columns(curves, state, i, contact))
    before, jacobian = minimum.residual[i], minimum.jacobian[i][:, ~minimum.at_bound[i]]
    while columns:
        trials = []
        for name, column in columns.items():
            wider = np.column_stack([jacobian, column / noise[:, None]])
            trials.append(_Trial.of(name, solved, i, before, wider, contact))
        best = max(trials, key=lambda trial: trial.rank)
        if not best.rank:
            return
        yield best.remark(curves.free)
        said = _TESTS[best.name].kind
        columns = {name: column for name, column in columns.items() if _TESTS[name].kind != said}
        before, jacobian = best.residual, best.jacobian


class _Trial(NamedTuple):
    """Fit with an additional parameter `name` of the value `size` (SI).

    It has the remaining residuals (N,), and their derivatives by all parameters (N, P). `factor` is the
    decrease of the misfit in contact, and `decrease` the decrease of χ² in variances of a residual.
    `independent` is this decrease over the length of a block of correlated residuals. `change` is the
    change of E* in its errors.
    """

    name: str
    size: float
    residual: np.ndarray
    jacobian: np.ndarray
    factor: float
    decrease: float
    independent: float
    change: float

    @classmethod
    def of(cls, name, solved, i, before, jacobian, contact):
        """Try the parameter of the last column of the Jacobian; `before` are the residuals without it."""
        first = solved.minimum.residual[i]
        step = _step(jacobian, first)
        residual = first + jacobian @ step
        decrease = (before @ before - residual @ residual) / _rms(residual) ** 2
        return cls(
            name, step[-1], residual, jacobian,
            factor=_rms(before[contact]) / _rms(residual[contact]),
            decrease=decrease,
            independent=decrease / block_length(residual[solved.orders[i]]),
            change=step[0] / solved.errors(i)["E_star"],
        )  # fmt: skip

    @property
    def rank(self):
        """Infinite for a clearly better fit, else the decrease if E* changes; 0 for no remark."""
        if self.factor > _TESTS[self.name].clearly and self.decrease > SIGNIFICANT**2:
            return np.inf
        said = self.independent > _SIGNIFICANT**2 and abs(self.change) > _UNCOVERED
        return self.decrease if said else 0.0

    def remark(self, free):
        """Return a remark on the parameter, its effect on misfit and E*, and the remaining remedies."""
        test = _TESTS[self.name]
        what = f"{test.what.format(engineering(self.size, test.unit))} would "
        if self.factor > _LOWERED:
            what += f"lower the misfit in contact by a factor of {self.factor:.3g} and "
        remedy = [each for each in test.remedy if each.what not in free]
        if self.name == "drift":
            remedy = [Remedy("subtract", "drift", float(f"{self.size:.4g}"))]
        return Remark(
            f"{what}change E* by {self.change:+.1f} standard errors", test.kind, *remedy, together=True
        )


def _rms(values):
    return np.sqrt(np.mean(values**2))


def _step(matrix, residual):
    """Return the change of the parameters that minimizes the squares of the residual."""
    scale = np.maximum(np.linalg.norm(matrix, axis=0), 1e-300)
    return np.linalg.lstsq(matrix / scale, -residual, rcond=SINGULAR)[0] / scale


def _columns(curves, state, i, contact):
    """Yield each name with the derivatives (N, K) of measured minus modelled force."""
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
            yield (
                "drag" if curves.held_elastic else "rate",
                -(np.gradient(depth) / np.maximum(steps, 1e-3 * steps.mean()))[:, None],
            )
        yield "drift", _drift(curves, state, i, contact)[:, None]
    after = np.arange(depth.size) > np.argmax(depth)
    yield "unloading", np.where(after, -state.force[i] / 100, 0.0)[:, None]


def _increases(curves, i):
    """Whether there are times that increase; some neighbouring times may be equal."""
    return curves.time is not None and 0 <= np.diff(curves.time[i]).min() < np.ptp(curves.time[i])


def _drift(curves, state, i, contact):
    """Return the derivative (N·s/m) of measured minus modelled force by a drift since first contact."""
    depth, time = curves.depth[i], curves.time[i] - curves.time[i][np.argmax(contact)]
    reached = np.where(depth >= np.maximum.accumulate(depth), np.arange(depth.size), 0)
    return state.slope[i] * time + state.memory_slope[i] * time[np.maximum.accumulate(reached)]


def _in_a_hold(curves, state, i, contact, change):
    """Yield a remark on the drift in a hold; `change` is the change of ln E* for 1 m/s."""
    depth, time = curves.depth[i], curves.time[i]
    duration, hold = time[-1] - time[np.argmax(contact)], _longest_hold(curves, state, i)
    if hold.stop - hold.start < _FEW or time[hold][-1] - time[hold][0] < _HOLD_TIME * duration:
        return
    rate = np.polyfit(time[hold], depth[hold], 1)[0]
    if abs(rate * change) > _LEAST_CHANGE:
        text = (
            f"in the hold at {engineering(curves.force[i][hold.start], 'N')} the depth changes by "
            f"{engineering(rate, 'm/s')}: this is creep, or a drift, which since first contact would "
            f"change E* by {100 * change * rate:+.2g} %"
        )
        yield Remark(text, "creep")


def _longest_hold(curves, state, i):
    """Return the longest part of a curve in contact at constant force, as a slice.

    The search compares means over enough samples to bring their noise within the deviation of a hold.
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
            # Omit means that include samples before or after the hold.
            part = slice(start + width - 1, stop)
            if part.stop - part.start < 2 or np.ptp(time[part]) <= np.ptp(time[longest]):
                continue
            # A slow ramp is within the noise of single samples, but its trend is not.
            trend = np.polyfit(time[part], curves.force[i][part], 1)[0] * np.ptp(time[part])
            if abs(trend) < 2 * _HOLD_FORCE * curves.load[i, 0]:
                longest = part
    return longest
