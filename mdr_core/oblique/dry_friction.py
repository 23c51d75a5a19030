"""Friction along the surface without viscosity, for many impacts at a time.

Tangential displacements are in units of μ/κ: an element at a depth g of the reduced profile, which sticks
at the origin O of the displacement U of the contact point, has the load Q = U − O, with |Q| ≤ B =
ℓ − (g − p)₊ for the live depth ℓ and the plastic depth p. Slip moves its origin so far that Q = ±B. The
body follows Ü = −C ∫Q dx, C = 2κE*/m_t.

1. Elements stand in pairs at Gauss's points of cells, whose edges are the contact radii at levels of depth:
   a front between stick and slip that moves through cells leaves no error in the mean.
2. Steps lie between the instants at which loading and unloading pass the levels, and cover or release one
   cell each. They are Nyström's of fourth order, for a force that depends on the displacement.
3. Where the elements slip that are covered or released, the impulse of ±B is that of the normal force,
   which is known exactly, and what the others lack of it is integrated.
4. While the outermost cell sticks, a narrow ring slips ahead of the edge that is released. It moves with
   the levels: its error in a cell has no mean of zero, and is corrected.
5. The next run has half the steps, and levels at the instants at which slip ended in the last one.
"""

import numpy as np

from ..numerics.blocks import chunks

#: Gauss's points of a cell.
_POINTS = np.array([[0.5 - np.sqrt(1 / 12)], [0.5 + np.sqrt(1 / 12)]])
#: Impacts that are solved at a time, and halvings of their steps at most.
_BLOCK, _HALVINGS = 32768, 7
#: Levels of a run, and instants at which slip ends, at most.
_MOST, _INSTANTS = 2048, 8


