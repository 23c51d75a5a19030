"""Whether samples are in the order in which they were measured, and all of them are measured."""

import numpy as np

from ...base.remark import Remark

#: Excess of the force after the largest depth over that before it, as a share of its range, that no medium
#: has; least share of samples at which depths turn, and least median step, as a share of their range, of a
#: record without order; least number of samples that tell it.
_REVERSED, _TURNS, _STEPS, _FEW = 0.05, 0.4, 0.1, 10
#: Least distance of a sample from both neighbours that no path has, as a share of the range of the middle
#: four fifths; least number of samples that tell it.
_APART, _PATH = 0.5, 20


def out_of_order(depth, force):
    """Remarks on a record that is shuffled, or runs backwards, so that its loading looks like unloading."""
    if depth.size < _FEW:
        return
    steps = np.diff(depth)
    turns = np.mean(steps[1:] * steps[:-1] < 0)
    if turns > _TURNS and np.median(np.abs(steps)) > _STEPS * np.ptp(depth):
        text = "depths go up and down from sample to sample, as in a shuffled record"
        yield Remark(f"{text}: give the samples in the order in which they were measured", "order")
    elif _rise_after(depth, force) > _REVERSED * np.ptp(force):
        text = "forces are larger after the largest depth than before it, as in a reversed record"
        yield Remark(f"{text}: give the samples in the order in which they were measured", "order")


def _rise_after(depth, force):
    """Mean force (N) after the largest depth less that before it, at the same depths."""
    top = int(np.argmax(depth))
    parts = slice(top + 1), slice(top, None)
    least = max(depth[part].min() for part in parts)
    if least == depth[top]:
        return 0.0
    common = np.linspace(least, depth[top], 50)
    before, after = (
        np.interp(common, depth[part][order], force[part][order])
        for part in parts
        for order in [np.argsort(depth[part], kind="stable")]
    )
    return float(np.mean(after - before))


def apart(depth, force):
    """A remark on single samples far from both neighbours, as numbers that stand for missing ones."""
    if depth.size < _PATH:
        return
    counts = {name: _count_apart(values) for name, values in (("depth", depth), ("force", force))}
    found = " and ".join(f"{count} samples of the {name}" for name, count in counts.items() if count)
    if found:
        text = (
            f"{found} are more than half of its range away from both neighbours, as numbers that stand for "
        )
        yield Remark(f"{text}missing ones: leave them out", "outliers")


def _count_apart(values):
    before, after = values[1:-1] - values[:-2], values[1:-1] - values[2:]
    least = np.where(before * after > 0, np.minimum(np.abs(before), np.abs(after)), 0.0)
    return np.count_nonzero(least > _APART * np.ptp(np.quantile(values, [0.1, 0.9])))
