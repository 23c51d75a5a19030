"""Law of one element: spring, yield cap and dashpot, along a straight ramp of depth.

The element at x is compressed by u = d − g(x) while it is in contact with the indenter:

    u_p ← max(u_p, u − u_c),   u_e = u − u_p,   q = E* u_e + 4η ḋ   (Popov 2015, Eqs. (1), (11)-(18)).

It is released when q reaches zero, at u_e = −τḋ, and relaxes as u_e ∝ exp(−t/τ). Contact returns when the
indenter reaches the surface of the relaxing element. Along a ramp of constant ḋ, each of these events is
the intersection of a line with a line or an exponential. A step of any length is therefore exact.

All quantities are lengths and times; the profile does not enter. Operations are vectorised over elements.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy


@dataclass(frozen=True, eq=False)
class Elements:
    """State of a row of elements: arrays with one entry per element.

    Lengths (m) are the coordinate, the width, the reduced profile g(x), the penetration d − g(x) − u_p into
    the relaxed surface, and the elastic part u_e and plastic part u_p of the compression. In contact the
    penetration equals u_e. After yield it is updated step by step, because the difference of depths would
    cancel.
    """

    x: np.ndarray
    width: np.ndarray
    reduced: np.ndarray
    penetration: np.ndarray
    elastic: np.ndarray
    plastic: np.ndarray
    contact: np.ndarray

    @classmethod
    def virgin(cls, profile, x, width):
        """Return undeformed elements at coordinates x (m), with the indenter at depth 0."""
        reduced, zero = np.asarray(profile.reduced(x)), np.zeros_like(x)
        return cls(x, width, reduced, -reduced, zero, zero, np.zeros(x.shape, bool))


@dataclass(frozen=True)
class Ramp:
    """A straight piece of a path of depth in time, with τ (s) and the elastic limit u_c (m) of the medium.

    `travel` (m) ends at `depth` (m). It is stored because a difference of depths may cancel. The `duration`
    (s) may be infinite. `yield_travel` is the ratio of the gains of depth and plastic depth while elements
    yield, 1 for a constant limit.
    """

    depth: float
    travel: float
    duration: float
    tau: float
    elastic_limit: float
    yield_travel: float = 1.0

    @property
    def lag(self):
        """τḋ (m), the compression at which spring and dashpot carry the same load, with the sign of ḋ."""
        return self.travel * (self.tau / self.duration)

    @property
    def decay(self):
        """Factor exp(−t/τ) by which the elastic part of a released element relaxes."""
        return np.exp(-self.duration / self.tau) if self.tau > 0 else 0.0


@dataclass(frozen=True, eq=False)
class Exchange:
    """Impulse and energy of each element along a ramp, per unit of E* and of width.

    In contact, `stroke` is the change of compression (m), `mean` the mean elastic part (m) over it, and
    `duration` the time (s). `spring_share` is the fraction of the stroke before the yield cap. Without
    contact, stroke and duration are 0. `relaxed` is the energy (m²) dissipated out of contact, and
    `plastic` the energy (m²) dissipated by yielding.
    """

    ramp: Ramp
    stroke: np.ndarray
    mean: np.ndarray
    duration: np.ndarray
    spring_share: np.ndarray | float
    relaxed: np.ndarray
    plastic: np.ndarray

    @property
    def impulse(self):
        """∫ q dt/E* (m s)."""
        return (self.mean + self.ramp.lag) * self.duration

    @property
    def impulse_slope(self):
        """Derivative of ∫ q dt/E* by the rate of the ramp (s²); approximate if contact returns."""
        ramp, spring_time = self.ramp, self.spring_share * self.duration
        if ramp.travel < 0:
            return self.duration * (self.duration / 2 + ramp.tau)
        # A larger rate compresses the spring by t more at time t, and begins contact earlier.
        free_time = ramp.duration - self.duration
        dashpot = ramp.tau * ramp.duration * (self.duration > 0)
        return spring_time * (free_time + spring_time / 2) + dashpot

    @property
    def viscous(self):
        """Energy (m²) dissipated by the dashpot, 4ηḋ along the stroke, and by relaxation out of contact."""
        return self.ramp.lag * self.stroke + self.relaxed


def _released_energy(before, after):
    """Return the energy (m²) of a spring's relaxation from one elastic part (m) to another."""
    return (before - after) * (before + after) / 2


def advance(elements, ramp):
    """Return the `Elements` at the end of a ramp, and the `Exchange` along it."""
    virgin = elements.plastic == 0
    penetration = np.where(virgin, ramp.depth - elements.reduced, elements.penetration + ramp.travel)
    return (_press if ramp.travel >= 0 else _withdraw)(elements, ramp, penetration)


