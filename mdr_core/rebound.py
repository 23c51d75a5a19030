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

import numpy as np

from . import collocation as gauss
from .course import DONE, ELASTIC, UNLOADING, YIELDING, Course, ahead, below, opening
from .panels import chunks
from .stages import Loading, Unloading, collocate, gathered
from .turning import pressed

#: What the deceleration of a step may leave unresolved, per velocity.
TOLERANCE = 1e-6
_MOST_STEPS = 3000


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
    # A step that overshoots may leave double precision; it is then made again, shorter.
    with np.errstate(all="ignore"):
        return _solve(bodies, record)


def _solve(bodies, record):
    course = Course(bodies)
    for _ in range(_MOST_STEPS):
        loading = np.flatnonzero(course.phase < UNLOADING)
        unloading = np.flatnonzero(course.phase == UNLOADING)
        if not loading.size + unloading.size:
            return course
        for rows in chunks(loading.size, 256):
            _load(bodies, course, loading[rows], record)
        for rows in chunks(unloading.size, 256):
            _unload(bodies, course, unloading[rows], record)
    raise ValueError(
        f"the motion of an impact did not converge in {_MOST_STEPS} steps; check mass, speed and viscosity"
    )


def _resolved(bodies, course, step, settled):
    """Which steps are good enough; plans the length of the next one for each."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        rest = step.length * gauss.unresolved(step.deceleration[:, 1:], step.kind)
        # What is left at the end must be resolved, small as it may be against the beginning.
        speed = np.abs(step.velocity - step.lost[:, -1])
        speed = np.maximum(speed, np.abs(step.deceleration[:, -1]) * step.length)
        live = np.maximum(np.abs(step.coordinate[:, -1]), speed * step.length)
        error = rest * np.maximum(1 / speed, step.lag / live) / TOLERANCE
        if np.any(bodies.relaxation_time[step.rows] > 0):
            slid = step.radius * (step.velocity[:, None] - step.lost[:, 1:]) ** 2
            gained = course.slid[step.rows] + step.integral(slid, np.ones(step.rows.size))
            drag = step.length * gauss.unresolved(slid, step.kind) / gained / TOLERANCE
            # Next to the tip the radius is a fractional power: the other kinds of step are made for it.
            error = np.where(step.kind == gauss.PLAIN, np.fmax(error, drag), error)
        good = settled & (error <= 1)
        factor = np.where(good, np.clip(0.9 * error ** (-1 / 14), 0.5, 3.0), 0.5)
        # Fractional powers resolve slowly, and so do layers that a step has overrun.
        factor = np.where(~settled | (error > 1e3), 0.25, factor)
    course.step[step.rows] = step.length * factor
    course.kind[step.rows[~good & (step.kind == gauss.CLOSING)]] = gauss.PLAIN
    return good


def _up_to(course, step, missed, edge):
    """Plans steps that end at an edge of the coordinate, for those that failed and had run past it."""
    side = np.sign(step.coordinate[:, 0] - edge)[:, None]
    past = missed & (side * (step.coordinate - edge[:, None]) < 0).any(axis=1)
    if past.any():
        rows, cut = step.rows[past], step.keep(past)
        theta = gauss.crossing(cut.coordinate, edge[past])
        course.step[rows] = cut.length * gauss.share(cut.kind, theta)
        # Where contact is lost the load vanishes as a fractional power of the time that is left.
        course.kind[rows] = np.where(edge[past] == 0, gauss.CLOSING, cut.kind)


def _load(bodies, course, rows, record):
    """One step of loading."""
    stage = Loading(bodies, course, rows)
    step, settled = collocate(stage, course, rows)
    good = _resolved(bodies, course, step, settled)
    edge = ahead(bodies, course, rows)
    smooth = (course.phase[rows] == ELASTIC) & (edge == bodies.critical_depth[rows])
    _up_to(course, step, settled & ~good & ~smooth, edge)
    step, edge, smooth = step.keep(good), edge[good], smooth[good]
    rows, last = step.rows, np.ones(step.rows.size)
    turned = step.velocity <= np.maximum(step.moved(last)[1], step.lost.max(axis=1))
    if turned.any():
        last[turned] = gauss.crossing(step.lost[turned], step.velocity[turned])
    y = course.y[rows] + step.moved(last)[2]
    arrived = ~turned & (edge < np.inf) & (np.abs(y - edge) <= 1e-10 * y)
    beyond = (y > edge) & ~arrived
    if beyond.any():
        last[beyond] = gauss.crossing(step.coordinate[beyond], edge[beyond])
    # Where the step ran on smoothly it is cut at the edge, otherwise done again up to there.
    again = beyond & ~smooth
    course.step[rows[again]] = (step.length * gauss.share(step.kind, last))[again]
    keep = ~again
    _advance(bodies, course, stage, step.keep(keep), last[keep], record)
    arrived, turned = (arrived | beyond) & keep, turned & ~beyond
    course.y[rows[arrived]] = edge[arrived]
    course.kind[rows[keep]] = np.where(arrived, opening(bodies)[rows], gauss.PLAIN)[keep]
    course.phase[rows[arrived & smooth]] = YIELDING
    _turn(bodies, course, rows[turned])


def _turn(bodies, course, rows):
    """From loading to unloading."""
    body = bodies.rows(rows)
    y = course.y[rows]
    live, growth = pressed(y, body.critical_depth, body.remainder, body.before)
    course.lower[rows], course.live[rows], course.growth[rows] = live.lower, live.length, growth
    course.deepest[rows], course.velocity[rows], course.phase[rows] = y, 0.0, UNLOADING


def _unload(bodies, course, rows, record):
    """One step of unloading."""
    stage = Unloading(bodies, course, rows)
    step, settled = collocate(stage, course, rows)
    good = _resolved(bodies, course, step, settled)
    edge = below(course, rows)
    _up_to(course, step, settled & ~good & (step.kind != gauss.CLOSING), edge)
    step, edge = step.keep(good), edge[good]
    rows, last = step.rows, np.ones(step.rows.size)
    free = edge == 0
    _, lost, change = step.moved(last)
    miss = course.live[rows] + change - edge
    # So close to the edge that the rest of the way is straight.
    load = gauss.interpolate(gauss.basis(last), step.deceleration)
    left = miss / (lost - course.velocity[rows] + step.lag * np.maximum(load, 0.0))
    arrived = np.abs(left) <= np.where(free, 1e-9, 1e-10) * step.length
    # A long step may run past the edge and come back.
    beyond = (np.minimum(miss, (step.coordinate - edge[:, None]).min(axis=1)) < 0) & ~arrived
    if beyond.any():
        last[beyond] = gauss.crossing(step.coordinate[beyond], edge[beyond])
    # The load ran on smoothly past the loss of contact if the tip was not yet reached.
    smooth = free & (course.lower[rows] + step.coordinate.min(axis=1) > 0)
    short = (step.kind == gauss.CLOSING) & ~beyond & ~arrived & (left < 0.1 * step.length)
    again = (beyond & ~smooth) | short
    plan = step.length * gauss.share(step.kind, last) + np.where(short, left, 0.0)
    course.step[rows[again]] = plan[again]
    course.kind[rows[again]] = np.where(free, gauss.CLOSING, gauss.PLAIN)[again]
    keep = ~again
    _advance(bodies, course, stage, step.keep(keep), last[keep], record)
    straight = arrived & free
    course.time[rows[straight]] += left[straight]
    arrived |= beyond & keep
    course.live[rows[arrived]] = edge[arrived]
    course.kind[rows[keep]] = np.where(arrived, gauss.OPENING, gauss.PLAIN)[keep]
    course.phase[rows[arrived & free]] = DONE


def _advance(bodies, course, stage, step, last, record):
    """Moves the course to θ = `last` of the steps."""
    if not step.rows.size:
        return
    if record is not None:
        record(course, step, last)
    rows, unloading = step.rows, isinstance(stage, Unloading)
    way, lost, change = step.moved(last)
    tau = bodies.relaxation_time[rows]
    if np.any(tau > 0):
        slid, released = gathered(step, tau, unloading)
        course.slid[rows] += step.integral(slid, last)
        course.released[rows] += step.integral(released, last)
    if not unloading:
        higher = step.deceleration.max(axis=1) > course.peak[rows]
        if higher.any():
            course.peak[rows[higher]] = _peak(bodies, course, step.keep(higher), last[higher])
    course.time[rows] += step.length * gauss.share(step.kind, last)
    course.y[rows] += way
    course.live[rows] += np.where(unloading, change, 0.0)
    course.velocity[rows] -= lost


def _peak(bodies, course, step, last):
    """Largest deceleration so far of impacts that load."""
    theta = gauss.largest(step.deceleration, last)
    weights = gauss.basis(theta)
    way, lost = (gauss.interpolate(weights, part)[:, None] for part in (step.way, step.lost))
    # The load itself, because fractional powers are not interpolated well.
    there = Loading(bodies, course, step.rows).deceleration(way, lost)[0][:, 0]
    known = np.where(last[:, None] >= gauss.POINTS, step.deceleration, 0.0).max(axis=1)
    return np.maximum(course.peak[step.rows], np.maximum(known, there))
