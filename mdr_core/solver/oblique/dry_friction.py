"""Friction along the surface without viscosity, for many impacts at a time: section 13 of the theory.

Lengths along the surface are in units of μ/κ. U is the displacement of the point of contact. An element at
a depth g of the reduced profile that sticks with the origin O has the load Q = U − O. Its bound is |Q| ≤ B
with B = d − max(g, p), the depth d and the plastic depth p. Slip moves its origin until |Q| = B. With
C = 2κE*/m_t, the velocity W = U̇ of the point of contact follows Ẇ = −C ∫Q dx.

1. Levels of depth are the edges of cells, each with a pair of elements at Gauss points. A step is between
   two instants at which the edge of the contact passes a level: it covers or releases one cell.
2. A step is a Nyström step, with F = ∫Q dx at its start, middle and end.
3. The origin of an element is U at the instant when it is covered, from a parabola in depth.
4. At the middle and at the end of a step, slip moves the origins.
5. On unloading, the load of the cell at the edge is corrected for the slipping ring in it.
6. Runs are repeated with twice the levels until the error is within the tolerance. The change from one run
   to the next estimates the error.

Errors are of second order in the step.
"""

import numpy as np

from ..numerics.blocks import chunks
from .viscous_friction import largest_force

#: Gauss points of a cell, from its inner side (0) to its outer side (1).
_POINTS = np.array([[0.5 - np.sqrt(1 / 12)], [0.5 + np.sqrt(1 / 12)]])
#: Number of impacts times levels solved at a time.
_BLOCK = 32768
#: Largest numbers of halvings of the steps, and of levels of a run.
_HALVINGS = 7
_MOST = 2048


