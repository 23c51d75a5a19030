"""Friction along the surface without viscosity, for many impacts at a time: section 13 of the theory.

Lengths along the surface are in units of μ/κ. An element at a depth g of the reduced profile that sticks at
the origin O of the displacement U of the contact point has the load Q = U − O, and |Q| ≤ B = d − max(g, p)
with the depth d and the plastic depth p. Slip moves its origin until |Q| = B. With C = 2κE*/m_t the
velocity W = U̇ of the contact point follows Ẇ = −C ∫Q dx.

1. Levels of depth are the edges of cells, with a pair of elements at Gauss's points in each. A step lies
   between two instants at which the edge of the contact passes a level: it covers or releases one cell.
2. A step is Nyström's, with F = ∫Q dx at its start, middle and end.
3. An element that is covered has for an origin the U of that instant, from a parabola in depth.
4. At the middle and at the end of a step slip moves the origins.
5. On unloading, the load of the cell at the edge is corrected for the ring in it that slips.
6. The next run has twice the levels, until the error, which is what this changes, is within the tolerance.

Errors are of second order in the step.
"""

import numpy as np

from ..numerics.blocks import chunks
from .viscous_friction import largest_force

#: Gauss's points of a cell.
_POINTS = np.array([[0.5 - np.sqrt(1 / 12)], [0.5 + np.sqrt(1 / 12)]])
#: Impacts times levels that are solved at a time; halvings of steps, and levels of a run, at most.
_BLOCK, _HALVINGS, _MOST = 32768, 7, 2048


