"""The motion of one body on a structure with modes: waves come back, and a body may hit several times.

The body and each mode are linear oscillators under the contact force, which over a step is a polynomial
(`oscillators`). x are the displacements of free masses, including the body (upward), and q of the modes.
Newton's method solves

    d = −Σ x − Σ q − r F(d)

at each node of a step. Steps end at the onset of yield and at the turning point of a yielding contact, so
that the law of the contact is smooth in each step. They are halved towards first contact and its loss,
because the force is a power of the distance there.
"""

from dataclasses import dataclass

import numpy as np

from ...base.errors import MDRError
from ...base.motions import Hit
from ..contact.integrals import integrals, tabulated_for
from ..contact.live_interval import LiveInterval
from ..contact.yielding import yield_rule
from ..numerics.roots import sign_change
from .energy_balance import dry_impact
from .oscillators import (
    DEGREE,
    DISPLACEMENTS,
    NODES,
    SLOPE,
    TO_LEGENDRE,
    WHOLE,
    Oscillators,
    at,
    polynomial,
    slope_at,
)  # fmt: skip
from .snap import snap

#: Error of the impulse of a step over m v₀, and its remainder at the loss of contact.
TOLERANCE, _LOST = 1e-9, 1e-13
#: Largest numbers of steps of a contact and of contacts of a body; periods of the lowest oscillation after
#: which a body is captured.
_STEPS, _CONTACTS, _PERIODS = 20_000, 10_000, 100
#: Number of depths for `tabulated_for`: a table is worth its time for a shape without a closed form, but
#: not for a thousand samples.
_EVALUATIONS = 64
#: Durations of the first, the shortest and the longest step of a contact, in sixteenths of the contact time
#: on a rigid body.
_FIRST, _SHORTEST, _LONGEST = 2.0**-14, 2.0**-45, 8.0
#: Remedy if there is no solution.
_CHECK = "check mass, speed and modes, and whether all quantities are in SI units"
#: Places of a step at which to search for events.
_PLACES = np.linspace(0.0, 1.0, 33)
_THERE, _SLOPE_THERE = at(_PLACES), slope_at(_PLACES)
_UNIT = np.eye(DEGREE)
#: Grid of the search for the next contact: number of places at once, and in its first interval. Motion, as
#: a share of the largest depth, below which modes do not determine the grid. Intervals per half period of
#: the other modes.
_AT_ONCE, _GEOMETRIC, _STILL, _TURN = 257, 120, 1e-6, 6


class ContactLaw:
    """The force (N) of the contact with its memory, the plastic depth p (m)."""

    def __init__(self, profile, medium, imprint, deepest):
        self.rule = yield_rule(tabulated_for(profile, _EVALUATIONS, lambda: deepest), medium)
        self.modulus, self.plastic_depth, self.yields = 2 * float(medium.E_star), float(imprint), False
        p = np.asarray(self.plastic_depth)
        #: Penetration (m) at which yield continues.
        self.onset = float(self.rule.penetration(p, p))
        #: Energy (J) dissipated by yielding.
        self.work = 0.0

    def __call__(self, y):
        """Return force (N) and its slope (N/m) at penetrations (m) below the imprint."""
        p = self.plastic_depth
        # A deeper contact raises an error after its step is found.
        y = np.clip(y, 0.0, self.rule.profile.known_depth - p)
        if self.yields:
            interval, increase = self.rule.loading(y, p)
            width = self.rule.loading_stiffness_radius(interval, increase)
        else:
            interval = LiveInterval(np.full_like(y, p), p + y, y)
            width = self.rule.profile.radius_at(interval.upper)
        return self.modulus * integrals(self.rule.profile).radius_integral(interval), self.modulus * width

    def turn(self, y):
        """Store the plastic depth and the work of yielding to a penetration (m)."""
        before = np.asarray(self.plastic_depth)
        interval, increase = self.rule.loading(np.asarray(y), before)
        self.work += float(self.modulus * self.rule.plastic_integral(before, increase))
        self.plastic_depth, self.onset, self.yields = float(interval.lower), float(interval.length), False


@dataclass(frozen=True, eq=False)
class Part:
    """A step of a contact, or a flight: its initial values, and forces and penetrations at its nodes.

    Free masses have the displacements `x` (m) and velocities `v` (m/s), modes have the complex `z` (m/s).
    `damping_work` (J) is the energy dissipated by damping before.
    """

    start: float
    duration: float
    x: np.ndarray
    v: np.ndarray
    z: np.ndarray
    damping_work: float
    imprint: float
    yields: bool = False
    force: np.ndarray | None = None
    penetration: np.ndarray | None = None

    @property
    def end(self):
        """Time (s) of its end."""
        return self.start + self.duration


