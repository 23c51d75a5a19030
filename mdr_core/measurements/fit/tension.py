"""Forces below those of the air beside first contact: an adhesion that a fit leaves out."""

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ..common.errors import roughness

#: Samples of a mean, and least number of those of a branch and of its air.
_MEAN, _BRANCH, _AIR = 5, 40, 20
#: Least tension in standard deviations of the air, and as a share of the range of force. Noise that is
#: correlated over a fifteenth of a curve reaches 1.3 %. E* changes by about the share.
_SIGNIFICANT, _LEAST = 4.0, 0.02


def tension(depth, force):
    """Largest tension (N) of the approach or the retract: the air beyond less the lowest force; else 0.

    No drag is one, as the rate of a branch is that of its air, nor a viscous medium, which only presses.
    """
    top, found = int(np.argmax(depth)), 0.0
    for branch in (force[top::-1], force[top:]):
        if branch.size < _BRANCH:
            continue
        means = np.convolve(branch, np.full(_MEAN, 1 / _MEAN), "valid")
        low = int(np.argmin(means))
        beyond = branch[low + _MEAN :]
        air = beyond[beyond.size // 4 :]
        if air.size < _AIR:
            continue
        level = np.median(air)
        scatter = max(1.4826 * np.median(np.abs(air - level)), roughness(branch[None])[0, 0])
        if level - means[low] > max(_SIGNIFICANT * scatter, _LEAST * np.ptp(force)):
            found = max(found, float(level - means[low]))
    return found


def of_tension(solved, i):
    """A remark on an adhesion that the fit of an elastic medium leaves out, if there is one."""
    curves = solved.curves
    if curves.adhesive or not curves.held_elastic or "E_star" not in curves.free:
        return
    largest = tension(curves.depth[i], curves.force[i])
    share = largest / (np.ptp(curves.force[i]) - largest)
    # E* changes by about this share, which the error of a curve that deviates may cover.
    if share <= solved.errors(i)["E_star"]:
        return
    pull = engineering(float(f"{largest:.2g}"), "N")
    text = (
        f"the force falls {pull} below that of the air, {100 * share:.2g} % of the largest one: an "
        "adhesion that is left out makes E* too large"
    )
    # That of a soft gel may be on the retract alone.
    retracts = bool(curves.depth.shape[1] - np.argmax(curves.depth[i]) > _BRANCH)
    yield Remark(
        text, "adhesion", Remedy("free", "work_of_adhesion"), *[Remedy("part", "loading")] * retracts
    )