class DryRun:
    """One run of impacts: C = `inertia` (1/(m s²)), and the velocity κW₀/μ (m/s) at first contact.

    Records, with a row for each time (s), are velocities (m/s) and forces over 2μE* (m²); `element_states`
    are loads of elements (m), and whether they stick, by the numbers of the `recorded` times.
    """

    def __init__(self, motions, inertia, velocity, counts, instants):
        self.loading, self.unloading = motions.branches(counts, instants)
        self.inertia, self.rate = inertia, motions.rate
        self.edge = np.maximum.accumulate(motions.radii(self.loading.depth), axis=0)
        width = np.diff(self.edge, axis=0)
        x = (self.edge[:-1, None] + width[:, None] * _POINTS).reshape(-1, velocity.size)
        depth = motions.at_levels(motions.profile._reduced, x)
        self.loading_ends, _ = self._ends(motions, self.loading)
        self.unloading_ends = self._ends(motions, self.unloading)
        # The first element is the flat face, if there is one. There are no elements behind a wall.
        self.width = np.vstack([self.edge[:1], np.repeat(width / 2, 2, axis=0)])
        self.reach = np.vstack([0 * velocity[None], np.cumsum(self.width, axis=0)])
        self.depth = np.where(self.width > 0, np.vstack([0 * velocity[None], depth]), 0.0)
        self.origin, self.zero, self.low, self.high = np.zeros((4, *self.width.shape))
        self.displacement, self.force, self.slip = np.zeros((3, velocity.size))
        self.velocity = velocity
        steps = np.vstack([self.loading.step, self.unloading.step])
        self.time = np.vstack([0 * velocity[None], np.cumsum(steps, axis=0)])

    def _ends(self, motions, branch):
        """By how much, relatively, a cell's load at the middle of a step differs from that by Gauss's rule.

        Two arrays: where the load falls to zero at the edge of the contact, which is in the cell then, as
        it does where elements slip; and where it ends there, as that of elements which are released.
        """
        edge = self.edge if branch is self.loading else self.edge[::-1][: len(branch.depth)]
        inner, width = np.minimum(edge[1:], edge[:-1]), np.abs(np.diff(edge, axis=0))
        with np.errstate(divide="ignore", invalid="ignore"):
            # Beside a flat face cells may be as narrow as the rounding of radii, or have no width.
            y = np.clip((motions.radii(branch.middle) - inner) / width, 0.0, 1.0)
            within = np.maximum(y - _POINTS[:, None], 0.0)
            falls, ends = y**2 / within.sum(axis=0) - 1, 2 * y / (within > 0).sum(axis=0) - 1
        return np.where(within[0] > 0, [falls, ends], 0.0)

    def solve(self, recorded=()):
        """The run itself, which returns itself."""
        steps = [(self.loading, i, 2 * i + 3) for i in range(len(self.loading.step))]
        steps += [(self.unloading, i, len(self.width) - 2 * i) for i in range(len(self.unloading.step))]
        self.velocities, self.forces = np.empty((2, *self.time.shape))
        self.velocities[0], self.forces[0] = self.velocity, self.force
        self.element_states = {0: (self.origin[:0], self.origin[:0] > 0)}
        for number, (branch, i, count) in enumerate(steps, 1):
            if np.any(branch.step[i] > 0):
                self._step(branch, i, count)
            self.velocities[number], self.forces[number] = self.velocity, self.force
            if number in recorded:
                self.element_states[number] = self._element_state(count, branch.depth[i + 1])
        return self

    def _step(self, branch, i, count):
        """A step from level i of a branch with `count` elements; the last two are covered or released."""
        h, middle, last = branch.step[i], branch.middle[i], slice(count - 2, count)
        (d, end), (_, end_p), (v, end_v), (a, end_a) = (levels[i : i + 2] for levels in branch[:4])
        u, w = self.displacement, self.velocity
        # ±1 where the elements that are covered or released slip; slip goes on while their bounds fall.
        goes_on = self.slip if branch is self.unloading else 0.0
        slip = np.where(np.abs(w) >= np.maximum(np.abs(v), np.abs(end_v)), np.sign(w), goes_on)
        gain = slip * self.inertia / self.rate
        # A step too long for the oscillation of all elements in stick makes a slower one of it.
        inertia = np.minimum(self.inertia, 2 / np.maximum(self.edge[-1] * h * h, 1e-300))
        lack = -inertia * (slip * a / self.rate + self.force)
        start = gain * a + lack
        if branch is self.loading:
            covered = _time_to(self.depth[last] - d, v, a, h)
            self.origin[last] = u + covered * (w + covered / 2 * start)
        middle_u = u + h / 2 * w + h * h / 8 * lack + gain * (middle - d - h / 2 * v)
        origin = self._origins(count, middle_u, middle, branch.middle_plastic_depth[i], self.low)
        missing = self._missing(slice(0, count), middle_u, middle, slip, origin)
        if branch is self.loading:
            end_share = self.loading_ends[i]
        else:
            sticks = np.abs(middle_u - self.origin[count - 2]) < middle - self.zero[count - 2]
            end_share = np.where(sticks & (slip == 0), *self.unloading_ends[::-1, i])
        missing += end_share * self._missing(last, middle_u, middle, slip, origin[last])
        if branch is self.unloading:
            excess = self._slip_at_edge(count - 2, middle_u, d - end, 1.0)
            missing += np.where(sticks & (slip == 0), excess, 0.0)
        end_u = u + h * w + gain * (end - d - h * v) + h * h / 6 * (lack + 2 * inertia * missing)
        if branch is self.loading:
            # The path is a cubic in time, of which the parabola above has not the end.
            late = (covered / np.maximum(h, 1e-300)) ** 3
            self.origin[last] += late * (end_u - u - h * (w + h / 2 * start))
        origin = self._origins(count, end_u, end, end_p, self.origin)
        end_missing = self._missing(slice(0, count), end_u, end, slip, origin)
        if branch is self.unloading and i + 2 < len(branch.depth) and count > 4:
            rise = end - branch.depth[i + 2]
            end_missing += self._slip_at_edge(count - 4, end_u, rise, _POINTS[0, 0])
        self.velocity = w + gain * (end_v - v) + h / 6 * (lack + inertia * (4 * missing + end_missing))
        self.force = -slip * end_a / self.rate - end_missing
        self.displacement, self.slip = end_u, slip

    def _origins(self, count, u, depth, plastic_depth, out):
        """Origins of elements (m) after slip, in the array `out`."""
        # The depth at which the bound of an element is zero.
        zero = np.maximum(self.depth[:count], plastic_depth, out=self.zero[:count])
        np.minimum(zero[-2:], depth, out=zero[-2:])
        low = np.add(zero, u - depth, out=self.low[:count])
        high = np.subtract(u + depth, zero, out=self.high[:count])
        np.maximum(self.origin[:count], low, out=low)
        return np.minimum(low, high, out=out[:count])

    def _missing(self, elements, u, depth, slip, origin):
        """∫(±B − Q) dx over elements (m²): 0 if they all slip as those that are covered or released."""
        width, total = self.width[elements], self.reach[elements.stop] - self.reach[elements.start]
        loads = total * (slip * depth - u) + np.einsum("ij,ij->j", width, origin)
        return loads - slip * np.einsum("ij,ij->j", width, self.zero[elements])

    def _slip_at_edge(self, inner, u, rise, seen_from):
        """By how much Gauss's rule overestimates the load (m²) of the cell at the edge of the contact.

        Its elements stick, all with the load of the `inner` one; but the bound falls to zero at the edge,
        by `rise` (m) over the cell, and an outer share of the cell slips. Gauss's points see what of the
        share is beyond `seen_from`.
        """
        load = u - self.origin[inner]
        share = np.minimum(np.abs(load) / np.maximum(rise, 1e-300), 1.0)
        excess = share**2 / 2 - np.maximum(share - seen_from, 0.0) / 2
        # Where the inner element slips, too, nothing is known of what its load would be.
        excess = np.where(share < _POINTS[1, 0], excess, 0.0)
        return np.copysign(excess, load) * rise * 2 * self.width[inner]

    def _element_state(self, count, depth):
        """Loads of elements (m), and whether they stick."""
        load, bound = self.displacement - self.origin[:count], depth - self.zero[:count]
        return load, np.abs(load) < bound * (1 - 1e-9)

    def largest_force(self):
        """Largest force over 2μE* (m²), from a parabola through three instants, or lines to a kink."""
        values, tiny = np.abs(self.forces), 1e-9 * self.time[-1]
        i, columns = np.argmax(values, axis=0), np.arange(values.shape[1])
        # Levels may coincide, and a step of rounding has no slope.
        near = [i]
        for _ in range(2):
            first, last = self.time[near[0], columns], self.time[near[-1], columns]
            before, after = (
                np.sum(self.time < first - tiny, axis=0),
                np.sum(self.time <= last + tiny, axis=0),
            )
            near = [np.maximum(before - 1, 0), *near, np.minimum(after, len(values) - 1)]
        near = np.stack(near)
        t, f = self.time[near, columns], values[near, columns]
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = np.diff(f, axis=0) / np.diff(t, axis=0)
            bend = np.diff(slope, axis=0) / (t[2:] - t[:-2])
            early, late = np.diff(t, axis=0)[1:3]
            top = (slope[1] * late + slope[2] * early) / (early + late)
            rise = -(top**2) / (4 * bend[1])
            # Where slip begins in one step, the force before and after it goes straight there.
            before = -slope[2] * early * (slope[0] - slope[1]) / (slope[0] - slope[2])
            after = slope[1] * late * (slope[2] - slope[3]) / (slope[1] - slope[3])
        smooth = np.abs(bend[1]) <= 3 * np.minimum(np.abs(bend[0]), np.abs(bend[2]))
        rise = np.where(smooth, rise, np.where(bend[2] < bend[0], after, before))
        sound = (bend[1] < 0) & (rise > 0) & (rise < np.inf) & np.all(np.diff(t, axis=0) > 0, axis=0)
        return f[2] + np.where(sound, rise, 0.0)

    def uncertain(self, velocity):
        """Least errors of velocity (relative to one) and force where steps are too long for stick."""
        step = np.maximum(self.loading.step.max(axis=0), self.unloading.step.max(axis=0))
        # Elements that stick leave with about this velocity, of unknown phase.
        left = np.sqrt(self.inertia / self.rate) * -self.unloading.velocity[-1]
        return np.where(self.inertia * self.edge[-1] * step**2 > 2, [left / velocity, 0 * step + 1], 0.0)

    def slip_ends(self):
        """Depths (m) at the first few instants at which all elements begin to stick, else 0.

        Slip ends where the velocity equals the rate of the bound, W = ±v, or W = 0 while yielding.
        """
        depth = np.vstack([self.loading.depth, self.unloading.depth[1:]])
        normal = np.vstack([self.loading.velocity, self.unloading.velocity[1:]])
        ends = []
        for excess in (self.velocities - normal, self.velocities + normal, self.velocities):
            rise = np.diff(excess, axis=0)
            share = -excess[:-1] / np.where(rise == 0, 1.0, rise)
            changes = excess[:-1] * excess[1:] < 0
            ends.append(np.where(changes, depth[:-1] + share * np.diff(depth, axis=0), 0.0))
        ends = np.vstack(ends)
        first = np.argsort(ends == 0, axis=0, kind="stable")[:_INSTANTS]
        return np.take_along_axis(ends, first, axis=0)


