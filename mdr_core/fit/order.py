"""Whether samples are in the order in which they were measured."""

import numpy as np

from ..numerics.remark import Remark

#: Excess of the force after the largest depth over that before it, as a share of its range, that no medium
#: has; least share of samples at which depths turn, and least median step, as a share of their range, of a
#: record without order; least number of samples that tell it.
_REVERSED, _TURNS, _STEPS, _FEW = 0.05, 0.4, 0.1, 10


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
