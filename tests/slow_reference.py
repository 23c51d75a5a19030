"""States and impacts by springs over x in plain quadrature: slow, and without the solver's code.

Of the package only the reduced profile g(x), its slope, and the radii of its kinks and faces are taken.
A spring at x is compressed by d − g(x). After a largest contact of radius a it is compressed elastically by
no more than u_c = π a σ_c(a)/(2E*), and keeps the rest as its plastic part. Contact radii are found by
bisection of g. Integrals are of Gauss and Legendre, in a variable in which powers at both ends of a piece
are smooth.
"""

import itertools

import numpy as np

_NODE, _WEIGHT = np.polynomial.legendre.leggauss(44)
_NODE, _WEIGHT = (1 + _NODE) / 2, _WEIGHT / 2
#: A way from 0 to 1 that starts and ends with the fourth power of the distance, and its rate.
WAY = _NODE**4 * (35 - 84 * _NODE + 70 * _NODE**2 - 20 * _NODE**3)
RATE = 140 * (_NODE * (1 - _NODE)) ** 3 * _WEIGHT

#: The same that ends with the square of the distance, from a turning point.
_HALF = _NODE * (2 - _NODE)
_TURN, _TURN_RATE = _HALF**4, 8 * _HALF**3 * (1 - _NODE) * _WEIGHT


def _to_the_end():
    """Matrix from values at the nodes to integrals of their polynomial from each node to 1."""
    legendre = np.polynomial.legendre
    to_series = np.linalg.inv(legendre.legvander(2 * _NODE - 1, _NODE.size - 1))
    whole = [legendre.legint(each, lbnd=1) / -2 for each in np.eye(_NODE.size)]
    return np.array([legendre.legval(2 * _NODE - 1, series) for series in whole]).T @ to_series


_TAIL = _to_the_end()


class Springs:
    """The springs under one profile on one medium, elementwise for arrays of states.

    `reach` is the largest radius (m) that is looked at.
    """

    def __init__(self, profile, medium, reach):
        self.profile, self.E = profile, float(medium.E_star)
        self.hardness = float(medium.hardness), float(medium.q_c), float(medium.f_c)
        self.w = float(medium.work_of_adhesion)
        self.face, self.wall = float(profile.face_radius), float(profile.wall)
        self.reach = min(reach, self.wall, float(profile.known_radius))
        kinks = (float(profile.contact_radius(kink)) for kink in profile.kinks)
        self.edges = sorted({self.face, *kinks} - {0.0})

    def g(self, x):
        """Reduced height (m); 0 on a flat face."""
        return np.where(x > self.face, self.profile.reduced(np.minimum(x, self.reach)), 0.0)

    def radius(self, depth):
        """Contact radius (m) at depths (m) > 0, by bisection of g; 0 at 0."""
        depth = np.asarray(depth, dtype=float)
        low, high = np.full(depth.shape, self.face), np.full(depth.shape, self.reach)
        for _ in range(75):
            middle = np.where(low > 0, np.sqrt(low * high), high * 1e-3)
            inside = self.g(middle) <= depth
            low, high = np.where(inside, middle, low), np.where(inside, high, middle)
        return np.where(depth > 0, np.where(low > 0, low, high), 0.0)

    def cap(self, a):
        """Largest elastic compression u_c (m) at contact radii (m)."""
        H, q_c, f_c = self.hardness
        return np.pi / (2 * self.E) * (H * a + q_c + (f_c / np.maximum(a, 1e-300) if f_c else 0.0))

    def plastic_depth(self, largest):
        """Plastic depth (m) that largest depths (m) leave."""
        return np.maximum(largest - self.cap(self.radius(largest)), 0.0)

    def over_x(self, load, low, high):
        """∫ load(x) dx between radii `low` and `high`, from kink to kink."""
        low, high = np.broadcast_arrays(low, high)
        edges = [low, *(np.clip(edge, low, high) for edge in self.edges), high]
        total = np.zeros(low.shape)
        for begin, end in itertools.pairwise(edges):
            x = begin[..., None] + (end - begin)[..., None] * WAY
            total = total + np.sum(RATE * load(x), axis=-1) * (end - begin)
        return total

    def compressed(self, depth, plastic_depth, a, c, power):
        """∫ u^power dx over x > 0, u the elastic compression (m) at a depth (m)."""

        def load(x):
            ring = np.maximum(self.g(x), np.asarray(plastic_depth)[..., None])
            return np.maximum(np.asarray(depth)[..., None] - ring, 0.0) ** power

        return c * np.maximum(depth - plastic_depth, 0.0) ** power + self.over_x(load, c, a)

    def first_force(self, depth):
        """Forces (N) at depths (m) of a first loading."""
        plastic_depth = self.plastic_depth(depth)
        radii = self.radius(depth), self.radius(plastic_depth)
        return 2 * self.E * self.compressed(depth, plastic_depth, *radii, 1)


