"""The law of one element: spring, yield cap and dashpot, moved along a straight ramp of depth.

An element at x is met by the indenter at the compression u = d − g(x). While in contact

    u_p ← max(u_p, u − d_c),   u_e = u − u_p,   q = E* u_e + 4η ḋ   (Popov 2015, Eqs. (1), (11)-(18)),

it lets go where q falls to zero, that is at u_e = −τḋ, relaxes as u_e ∝ exp(−t/τ), and is met
again where the indenter reaches its u. Along a ramp of constant ḋ each of these events is the root
of a line against a line or an exponential, so that a step is exact however long it is.

Nothing here knows a shape; all quantities are lengths, and everything is vectorised over elements.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import wrightomega


@dataclass(frozen=True, eq=False)
class Elements:
    """State of a row of elements, one entry each.

    `above` is d − g(x) − u_p (m): how far the indenter has come beyond the element's relaxed
    place. In contact it is the elastic part u_e itself. It is carried from step to step, never
    recovered as a difference of depths, once the element has yielded.
    """

    reduced: np.ndarray
    above: np.ndarray
    elastic: np.ndarray
    plastic: np.ndarray
    contact: np.ndarray

    @classmethod
    def virgin(cls, reduced):
        """Elements under an indenter of reduced heights g(x) (m) that rests on their surface."""
        zero = np.zeros_like(reduced)
        return cls(reduced, -reduced, zero, zero, np.zeros(reduced.shape, bool))


@dataclass(frozen=True)
class Ramp:
    """A straight piece of a depth–time path.

    Parameters
    ----------
    start, depth : float
        Depths (m) at its ends.
    time : float
        Its duration (s), positive; infinite for an infinitely slow one.
    tau : float
        Relaxation time τ (s) of the elements.
    critical_depth : float
        d_c (m), at which they yield.
    """

    start: float
    depth: float
    time: float
    tau: float
    critical_depth: float

    @property
    def rise(self):
        """Change of depth (m)."""
        return self.depth - self.start

    @property
    def lag(self):
        """τḋ (m): the elastic part whose force equals that of the dashpot, of the sign of the rise."""
        return self.rise * (self.tau / self.time)

    @property
    def keep(self):
        """Fraction of its elastic part that a free element keeps."""
        return np.exp(-self.time / self.tau) if self.tau > 0 else 0.0


@dataclass(frozen=True, eq=False)
class Exchange:
    """What each element did along a ramp; forces and energies are per unit of E* and of width.

    `stroke` is the path (m) along which it was pushed or let out in contact, `mean` its mean
    elastic part (m) in contact, `duration` the time (s) of contact, `relaxed` the energy (m²) lost
    while free, `lag` that of the ramp (m).
    """

    stroke: np.ndarray
    mean: np.ndarray
    duration: np.ndarray
    relaxed: np.ndarray
    lag: float

    @property
    def impulse(self):
        """∫ q dt/E* (m s)."""
        return (self.mean + self.lag) * self.duration

    @property
    def viscous(self):
        """Energy (m²) dissipated by the dashpot: 4ηḋ along the stroke, and all that is lost while free."""
        return self.lag * self.stroke + self.relaxed


def advance(elements, ramp):
    """Elements after a ramp, and what they did along it.

    1. Move the indenter: `above` += rise.
    2. Find the compression at which a free element is met.
    3. Follow it in contact to the end of the ramp, to the yield cap, or to where it lets go.
    4. Let it relax for the rest of the time.
    """
    virgin = elements.plastic == 0
    above = np.where(virgin, ramp.depth - elements.reduced, elements.above + ramp.rise)
    return (_press if ramp.rise >= 0 else _withdraw)(elements, ramp, above)


def _press(elements, ramp, above):
    """A ramp that goes deeper, or holds: what is met stays met."""
    before, relaxed = elements.elastic, elements.elastic * ramp.keep
    met = (above > relaxed) & ~elements.contact
    contact = elements.contact | met
    first, duration = before, np.where(elements.contact, ramp.time, 0.0)
    if met.any():
        first = np.where(met, _meeting_pressed(elements, ramp, above, met), before)
        duration = np.where(met, _time_since(first, elements, ramp, above), duration)
    elastic = np.where(contact, np.minimum(above, ramp.critical_depth), relaxed)
    stroke = np.where(contact, above - first, 0.0)
    excess = np.where(contact, above - elastic, 0.0)
    # On the capped part of the stroke the elastic part stays what it is.
    rising = 1 - np.divide(excess, stroke, out=np.zeros_like(stroke), where=stroke > 0)
    mean = np.where(contact, elastic - rising * (elastic - first) / 2, 0.0)
    lost = (before**2 - np.where(contact, first, relaxed) ** 2) / 2
    new = Elements(
        elements.reduced,
        np.where(contact, elastic, above),
        elastic,
        elements.plastic + excess,
        contact,
    )
    return new, Exchange(stroke, mean, duration, lost, ramp.lag)


def _meeting_pressed(elements, ramp, above, met):
    """Elastic part w (m) at which a relaxing element is met: w − w₀ = lag ln(u₀/w)."""
    start = np.where(elements.plastic == 0, ramp.start - elements.reduced, elements.above)
    low = np.maximum(start, 0.0)
    if ramp.lag == 0 or not np.any(elements.elastic[met]):
        return low
    with np.errstate(divide="ignore", over="ignore", under="ignore"):
        # w/lag + ln(w/lag) = w₀/lag + ln(u₀/lag).
        scaled = np.where(met, start, 0.0) / ramp.lag + np.log(elements.elastic / ramp.lag)
        root = ramp.lag * wrightomega(scaled)
    return np.clip(np.where(scaled < np.inf, root, low), low, np.maximum(above, low))


def _time_since(first, elements, ramp, above):
    """Time (s) since an element was met; it counts in a ramp of finite time."""
    if ramp.time == np.inf:
        return np.zeros_like(first)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # One that was relaxed is met at 0, another once it has relaxed so far.
        since = np.where(
            elements.elastic > 0,
            ramp.time - ramp.tau * (np.log(elements.elastic) - np.log(first)),
            above / np.float64(ramp.rise) * ramp.time,
        )
    return np.clip(since, 0.0, ramp.time)


def _withdraw(elements, ramp, above):
    """A ramp that goes back: what is in contact may let go, once, and is not met again."""
    lag, before = -ramp.lag, elements.elastic
    first, touched = before, elements.contact
    met = ~elements.contact & (before > lag) & (above - ramp.rise > 0)
    if met.any():
        meeting, met = _meeting_withdrawn(elements, ramp, above, met)
        first, touched = np.where(met, meeting, before), touched | met
    last = np.maximum(above, np.minimum(first, lag))
    contact = touched & (above > lag)
    stroke = np.where(touched, first - last, 0.0)
    # Without a lag what has let go is relaxed at once.
    with np.errstate(over="ignore"):
        since = np.exp(np.minimum(above - last, 0.0) / lag) if lag > 0 else 0.0
    elastic = np.where(contact, above, np.where(touched, last * since, before * ramp.keep))
    duration = np.zeros_like(stroke)
    if ramp.time < np.inf:
        duration = np.where(elements.contact & contact, ramp.time, stroke / -ramp.rise * ramp.time)
    kept = np.where(touched, np.where(contact, 0.0, last**2 - elastic**2), -(elastic**2))
    lost = (before**2 - np.where(touched, first**2, 0.0) + kept) / 2
    mean = np.where(touched, (first + last) / 2, 0.0)
    new = Elements(elements.reduced, above, elastic, elements.plastic, contact)
    return new, Exchange(-stroke, mean, duration, lost, ramp.lag)


def _meeting_withdrawn(elements, ramp, above, able):
    """Elastic part w (m) at which a relaxing element springs back to a slower indenter, and where it does.

    Y − ln Y = w₀/lag − ln(u₀/lag) with w = lag Y, Y ≥ 1: later it would no longer be faster.
    """
    start, lag = above - ramp.rise, -ramp.lag
    if lag == 0:
        return start, able
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # As u − ln(1 + u) with u = Y − 1, which is often small.
        goal = np.where(able, start / lag - np.log(elements.elastic / lag) - 1, 0.0)
    able = able & (goal >= 0)
    goal = np.where(able, np.minimum(goal, 1e17), 0.0)
    root = goal + np.sqrt(2 * goal)
    for _ in range(6):
        # The upper bound above is close enough for Newton's method to settle.
        change = (root - np.log1p(root) - goal) * (1 + root)
        root = root - np.divide(change, root, out=np.zeros_like(root), where=root > 0)
    # Beyond 16 digits the lag makes no difference.
    meeting = np.where(goal < 1e17, np.minimum(lag * (1 + root), start), start)
    return meeting, able & (meeting > above)
