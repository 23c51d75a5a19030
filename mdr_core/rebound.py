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
from .course import DONE, ELASTIC, NEAR, UNLOADING, YIELDING, Course, ahead, below
from .panels import chunks
from .stages import Loading, Unloading, collocate, gathered
from .turning import pressed

#: What the deceleration of a step may leave unresolved, per velocity.
TOLERANCE = 1e-6
_MOST_STEPS = 3000
#: Shares of an interval at which the largest load is looked for.
_GRID = np.linspace(0.0, 1.0, 17)


def solve(bodies, record=None):
    """The courses of some impacts, from first contact to its loss.

    Parameters
    ----------
    bodies : Bodies
    record : callable, optional
        Called with the course, before it has moved, and the parts of steps that are accepted.

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
    rest = step.length * gauss.unresolved(step.deceleration, step.kind)
    # What is left at the end must be resolved, small as it may be against the beginning.
    speed = np.abs(step.velocity - step.lost[:, -1])
    speed = np.maximum(speed, np.abs(step.deceleration[:, -1]) * step.length)
    live = np.maximum(np.abs(step.coordinate[:, -1]), speed * step.length)
    error = rest * np.maximum(1 / speed, step.lag / live) / TOLERANCE
    plain = step.kind == gauss.PLAIN
    # Next to the tip the radius is a fractional power: the other kinds of step are made for it.
    if plain.any() and course.viscous:
        slid = step.radius * (step.velocity[:, None] - step.lost) ** 2
        gained = course.slid[step.rows] + step.length * gauss.dot(gauss.WHOLE[step.kind], slid)
        drag = step.length * gauss.unresolved(slid, step.kind) / gained / TOLERANCE
        error = np.where(plain, np.fmax(error, drag), error)
    good = settled & (error <= 1)
    factor = np.where(good, np.minimum(np.maximum(0.9 * error ** (-1 / 14), 0.5), 3.0), 0.5)
    # Fractional powers resolve slowly, and so do layers that a step has overrun.
    factor = np.where(~settled | (error > 1e3), 0.25, factor)
    course.step[step.rows] = step.length * factor
    if not plain.all():
        course.kind[step.rows[~good & (step.kind == gauss.CLOSING)]] = gauss.PLAIN
    return good


def _up_to(course, step, missed, edge):
    """Plans steps that end at an edge of the coordinate, for those that failed and had run past it."""
    if not missed.any():
        return
    side = np.sign(step.coordinate[:, 0] - edge)[:, None]
    past = missed & (side * (step.coordinate - edge[:, None]) < 0).any(axis=1)
    if past.any():
        rows, cut = step.rows[past], step.keep(past)
        theta = gauss.crossing(cut.coordinate, edge[past])
        course.uncut[rows] = np.maximum(course.uncut[rows], cut.length / 4)
        course.step[rows] = cut.length * gauss.share(cut.kind, theta)
        # Where contact is lost the load vanishes as a fractional power of the time that is left.
        course.kind[rows] = np.where(edge[past] == 0, gauss.CLOSING, cut.kind)


def _redo(course, step, again, length, kind):
    """Plans steps to be made again up to an edge, of these lengths and kinds."""
    rows = step.rows[again]
    course.uncut[rows] = np.maximum(course.uncut[rows], step.length[again] / 4)
    course.step[rows], course.kind[rows] = length[again], kind[again]
    _learn(course, step, again)


def _learn(course, step, again):
    """Steps that are made again begin with what was found."""
    if again.any():
        rows, step = step.rows[again], step.keep(again)
        elapsed = gauss.ELAPSED[course.kind[rows]] * (course.step[rows] / step.length)[:, None]
        course.guess[rows] = step.at(gauss.theta_at(step.kind[:, None], elapsed), step.deceleration)


def _load(bodies, course, rows, record):
    """One step of loading."""
    stage = Loading(bodies, course, rows)
    step, settled = collocate(stage, course, rows)
    good = _resolved(bodies, course, step, settled)
    edge = ahead(bodies, course, rows)
    smooth = (course.phase[rows] == ELASTIC) & (edge == bodies.critical_depth[rows])
    _up_to(course, step, settled & ~good & ~smooth, edge)
    _learn(course, step, settled & ~good)
    if not good.any():
        return
    step, edge, smooth = step.keep(good), edge[good], smooth[good]
    last = np.ones(step.rows.size)
    part = step.until(last)
    turned = step.velocity <= np.maximum(part.lost, np.maximum.reduce(step.lost, axis=1))
    if turned.any():
        last[turned] = gauss.crossing(step.lost[turned], step.velocity[turned])
        # Where yield began as the body stopped, rounding may have left it none of its speed.
        last[step.velocity <= 0] = 0.0
        part = step.until(last)
    y = course.y[step.rows] + part.way
    arrived = ~turned & (edge < np.inf) & (np.abs(y - edge) <= np.where(smooth, 1e-10, NEAR) * y)
    beyond = (y > edge) & ~arrived
    if beyond.any():
        # Only up to the turning point: the way back crosses the edge again.
        last[beyond] = gauss.crossing(step.coordinate[beyond], edge[beyond], last[beyond])
        # Where the step ran on smoothly it is cut at the edge, otherwise done again up to there.
        keep = smooth | ~beyond
        _redo(course, step, ~keep, step.length * gauss.share(step.kind, last), step.kind)
        step, last, edge, smooth = step.keep(keep), last[keep], edge[keep], smooth[keep]
        arrived, turned = (arrived | beyond)[keep], (turned & ~beyond)[keep]
        part = step.until(last)
    _advance(bodies, course, stage, part, record)
    rows = step.rows
    course.kind[rows] = np.where(arrived, course.opening[rows], gauss.PLAIN)
    if arrived.any():
        yielding = arrived & smooth
        course.y[rows[yielding]], course.phase[rows[yielding]] = edge[yielding], YIELDING
        _resume(course, rows[arrived])
    if turned.any():
        _turn(bodies, course, rows[turned])
    if not turned.all():
        _stop(bodies, course, step.keep(~turned))


def _stop(bodies, course, step):
    """Keeps the next step of loading from running far past the turning point."""
    rows = step.rows
    speed, load = course.velocity[rows], course.load[rows]
    drag = bodies.relaxation_time[rows] * step.radius[:, -1] / bodies.inertia[rows]
    # A body that a constant force and a dashpot bring to rest.
    time = np.where(
        drag * speed > 1e-3 * load, np.log1p(drag * speed / (load - drag * speed)) / drag, speed / load
    )
    course.step[rows] = np.fmin(course.step[rows], np.where(time > 0, 1.5 * time, np.inf))


def _resume(course, rows):
    """Steps go on behind an edge about as long as before it."""
    course.step[rows] = np.maximum(course.step[rows], course.uncut[rows])
    course.uncut[rows] = 0.0


def _turn(bodies, course, rows):
    """From loading to unloading."""
    body = bodies.rows(rows)
    y = course.y[rows]
    live, growth = pressed(y, body.critical_depth, body.remainder, body.before)
    course.lower[rows], course.live[rows], course.growth[rows] = live.lower, live.length, growth
    course.deepest[rows], course.velocity[rows], course.phase[rows] = y, 0.0, UNLOADING
    # About as long as a spring takes to let go.
    course.step[rows] = np.minimum(course.step[rows], 2.0 * np.sqrt(live.length / course.load[rows]))


def _unload(bodies, course, rows, record):
    """One step of unloading."""
    stage = Unloading(bodies, course, rows)
    step, settled = collocate(stage, course, rows)
    good = _resolved(bodies, course, step, settled)
    edge = below(course, rows)
    _up_to(course, step, settled & ~good & (step.kind != gauss.CLOSING), edge)
    _learn(course, step, settled & ~good)
    if not good.any():
        return
    step, edge = step.keep(good), edge[good]
    last, free, closing = np.ones(step.rows.size), edge == 0, step.kind == gauss.CLOSING
    part = step.until(last)
    miss = course.live[step.rows] + part.change - edge
    # So close to the edge that the rest of the way is straight.
    load = gauss.dot(gauss.basis(last), step.deceleration)
    left = miss / (part.lost - step.velocity + step.lag * np.maximum(load, 0.0))
    arrived = np.where(free, np.abs(left) <= 1e-9 * step.length, np.abs(miss) <= NEAR * edge)
    # A long step may run past the edge and come back.
    least = np.minimum.reduce(step.coordinate, axis=1)
    beyond = (np.minimum(miss, least - edge) < 0) & ~arrived
    short = closing & ~beyond & ~arrived & (left < 0.1 * step.length)
    if (beyond | short).any():
        theta = gauss.crossing(step.coordinate[beyond], edge[beyond])
        # Of an edge far below the live depth rounding may hide where it is: it shows from closer by.
        last[beyond] = np.where((theta < 1 - 1e-12) | free[beyond], theta, 0.99)
        # The load ran on smoothly past the loss of contact if the tip was not yet reached.
        keep = ~short & ~(beyond & ~(free & (course.lower[step.rows] + least > 0)))
        plan = step.length * gauss.share(step.kind, last) + np.where(short, left, 0.0)
        _redo(course, step, ~keep, plan, np.where(free, gauss.CLOSING, gauss.PLAIN))
        step, last, free, left = step.keep(keep), last[keep], free[keep], left[keep]
        arrived, beyond = arrived[keep], beyond[keep]
        part = step.until(last)
    _advance(bodies, course, stage, part, record)
    rows, straight = step.rows, arrived & free
    course.time[rows[straight]] += left[straight]
    arrived |= beyond
    course.kind[rows] = np.where(arrived, gauss.OPENING, gauss.PLAIN)
    if arrived.any():
        done = rows[arrived & free]
        course.live[done], course.phase[done] = 0.0, DONE
        _resume(course, rows[arrived])


def _advance(bodies, course, stage, part, record):
    """Moves the course on by parts of steps."""
    step = part.step
    if not step.rows.size:
        return
    if record is not None:
        record(course, part)
    rows, unloading = step.rows, isinstance(stage, Unloading)
    if course.viscous:
        slid, released = gathered(step, bodies.relaxation_time[rows], unloading)
        course.slid[rows] += gauss.dot(part.weights, slid)
        if unloading:
            course.released[rows] += gauss.dot(part.weights, released)
    _peak(bodies, course, stage, part)
    course.time[rows] += part.duration
    course.y[rows] += part.way
    course.velocity[rows] -= part.lost
    if unloading:
        course.live[rows] += part.change


def _peak(bodies, course, stage, part):
    """Notes the deceleration at the end of parts of steps, and the largest so far."""
    step, last = part.step, part.theta
    known = np.where(last[:, None] >= gauss.POINTS, step.deceleration, 0.0)
    course.peak[step.rows] = np.maximum(course.peak[step.rows], np.maximum.reduce(known, axis=1))
    course.load[step.rows] = load = gauss.dot(gauss.basis(last), step.deceleration)
    course.guess[step.rows] = load[:, None]
    if isinstance(stage, Unloading):
        return
    # Where the load still grows at the end of a step, its largest value is the beginning of the next.
    inside = (known.argmax(axis=1) > 0) & (gauss.slope(step.deceleration, last) < 0)
    if not inside.any():
        return
    step, rows = step.keep(inside), step.rows[inside]
    low, high = gauss.around(known[inside].argmax(axis=1), last[inside])
    # The load itself, because fractional powers are not interpolated well.
    stage = Loading(bodies, course, rows)
    for _ in range(2):
        theta = low[:, None] + (high - low)[:, None] * _GRID
        load = stage.deceleration(step.at(theta, step.way), step.at(theta, step.lost))[0]
        best = np.minimum(np.maximum(load.argmax(axis=1), 1), _GRID.size - 2)
        each = np.arange(rows.size)
        low, high = theta[each, best - 1], theta[each, best + 1]
    before, there, after = (load[each, best + side] for side in (-1, 0, 1))
    # The top of the parabola through the last three, if it lies between them.
    bend = 2 * there - before - after
    rise = (after - before) ** 2 / (8 * np.where(bend > 0, bend, np.inf))
    top = np.where(np.abs(after - before) < 2 * bend, there + rise, np.maximum(before, after))
    course.peak[rows] = np.maximum(course.peak[rows], top)
