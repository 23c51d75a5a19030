"""From where depth and force of a record count: from first contact after the air, or as they are given."""

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

#: First contact of depths that are taken as they are given.
GIVEN = FirstContact(0.0, 0.0, 0.0, 0.0)
#: Least force where the depth is 0, as a share of the largest one, by which a cone has 1.4 % less depth;
#: largest depth that is 0.
_LEAST_FORCE, _ZERO = 2e-4, 1e-3
#: Largest force of an indenter that is lifted off, and least force of a contact, as shares of the largest.
_LOST, _SEEN = 0.01, 1e-3
#: Largest force of a preload before the indenter is lifted off, as a share of the largest one.
_PRELOAD = 0.25


@dataclass(frozen=True)
class InContact:
    """A record whose depth is 0 at a force (N), and its first contact (m) by the law of the loading."""

    depth: float
    force: float
    largest: float

    def remark(self, given, first, offset):
        """A remark with E* and H (Pa): as given, from first contact on, and by an offset of the force."""
        given, first, offset = (
            f"E* {engineering(E, 'Pa')} and H {engineering(H, 'Pa')}" for E, H in (given, first, offset)
        )
        share = self.force / self.largest
        return Remark(
            f"the depth is 0 at {100 * share:.2g} % of the largest force, {engineering(self.force, 'N')}: "
            f"a cone has {100 * np.sqrt(share):.2g} % of its depth there. If it was set to 0 in contact, "
            f"first contact is {engineering(-self.depth, 'm')} before, by the power law of the loading: "
            f"{first}, instead of {given}. If the force has an offset: {offset}. Give the depth from first "
            "contact on",
            "zero",
        )


def begin_of(depth, force):
    """Index of the sample at which the last approach begins, after a preload; else 0.

    The loading that counts leads to the largest depth. Before it the indenter is in the air. There it may
    have been pressed before, held at a small force or loaded from 0.
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
        # A preload that is not seen: the record goes back from its first samples on.
        deeper = np.flatnonzero(depth > depth[0] + LEAST_LENGTH * np.ptp(depth))
        begin = int(np.argmin(depth[: deeper[0]])) if deeper.size else 0
        retreats = depth[0] - depth[begin] > LEAST_LENGTH * np.ptp(depth) / 2
        lost = force[begin] <= force[begin : top + 1].min() + max(noise, _LOST * largest)
        begin = begin if retreats and lost else 0
    return begin if before[: begin + 1].max() - force[begin] < _PRELOAD * largest else 0


def zero_of(profile, depth, force):
    """Index of the first sample that counts, first contact, a remark on it or None, `InContact` or None."""
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
    """Index after the first unloading, None where there is none."""
    parts = parts_of(force - np.median(force[:LEAST_SAMPLES]))
    return parts[0].stop if parts else None


def _in_contact(profile, depth, force, loading):
    """`InContact` of a record whose first depth is 0 at a force, else None."""
    top = loading.start + int(np.argmax(force[loading]))
    largest, noise = force[top], SIGNIFICANT * roughness(force[None])[0, 0]
    if abs(depth[0]) >= _ZERO * depth[top]:
        return None
    # Of a flat face the depth of the first sample may be this force.
    elastic = largest * (max(depth[0], 0.0) / depth[top]) ** elastic_exponents(profile, depth[top])[0]
    if force[0] < max(_LEAST_FORCE * largest, noise, 2 * elastic):
        return None
    # After a preload from where the depth is again that of the first sample.
    start = loading.start + int(np.flatnonzero(depth[loading.start : top] <= depth[0])[-1:].sum())
    contact = contact_before(profile, depth[start : top + 1], force[start : top + 1])
    return InContact(contact.depth, float(force[0]), float(force.max()))


def _rounded(values, value, error):
    """A value and its error without digits below 10⁻⁹ of the range of values, for a text."""
    least = 1e-9 * np.ptp(values)
    return round(value / least) * least, error if error > least else 0.0
