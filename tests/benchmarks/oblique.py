"""Errors of oblique impacts without viscosity, and what is said of them, against a chain of cells.

    python -m tests.benchmarks.oblique

solves random impacts of all shapes by `oblique_impact` and by the chain, which takes the reduced profile
from the package, the constants of the medium, and nothing else. `accuracy` has the table.
"""

from typing import NamedTuple

import numpy as np

import mdr_core as mdr

from ..shapes import SHAPES

#: The classes of hardness, and sums of them, as names of the constants of a medium.
CLASSES = {
    "(a)": ("hardness",),
    "(b)": ("q_c",),
    "(c)": ("f_c",),
    "(a) + (b)": ("hardness", "q_c"),
    "(a) + (b) + (c)": ("hardness", "q_c", "f_c"),
}
#: Largest depth over the elastic compression of an element there: what is deeper is among the `limits`.
DEEPEST = 1e3


class Case(NamedTuple):
    """An impact: indenter, medium, m and m_t (kg), v₀ and W₀ (m/s), μ, and its largest depth (m)."""

    profile: mdr.Profile
    medium: mdr.Medium
    mass: float
    tangential_mass: float
    speed: float
    tangential_speed: float
    friction: float
    depth: float

    @classmethod
    def random(cls, profile, constants, rng):
        """One with d/d_y from 0.1 to 10³, μ from 0.01 to 3, m_t/m from 0.1 to 10, and ψ from 0.03 to 8.

        A cone of constant hardness has no depth d_y of onset: d/u_c is in the same range.
        """
        E_star, mass = 1e9, 1e-9
        depth, ratio = 10 ** rng.uniform(-7.5, -5.5), 10 ** rng.uniform(-1, 3)
        friction, heavier = 10 ** rng.uniform(-2, np.log10(3)), 10 ** rng.uniform(-1, 1)
        psi, poisson = 10 ** rng.uniform(np.log10(0.03), np.log10(8)), rng.uniform(0, 0.5)
        # At the onset the compression is the depth, and under a cone of constant hardness a share of it at
        # any depth. The classes share it at random.
        similar = isinstance(profile, mdr.Cone) and constants == ("hardness",)
        radius = float(profile.contact_radius(depth if similar else depth / ratio))
        shares = rng.dirichlet(np.ones(len(constants)))
        powers = {"hardness": -1, "q_c": 0, "f_c": 1}
        given = {
            name: 2 * E_star * depth / ratio / np.pi * share * radius ** powers[name]
            for name, share in zip(constants, shares, strict=True)
        }
        medium = mdr.Medium(E_star, poisson=poisson, **given)
        state = mdr.indent(profile, medium, depth)
        if depth > DEEPEST * compression(medium, float(state.contact_radius)):
            return cls.random(profile, constants, rng)
        speed = float(np.sqrt(2 * (state.stored_energy + state.plastic_work) / mass))
        along = psi * friction * speed / float(medium.tangential_ratio)
        return cls(profile, medium, mass, heavier * mass, speed, along, friction, depth)

    def solve(self, **tolerance):
        """The `ObliqueImpact`."""
        given = self.profile, self.medium, self.mass, self.speed, self.tangential_speed, self.friction
        return mdr.oblique_impact(*given, tangential_mass=self.tangential_mass, **tolerance)


def compression(medium, radius):
    """Elastic compression π a σ_c(a)/(2E*) (m) under which elements yield in a contact of radius a (m)."""
    hardness = medium.hardness + medium.q_c / radius + medium.f_c / radius**2
    return np.pi * radius * hardness / (2 * medium.E_star)


#: Columns of the table.
HEAD = (
    "hardness", "tolerance", "with stick", "tolerance met", "error of velocity: median / 99 % / largest",
    "within 10⁻⁴", "covered by what is said, worst ratio", "error of force: median / 99 % / largest",
    "within 10⁻⁴", "covered, worst ratio",
)  # fmt: skip


def chain(case, cells, steps):
    """W′/W₀ and the largest tangential force (N) by cells under a polygon, and so many steps of a branch.

    The normal load of a cell is the mean over its linear profile, and it sticks or slips as a whole; a cell
    that is covered in part gains load in that part. Cells yield under the compression that belongs to the
    radius of the largest contact. Steps are Verlet's. Errors are of second order.
    """
    width, lower, rise, table = _polygon(case, cells)
    E_star, nu = case.medium.E_star, case.medium.poisson
    kappa = 2 * (1 - nu) / (2 - nu)
    rate, inertia = 2 * E_star / case.mass, 2 * kappa * E_star / case.tangential_mass

    def compressions(depth):
        below = np.maximum(depth - lower, 0.0)
        return np.where(below < rise, below**2 / (2 * rise), below - rise / 2)

    depth, speed, slip_speed = 0.0, case.speed, case.tangential_speed
    load, yielded, compressed = np.zeros((3, width.size))
    plastic_depth, normal, along, forces, times = 0.0, 0.0, 0.0, [0.0], [0.0]
    # Loading takes one to two times this over two, and unloading as well. While all cells stick the contact
    # point oscillates, and some hundred steps make a period.
    longest = 0.05 * (2000 / cells) / np.sqrt(inertia * table[0][-1])
    dt, turned = min(2 * case.depth / case.speed / steps, longest), False
    while depth > plastic_depth or speed > 0:
        speed -= rate * normal * dt / 2
        slip_speed -= inertia * along * dt / 2
        rise_of_depth = speed * dt
        depth += rise_of_depth
        left = depth - compression(case.medium, np.interp(depth, table[1], table[0])) if depth > 0 else 0.0
        if speed > 0 and left > plastic_depth:
            plastic_depth = left
            yielded = compressions(plastic_depth)
        before, compressed = compressed, compressions(depth)
        if abs(rise_of_depth) > 1e-7 * case.depth:
            covered = (compressed - before) / rise_of_depth
        else:
            covered = np.clip((depth - lower) / rise, 0.0, 1.0)
        spring = np.maximum(compressed - yielded, 0.0)
        bound = case.friction / kappa * spring
        load = np.clip(load + covered * slip_speed * dt, -bound, bound)
        normal, along = width @ spring, width @ load
        speed -= rate * normal * dt / 2
        slip_speed -= inertia * along * dt / 2
        forces.append(abs(along))
        times.append(times[-1] + dt)
        if speed <= 0 and not turned:
            back = 2 * np.sqrt((depth - plastic_depth) / (rate * normal)) / steps
            dt, turned = min(back, longest), True
    force = 2 * kappa * E_star * _peak(np.array(times), np.array(forces))
    return np.array([slip_speed / case.tangential_speed, force])


