"""Curves of elastic media with adhesion: states with derivatives, and the samples in contact.

With the end D of the live interval, a = a(D), the stretch Δl at the rim, and p = Δl/(2a g′(a)),

    ∂F/∂d = 2E* (a − 3Δl/(2g′))/(1 − p)     w ∂F/∂w = −E* Δl²/(g′ (1 − p))     E* ∂F/∂E* = F − w ∂F/∂w

Contact is made and lost in jumps, at which the sum of squares would also jump. Therefore the set of samples
in contact is fixed while the other parameters are searched. It has the jumps of the model, each moved to
the sample where it fits best. Beyond the end of their stable range the states have the force at this end.
Samples next to a jump have no weight.
"""

from dataclasses import dataclass, replace

import numpy as np

from ...solver.contact.adhesion import (
    AT_DEPTH,
    contact_interval,
    stable_ranges,
    stretch,
    stretch_rate,
    tension_integral,
)
from ...solver.contact.live_interval import LiveInterval
from ...solver.medium.medium import Medium
from .curves import NO_WEIGHT, Curves
from .model import States

#: Smallest 1 − p in derivatives, which are infinite at the end of the stable range.
_LEAST = 0.01
#: Largest number of searches; between them the samples in contact are updated.
_SEARCHES = 8


@dataclass(frozen=True)
class AdhesiveCurves(Curves):
    """`Curves` of elastic media with adhesion; `contact` (R, N) marks the samples in contact."""

    contact: np.ndarray | None = None

    adhesive = True

    def states_at(self, values, depth):
        return adhesive_states(self.profile, values, depth, self.contact)

    def model_states(self, x):
        return replace(self, contact=self.contact_of_model(x)).states(x)

    def noise(self, slope):
        jump = self.contact[:, 1:] != self.contact[:, :-1]
        next_to_jump = np.pad(jump, ((0, 0), (1, 0))) | np.pad(jump, ((0, 0), (0, 1)))
        return np.where(next_to_jump, NO_WEIGHT, 1.0) * self.sigma

    def search(self, start):
        contact = None
        for _ in range(_SEARCHES):
            before, contact = contact, self.contact_of_data(start)
            if np.array_equal(before, contact):
                break
            minimum = replace(self, contact=contact).minimum(start)
            start = minimum.x
        return minimum

    def contact_of_model(self, x):
        """Return a mask of the samples in contact (R, N) in the model at scaled parameters x."""
        values = self.values(x)
        _, low, shortest = _end_of_contact(self.profile, values)
        return in_contact(self.depth - values["contact_point"], low - shortest)

    def contact_of_data(self, x):
        """Return a mask of the samples in contact (R, N): the jumps of the model, moved to the best fit."""
        contact = self.contact_of_model(x)
        outside, inside = (
            replace(self, contact=np.full_like(contact, there)).residuals(x)[0] ** 2
            for there in (False, True)
        )
        for row, gain in zip(contact, outside - inside, strict=True):
            # Cumulative gain of contact at all samples before each jump.
            total = np.append(0.0, np.cumsum(gain))
            jumps = np.flatnonzero(np.diff(row, prepend=False, append=False))
            for k in range(len(jumps)):
                low = jumps[k - 1] + 1 if k else 0
                stop = jumps[k + 1] if k + 1 < len(jumps) else row.size + 1
                between = total[low:stop]
                jumps[k] = low + int(between.argmax() if k % 2 else between.argmin())
            row[:] = np.sum(np.arange(row.size)[:, None] >= jumps, axis=1) % 2 == 1
        return contact


def adhesive_states(profile, values, depth, contact):
    """Return the `States` at depths (m) from first contact, arrays (R, N); no force out of contact."""
    medium, low, shortest = _end_of_contact(profile, values)
    modulus, first, known = 2 * medium.E_star, low - shortest, profile.known_depth
    last = known - stretch(medium, profile.radius_at(np.asarray(known))) if known < np.inf else np.inf
    # Beyond the known depth, the states are those at the known depth.
    clamped, at_end = depth < first, np.minimum(np.maximum(depth, first), last)
    _, length = contact_interval(profile, medium, np.zeros_like(depth), at_end, low, known)
    # Two roots meet at the end of the stable range, where D has only half of its digits.
    length = np.where(clamped, shortest, length)
    interval = LiveInterval.elastic(at_end + length)
    a = profile.radius_at(interval.upper)
    rate = np.where(length > 0, stretch_rate(profile, a, length), 0.0)
    remainder = np.maximum(1 - np.divide(rate, 2 * a, out=np.zeros_like(a), where=a > 0), _LEAST)
    force = modulus * tension_integral(profile, interval, a, length)
    by_work = -modulus / 2 * length * rate / remainder
    # At the end of the range g ∝ aⁿ gives −E* a Δl (2 + 1/n)/(2 − 1/n).
    inverse = np.minimum(rate * interval.upper / np.maximum(a * length, 1e-300), 1.5)
    by_work = np.where(clamped, -modulus / 2 * a * length * (2 + inverse) / (2 - inverse), by_work)
    slope = np.where(clamped, 0.0, modulus * (a - 1.5 * rate) / remainder)
    gradient = {
        "E_star": np.where(contact, (force - by_work) / medium.E_star, 0.0),
        "work_of_adhesion": np.where(contact, by_work / medium.work_of_adhesion, 0.0),
    }
    return States(
        depth=depth,
        loading=depth >= np.maximum.accumulate(depth, axis=1),
        cap=np.full_like(values["E_star"], np.inf),
        live_interval=LiveInterval.elastic(np.where(contact, interval.upper, 0.0)),
        uniform_load=np.where(contact, -medium.E_star * length, 0.0),
        force=np.where(contact, force, 0.0),
        slope=np.where(contact, slope, 0.0),
        memory_slope=np.zeros_like(depth),
        gradient=gradient,
    )


def _end_of_contact(profile, values):
    """Return the medium, and D and the stretch at the rim (m) at the end of the stable range."""
    medium = Medium(values["E_star"], work_of_adhesion=values["work_of_adhesion"])
    low = stable_ranges(profile, medium, AT_DEPTH)[0][0]
    return medium, low, stretch(medium, profile.radius_at(low))


def in_contact(depth, lost):
    """Return a mask (…, N) of contact along paths, from first touch until a depth below `lost` (m)."""
    order, jumps = np.arange(depth.shape[-1]), (depth >= 0, depth < lost)
    begins, ends = (np.maximum.accumulate(np.where(each, order, -1), axis=-1) for each in jumps)
    return begins > ends
