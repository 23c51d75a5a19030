"""Force–depth curves with adhesion: their states with derivatives, and the samples in contact.

With D the end of the live interval, a = a(D), Δl the stretch at the rim and p = Δl/(2a g′(a)),

    ∂F/∂d = 2E* (a − 3Δl/(2g′))/(1 − p)       ∂F/∂ln w = −E* Δl²/(g′ (1 − p))
    ∂F/∂ln q_c = 2E* c d_c                    ∂F/∂ln E* = F − ∂F/∂ln w − 2E* c d_c

and ∂F/∂d_max = −2E* c. Contact is made and lost in jumps, at which the sum of squares would jump, too.
Which samples are in contact is therefore held while the other parameters are searched: the jumps of the
model, each moved to the sample where it fits best. The states go on beyond the rim of the imprint, and
beyond the end of their stable range have the force at this end. Samples next to a jump have no weight.
"""

import numpy as np

from ..adhesion import AT_DEPTH, contact_interval, stable_ranges, stretch, stretch_rate, tension_integral
from ..live_interval import LiveInterval
from ..medium import Medium, critical_depth, plastic_depth

#: Least 1 − p in derivatives, which are infinite at the end of the stable range.
_LEAST = 0.01


def adhesive_states(profile, values, depth, largest, loading, contact):
    """States at depths (m), arrays (R, N), `largest` the largest depths so far; 0 out of contact.

    Returns live interval, line load −E*Δl (N/m), force (N), slope and memory slope (N/m), and the
    derivatives of the force by the logarithms of E*, q_c and w.
    """
    medium, d_c, lower, low = _medium(profile, values, largest)
    modulus = 2 * medium.E_star
    # D follows from d alone; above the known depth the states are those at it.
    shortest = stretch(medium, profile._radius(low))
    first, known = low - shortest, profile.known_depth
    last = known - stretch(medium, profile._radius(np.asarray(known))) if known < np.inf else np.inf
    clamped, at_end = depth < first, np.minimum(np.maximum(depth, first), last)
    _, length = contact_interval(profile, medium, np.zeros_like(depth), at_end, low, known)
    # There two roots meet, and D has half of its digits.
    length = np.where(clamped, shortest, length)
    # Where d is much larger than d_c, d − d_p has few digits.
    yielded = (lower > 0) & (at_end == depth)
    live_length = length + np.where(yielded, d_c - (largest - depth), at_end - lower)
    interval = LiveInterval(lower, lower + live_length, live_length)
    a = profile._radius(interval.upper)
    c = np.where(lower > 0, profile._radius(lower), 0.0)
    rate = np.where(length > 0, stretch_rate(profile, a, length), 0.0)
    remainder = np.maximum(1 - np.divide(rate, 2 * a, out=np.zeros_like(a), where=a > 0), _LEAST)
    force = modulus * tension_integral(profile, interval, a, length)
    by_work = -modulus / 2 * length * rate / remainder
    # At the end of the range g ∝ aⁿ gives −E* a Δl (2 + 1/n)/(2 − 1/n).
    inverse = np.minimum(rate * interval.upper / np.maximum(a * length, 1e-300), 1.5)
    by_work = np.where(clamped, -modulus / 2 * a * length * (2 + inverse) / (2 - inverse), by_work)
    memory_slope = -modulus * c
    slope = np.where(clamped, 0.0, modulus * (a - 1.5 * rate) / remainder)
    slope = slope + np.where(loading, memory_slope, 0.0)
    yielded = np.where(lower > 0, -memory_slope * d_c, 0.0)
    gradient = [force - by_work - yielded, yielded, by_work]
    forces = -medium.E_star * length, force, slope, np.where(loading, 0.0, memory_slope), *gradient
    load, force, slope, memory_slope, *gradient = (np.where(contact, each, 0.0) for each in forces)
    upper, length = np.where(contact, interval.upper, lower), np.where(contact, interval.length, 0.0)
    return LiveInterval(lower, upper, length), load, force, slope, memory_slope, np.stack(gradient)


def _medium(profile, values, largest):
    """Elastic medium, d_c and plastic depths (m), and D (m) at the end of the stable range."""
    medium = Medium(values["E_star"], work_of_adhesion=values["work_of_adhesion"])
    d_c = critical_depth(values["E_star"], values["q_c"])
    return medium, d_c, plastic_depth(largest, d_c), stable_ranges(profile, medium, AT_DEPTH)[0][0]


def contact_of_model(problem, x):
    """Which samples are in contact (R, N) in the model at scaled parameters x."""
    values, _ = problem.parameters(x)
    depth = problem.depth - values["contact_point"]
    medium, _, lower, low = _medium(problem.profile, values, np.maximum.accumulate(depth, axis=1))
    end = np.maximum(low, lower)
    return in_contact(depth, lower, end - stretch(medium, problem.profile._radius(end)))


def in_contact(depth, touching, lost):
    """Contact (…, N) along paths that begins at depths `touching` and ends below depths `lost` (m)."""
    order, jumps = np.arange(depth.shape[-1]), (depth >= touching, depth < lost)
    begins, ends = (np.maximum.accumulate(np.where(each, order, -1), axis=-1) for each in jumps)
    return begins > ends


def contact_of_data(problem, x):
    """Which samples are in contact (R, N): the jumps of the model, moved to where they fit best."""
    contact = contact_of_model(problem, x)
    either = (problem.in_contact(np.full_like(contact, there)) for there in (False, True))
    outside, inside = (each.residuals(x)[0] ** 2 for each in either)
    for row, gain in zip(contact, outside - inside, strict=True):
        # The gain from contact up to each jump is that of all samples before it.
        total = np.append(0.0, np.cumsum(gain))
        jumps = np.flatnonzero(np.diff(row, prepend=False, append=False))
        for k in range(len(jumps)):
            low = jumps[k - 1] + 1 if k else 0
            stop = jumps[k + 1] if k + 1 < len(jumps) else row.size + 1
            between = total[low:stop]
            jumps[k] = low + int(between.argmax() if k % 2 else between.argmin())
        row[:] = np.sum(np.arange(row.size)[:, None] >= jumps, axis=1) % 2 == 1
    return contact


def next_to_jumps(contact):
    """Samples (R, N) with a jump between them and their neighbour."""
    jump = contact[:, 1:] != contact[:, :-1]
    return np.pad(jump, ((0, 0), (1, 0))) | np.pad(jump, ((0, 0), (0, 1)))