class DryRun:
    """One run of impacts: C = `inertia` (1/(m s²)), and the velocity κv_t0/μ (m/s) at first contact.

    Records are velocities W (m/s) and forces ∫Q dx (m²), with one row per instant of `levels`. Forces also
    have a row for the middle of each step. `element_states` are loads of elements and their bounds (m), by
    the numbers of the `recorded` instants.

    Every array has one column per impact. Arrays of the elements have one row per element, from the axis
    outward. Element 0 is the flat face, with the width 0 if there is no face. Two elements follow for each
    of the n = `levels.turn` cells. Cell k, counted from 0, has the elements 2k + 1 and 2k + 2. Its inner
    side (towards the axis) is the edge of the contact at instant k of loading, its outer side the edge at
    instant k + 1. The first `count` elements are in contact.

    Attributes
    ----------
    width, depth : ndarray, shape (2n + 1, N)
        Width (m) and depth g (m) of each element.
    reach : ndarray, shape (2n + 1, N)
        Width (m) of each element and of all elements inside it.
    origin, zero : ndarray, shape (2n + 1, N)
        Origin O of each element, and the depth max(g, p) (m) at which its bound is zero. Each step changes
        them for the elements in contact; released elements keep their last values.
    displacement, velocity, force : ndarray, shape (N,)
        U, W and F = ∫Q dx at the present instant.
    """

    def __init__(self, motions, inertia, velocity, counts, depths=()):
        self.levels = motions.levels(*counts, depths)
        edge = motions.profile.radius_at(self.levels.depth[: self.levels.turn + 1])
        edge = np.maximum.accumulate(edge, axis=0)
        width = np.diff(edge, axis=0)
        x = (edge[:-1, None] + width[:, None] * _POINTS).reshape(-1, velocity.size)
        depth = motions.profile.reduced_at(x)
        self.width = np.vstack([edge[:1], np.repeat(width / 2, 2, axis=0)])
        # There are no elements outside a wall.
        self.depth = np.where(self.width > 0, np.vstack([0 * edge[:1], depth]), 0.0)
        self.reach = np.cumsum(self.width, axis=0)
        self.origin = np.zeros_like(self.width)
        self.zero = np.zeros_like(self.width)
        # Beyond some 10⁵ d_c, steps are too long for the oscillation of sticking elements. A κ reduced by
        # this ratio makes it slower, and does not change slip.
        longest = self.levels.step.max(axis=0)
        self.softness = 1 / np.maximum(inertia * edge[-1] * longest**2 / 2, 1.0)
        self.inertia = self.softness * inertia
        self.displacement = np.zeros_like(velocity)
        self.force = np.zeros_like(velocity)
        self.velocity = self.softness * velocity

    def solve(self, recorded=()):
        """Take all steps of the run, and return it."""
        self.velocities, self.forces = [self.velocity], [self.force]
        self.element_states = {0: (self.origin[:0], self.origin[:0])}
        for i in range(len(self.levels.step)):
            count = self._load(i) if i < self.levels.turn else self._unload(i)
            if i + 1 in recorded:
                load, bound = self.displacement - self.origin, self.levels.depth[i + 1] - self.zero
                self.element_states[i + 1] = load[:count], bound[:count]
        self.velocities = np.array(self.velocities) / self.softness
        self.forces = np.array(self.forces)
        return self

    def _load(self, i):
        """Take the step from instant i to i + 1 of loading; the contact edge moves outward over cell i.

        The origin of a covered element is U at the instant when the depth d is its g. At first U is a line
        in d through its values at the start and the middle of the step, which is enough for the force at
        the middle. Then it is the parabola in d through start, middle and end.

        Return the number of elements in contact, including this cell.
        """
        levels, start_U = self.levels, self.displacement
        start, middle, end = levels.depth[i], levels.middle[i], levels.depth[i + 1]
        cell = _cell(i)
        # Shares of the change of depth in this step: up to its middle, and up to d = g.
        half = _ratio(middle - start, end - start)
        covered = _ratio(self.depth[cell] - start, end - start)
        middle_U = self._middle_displacement(i)
        self.origin[cell] = start_U + (middle_U - start_U) * _ratio(covered, half)
        middle_F = self._slip(cell.stop, middle_U, middle, levels.middle_plastic_depth[i])
        end_U = self._end_displacement(i, middle_F)
        self.origin[cell] = _parabola(covered, half, start_U, middle_U, end_U)
        end_F = self._slip(cell.stop, end_U, end, levels.plastic_depth[i + 1])
        self._finish(i, end_U, middle_F, end_F)
        return cell.stop

    def _unload(self, i):
        """Take the step from instant i to i + 1 of unloading, in which one cell is released.

        The edge of the contact moves inward, from the outer side of the cell at the start of the step to
        its inner side at the end. Then the next cell towards the axis is at the edge, and all of it is in
        contact. At the turning point, instant n, all n cells are in contact.

        Return the number of elements in contact at the start, including the released cell. At the end, the
        bounds and loads of this cell are zero.
        """
        levels = self.levels
        start, middle, end = levels.depth[i], levels.middle[i], levels.depth[i + 1]
        released = 2 * levels.turn - 1 - i
        count = _cell(released).stop
        # Remaining share of the change of depth at the middle of this step.
        rest = 1 - _ratio(middle - start, end - start)
        middle_U = self._middle_displacement(i)
        middle_F = self._slip(count, middle_U, middle, levels.middle_plastic_depth[i])
        middle_F += self._excess(released, middle_U, middle, end, rest)
        end_U = self._end_displacement(i, middle_F)
        end_F = self._slip(count, end_U, end, levels.plastic_depth[i + 1])
        if i + 1 < len(levels.step):
            end_F += self._excess(released - 1, end_U, end, levels.depth[i + 2], 1.0)
        self._finish(i, end_U, middle_F, end_F)
        return count

    def _middle_displacement(self, i):
        """Return U(h/2) = U + h W/2 − h² C F/8 of Nyström step i, of the time h."""
        h = self.levels.step[i]
        return self.displacement + h / 2 * self.velocity - h**2 / 8 * self.inertia * self.force

    def _end_displacement(self, i, middle_F):
        """Return U(h) = U + h W − h² C (F + 2 F(h/2))/6."""
        h = self.levels.step[i]
        mean = self.force + 2 * middle_F
        return self.displacement + h * self.velocity - h**2 / 6 * self.inertia * mean

    def _finish(self, i, end_U, middle_F, end_F):
        """Go to the end of step i, with W(h) = W − h C (F + 4 F(h/2) + F(h))/6, and record it."""
        total = self.force + 4 * middle_F + end_F
        self.velocity = self.velocity - self.levels.step[i] / 6 * self.inertia * total
        self.displacement = end_U
        self.force = end_F
        self.velocities.append(self.velocity)
        self.forces += [middle_F, end_F]

    def _slip(self, count, U, depth, plastic_depth):
        """Return F (m²) of the first `count` elements after slip, at U, a depth d and a plastic depth p.

        Slip moves origins O until |U − O| ≤ B, with the bound B = d − `zero` and `zero` = max(g, p). The
        last two elements are the cell at the moving edge of the contact. Their `zero` is at most d, so that
        B is not negative.
        """
        zero = np.maximum(self.depth[:count], plastic_depth, out=self.zero[:count])
        np.minimum(zero[-2:], depth, out=zero[-2:])
        origin = self.origin[:count]
        np.maximum(origin, zero + (U - depth), out=origin)
        np.minimum(origin, (U + depth) - zero, out=origin)
        return self.reach[count - 1] * U - np.einsum("ij,ij->j", self.width[:count], origin)

    def _excess(self, cell, U, depth, inner_depth, share):
        """Return the excess (m²) of the load of a cell on unloading over the load of its two elements.

        The edge of the contact is in this cell. From the inner side, a `share` of the width is in contact.
        Over this share the bound falls from B_i = d − `inner_depth` to zero, with `inner_depth` the g (m)
        of the inner side. If the inner element sticks with the load Q, all of the cell sticks except the
        ring at the edge with B < |Q|. The mean load is then Q (1 − |Q|/(2 B_i)). If the inner element
        slips, all of the cell slips, with the mean ±B_i/2.
        """
        inner, outer = self._pair_loads(cell, U)
        number = _cell(cell).start
        # The width of one element is half of the width of the cell.
        width = self.width[number]
        most = np.maximum(depth - inner_depth, 1e-300)
        sticks = np.abs(inner) < (depth - self.zero[number]) * (1 - 1e-9)
        mean = np.where(sticks, inner * (1 - np.abs(inner) / (2 * most)), np.sign(inner) * most / 2)
        return width * (2 * share * mean - inner - outer)

    def _pair_loads(self, cell, U):
        """Return the loads Q = U − O of the inner and the outer element of a cell."""
        return U - self.origin[_cell(cell)]