class ModalMotion:
    """The motion of one body on a structure with modes, from first contact until it has left.

    `parts` are steps and flights one after the other, `hits` the contacts.
    """

    def __init__(self, profile, medium, mass, speed, imprint, structure, tolerance=TOLERANCE):
        self.mass, self.speed, self.tolerance = float(mass), float(speed), tolerance
        self.momentum = self.mass * self.speed
        rigid = dry_impact(profile, medium, *(np.asarray(each) for each in (mass, speed, imprint)))
        # No contact is deeper than on a rigid body, which takes no energy.
        self.known, deepest = float(profile.known_depth), float(rigid.max_depth)
        self.law = ContactLaw(profile, medium, imprint, min(deepest, self.known))
        duration = float(rigid.contact_time) if deepest < np.inf else self.known / self.speed
        self.snap_depth = _snap_depth(self.law, imprint, rigid, max(structure.residual_compliance, 0.0))
        self.unit = duration / 16
        self.system, self.longest = self._system(structure, duration)
        self.x, self.v = (np.zeros(self.system.free_mass.size) for _ in range(2))
        self.x[0], self.v[0] = -float(imprint), -self.speed
        self.z = np.zeros(self.system.mass.size, complex)
        self.time = self.turning_time = self.force = 0.0
        self.max_depth, self.max_deflection, self.damping_work = float(imprint), 0.0, 0.0
        self.parts, self.hits, self.captured, self.too_deep = [], [], False, False
        self.damped = np.any(self.system.root.real < 0)
        while True:
            self._contact()
            if self.too_deep or not self._flight():
                break

    def _system(self, structure, contact_time):
        """Return body and modes as `Oscillators`, and the time (s) after which the body is captured."""
        modes = structure.modes
        omega = np.append(0.0, 2 * np.pi * np.array(modes.frequency))
        masses, damping = np.append(self.mass, modes.mass), np.append(0.0, modes.damping)
        compliance = 1 / structure.stiffness if structure.stiffness < np.inf else modes.compliance
        lowest = omega[omega > 0].min(initial=np.inf)
        # Without a support the compliance is infinite; then the lowest mode determines the period.
        soft = self.mass * compliance if compliance < np.inf else 0.0
        period = 2 * np.pi * np.sqrt(soft + lowest**-2.0) + contact_time
        return Oscillators(
            omega, masses, damping, max(structure.residual_compliance, 0.0)
        ), _PERIODS * period

    @property
    def restitution(self):
        """Rebound speed of the body over its speed; negative if it continues behind a free structure."""
        if self.captured or self.too_deep:
            return 0.0
        e = float(self.v[0] / self.speed)
        if e < -1e-9 and self.system.free_mass.size == 1:
            raise MDRError(f"the body would leave through the structure, e = {e:.3g}; {_CHECK}")
        return e

    @property
    def contact_time(self):
        """Time (s) from first touch to the last loss of contact; infinite for a captured body."""
        return np.inf if self.captured or self.too_deep else self.hits[-1].end

    @property
    def structure_work(self):
        """Energy (J) that the structure has taken and does not return."""
        if self.captured:
            return self.mass * self.speed**2 / 2 - self.law.work
        return self.energy + self.damping_work

    def depth_rate(self):
        """Return the rate (m/s) of the depth without force."""
        return -np.sum(self.v) - np.sum(self.system.rates(self.z))

    @property
    def energy(self):
        """Energy (J) of the structure."""
        return self.energy_of(self.z, self.v, self.force)

    def energy_of(self, z, v, force):
        """Return the energy (J) of the structure with modes z, velocities v of free masses and a force."""
        free = np.sum(self.system.free_mass[1:] * v[1:] ** 2) / 2
        return float(self.system.energies(z) + free + self.system.residual * force**2 / 2)

    def _trial(self, h):
        """Return forces (N) and penetrations (m) at the nodes of a step of duration h (s), or None."""
        s, (compliance, turned, _) = self.system, self.system.step(h)
        free = -np.sum(self.x) - np.sum(self.v) * h * NODES - (turned @ (self.z / s.root.imag)).imag
        free -= self.law.plastic_depth
        # The first node is known: its force is the force at the end of the last step.
        known, inner = free[1:] - compliance[1:, 0] * self.force, compliance[1:, 1:]
        y, scale = known - inner @ np.full(DEGREE, self.force), np.abs(known).max()
        for _ in range(25):
            force, slope = self.law(y)
            slope = np.where(y > 0, slope, 0.0)
            step = np.linalg.solve(_UNIT + inner * slope, known - y - inner @ force)
            y, force = y + step, force + slope * step
            # The next Newton step would be about the square of this step.
            if np.abs(step).max() <= 1e-9 * scale:
                start = free[0] - s.residual * self.force
                return np.append(self.force, force), np.append(start, y)
        return None

    def _contact(self):
        """Take the steps from first contact to its loss."""
        start, done, h = self.time, [], self.unit * _FIRST
        for _ in range(_STEPS):
            trial = self._trial(h)
            if self.max_depth >= self.snap_depth:
                raise MDRError(
                    "after the onset of yield the force falls with depth by more than 1/r, the stiffness "
                    "of the modes that are not given: the contact snaps, with an energy loss that is not "
                    "computed; give more modes, less speed, or a hardness without f_c"
                )
            if trial is None:
                h = self._halved(h)
                continue
            force, y = trial
            lost, rate = np.min(y[1:]) <= 0, self.depth_rate()
            if lost and rate < 0 and (rest := max(y[0], 0.0) / -rate) * self.force < _LOST * self.momentum:
                break
            error = h * np.abs((TO_LEGENDRE @ force)[-2:]).max() / self.momentum
            if lost or error > self.tolerance:
                # If contact is lost, the step is halved at once to end before the loss.
                first = int(np.argmax(_THERE @ y <= 0)) if lost else 0
                h = self._halved(h, int(np.log2(_PLACES[-1] / _PLACES[first])) if first else 1)
                continue
            if y.max() + self.law.plastic_depth > self.known:
                self.too_deep = True
                return
            share = self._event(y)
            if share is None:
                done.append(self._accept(h, force, y))
                if error < self.tolerance / 600 and h < _LONGEST * self.unit:
                    h *= 2
                continue
            last = y[0]
            if share > 1e-9 and (trial := self._trial(h * share)) is not None:
                done.append(self._accept(h * share, *trial))
                last = trial[1][-1]
            if self.law.yields:
                self.law.turn(last)
            else:
                self.law.yields = True
        else:
            raise MDRError(f"a contact on the structure has not ended in {_STEPS} steps; {_CHECK}")
        impulse, largest = np.transpose(done)
        self.force = 0.0
        # The rest has no impulse, but up to 10⁻⁴ of the contact time: for F ∝ dⁿ the share 10⁻¹³ᐟ⁽ⁿ⁺¹⁾.
        gap, rest = self._gap(), min(rest, h)
        for _ in range(3):
            overlap, rate = gap(rest)
            # The contact is lost within the last step.
            rest = min(max(rest - overlap / rate, 0.0), h) if rate < 0 else rest
        self._fly(rest, self.unit)
        self.hits.append(Hit(start, self.time, float(largest.max()), float(impulse.sum())))

    def _halved(self, h, times=1):
        """Halve a duration (s) that is too long `times`, but at least once."""
        if h < _SHORTEST * self.unit:
            raise MDRError(f"the contact on the structure is not solved by steps of {h:.3g} s; {_CHECK}")
        return h / 2 ** max(times, 1)

    def _event(self, y):
        """Return the share of a step at which yield begins or a yielding contact turns, or None."""
        slope = _SLOPE_THERE @ y
        if self.law.yields:
            values, place, goal, close = -slope, polynomial(y, -1), 0.0, 0.0
        else:
            values, place, goal = _THERE @ y, polynomial(y), self.law.onset
            # The rounding of this penetration, and of the depth.
            close = 1e-13 * goal + 1e-15 * self.max_depth if goal < np.inf else 0.0
        beyond = values > goal + close
        if beyond[0] and (self.law.yields or slope[0] > 0):
            return 0.0
        crossed = np.flatnonzero(beyond[1:] & ~beyond[:-1])
        if not crossed.size:
            return None
        first = crossed[0]
        if values[first] >= goal:
            return float(_PLACES[first])
        return sign_change(lambda share: place(share) - goal, *_PLACES[first : first + 2])

    def _accept(self, h, force, y):
        """Take a step; return its impulse (N·s) and largest force (N)."""
        s, imprint = self.system, self.law.plastic_depth
        _, turned, weights = s.step(h)
        self.parts.append(Part(*self._begun(h), self.law.yields, force, y))
        before, impulse = self.energy if self.damped else 0.0, h * WHOLE @ force
        displacements = -self.x[0] - self.v[0] * h * NODES - h * h / self.mass * (DISPLACEMENTS @ force)
        deflection = displacements - y - imprint
        self.x = self.x + self.v * h + h * h * (DISPLACEMENTS[-1] @ force) / s.free_mass
        self.v = self.v + impulse / s.free_mass
        self.z = turned[-1] * self.z + weights[-1] @ force
        self.time, self.force = self.time + h, float(force[-1])
        if self.damped:
            # Lobatto's quadrature is exact for the product of both polynomials.
            self.damping_work += WHOLE @ (force * (SLOPE @ deflection)) + before - self.energy
        (deepest, share), (largest, _), (bent, _) = _largest(y, force, deflection)
        if imprint + deepest > self.max_depth:
            self.max_depth, self.turning_time = imprint + deepest, self.parts[-1].start + share * h
        self.max_deflection = max(self.max_deflection, bent)
        return impulse, largest

    def _gap(self):
        """Return a function of a free time (s): the overlap (m), below 0 in flight, and its rate (m/s)."""
        root, swing = self.system.root, self.z / self.system.root.imag
        drift, position = -np.sum(self.v), -np.sum(self.x) - self.law.plastic_depth

        def gap(t):
            turned = np.exp(np.multiply.outer(t, root)) * swing
            return position + drift * t - turned.imag.sum(-1), drift - (turned * root).imag.sum(-1)

        return gap

    def _flight(self):
        """Move freely to the next contact; return whether there is a next contact."""
        s, gap = self.system, self._gap()
        if len(self.hits) >= _CONTACTS:
            raise MDRError(f"the body has hit the structure {_CONTACTS} times; {_CHECK}")
        # If the body is farther away than the sum of all amplitudes, the modes do not reach it.
        amplitude, drift = np.abs(self.z / s.root.imag), -np.sum(self.v)
        far, last = amplitude.sum() - np.sum(self.x) - self.law.plastic_depth, self.longest - self.time
        leaves = drift < 0 and far <= -drift * last
        last = max(far, 0.0) / -drift if leaves else last
        order = np.argsort(s.omega)
        together = np.cumsum(amplitude[order][::-1])[::-1]
        moving = s.omega[order][together > _STILL * self.max_depth]
        interval = min(self.unit, np.pi / _TURN / moving.max(initial=0.0)) if moving.size else self.unit
        t = 0.0
        while t < last:
            grid = t + interval * np.arange(_AT_ONCE)
            if t == 0.0:
                # Light modes may bring the structure back within a fraction of the first interval.
                close = 1.5 * max(gap(0.0)[0], 0.0) / max(-gap(0.0)[1], 1e-300) + 1e-12 * interval
                early = np.geomspace(close, interval, _GEOMETRIC) if close < interval else grid[1:2]
                grid = np.concatenate([early, grid[2:]])
            value = gap(grid)[0]
            for i in np.flatnonzero((value[1:] > 0) & (value[:-1] <= 0)):
                low, high = grid[i : i + 2]
                # A single place is summed in another order: at the end of a contact the gap is rounding.
                if gap(low)[0] < 0 < gap(high)[0]:
                    touch = sign_change(lambda u: float(gap(u)[0]), low, high)
                    if gap(touch)[1] > 0:
                        self._fly(touch, interval)
                        return True
            t = grid[-1]
        self.captured = not leaves
        return False

    def _fly(self, t, interval):
        """Move freely for a time t (s); the deflection is sampled at a quarter of an interval (s)."""
        self.parts.append(Part(*self._begun(t)))
        before = self.energy
        times = np.linspace(0.0, t, int(np.ceil(4 * t / interval)) + 1)[:, None]
        turned = np.exp(times * self.system.root) * self.z
        deflection = np.sum(self.x[1:] + self.v[1:] * times, axis=1) + self.system.displacements(
            turned
        ).sum(axis=1)
        self.max_deflection = max(self.max_deflection, deflection.max())
        self.x, self.z = self.x + self.v * t, np.exp(self.system.root * t) * self.z
        self.time += t
        if self.damped:
            self.damping_work += before - self.energy

    def _begun(self, duration):
        """Return the initial values of a part of a duration (s)."""
        return self.time, duration, self.x, self.v, self.z, self.damping_work, self.law.plastic_depth


def _snap_depth(law, imprint, rigid, compliance):
    """Return the depth (m) at which the contact snaps, up to the rigid body's depth; infinite if none."""
    depth = rigid.max_depth
    if not compliance or not law.rule.may_fall(depth) or not np.isfinite(depth):
        return np.inf
    before, end = np.full((1, 1), float(imprint)), np.full((1, 1), float(depth) - float(imprint))
    return float(imprint + snap(law.rule, before, end, compliance * law.modulus)[0][0, 0])


def _largest(*columns):
    """Return largest values of polynomials with values at the nodes, and their shares of the step."""
    found = [max((values[0], 0.0), (values[-1], 1.0)) for values in columns]
    slope = np.array(columns) @ _SLOPE_THERE.T
    for k, i in zip(*np.nonzero((slope[:, :-1] > 0) & (slope[:, 1:] <= 0)), strict=True):
        share = sign_change(polynomial(columns[k], -1), *_PLACES[i : i + 2])
        found[k] = max(found[k], (polynomial(columns[k])(share), share))
    return found