def _peak(time, force):
    """Largest value, at a kink between two samples as well: where the lines from both sides meet."""
    i, found = np.argmax(force), np.max(force)
    for k in (i - 1, i):
        if 1 <= k < force.size - 2:
            left, right = (np.diff(force[j : j + 2]) / np.diff(time[j : j + 2]) for j in (k - 1, k + 1))
            gap = time[k + 1] - time[k]
            share = (force[k + 1] - force[k] - right * gap) / (left - right) / gap if left > right else -1.0
            if 0 <= share <= 1:
                found = max(found, float((force[k] + left * share * gap)[0]))
    return found


def _polygon(case, cells):
    """Widths of cells, depths (m) of their inner ends, rises along them; a table of radii over depths (m).

    Cells are even in radius and depth.
    """
    top = float(case.profile.contact_radius(1.003 * case.depth))
    x = top * np.sort(np.append(np.linspace(0, 1, 20001), np.geomspace(1e-9, 1, 5001)))
    g = np.maximum.accumulate(case.profile.reduced(np.minimum(x, top)))
    # The last radius of each depth: a flat face is covered at once.
    last = np.append(np.diff(g) > 0, True)
    length = x / top + g / case.depth
    edge, table = np.interp(np.linspace(0.0, length[-1], cells + 1), length, x), (x[last], g[last])
    g = np.maximum.accumulate(case.profile.reduced(edge))
    return np.diff(edge), g[:-1], np.maximum(np.diff(g), 1e-12 * case.depth), table


def limits(case, cells):
    """What the chain tends to, and a bound of its own error: W′/W₀, and the largest force (N)."""
    coarse, fine = (chain(case, count, 2 * count) for count in (cells // 2, cells))
    # Extrapolation leaves a tenth of the difference at most.
    return fine + (fine - coarse) / 3, np.abs(fine - coarse) / 10


class Miss(NamedTuple):
    """Deviations of the velocity (of W₀) and of the force, relative, beyond the chain's own error; what is
    said of them; and whether the tolerance is met."""

    velocity: float
    force: float
    said_velocity: float
    said_force: float
    met: bool


def misses(cases, tolerance, references):
    """A `Miss` for each of the cases in which some elements stick."""
    for case, (true, unsure) in zip(cases, references, strict=True):
        hit = case.solve(tolerance=tolerance)
        if not hit.slips_throughout:
            found = np.array([-hit.tangential_restitution, hit.max_tangential_force])
            off = np.maximum(np.abs(found - true) - unsure, 0.0) / [1.0, true[1]]
            errors = hit.errors.tangential_velocity, hit.errors.max_tangential_force
            yield Miss(*off, *errors, not next(x for x in hit.limits if x.what == "tolerance").exceeded)


def random_impacts(count, constants):
    """So many of the `Case`s of a class of hardness by turns of all shapes."""
    rng = np.random.default_rng(38)
    # A constant hardness is for convex shapes, all but the power law of exponent 1/2.
    shapes = [x for x in SHAPES if "hardness" not in constants or getattr(x, "exponent", 1.0) >= 1]
    return [Case.random(shapes[i % len(shapes)], constants, rng) for i in range(count)]


def table(count=60, tolerances=(5e-4, 1e-4, 1e-5), cells=2000):
    """Rows of text under `HEAD`, one for each class of hardness and tolerance."""
    for hardness, constants in CLASSES.items():
        cases = random_impacts(count, constants)
        references = [limits(case, cells) for case in cases]
        for tolerance in tolerances:
            yield [hardness, *_row(cases, references, tolerance)]


def _row(cases, references, tolerance):
    columns = (np.array(column) for column in zip(*misses(cases, tolerance, references), strict=True))
    velocity, force, said_velocity, said_force, met = columns
    texts = [f"{tolerance:g}", f"{velocity.size} of {len(cases)}", f"{np.mean(met):.0%}"]
    for off, said in ((velocity, said_velocity), (force, said_force)):
        middle, most = np.quantile(off, (0.5, 0.99))
        share = off / said
        texts += [f"{middle:.0e} / {most:.0e} / {off.max():.0e}", f"{np.mean(off <= 1e-4):.1%}"]
        texts += [f"{np.mean(share <= 1):.1%}, {share.max():.1f}"]
    return texts


def main():
    for row in table():
        print(" | ".join(row), flush=True)


if __name__ == "__main__":
    main()
