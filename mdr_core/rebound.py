"""The equation of motion of an impact, solved by Gauss collocation, many impacts in step.

The element of Popov (2015), Eqs. (1), (17), (18) is a spring that never carries more than π q_c/2,
and a dashpot beside it. With τ = 4η/E*, the elastic force φ, the plastic depth p, and v = ḋ,

    loading     F = φ(d) − φ(p) + τ φ′(d) v      as long as v > 0
    unloading   F = φ(D) − φ(p),  D = d + τ v    as long as D > p

because an element lets go when its total load reaches zero, which happens at g = D. The unknowns of
a step are the decelerations at its nodes; Newton's method finds them, and the size of their last
Legendre coefficients sets the length of the step. Steps end where the motion is not smooth: where
yield begins, at kinks of the profile, at the turning point, at the loss of contact. On unloading the
live depth ℓ = D − p is carried itself, so that its last digits decide when contact ends.
"""

from dataclasses import dataclass, fields

import numpy as np

from . import collocation as gauss
from . import superpose
from .contact_time import power
from .inverse import increasing_root
from .panels import chunks
from .profiles import Profile
from .turning import plastic_integral, pressed
from .yielding import LiveInterval

#: What the deceleration of a step may leave unresolved, per velocity.
TOLERANCE = 1e-6
_MOST_STEPS = 3000
_ELASTIC, _YIELDING, _UNLOADING, _DONE = range(4)


@dataclass(frozen=True)
class Bodies:
    """Impacts to solve, one a row of each array; `profile` is one indenter, or one for each row.

    Relaxation time τ (s), inertia m/(2E*) (m s²), speed v₀ (m/s), critical depth d_c (m) and its
    remainder, plastic depth p₀ (m) of the imprint that is met.
    """

    profile: Profile
    relaxation_time: np.ndarray
    inertia: np.ndarray
    speed: np.ndarray
    critical_depth: np.ndarray
    remainder: np.ndarray
    before: np.ndarray

    def rows(self, index):
        """Some of the impacts."""
        arrays = (
            self.relaxation_time,
            self.inertia,
            self.speed,
            self.critical_depth,
            self.remainder,
            self.before,
        )
        profile = self.profile.entries(index, self.speed.shape)
        return Bodies(profile, *(part[index] for part in arrays))


class Course:
    """Where each impact is, and what it has gathered on its way: arrays of one entry for each."""

    def __init__(self, bodies):
        count = bodies.speed.size
        self.phase = np.full(count, _ELASTIC)
        #: Time (s), penetration y = d − p₀ and live depth ℓ (m), velocity (m/s).
        self.time, self.y, self.live = np.zeros((3, count))
        self.velocity = bodies.speed.copy()
        #: Plastic depth (m), what of it this impact has added, and the largest penetration.
        self.lower, self.growth, self.deepest = bodies.before.copy(), np.zeros(count), np.zeros(count)
        #: ∫ a v² dt in contact, and τ ∫ a v v̇ dt on unloading (m³/s): viscous work over 2E* τ.
        self.slid, self.released = np.zeros((2, count))
        #: Largest deceleration so far (m/s²).
        self.peak = np.zeros(count)
        #: Length (s) and kind of the next step.
        self.step = 0.5 * _depth_scale(bodies) / bodies.speed
        self.kind = _opening(bodies)
        self.breaks = _breaks(bodies)


def solve(bodies, record=None):
    """The courses of some impacts, from first contact to its loss.

    Parameters
    ----------
    bodies : Bodies
    record : callable, optional
        Called with the course, before it has moved, and the steps that are accepted.

    Raises
    ------
    ValueError
        If a motion does not converge.
    """
    course = Course(bodies)
    for _ in range(_MOST_STEPS):
        loading = np.flatnonzero(course.phase < _UNLOADING)
        unloading = np.flatnonzero(course.phase == _UNLOADING)
        if not loading.size + unloading.size:
            return course
        for rows in chunks(loading.size, 256):
            _load(bodies, course, loading[rows], record)
        for rows in chunks(unloading.size, 256):
            _unload(bodies, course, unloading[rows], record)
    raise ValueError(
        f"the motion of an impact did not converge in {_MOST_STEPS} steps; check mass, speed and viscosity"
    )


