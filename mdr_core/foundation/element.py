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
import scipy


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
    depth : float
        Depth (m) at its end.
    rise : float
        Change of depth (m) along it: where next to nothing, no difference of depths.
    time : float
        Its duration (s), positive; infinite for an infinitely slow one.
    tau : float
        Relaxation time τ (s) of the elements.
    critical_depth : float
        d_c (m), at which they yield.
    """

    depth: float
    rise: float
    time: float
    tau: float
    critical_depth: float

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

    `touched` tells whether it was in contact. If so, `stroke` is the path (m) along which it was
    pushed or let out, `mean` its mean elastic part (m), `duration` the time (s), 0 if not, `springy`
    the share of it in which the spring followed the indenter. `elastic` are its elastic parts (m) at
    the beginning and end of the ramp, with those at the beginning and end of contact in between.
    """

    ramp: Ramp
    touched: np.ndarray
    stroke: np.ndarray
    mean: np.ndarray
    duration: np.ndarray
    springy: np.ndarray | float
    elastic: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]

    @property
    def impulse(self):
        """∫ q dt/E* (m s)."""
        return (self.mean + self.ramp.lag) * self.duration

    @property
    def response(self):
        """Change of the impulse with the ramp's rate, ∂(∫ q dt)/∂ḋ/E* (s²).

        At a time t of the ramp the spring is compressed more by t, and what is met, is met sooner. Of
        relaxing elements that are met it is an estimate.
        """
        ramp, springy = self.ramp, self.springy * self.duration
        if ramp.rise < 0:
            return self.duration * (self.duration / 2 + ramp.tau)
        before = ramp.time - self.duration
        return springy * (before + springy / 2) + ramp.tau * ramp.time * (self.duration > 0)

    @property
    def viscous(self):
        """Energy (m²) dissipated by the dashpot: 4ηḋ along the stroke, and all that is lost while free."""
        before, first, last, after = self.elastic
        # What is not met relaxes from beginning to end.
        begun = np.where(self.touched, first, after)
        relaxed = (before - begun) * (before + begun)
        if last is not after:
            relaxed += np.where(self.touched, (last - after) * (last + after), 0.0)
        return self.ramp.lag * np.where(self.touched, self.stroke, 0.0) + relaxed / 2


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
    before, held = elements.elastic, elements.contact
    relaxed = before * ramp.keep
    contact = (above > relaxed) | held
    first, duration = _meeting_pressed(elements, ramp, above, contact & ~held)
    elastic = np.where(contact, np.minimum(above, ramp.critical_depth), relaxed)
    stroke, excess = above - first, np.maximum(above - ramp.critical_depth, 0.0)
    # On the capped part of the stroke the elastic part stays what it is.
    springy = 1 - excess / np.maximum(stroke, 1e-300)
    mean = elastic - springy * ((elastic - first) / 2)
    still = np.where(contact, elastic, above)
    new = Elements(elements.reduced, still, elastic, elements.plastic + excess, contact)
    return new, Exchange(ramp, contact, stroke, mean, duration, springy, (before, first, elastic, elastic))


def _meeting_pressed(elements, ramp, above, met):
    """Elastic parts (m) at which elements begin to be pressed, and the times (s) for which they are.

    What is in contact begins with what it has, a relaxed element with none; a relaxing one is met at
    w − w₀ = lag ln(u₀/w).
    """
    held, before = elements.contact, elements.elastic
    met_relaxing = met & (before > 0)
    start = above - ramp.rise
    low = np.where(held, before, np.maximum(start, 0.0))
    if ramp.time == np.inf:
        return low, np.zeros_like(low)
    pace = ramp.rise / ramp.time
    since = np.where(met, above - low, 0.0) / pace if pace > 0 else 0.0
    duration = np.where(held, ramp.time, since)
    if not met_relaxing.any():
        return low, duration
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        first = low
        if ramp.lag > 0:
            # w/lag + ln(w/lag) = w₀/lag + ln(u₀/lag).
            scaled = np.where(met, start, 0.0) / ramp.lag + np.log(before / ramp.lag)
            root = ramp.lag * scipy.special.wrightomega(scaled)
            root = np.clip(np.where(scaled < np.inf, root, low), low, np.maximum(above, low))
            first = np.where(met_relaxing, root, low)
        since = ramp.time - ramp.tau * (np.log(before) - np.log(first))
    duration = np.where(met_relaxing, np.clip(since, 0.0, ramp.time), duration)
    return first, duration


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
    stroke = first - last
    # Without a lag what has let go is relaxed at once.
    with np.errstate(over="ignore"):
        since = np.exp(np.minimum(above - last, 0.0) / lag) if lag > 0 else 0.0
    elastic = np.where(contact, above, np.where(touched, last * since, before * ramp.keep))
    duration = np.zeros_like(stroke)
    if ramp.time < np.inf:
        partly = np.where(touched, stroke, 0.0) / -ramp.rise * ramp.time
        duration = np.where(elements.contact & contact, ramp.time, partly)
    new = Elements(elements.reduced, above, elastic, elements.plastic, contact)
    parts = before, first, last, elastic
    return new, Exchange(ramp, touched, -stroke, (first + last) / 2, duration, 1.0, parts)


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