class DryRun:
    """One run of impacts: C = `inertia` (1/(m s²)), and the velocity κv_t0/μ (m/s) at first contact.

    Records are velocities W (m/s) and forces ∫Q dx (m²), with a row for each instant of `levels`, forces
    also with one for each middle of a step; `element_states` are loads of elements and their bounds (m), by
    the numbers of the `recorded` instants.
    """

    def __init__(self, motions, inertia, velocity, counts, depths=()):
        self.levels = motions.levels(*counts, depths)
        edge = motions.profile.radius_at(self.levels.depth[: self.levels.turn + 1])
        edge = np.maximum.accumulate(edge, axis=0)
        width = np.diff(edge, axis=0)
        x = (edge[:-1, None] + width[:, None] * _POINTS).reshape(-1, velocity.size)
        depth = motions.profile.reduced_at(x)
        # The first element is the flat face, if there is one. There are no elements behind a wall.
        self.width = np.vstack([edge[:1], np.repeat(width / 2, 2, axis=0)])
        self.depth = np.where(self.width > 0, np.vstack([0 * edge[:1], depth]), 0.0)
        self.reach = np.cumsum(self.width, axis=0)
        # The depth at which the bound of an element is zero, and the range of origins that it allows.
        self.zero, self.low, self.high, self.origin = np.zeros((4, *self.width.shape))
        # Beyond some 10⁵ d_c steps are too long for the oscillation of elements that stick. A smaller κ, in
        # this ratio, makes it slower, and leaves slip as it is.
        longest = self.levels.step.max(axis=0)
        self.softness = 1 / np.maximum(inertia * edge[-1] * longest**2 / 2, 1.0)
        self.inertia = self.softness * inertia
        self.displacement, self.force, self.velocity = 0 * velocity, 0 * velocity, self.softness * velocity

    def solve(self, recorded=()):
        """The run itself, which returns itself."""
        self.velocities, self.forces = [self.velocity], [self.force]
        self.element_states = {0: (self.origin[:0], self.origin[:0])}
        for i in range(len(self.levels.step)):
            back = i - self.levels.turn
            count = 2 * i + 3 if back < 0 else len(self.width) - 2 * back
            self._step(i, count, pressed=back < 0)
            if i + 1 in recorded:
                load, bound = self.displacement - self.origin, self.levels.depth[i + 1] - self.zero
                self.element_states[i + 1] = load[:count], bound[:count]
        self.velocities = np.array(self.velocities) / self.softness
        self.forces = np.array(self.forces)
        return self

    def _step(self, i, count, pressed):
        """The step from instant i to i + 1, Nyström's, with the first `count` elements from the axis.

        The last two of these are the cell that is covered (`pressed`) or released in the step. With the
        displacement U, its rate W and F = ∫Q dx, so that Ẇ = −C F, over a time h

            U(h/2) = U + h W/2 − h² C F/8
            U(h) = U + h W − h² C (F + 2 F(h/2))/6
            W(h) = W − h C (F + 4 F(h/2) + F(h))/6

        An element that is covered has for its origin the U of the instant at which the depth d is that of
        its reduced profile: from a line in d through U(0) and U(h/2) for F(h/2), then from the parabola in
        d through all three. `half` and `share` are counted from the start of the step: parts of its change
        of depth up to its middle, and up to where d reaches these two elements.
        """
        levels, C, U, W, F = self.levels, self.inertia, self.displacement, self.velocity, self.force
        h = levels.step[i]
        start, middle, end = levels.depth[i], levels.middle[i], levels.depth[i + 1]
        last, half = slice(count - 2, count), _ratio(middle - start, end - start)
        middle_U = U + h / 2 * W - h**2 / 8 * C * F
        if pressed:
            share = _ratio(self.depth[last] - start, end - start)
            self.origin[last] = U + (middle_U - U) * _ratio(share, half)
        middle_F = self._slip(count, middle_U, middle, levels.middle_plastic_depth[i])
        if not pressed:
            middle_F += self._edge(count - 2, middle_U, middle, end, 1 - half)
        end_U = U + h * W - h**2 / 6 * C * (F + 2 * middle_F)
        if pressed:
            # U = U(0) + share (U(h) − U(0)) + share (1 − share) bend is U(h/2) at half.
            bend = _ratio(middle_U - U - half * (end_U - U), half * (1 - half))
            self.origin[last] = U + share * (end_U - U) + share * (1 - share) * bend
        end_F = self._slip(count, end_U, end, levels.plastic_depth[i + 1])
        if not pressed and i + 1 < len(levels.step):
            # These two are released, and the next cell is at the edge, all of it in contact.
            end_F += self._edge(count - 4, end_U, end, levels.depth[i + 2], 1.0)
        self.velocity = W - h / 6 * C * (F + 4 * middle_F + end_F)
        self.displacement, self.force = end_U, end_F
        self.velocities.append(self.velocity)
        self.forces += [middle_F, end_F]

    def _slip(self, count, U, depth, plastic_depth):
        """F (m²) at a displacement U, a depth d and a plastic depth p (m) after slip, which moves origins.

        The first `count` elements are in contact. The bound of the load is B = d − `zero` with
        zero = max(g, p), at most d for the two at the edge; |U − O| ≤ B for O between `low`
        and `high`. All are lengths along the surface, in units of μ/κ, or depths (m). They are changed in
        place: rows that are released keep their last values.
        """
        zero = np.maximum(self.depth[:count], plastic_depth, out=self.zero[:count])
        np.minimum(zero[-2:], depth, out=zero[-2:])
        low = np.add(zero, U - depth, out=self.low[:count])
        high = np.subtract(U + depth, zero, out=self.high[:count])
        origin = np.maximum(self.origin[:count], low, out=self.origin[:count])
        np.minimum(origin, high, out=origin)
        return self.reach[count - 1] * U - np.einsum("ij,ij->j", self.width[:count], origin)

    def _edge(self, inner, U, depth, inner_depth, share):
        """By how much the load (m²) of the cell at the edge of the contact exceeds that of its pair.

        The cell begins at a depth (m), where `inner` is the number of its first element; this `share` of it
        is in contact. The bound falls to zero at the edge. If the inner element sticks, all have its load,
        but for a ring in which the bound is less; if it slips, they all have their bounds.
        """
        load, outer_load = U - self.origin[inner : inner + 2]
        most, width = np.maximum(depth - inner_depth, 1e-300), self.width[inner]
        sticks = np.abs(load) < (depth - self.zero[inner]) * (1 - 1e-9)
        mean = np.where(sticks, load * (1 - np.abs(load) / (2 * most)), np.sign(load) * most / 2)
        return width * (2 * share * mean - load - outer_load)