def _depth_scale(bodies):
    """Depth (m) at which pressing at the full speed has spent the kinetic energy."""

    def work(y):
        live, growth = pressed(y, bodies.critical_depth, bodies.remainder, bodies.before)
        way = LiveInterval(bodies.before, bodies.before + y, y)
        drag = bodies.relaxation_time * bodies.speed
        stored = superpose.energy_integral(bodies.profile, live)
        spent = plastic_integral(bodies.profile, live, bodies.critical_depth, growth)
        slid = drag * superpose.radius_integral(bodies.profile, way)
        force = superpose.radius_integral(bodies.profile, live) + drag * bodies.profile._radius(way.upper)
        return stored + spent + slid, force

    start = np.where(np.isinf(bodies.critical_depth), 1.0, bodies.critical_depth)
    highest = bodies.profile.deepest - bodies.before
    return np.minimum(increasing_root(work, bodies.inertia * bodies.speed**2 / 2, start, highest), highest)


def _opening(bodies):
    """Kind of the steps in which contact or yield begins, where radii grow as powers of the depth."""
    exponent = power(bodies.profile)
    # Whole powers are smooth in time itself, high ones nearly so.
    smooth = exponent is not None and (np.mod(exponent, 1) == 0) | (np.asarray(exponent) > 3)
    return np.where(smooth, gauss.PLAIN, gauss.OPENING) + np.zeros(bodies.speed.shape, int)


def _breaks(bodies):
    """Depths (m) at which either end of the live interval passes a kink of the profile."""
    kinks = bodies.profile.kinks
    return np.column_stack([np.broadcast_to(k, bodies.speed.shape) for k in kinks]) if kinks else None


def _ahead(bodies, course, rows):
    """Penetration (m) at which loading stops being smooth."""
    d_c = bodies.critical_depth[rows]
    ahead = np.where(course.phase[rows] == _ELASTIC, d_c, np.inf)
    if course.breaks is not None:
        kinks = course.breaks[rows] - bodies.before[rows, None]
        both = np.hstack([kinks, kinks + d_c[:, None]])
        passed = both <= course.y[rows, None] * (1 + 1e-12)
        ahead = np.minimum(ahead, np.where(passed, np.inf, both).min(axis=1))
    return ahead


def _below(course, rows):
    """Live depth (m) at which unloading stops being smooth: 0, where contact is lost, if not before."""
    if course.breaks is None:
        return np.zeros(rows.size)
    kinks = course.breaks[rows] - course.lower[rows, None]
    passed = kinks >= course.live[rows, None] * (1 - 1e-12)
    return np.maximum(np.where(passed, 0.0, kinks).max(axis=1), 0.0)


class _Loading:
    """Loading: the coordinate is the penetration y, and elements yield beyond the critical depth."""

    def __init__(self, bodies, course, rows):
        body = bodies.rows(rows)
        self.profile = body.profile.entries((slice(None), None), rows.shape)
        self.start, self.lag = course.y[rows], np.zeros(rows.size)
        self.tau, self.inertia = body.relaxation_time[:, None], body.inertia[:, None]
        self.met = body.before[:, None], body.remainder[:, None]
        # A step that begins before the critical depth runs on as if nothing ever yielded: smoothly.
        self.elastic = course.phase[rows] == _ELASTIC
        self.d_c = np.where(self.elastic, np.inf, body.critical_depth)[:, None]
        self.velocity, self.step = course.velocity[rows, None], course.step[rows, None]
        self.differentiate = gauss.DIFFERENTIATE[course.kind[rows]]

    def deceleration(self, way, lost):
        """Deceleration (m/s²), live interval and contact radius after a way gone and a velocity lost."""
        before, remainder = self.met
        live, _ = pressed(np.maximum(self.start[:, None] + way, 0.0), self.d_c, remainder, before)
        a = self.profile._radius(live.upper)
        load = superpose.radius_integral(self.profile, live) + self.tau * a * (self.velocity - lost)
        return load / self.inertia, live, a

    def slopes(self, live, a):
        """Derivatives of the deceleration by depth (1/s²) and velocity (1/s) at the nodes."""
        ring = a
        if not self.elastic.all():
            ring = np.where(np.isinf(self.d_c), a, superpose.radius_drop(self.profile, live))
        # a′(d) v is da/dt, and that is at hand without a formula for a′.
        growth = np.einsum("kij,kj->ki", self.differentiate, a) / self.step
        return (ring + self.tau * growth) / self.inertia, self.tau * a / self.inertia