def _press(elements, ramp, penetration):
    """Advance on a ramp of increasing or constant depth: no element is released."""
    initial = elements.elastic
    relaxed = initial * ramp.decay
    contact = (penetration > relaxed) | elements.contact
    first, duration = _pressed_contact(elements, ramp, penetration, contact & ~elements.contact)
    elastic = np.where(contact, np.minimum(penetration, ramp.elastic_limit), relaxed)
    first = np.where(contact, first, elastic)
    stroke = np.where(contact, penetration - first, 0.0)
    excess = np.maximum(penetration - ramp.elastic_limit, 0.0)
    # Along the stroke at the yield cap, the elastic part goes linearly from `capped` to `elastic`.
    spring_share = 1 - ramp.yield_travel * excess / np.maximum(stroke, 1e-300)
    capped = elastic + excess * (1 - ramp.yield_travel)
    mean = (elastic + capped) / 2 - spring_share * ((elastic - first) / 2)
    penetration = np.where(contact, elastic, penetration)
    plastic = elements.plastic + excess
    new = replace(elements, penetration=penetration, elastic=elastic, plastic=plastic, contact=contact)
    relaxed, work = _released_energy(initial, first), excess * (elastic + capped) / 2
    return new, Exchange(ramp, stroke, mean, duration, spring_share, relaxed, work)


def _pressed_contact(elements, ramp, penetration, touching):
    """Return elastic parts (m) at the start of contact on a pressing ramp, and the times (s) in contact.

    Elements in contact start from their elastic part, relaxed elements from zero. A relaxing element with
    the elastic part u₀ and the penetration w₀ comes into contact at w, with w − w₀ = lag ln(u₀/w).
    """
    initial = elements.elastic
    relaxing = touching & (initial > 0)
    start = penetration - ramp.travel
    first = np.where(elements.contact, initial, np.maximum(start, 0.0))
    if ramp.duration == np.inf:
        return first, np.zeros_like(first)
    rate = ramp.travel / ramp.duration
    time = np.where(touching, penetration - first, 0.0) / rate if rate > 0 else 0.0
    duration = np.where(elements.contact, ramp.duration, time)
    if not relaxing.any():
        return first, duration
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        if ramp.lag > 0:
            # w/lag + ln(w/lag) = w₀/lag + ln(u₀/lag).
            scaled = np.where(touching, start, 0.0) / ramp.lag + np.log(initial / ramp.lag)
            root = ramp.lag * scipy.special.wrightomega(scaled)
            root = np.clip(np.where(scaled < np.inf, root, first), first, np.maximum(penetration, first))
            first = np.where(relaxing, root, first)
        time = ramp.duration - ramp.tau * (np.log(initial) - np.log(first))
    return first, np.where(relaxing, np.clip(time, 0.0, ramp.duration), duration)


def _withdraw(elements, ramp, penetration):
    """Advance on a ramp of decreasing depth: released elements remain free."""
    lag, initial = -ramp.lag, elements.elastic
    first, touched = initial, elements.contact
    returning = ~elements.contact & (initial > lag) & (penetration - ramp.travel > 0)
    if returning.any():
        root, returning = _withdrawn_contact(elements, ramp, penetration, returning)
        first, touched = np.where(returning, root, initial), touched | returning
    last = np.maximum(penetration, np.minimum(first, lag))
    contact = touched & (penetration > lag)
    # Without viscosity, a released element relaxes at once.
    with np.errstate(over="ignore"):
        decay = np.exp(np.minimum(penetration - last, 0.0) / lag) if lag > 0 else 0.0
    relaxed = np.where(touched, last * decay, initial * ramp.decay)
    elastic = np.where(contact, penetration, relaxed)
    first, last = np.where(touched, first, elastic), np.where(touched, last, elastic)
    stroke, mean, duration = last - first, (first + last) / 2, np.zeros_like(first)
    if ramp.duration < np.inf:
        held = elements.contact & contact
        duration = np.where(held, ramp.duration, stroke / ramp.travel * ramp.duration)
    new = replace(elements, penetration=penetration, elastic=elastic, contact=contact)
    energy = _released_energy(initial, first) + _released_energy(last, elastic)
    return new, Exchange(ramp, stroke, mean, duration, 1.0, energy, np.zeros_like(first))


def _withdrawn_contact(elements, ramp, penetration, candidates):
    """Return the elastic part w (m) at which a relaxing element reaches the indenter, and whether it does.

    Y − ln Y = w₀/lag − ln(u₀/lag) with w = lag Y. The element is faster than the indenter only for Y ≥ 1.
    """
    start, lag = penetration - ramp.travel, -ramp.lag
    if lag == 0:
        return start, candidates
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # Solved as u − ln(1 + u) with u = Y − 1, because u is often small.
        target = np.where(candidates, start / lag - np.log(elements.elastic / lag) - 1, 0.0)
    candidates = candidates & (target >= 0)
    target = np.where(candidates, np.minimum(target, 1e17), 0.0)
    root = target + np.sqrt(2 * target)
    for _ in range(6):
        # From this upper bound Newton's method converges in six steps.
        change = (root - np.log1p(root) - target) * (1 + root)
        root = root - np.divide(change, root, out=np.zeros_like(root), where=root > 0)
    # Above 1e17 the lag is below the rounding of w₀.
    elastic = np.where(target < 1e17, np.minimum(lag * (1 + root), start), start)
    return elastic, candidates & (elastic > penetration)
