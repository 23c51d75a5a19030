"""Zero of depth and force of a record: first contact after the air, or unchanged."""

from dataclasses import dataclass

import numpy as np

from ...base.remark import Remark
from ...show.quantities import engineering
from ...show.report import with_error
from ..common.errors import SIGNIFICANT, roughness
from .first_contact import (
    LEAST_LENGTH,
    LEAST_SAMPLES,
    FirstContact,
    contact_before,
    elastic_exponents,
    first_contact,
)
from .unloading import parts_of

#: First contact of unchanged depths.
GIVEN = FirstContact(0.0, 0.0, 0.0, 0.0)
#: Smallest force at depth 0 that counts, as a share of the largest force; it makes the depth of a cone
#: 1.4 % smaller. Largest depth that counts as 0, as a share of the largest depth.
_LEAST_FORCE, _ZERO = 2e-4, 1e-3
#: Largest force of a lifted indenter, and smallest force of a contact, as shares of the largest force.
_LOST, _SEEN = 0.01, 1e-3
#: Largest force of a preload before the indenter is lifted off, as a share of the largest force.
_PRELOAD = 0.25


@dataclass(frozen=True)
class InContact:
    """Record whose depth is 0 at a force (N), and its first contact (m) by the law of the loading."""

    depth: float
    force: float
    largest: float

    def remark(self, given, first, offset):
        """Return a remark with E* and H (Pa): as given, from first contact, and with an offset of force."""
        given, first, offset = (
            f"E* {engineering(E, 'Pa')} and H {engineering(H, 'Pa')}" for E, H in (given, first, offset)
        )
        share = self.force / self.largest
        return Remark(
            f"the depth is 0 at {100 * share:.2g} % of the largest force, {engineering(self.force, 'N')}: "
            f"a cone has {100 * np.sqrt(share):.2g} % of its depth there. If it was set to 0 in contact, "
            f"first contact is {engineering(-self.depth, 'm')} before, by the power law of the loading: "
            f"{first}, instead of {given}. If the force has an offset: {offset}. Give the depth from first "
            "contact",
            "zero",
        )


def begin_of(depth, force):
    """Return the index of the sample at which the last approach begins, after a preload; otherwise 0.

    The relevant loading leads to the largest depth. Before it the indenter is in the air. Even before that,
    the indenter may have been pressed, held at a small force or loaded from 0.
    """
    top = int(np.argmax(depth))
    before, noise, largest = force[: top + 1], SIGNIFICANT * roughness(force[None])[0, 0], force.max()
    pressed = before > before.min() + max(2 * noise, _SEEN * largest)
    last = int(np.flatnonzero(~pressed)[-1])
    begin = int(np.flatnonzero(np.append(True, pressed[:last]))[-1])
    air = depth[begin : last + 1]
    if air.size >= LEAST_SAMPLES and np.ptp(air) > LEAST_LENGTH * np.ptp(depth) / 2:
        begin += int(np.argmin(air))
    else:
        begin = 0
    if not pressed[:begin].any():
        # The record may begin during the retreat from a preload.
        deeper = np.flatnonzero(depth > depth[0] + LEAST_LENGTH * np.ptp(depth))
        begin = int(np.argmin(depth[: deeper[0]])) if deeper.size else 0
        retreats = depth[0] - depth[begin] > LEAST_LENGTH * np.ptp(depth) / 2
        lost = force[begin] <= force[begin : top + 1].min() + max(noise, _LOST * largest)
        begin = begin if retreats and lost else 0
    return begin if before[: begin + 1].max() - force[begin] < _PRELOAD * largest else 0


def zero_of(profile, depth, force):
    """Return the first relevant sample, first contact, its remark or None, and `InContact` or None."""
    begin = begin_of(depth, force)
    end = _end_of_loading(force[begin:])
    loading = slice(begin, None if end is None else begin + end)
    contact, samples = first_contact(profile, depth[loading], force[loading])
    if contact is None:
        return begin, GIVEN, None, _in_contact(profile, depth, force, loading)
    point = with_error(*_rounded(depth, contact.depth, contact.depth_error), "m")
    level = with_error(*_rounded(force, contact.baseline, contact.baseline_error), "N")
    where = f"is in the air after its first {begin} samples" if begin else "begins in the air"
    text = f"the record {where}: first contact at {point} is subtracted from the depth"
    text = f"{text}, {level} from the force; {samples} samples are before it"
    return begin, contact, Remark(text, "taken"), None


def _end_of_loading(force):
    """Return the index after the first unloading, or None."""
    parts = parts_of(force - np.median(force[:LEAST_SAMPLES]))
    return parts[0].stop if parts else None


def _in_contact(profile, depth, force, loading):
    """Return the `InContact` of a record whose first depth is 0 at a force, or None."""
    top = loading.start + int(np.argmax(force[loading]))
    largest, noise = force[top], SIGNIFICANT * roughness(force[None])[0, 0]
    if abs(depth[0]) >= _ZERO * depth[top]:
        return None
    # Under a flat face, the depth of the first sample may explain this force.
    elastic = largest * (max(depth[0], 0.0) / depth[top]) ** elastic_exponents(profile, depth[top])[0]
    if force[0] < max(_LEAST_FORCE * largest, noise, 2 * elastic):
        return None
    # After a preload, start where the depth is again that of the first sample.
    start = loading.start + int(np.flatnonzero(depth[loading.start : top] <= depth[0])[-1:].sum())
    contact = contact_before(profile, depth[start : top + 1], force[start : top + 1])
    return InContact(contact.depth, float(force[0]), float(force.max()))


def _rounded(values, value, error):
    """Round a value and its error to 10⁻⁹ of the range of values, for a text."""
    least = 1e-9 * np.ptp(values)
    return round(value / least) * least, error if error > least else 0.0