class WithRadii(Springs):
    """Springs that take their contact radii from the profile, because a bisection takes long."""

    def radius(self, depth):
        return np.where(depth > 0, self.profile.contact_radius(np.maximum(depth, 0.0)), 0.0)


class State:
    """Quantities and fields of one state, at a depth (m) after a largest depth (m)."""

    def __init__(self, springs, depth, largest):
        self.springs, self.depth, self.largest = springs, depth, largest
        self.plastic_depth = float(springs.plastic_depth(largest))
        self.plastic_radius = float(springs.radius(self.plastic_depth))
        self.live = max(depth - self.plastic_depth, 0.0)
        self.contact_radius = float(springs.radius(depth)) if self.live else 0.0
        # At a wall the radius of the contact is that of the wall.
        if springs.wall < np.inf and self.contact_radius > springs.wall * (1 - 1e-12):
            self.contact_radius = springs.wall

    def _sum(self, power):
        inner = min(self.plastic_radius, self.contact_radius)
        ends = self.depth, self.plastic_depth, self.contact_radius, inner
        return float(self.springs.compressed(*ends, power)) if self.live else 0.0

    @property
    def force(self):
        return 2 * self.springs.E * self._sum(1)

    @property
    def stored_energy(self):
        return self.springs.E * self._sum(2)

    def compression(self, x):
        """Elastic compression (m) of springs at x (m)."""
        ring = np.maximum(self.springs.g(x), self.plastic_depth)
        return np.where(x < self.contact_radius, np.maximum(self.depth - ring, 0.0), 0.0)

    def line_load(self, x):
        return self.springs.E * float(self.compression(np.asarray(x)))

    def pressure(self, r):
        """−(E*/π) ∫ (du/dx) dx/√(x² − r²) over x > r; u may jump at the rim of a wall."""
        a = self.contact_radius
        if r >= a:
            return 0.0
        springs, low = self.springs, max(self.plastic_radius, r, self.springs.face)
        slope = springs.profile.reduced_slope

        def load(y):
            # x² = r² + y² takes the root away.
            x = np.hypot(r, y)
            return slope(np.clip(x, low * (1 + 1e-16), a * (1 - 1e-16))) / np.maximum(x, 1e-300)

        ends = [low, *(edge for edge in springs.edges if low < edge < a), a]
        total = 0.0
        for begin, end in itertools.pairwise(ends):
            first, last = (np.sqrt((x - r) * (x + r)) for x in (begin, end))
            total += np.sum(RATE * load(first + (last - first) * WAY)) * (last - first)
        if a == springs.wall:
            jump = self.depth - max(float(springs.g(np.asarray(a * (1 - 1e-15)))), self.plastic_depth)
            total += jump / np.sqrt((a - r) * (a + r))
        return springs.E / np.pi * float(total)

    def _abel(self, load, end, r):
        """(2/π) ∫ load(x) dx/√(r² − x²) over x < end, r."""
        end = min(end, r)
        cuts = {edge for edge in (self.plastic_radius, *self.springs.edges) if 0 < edge < end}
        total = 0.0
        for begin, stop in itertools.pairwise(sorted({0.0, end} | cuts)):
            first, last = np.arcsin(begin / r), np.arcsin(stop / r)
            total += np.sum(RATE * load(r * np.sin(first + (last - first) * WAY))) * (last - first)
        return 2 / np.pi * float(total)

    def surface(self, r):
        return self._abel(self.compression, self.contact_radius, r)

    def imprint(self, r):
        def left(x):
            return np.maximum(self.plastic_depth - self.springs.g(x), 0.0)

        return self._abel(left, self.plastic_radius, r)


