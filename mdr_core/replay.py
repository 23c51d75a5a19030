"""The motion of one impact at equal steps of time: its equation of motion solved anew, and read off."""

import numpy as np

from . import _check, superpose
from . import collocation as gauss
from .course import UNLOADING
from .motion import Motion
from .rebound import solve
from .stages import gathered
from .turning import plastic_integral, pressed
from .viscous import bodies_of
from .yielding import LiveInterval


def motion(hit, n):
    """The `Motion` of one `Impact` at n instants."""
    if np.ndim(hit.mass):
        raise ValueError(
            f"motion is that of one impact, but these are {hit.mass.size}; pick one, as in "
            "result[0].motion()"
        )
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 2 <= n <= 10**7:
        raise ValueError(f"number of instants n = {_check.shown(n)} must be a whole number from 2 to 10⁷")
    before = np.asarray(hit.plastic_depth - hit.growth)
    bodies = bodies_of(hit.profile, hit.medium, hit.mass, hit.speed, before)
    steps = []
    course = solve(bodies, lambda course, part: steps.append(_Stretch(bodies, course, part)))
    time = np.linspace(0.0, course.time[0], n)
    begins = np.array([stretch.time for stretch in steps])
    owner = np.searchsorted(begins, time, side="right") - 1
    parts, let_go = [], 0.0
    for i, stretch in enumerate(steps):
        columns, let_go = stretch.at(time[owner == i], let_go)
        parts.append(columns)
    return _ledger(hit, bodies, time, course, *np.hstack(parts))


class _Stretch:
    """One accepted step of one impact, and where it began."""

    def __init__(self, bodies, course, part):
        self.bodies, self.step, self.last = bodies, part.step, part.theta
        self.time, self.y = course.time[0], course.y[0]
        self.slid, self.released, self.lower = course.slid[0], course.released[0], course.lower[0]
        self.unloading = course.phase[0] == UNLOADING
        rates = gathered(self.step, bodies.relaxation_time, self.unloading)
        matrix = self.step.length * gauss.INTEGRATE[self.step.kind[0]]
        self.sums = [matrix @ rate[0] for rate in rates]

    def at(self, time, let_go):
        """y, v, ℓ, slid, released, energy of elements that have let go, unloading; at instants of it.

        Takes and gives the energy of elements that have let go at its beginning and end, over 2E*.
        """
        step, kind = self.step, self.step.kind[0]
        theta = gauss.theta_at(kind, (time - self.time) / step.length[0])
        theta = np.append(np.minimum(theta, self.last[0]), self.last[0])
        weights = gauss.basis(theta)
        left = self._relaxing(let_go)
        rows = [
            self.y + weights @ step.way[0],
            step.velocity[0] - weights @ step.lost[0],
            np.maximum(weights @ step.coordinate[0], 0.0),
            self.slid + weights @ self.sums[0],
            self.released + weights @ self.sums[1],
            weights @ left,
            np.full(theta.size, float(self.unloading)),
        ]
        return np.array(rows)[:, :-1], rows[5][-1]

    def _relaxing(self, let_go):
        """Energy over 2E* (m³) of the springs that have let go, at 0 and the nodes.

        They take over energy at the edge of contact, and relax as exp(−2t/τ).
        """
        tau = self.bodies.relaxation_time[0]
        if not self.unloading or tau == 0:
            return np.zeros(gauss.COUNT)
        step = self.step
        a = self.bodies.profile._radius(np.abs(self.lower + step.coordinate[0]))
        velocity = step.velocity[0] - step.lost[0]
        # What has been taken over since the beginning, by parts: no derivative of the radius.
        taken = tau * self.sums[1] - (tau * velocity) ** 2 * a / 2
        taken -= taken[0]
        matrix = gauss.IDENTITY + 2 * step.length[0] / tau * gauss.INTEGRATE[step.kind[0]]
        return np.linalg.solve(matrix, let_go + taken)


def _ledger(hit, bodies, time, course, y, velocity, length, slid, released, let_go, unloading):
    """The `Motion`, from the course at its instants."""
    profile, modulus, tau = hit.profile, 2 * hit.medium.E_star, bodies.relaxation_time[0]
    rising = unloading == 0
    yielding = bodies.critical_depth, bodies.remainder, bodies.before
    first, growth = pressed(np.maximum(y, 0.0), *yielding)
    growth = np.where(rising, growth, course.growth[0])
    lower = np.where(rising, first.lower, course.lower[0])
    length = np.where(rising, first.length, length)
    length[-1] = 0.0
    live = LiveInterval(lower, lower + length, length)
    a = profile._radius(live.upper)
    area = superpose.radius_integral(profile, live)
    # On unloading the elements in contact are compressed by d − s, and d = d_p + ℓ − τ v.
    ahead = np.where(rising, 0.0, -tau * velocity)
    stored = superpose.energy_integral(profile, live) + ahead * (area + ahead * a / 2)
    taken = tau * released - ahead**2 * a / 2
    viscous = tau * slid + np.where(rising, 0.0, taken - let_go)
    in_contact = (length > 0) | (bodies.before[0] + y > lower)
    return Motion(
        time=time,
        depth=bodies.before[0] + y,
        velocity=velocity,
        force=modulus * (area + np.where(rising, tau * a * velocity, 0.0)),
        contact_radius=np.where(in_contact, a, 0.0),
        plastic_radius=np.where(lower > 0, profile._radius(lower), 0.0),
        plastic_depth=lower,
        live_depth=length,
        kinetic_energy=hit.mass * velocity**2 / 2,
        stored_energy=modulus * (stored + let_go),
        plastic_work=modulus * plastic_integral(profile, live, bodies.critical_depth, growth),
        viscous_work=modulus * viscous,
    )