def _cell(number):
    """Return the slice of the two elements of a cell."""
    return slice(2 * number + 1, 2 * number + 3)


def _parabola(share, half, start, middle, end):
    """Return values at shares of a step, of the parabola through its start, the share `half`, and its end.

    U(s) = U(0) + s (U(1) − U(0)) + s (1 − s) bend, with the bend from U(half) = `middle`.
    """
    bend = _ratio(middle - start - half * (end - start), half * (1 - half))
    return start + share * (end - start) + share * (1 - share) * bend


def _ratio(part, whole):
    """Return part/whole, or `part` if a step has no length."""
    return part / np.where(whole == 0, 1.0, whole)


def solve_dry(motions, inertia, velocity, tolerance):
    """Return velocities (m/s) after impacts, largest forces ∫Q dx (m²), relative errors, and halvings.

    Errors are relative to the velocity at first contact, and to the force. An error is the larger change of
    velocity or force by the last halving of the steps. As runs may agree by chance, a change still counts
    with 1/6 in the next halving, with 1/36 in the second next, and so on. No error of a run with n levels
    is less than 1/n².
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
    """Return the first numbers of levels below and above the imprint, with few different values."""
    levels = motions.levels(8, 8)
    # Phase of the oscillation in a step (rad) if all elements stick.
    angle = np.sqrt(inertia * motions.profile.radius_at(levels.middle)) * levels.step
    imprint = 2 * levels.turn - len(angle)
    parts = angle[:imprint], angle[imprint : levels.turn], angle[levels.turn :]
    below, loading, unloading = (part.sum(axis=0) for part in parts)
    counts = np.array([2 * (2 + below), 5 * (1 + np.maximum(loading, unloading))])
    counts = np.ceil(2 ** (np.ceil(3 * np.log2(np.minimum(counts, _MOST / 4))) / 3)).astype(int)
    counts[0] = np.where(motions.plastic_depth > 0, counts[0], 1)
    return counts


def _run(motions, inertia, velocity, counts):
    """Return velocities after impacts and largest forces of runs, and their least errors."""
    values, least = np.empty((2, velocity.size)), np.zeros((2, velocity.size))
    pairs, numbers = np.unique(counts, axis=1, return_inverse=True)
    for number, pair in enumerate(pairs.T):
        members = np.flatnonzero(numbers.ravel() == number)
        for block in chunks(members.size, max(1, _BLOCK // int(pair.sum()))):
            rows = members[block]
            run = DryRun(motions[rows], inertia[rows], velocity[rows], pair).solve()
            values[:, rows] = run.velocities[-1], largest_force(run.levels.time, run.forces)
            # With softer springs, sticking elements leave with about this velocity.
            left = np.sqrt(inertia[rows] / motions.rate[rows]) * -run.levels.velocity[-1]
            least[:, rows] = np.where(run.softness < 1, [left / velocity[rows], 0 * left + 1], 0.0)
    return values, least