class _Unloading:
    """Unloading: the coordinate is the live depth ℓ = d + τ v − p, and the plastic depth stays."""

    def __init__(self, bodies, course, rows):
        body = bodies.rows(rows)
        self.profile = body.profile.entries((slice(None), None), rows.shape)
        self.start, self.lag = course.live[rows], body.relaxation_time
        self.inertia, self.lower = body.inertia[:, None], course.lower[rows, None]

    def deceleration(self, way, lost):
        """Deceleration (m/s²), live interval and contact radius after a way gone and a velocity lost."""
        length = self.start[:, None] + way - self.lag[:, None] * lost
        edge = self.lower + length
        # Beyond the loss of contact φ goes on below φ(p), so that a step across it is smooth.
        low = np.where(length >= 0, self.lower, np.maximum(edge, 0.0))
        high = np.where(length >= 0, edge, np.where(edge > 0, self.lower, -length))
        live = LiveInterval(low, high, np.abs(length))
        load = np.copysign(superpose.radius_integral(self.profile, live), length)
        return load / self.inertia, live, self.profile._radius(np.abs(edge))

    def slopes(self, live, a):
        """Derivatives of the deceleration by depth (1/s²) and velocity (1/s) at the nodes."""
        return a / self.inertia, self.lag[:, None] * a / self.inertia


@dataclass(frozen=True)
class Step:
    """Steps of some impacts, one a row; values at 0 and at the nodes where there are seventeen.

    Length (s), velocity at the beginning (m/s), deceleration (m/s²), way gone (m), velocity lost
    (m/s), coordinate of the stage (m), and the time by which it runs ahead of the way (s).
    """

    rows: np.ndarray
    kind: np.ndarray
    length: np.ndarray
    velocity: np.ndarray
    deceleration: np.ndarray
    way: np.ndarray
    lost: np.ndarray
    coordinate: np.ndarray
    lag: np.ndarray

    def keep(self, some):
        """The steps of some impacts."""
        return Step(*(getattr(self, field.name)[some] for field in fields(self)))

    def integral(self, values, theta):
        """∫ over time up to θ of values at the nodes."""
        # At the end the quadrature is better than the interpolant.
        result = np.einsum("kj,kj->k", gauss.WHOLE[self.kind], values)
        cut = np.flatnonzero(theta < 1)
        if cut.size:
            sums = np.einsum("kij,kj->ki", gauss.INTEGRATE[self.kind[cut]], values[cut])
            sums = gauss.with_start(np.zeros(cut.size), sums)
            result[cut] = gauss.interpolate(gauss.basis(theta[cut]), sums)
        return self.length * result

    def moved(self, theta):
        """Way, velocity lost, and change of the coordinate up to θ."""
        lost = self.integral(self.deceleration[:, 1:], theta)
        way = self.integral(self.velocity[:, None] - self.lost[:, 1:], theta)
        return way, lost, way - self.lag * lost


def _collocate(stage, course, rows):
    """Steps of their planned length, and whether Newton's method settled."""
    kind, h = course.kind[rows], course.step[rows, None]
    once, twice = h[..., None] * gauss.INTEGRATE[kind], h[..., None] ** 2 * gauss.TWICE[kind]
    run = h * gauss.ELAPSED[kind] * course.velocity[rows, None]
    nothing = np.zeros((rows.size, 1))
    begun = stage.deceleration(nothing, nothing)[0]
    alpha = np.repeat(begun, gauss.NODES.size, axis=1)
    settled = np.zeros(rows.size, bool)
    for _ in range(12):
        way = run - np.einsum("kij,kj->ki", twice, alpha)
        value, *state = stage.deceleration(way, np.einsum("kij,kj->ki", once, alpha))
        by_depth, by_velocity = stage.slopes(*state)
        jacobian = by_depth[..., None] * twice + by_velocity[..., None] * once
        jacobian[:, _DIAGONAL, _DIAGONAL] += 1
        miss = alpha - value
        usable = np.isfinite(jacobian).all(axis=(1, 2)) & np.isfinite(miss).all(axis=1) & ~settled
        change = np.linalg.solve(jacobian[usable], miss[usable, :, None])[..., 0]
        alpha[usable] -= change
        settled[usable] = np.abs(change).max(axis=1) <= 1e-9 * np.abs(alpha[usable]).max(axis=1)
        if settled.all() or not usable.any():
            break
    lost = np.einsum("kij,kj->ki", once, alpha)
    way = run - np.einsum("kij,kj->ki", twice, alpha)
    coordinate = stage.start[:, None] + way - stage.lag[:, None] * lost
    zero, speed = nothing[:, 0], course.velocity[rows]
    columns = ((begun, alpha), (zero, way), (zero, lost), (stage.start, coordinate))
    values = (gauss.with_start(*pair) for pair in columns)
    return Step(rows, kind, h[:, 0], speed, *values, stage.lag), settled