class Impact:
    """An impact to a given largest contact radius (m): work, rebound and time, without a mass of its own.

    `work` is that of loading (J), `returned` that of unloading, and `time` the contact time (s) of a body
    of `mass` (kg) that the work of loading stops.
    """

    def __init__(self, springs, radius, mass):
        self.springs = springs
        self.max_depth = float(springs.g(np.asarray(radius)))
        self.plastic_depth = float(springs.plastic_depth(self.max_depth))
        self._last_radius = float(springs.radius(self.plastic_depth))
        loaded, self.work = self._passage(self._loading, springs.face, radius, self._cuts(radius), mass)
        # Within the face and the plastic zone the springs move together.
        low = max(self._last_radius, springs.face)
        back, self.returned = self._passage(self._unloading, low, radius, springs.edges, mass)
        self.contact_time = loaded + back

    def _loading(self, a):
        depth = self.springs.g(a)
        p = np.maximum(depth - self.springs.cap(a), 0.0)
        return 2 * self.springs.E * self.springs.compressed(depth, p, a, self.springs.radius(p), 1)

    def _unloading(self, a):
        p, c = (np.full(a.shape, each) for each in (self.plastic_depth, self._last_radius))
        return 2 * self.springs.E * self.springs.compressed(self.springs.g(a), p, a, c, 1)

    def _cuts(self, radius):
        """Radii (m) of kinks, and those at which the plastic depth passes 0 and the kinks."""
        springs = self.springs
        passed = [0.0, *(float(springs.g(np.asarray(edge))) for edge in springs.edges)]
        cuts = list(springs.edges)
        for depth in passed:
            low, high = springs.face, radius
            if not depth < self.plastic_depth:
                continue
            for _ in range(100):
                middle = (low + high) / 2
                s = springs.g(np.asarray(middle))
                yielded = s - springs.cap(middle) > depth
                low, high = (low, middle) if yielded else (middle, high)
            cuts.append(high)
        return cuts

    def _passage(self, force, low, high, cuts, mass):
        """Time (s) and work (J) between two contact radii (m), counted from the larger one back."""
        # At the edge of a face g′ varies over decades of the distance.
        decades = [1e-6, 1e-4, 1e-2, 0.5] if self.springs.face else [0.5]
        cuts = [*cuts, *(low + (high - low) * np.array(decades))]
        edges = sorted({low, high, *(float(cut) for cut in cuts if low < cut < high)})
        time = work = 0.0
        for begin, end in reversed(list(itertools.pairwise(edges))):
            way, steps = (_TURN, _TURN_RATE) if end == high else (WAY, RATE)
            a = begin + (end - begin) * way
            slope = self.springs.profile.reduced_slope(a)
            # A node that rounds to a kink, where the slope is infinite, hardly counts.
            rate = steps / _WEIGHT * (end - begin) * np.where(np.isfinite(slope), slope, 0.0)
            power = force(a) * rate
            energy = work + _TAIL @ power
            time += np.sum(_WEIGHT * rate / np.sqrt(2 * energy / mass))
            work += np.sum(_WEIGHT * power)
        return float(time), float(work)