def _time_to(rise, velocity, acceleration, step):
    """Time (s) in which the depth rises by so much (m), at most a step."""
    root = np.sqrt(np.maximum(velocity * velocity + 2 * acceleration * rise, 0.0))
    return np.clip(2 * rise / np.maximum(velocity + root, 1e-300), 0.0, step)


def solve_dry(motions, inertia, velocity, tolerance):
    """Velocities (m/s) after impacts, largest forces over 2μE* (m²), their relative errors, and halvings.

    Errors are 0.6 of what the last halving of the steps changed, of second order a third. As runs may agree
    by chance there are three at least, a change counts for a sixth in the next halving, for a 36th in the
    one after that, and so on, and no error of a run with n levels is less than 0.3/n². Of velocity or
    force, whichever changed more; relative to the velocity at first contact, and to the force. Halvings
    count from `first_counts`: the first run has half of them.
    """
    counts, result = (first_counts(motions, inertia) + 1) // 2, np.zeros((5, velocity.size))
    lasting = np.zeros(velocity.size)
    rows, coarse, instants = np.arange(velocity.size), None, np.zeros((_INSTANTS, velocity.size))
    for halvings in range(-1, _HALVINGS + 1):
        given = motions[rows], inertia[rows], velocity[rows], counts[:, rows], instants
        values, uncertain, instants = _run(*given)
        if coarse is not None:
            change = np.max(np.abs(values - coarse) / np.stack([velocity[rows], values[1]]), axis=0)
            lasting, total = np.maximum(change, lasting / 6), counts[:, rows].sum(axis=0)
            errors = np.maximum(np.maximum(0.6 * lasting, 0.3 / total**2), uncertain)
            result[:, rows] = [*values, *errors, np.full(rows.size, halvings)]
            left = (errors[0] > tolerance) & (2 * total <= _MOST) | (halvings == 0)
            rows, values, instants, lasting = rows[left], values[:, left], instants[:, left], lasting[left]
            if not rows.size:
                break
        coarse, counts = values, 2 * counts
    return result