def _resolved(course, step, settled):
    """Which steps are good enough; plans the length of the next one for each."""
    velocity = step.velocity[:, None] - step.lost
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        rest = step.length * gauss.unresolved(step.deceleration[:, 1:], step.kind)
        error = rest / np.abs(velocity).max(axis=1) / TOLERANCE
        good = settled & (error <= 1)
        factor = np.where(good, np.clip(0.9 * error ** (-1 / 14), 0.5, 3.0), 0.5)
        # Fractional powers resolve slowly, and so do layers that a step has overrun.
        factor = np.where(~settled | (error > 1e3), 0.25, factor)
    course.step[step.rows] = step.length * factor
    course.kind[step.rows[~good & (step.kind == gauss.CLOSING)]] = gauss.PLAIN
    return good


def _closed(course, step, settled, good):
    """Plans steps that end where contact is lost, for those that failed because they ran past it."""
    past = settled & ~good & (step.kind != gauss.CLOSING) & (step.coordinate.min(axis=1) < 0)
    if not past.any():
        return
    rows, cut = step.rows[past], step.keep(past)
    theta = gauss.crossing(cut.coordinate, np.zeros(rows.size))
    course.step[rows] = cut.length * gauss.share(cut.kind, theta)
    course.kind[rows] = gauss.CLOSING


def _load(bodies, course, rows, record):
    """One step of loading."""
    stage = _Loading(bodies, course, rows)
    step, settled = _collocate(stage, course, rows)
    step = step.keep(_resolved(course, step, settled))
    if not step.rows.size:
        return
    rows, ahead = step.rows, _ahead(bodies, course, step.rows)
    last = np.ones(rows.size)
    turned = step.velocity <= np.maximum(step.moved(last)[1], step.lost.max(axis=1))
    if turned.any():
        last[turned] = gauss.crossing(step.lost[turned], step.velocity[turned])
    y = course.y[rows] + step.moved(last)[2]
    arrived = ~turned & (ahead < np.inf) & (np.abs(y - ahead) <= 1e-10 * y)
    beyond = (y > ahead) & ~arrived
    if beyond.any():
        last[beyond] = gauss.crossing(step.coordinate[beyond], ahead[beyond])
    # Where the step ran on smoothly it is cut at the break, otherwise done again up to there.
    yields = (course.phase[rows] == _ELASTIC) & (ahead == bodies.critical_depth[rows])
    again = beyond & ~yields
    course.step[rows[again]] = (step.length * gauss.share(step.kind, last))[again]
    arrived, turned = (arrived | beyond)[~again], (turned & ~beyond)[~again]
    yields, ahead, last = yields[~again], ahead[~again], last[~again]
    step = step.keep(~again)
    _advance(bodies, course, stage, step, last, record)
    rows = step.rows
    course.y[rows[arrived]] = ahead[arrived]
    course.kind[rows] = np.where(arrived, _opening(bodies)[rows], gauss.PLAIN)
    course.phase[rows[arrived & yields]] = _YIELDING
    _turn(bodies, course, rows[turned])


def _turn(bodies, course, rows):
    """From loading to unloading."""
    body = bodies.rows(rows)
    y = course.y[rows]
    live, growth = pressed(y, body.critical_depth, body.remainder, body.before)
    course.lower[rows], course.live[rows], course.growth[rows] = live.lower, live.length, growth
    course.deepest[rows], course.velocity[rows], course.phase[rows] = y, 0.0, _UNLOADING


