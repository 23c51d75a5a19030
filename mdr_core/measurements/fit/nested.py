"""Tests whether a tilt, a drag, a drift of the depth or another force on unloading fits a curve better.

Each is one more linear parameter. With residuals r, their derivatives J by the fitted parameters and c by
another one, v, the least squares of r + J δ + c v give v and the change δ of the parameters. It is said
where it is significant and lowers the misfit clearly, or changes E* by more than its error: then the error
that the fit states is too small. The misfit is the root mean square of the residuals in contact, which a
long baseline does not hide. A drift v (m/s) makes the depth z − v t.

In a medium that yields a slow drift changes E* and hardly the residuals. Its rate is that of the depth in
a hold, where the force is constant.
"""

from typing import NamedTuple

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ..common.errors import SIGNIFICANT, SINGULAR, block_length, roughness


class _Test(NamedTuple):
    """Kind of a remark, words, unit, the factor by which the misfit falls clearly, and what one can do."""

    kind: str
    what: str
    unit: str
    clearly: float
    remedy: tuple[Remedy, ...] = ()


_CAUSES = "creep or hysteresis of the scanner or the medium, or a drag"
_LOADING = (Remedy("part", "loading"),)
#: The misfit of measured curves without a tilt falls up to 1.2 times by one.
_TESTS = {
    "tilt": _Test(
        "tilt", "a tilt of {}", "N/m", 1.5, (Remedy("free", "tilt"), Remedy("free", "baseline"))
    ),
    "drag": _Test("drag", "a drag of {}", "N·s/m", 1.3, (Remedy("free", "drag"),)),
    # Of a medium that yields, which is too stiff for the drag of a liquid.
    "rate": _Test(
        "unloading", f"a force that goes with the rate ({{}}), by {_CAUSES},", "N·s/m", 1.3, _LOADING
    ),
    "drift": _Test("drift", "a drift of {}, or a relaxation of the medium,", "m/s", 1.6),
    "unloading": _Test(
        "unloading", f"a force that changes by {{}} on unloading, by {_CAUSES},", "%", np.inf, _LOADING
    ),
}  # fmt: skip
#: Standard deviations from which on one of them is significant, and change of E* in its errors beyond which
#: these do not cover what is left out.
_SIGNIFICANT, _UNCOVERED = 3.3, 1.0
#: Factor of the misfit that is worth a word.
_LOWERED = 1.005
#: Least number of samples in contact and without, and least misfit as a share of the range of force.
_FEW, _SMALL = 10, 1e-5
#: Least share of the samples in contact before and after the depth is within a share of the largest one.
_TURNS, _REACHED = 0.1, 0.02
#: Deviation of the force in a hold, its least force and duration, as shares of those of the curve.
_HOLD_FORCE, _LEAST_FORCE, _HOLD_TIME = 0.005, 0.05, 0.05
#: Standard deviations of noise that the force deviates by in a hold.
_HOLD_NOISE = 5.0
#: Least change of ln E* by a drift that is said.
_LEAST_CHANGE = 0.005


def nested_tests(solved, i):
    """Remarks on what a tilt, a drag or a drift changes in curve i of a `Solution`."""
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
    """Yields remarks on the parameters with which a curve fits better.

    Of those that are clearly better the first one of `_TESTS` is taken, else the best one. Each later one
    is tried beside those before it.
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
    """A fit with one parameter more, `name`, of the value `size` (SI).

    The residuals (N,) that it leaves, their derivatives by all of its parameters (N, P), the factor by
    which the misfit in contact falls, the decrease of χ² (in variances of a residual; and that of
    `independent` residuals, where neighbours are correlated), and the change of E* in its errors.
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
        """The one whose derivatives are the last column of the Jacobian, after the residuals `before`."""
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
        """Infinite if it is clearly better, else the decrease if E* changes; 0 if nothing is to be said."""
        if self.factor > _TESTS[self.name].clearly and self.decrease > SIGNIFICANT**2:
            return np.inf
        said = self.independent > _SIGNIFICANT**2 and abs(self.change) > _UNCOVERED
        return self.decrease if said else 0.0

    def remark(self, free):
        """What it is, what it does to misfit and E*, and what one can do that is not done yet."""
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
            yield (
                "drag" if curves.held_elastic else "rate",
                -(np.gradient(depth) / np.maximum(steps, 1e-3 * steps.mean()))[:, None],
            )
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
    """Remark on the drift in a hold; `change` is that of ln E* by 1 m/s."""
    depth, time = curves.depth[i], curves.time[i]
    duration, hold = time[-1] - time[np.argmax(contact)], _longest_hold(curves, state, i)
    if hold.stop - hold.start < _FEW or time[hold][-1] - time[hold][0] < _HOLD_TIME * duration:
        return
    rate = np.polyfit(time[hold], depth[hold], 1)[0]
    if abs(rate * change) > _LEAST_CHANGE:
        text = (
            f"in the hold at {engineering(curves.force[i][hold.start], 'N')} the depth changes by "
            f"{engineering(rate, 'm/s')}: this is creep, or a drift that since first contact would "
            f"change E* by {100 * change * rate:+.2g} %"
        )
        yield Remark(text, "creep")


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