def first_counts(motions, inertia):
    """Numbers of levels below and above the imprint to begin with, of few different values."""
    branches = motions.branches((8, 8), np.zeros((0, inertia.size)))
    # How far elements that all stick oscillate in a step (rad).
    angles = [np.sqrt(inertia * motions.radii(x.middle)) * x.step for x in branches]
    split = len(angles[0]) - len(angles[1])
    below = angles[0][:split].sum(axis=0)
    above = np.maximum(angles[0][split:].sum(axis=0), angles[1].sum(axis=0))
    counts = np.minimum([2 * (2 + below), 5 * (1 + above)], _MOST / 4)
    counts = np.ceil(2 ** (np.ceil(3 * np.log2(counts)) / 3)).astype(int)
    counts[0] = np.where(motions.plastic_depth > 0, counts[0], 1)
    return counts


def _run(motions, inertia, velocity, counts, instants):
    """Velocities after impacts and largest forces of runs, their least errors, and where slip ended."""
    values, uncertain, ends = (
        np.empty((2, velocity.size)),
        np.empty((2, velocity.size)),
        np.empty_like(instants),
    )
    pairs, numbers = np.unique(counts, axis=1, return_inverse=True)
    for number, pair in enumerate(pairs.T):
        members = np.flatnonzero(numbers.ravel() == number)
        for block in chunks(members.size, max(1, _BLOCK // int(pair.sum()))):
            rows = members[block]
            run = DryRun(motions[rows], inertia[rows], velocity[rows], pair, instants[:, rows]).solve()
            values[:, rows], ends[:, rows] = (run.velocity, run.largest_force()), run.slip_ends()
            uncertain[:, rows] = run.uncertain(velocity[rows])
    return values, uncertain, ends