def _unload(bodies, course, rows, record):
    """One step of unloading."""
    stage = _Unloading(bodies, course, rows)
    step, settled = _collocate(stage, course, rows)
    good = _resolved(course, step, settled)
    if course.breaks is None:
        _closed(course, step, settled, good)
    step = step.keep(good)
    if not step.rows.size:
        return
    rows, below = step.rows, _below(course, step.rows)
    last = np.ones(rows.size)
    _, lost, change = step.moved(last)
    length = course.live[rows] + change
    # Close to the loss of contact there is no load, and the rest of the way is straight.
    near = np.where(below == 0, 1e-6, 1e-10) * course.live[rows]
    arrived = np.abs(length - below) <= near
    # A long step may come back.
    beyond = (np.minimum(length, step.coordinate.min(axis=1)) < below) & ~arrived
    if beyond.any():
        last[beyond] = gauss.crossing(step.coordinate[beyond], below[beyond])
    # The load ran on smoothly past the loss of contact if the tip was not yet reached.
    smooth = (below == 0) & (course.lower[rows] + step.coordinate.min(axis=1) > 0)
    # A step that was to end there is corrected by Newton's method, the load being nearly zero.
    short = ~beyond & ~arrived & (step.kind == gauss.CLOSING)
    ratio = gauss.share(step.kind, last)
    left = (length - below) / (lost - course.velocity[rows])
    ratio[short] += (left / step.length)[short]
    again = (beyond & ~smooth) | (short & (ratio < 1.1))
    course.step[rows[again]] = step.length[again] * ratio[again]
    # The load vanishes as a fractional power of the time that is left.
    course.kind[rows[again]] = np.where(below[again] == 0, gauss.CLOSING, gauss.PLAIN)
    left = np.where(arrived & ~beyond & (below == 0), left, 0.0)
    arrived |= beyond
    step, arrived, below, last, left = (
        step.keep(~again),
        *(part[~again] for part in (arrived, below, last, left)),
    )
    _advance(bodies, course, stage, step, last, record)
    rows = step.rows
    course.time[rows] += left
    course.live[rows[arrived]] = below[arrived]
    course.kind[rows] = np.where(arrived, gauss.OPENING, gauss.PLAIN)
    course.phase[rows[arrived & (below == 0)]] = _DONE


def _advance(bodies, course, stage, step, last, record):
    """Moves the course to θ = `last` of the steps."""
    if not step.rows.size:
        return
    if record is not None:
        record(course, step, last)
    rows, unloading = step.rows, isinstance(stage, _Unloading)
    way, lost, change = step.moved(last)
    tau = bodies.relaxation_time[rows]
    if np.any(tau > 0):
        slid, released = gathered(bodies, step, unloading, course)
        course.slid[rows] += step.integral(slid, last)
        course.released[rows] += step.integral(released, last)
    if not unloading:
        higher = step.deceleration.max(axis=1) > course.peak[rows]
        if higher.any():
            peak = gauss.largest(step.deceleration[higher], last[higher])
            course.peak[rows[higher]] = np.maximum(course.peak[rows[higher]], peak)
    course.time[rows] += step.length * gauss.share(step.kind, last)
    course.y[rows] += way
    course.live[rows] += np.where(unloading, change, 0.0)
    course.velocity[rows] -= lost


def unloading(course):
    """Which impacts are past their turning point."""
    return course.phase >= _UNLOADING


def gathered(bodies, step, unloading, course):
    """a v² and, on unloading, τ a v v̇ at the nodes of steps."""
    profile = bodies.profile.entries((step.rows, None), bodies.speed.shape)
    edge = course.lower[step.rows, None] if unloading else bodies.before[step.rows, None]
    a = profile._radius(np.abs(edge + step.coordinate[:, 1:]))
    velocity = step.velocity[:, None] - step.lost[:, 1:]
    released = -bodies.relaxation_time[step.rows, None] * a * velocity * step.deceleration[:, 1:]
    return a * velocity**2, released if unloading else np.zeros_like(released)


_DIAGONAL = np.arange(gauss.NODES.size)
