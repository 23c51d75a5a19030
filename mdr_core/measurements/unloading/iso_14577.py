"""Quantities of ISO 14577 for one unloading and the loading before it: n_IT, C_IT and HM."""

import numpy as np

from ...solver.numerics.stable import trapezoid
from ...solver.profiles.power import Cone
from ...solver.profiles.profile import Profile
from ..common.errors import roughness
from .creep import hold
from .first_contact import elastic_exponents
from .unloading import last_at_top

#: Half-angles (degrees) of cones equivalent to Berkovich and Vickers pyramids. Area of the sides of the
#: pyramids over the square of the depth: 4 sin α/cos² α for α = 68° (Vickers), 3 √3 tan α/cos α for 65.03°.
_ANGLES, _SIDES = (70.2, 70.4), 26.43
#: Largest share of the largest force over which a work is extrapolated.
_EXTRAPOLATED = 0.2
#: Largest excess of the depth of an earlier loading, as a share of the largest depth, for a first loading.
_DEEPER = 0.01
#: Width of classes of force, as a share of the largest force and in standard deviations of noise. Smallest
#: number of samples in a class with a hold, relative to other classes and absolute.
_CLASS, _NOISE, _TIMES, _FEW = 0.02, 8.0, 5.0, 10
#: Largest deviation of the force of samples at the ends of a hold, as a share of this force.
_HELD = 5e-4
#: Largest force in the classes without a hold, as a share of the largest force. They serve as a reference.
_MOVING = 0.9
#: Share of the largest force above which a remark reports the extrapolation; it is 0.05 % of the work.
_NAMED = 0.01


def iso_numbers(profile: Profile, depth, force, time, part: slice, laws) -> tuple[tuple, str]:
    """Return n_IT, C_IT and HM (Pa) of the unloading in a part of a record, and a remark on n_IT or "".

    Undetermined quantities are NaN. Depths (m) and forces (N) of the whole record count from first contact.
    Without times (s) the sampling is uniform. `laws` are the values and errors of the unloading with and
    without a correction for creep, arrays (2, 5) in the order of `OliverPharr`.
    """
    corrected, measured = (values for values, _ in laws)
    stiffness, *_, exponent = measured if np.isfinite(measured).all() else corrected
    top = part.start + last_at_top(depth[part])
    first = depth[:top].max(initial=-np.inf) <= (1 + _DEEPER) * depth[top]
    moments = np.arange(depth.size) if time is None else time
    held = hold(moments[part], force[part], depth[part])
    work, creep, remark = np.nan, np.nan, ""
    end, height = top, force[top]
    if held is not None:
        height = np.median(force[part][held])
        end, last = _ends(force, height, part.start + held)
        if depth[end] > 0:
            creep = (depth[last] - depth[end]) / depth[end]
    if first:
        total = _work_of_loading(profile, depth[: top + 1], force[: top + 1])
        unloaded = slice(top, part.stop)
        elastic, share = _work_of_unloading(depth[unloaded], force[unloaded], stiffness, exponent)
        work = elastic / total
        if np.isfinite(work) and share > _NAMED:
            remark = f"{_end_of(share)}: n_IT is extrapolated to 0 by the power law"
    martens = height / (_SIDES * depth[end] ** 2) if first and is_pyramid(profile) else np.nan
    return (float(work), float(creep), float(martens)), remark


def remark_on_beginning(force: np.ndarray) -> str:
    """Return a remark on a record of forces (N) whose unloading has hardly begun."""
    return f"{_end_of(force[-1] / force.max())}: n_IT, C_IT and HM are not computed"


def _end_of(share):
    return f"the unloading ends at {100 * share:.3g} % of the largest force"


def is_pyramid(profile: Profile) -> bool:
    """Whether a profile is a cone equivalent to a Berkovich or Vickers pyramid."""
    least, most = _ANGLES
    return isinstance(profile, Cone) and least <= np.degrees(np.arctan(1 / profile.slope)) <= most


def _ends(force, height, held):
    """Return the indices of the first and last sample of a hold, with adjacent samples at its force."""
    other = np.flatnonzero(force < (1 - _HELD) * height)
    before, after = other[other < held[0]], other[other > held[-1]]
    return before[-1] + 1 if before.size else 0, after[0] - 1 if after.size else force.size - 1


def _work_of_loading(profile, depth, force):
    """Return the work (J) up to the largest depth (m), including work before the first sample, or NaN."""
    begin = 0.0
    if depth[0] > 0 and force[0] > 0:
        if force[0] > _EXTRAPOLATED * force[-1]:
            return np.nan
        # Work before the first sample, for an elastic contact.
        begin = force[0] * depth[0] / (np.mean(elastic_exponents(profile, depth[0])) + 1)
    # In the air there is no work.
    return begin + trapezoid(force, np.maximum(depth, 0.0))


def _work_of_unloading(depth, force, stiffness, exponent):
    """Return the work (J) of an unloading down to the force 0, or NaN, and the final share of the force."""
    end = _end(force)
    share = max(force[end], 0.0) / force[0]
    if share > _EXTRAPOLATED:
        return np.nan, share
    # F ∝ u^m, u = 1 at the first sample, where dh = (m F/S) du.
    u = share ** (1 / exponent)
    rest = force[0] ** 2 * exponent / stiffness * u ** (exponent + 1) / (exponent + 1)
    return rest - trapezoid(force[: end + 1], depth[: end + 1]), share


def _end(force):
    """Return the index of the last sample of an unloading: without force, or in a hold of a small force."""
    largest = force[0]
    width = max(_CLASS * largest, _NOISE * roughness(force[None])[0, 0])
    classes = np.floor(force / width).astype(int)
    moving = classes[(force > _EXTRAPOLATED * largest) & (force < _MOVING * largest)]
    usual = np.median(np.unique(moving, return_counts=True)[1]) if moving.size else 1.0
    low = classes[(force > 0) & (force <= _EXTRAPOLATED * largest)]
    found, counts = np.unique(low, return_counts=True)
    held = found[counts > max(_TIMES * usual, _FEW)]
    # The unloading ends at the hold with the largest force.
    level = np.median(force[classes == held[-1]]) if held.size else 0.0
    ended = np.flatnonzero(force <= level)
    return int(ended[0]) if ended.size else force.size - 1