def _ratio(part, whole):
    """part/whole, and `part` where a step has no length."""
    return part / np.where(whole == 0, 1.0, whole)


def solve_dry(motions, inertia, velocity, tolerance):
    """Velocities (m/s) after impacts, largest forces ∫Q dx (m²), their relative errors, and halvings.

    Errors are relative to the velocity at first contact, and to the force: what the last halving of the
    steps changed, of velocity or force, whichever changed more. As runs may agree by chance, a change
    counts for a sixth in the next halving, for a 36th in the one after that, and so on, and no error of a
    run with n levels is less than 1/n².
    """
    counts, result = first_counts(motions, inertia), np.empty((5, velocity.size))
    rows, coarse, change = np.arange(velocity.size), None, np.zeros(velocity.size)
    for halvings in range(_HALVINGS + 1):
        fine, least = _run(motions[rows], inertia[rows], velocity[rows], counts)
        if halvings:
            total, scale = counts.sum(axis=0), [velocity[rows], fine[1]]
            change = np.maximum(np.max(np.abs(fine - coarse) / scale, axis=0), change / 6)
            errors = np.maximum(np.maximum(change, 1 / total**2), least)
            result[:, rows] = [*fine, *errors, np.full(rows.size, halvings)]
            left = (errors.max(axis=0) > tolerance) & (2 * total <= _MOST)
            rows, fine, change, counts = rows[left], fine[:, left], change[left], counts[:, left]
            if not rows.size:
                break
        coarse, counts = fine, 2 * counts
    return result


def first_counts(motions, inertia):
    """Numbers of levels below and above the imprint to begin with, of few different values."""
    levels = motions.levels(8, 8)
    # How far elements that all stick oscillate in a step (rad).
    angle = np.sqrt(inertia * motions.profile.radius_at(levels.middle)) * levels.step
    imprint = 2 * levels.turn - len(angle)
    parts = angle[:imprint], angle[imprint : levels.turn], angle[levels.turn :]
    below, loading, unloading = (part.sum(axis=0) for part in parts)
    counts = np.array([2 * (2 + below), 5 * (1 + np.maximum(loading, unloading))])
    counts = np.ceil(2 ** (np.ceil(3 * np.log2(np.minimum(counts, _MOST / 4))) / 3)).astype(int)
    counts[0] = np.where(motions.plastic_depth > 0, counts[0], 1)
    return counts


def _run(motions, inertia, velocity, counts):
    """Velocities after impacts and largest forces of runs, and their least errors."""
    values, least = np.empty((2, velocity.size)), np.zeros((2, velocity.size))
    pairs, numbers = np.unique(counts, axis=1, return_inverse=True)
    for number, pair in enumerate(pairs.T):
        members = np.flatnonzero(numbers.ravel() == number)
        for block in chunks(members.size, max(1, _BLOCK // int(pair.sum()))):
            rows = members[block]
            run = DryRun(motions[rows], inertia[rows], velocity[rows], pair).solve()
            values[:, rows] = run.velocities[-1], largest_force(run.levels.time, run.forces)
            # Where springs had to be softer, elements that stick leave with about this velocity.
            left = np.sqrt(inertia[rows] / motions.rate[rows]) * -run.levels.velocity[-1]
            least[:, rows] = np.where(run.softness < 1, [left / velocity[rows], 0 * left + 1], 0.0)
    return values, least
