"""Errors of oblique impacts without viscosity, and what is said of them, against a chain of cells.

    python -m tests.benchmarks.oblique

solves random impacts of all shapes by `oblique_impact` and by the chain, which takes the reduced profile
from the package and nothing else. `accuracy` has the table.
"""

from typing import NamedTuple

import numpy as np

import mdr_core as mdr

from ..shapes import SHAPES


class Case(NamedTuple):
    """An impact: E* (Pa), d_c (m), ν, m and m_t (kg), v₀ and W₀ (m/s), μ, and its largest depth (m)."""

    profile: mdr.Profile
    E_star: float
    critical_depth: float
    poisson: float
    mass: float
    tangential_mass: float
    speed: float
    tangential_speed: float
    friction: float
    depth: float

    @classmethod
    def random(cls, profile, rng):
        """One with d/d_c from 0.1 to 10³, μ from 0.01 to 3, m_t/m from 0.1 to 10, and ψ from 0.03 to 8."""
        E_star, mass = 1e9, 1e-9
        depth, ratio = 10 ** rng.uniform(-7.5, -5.5), 10 ** rng.uniform(-1, 3)
        friction, heavier = 10 ** rng.uniform(-2, np.log10(3)), 10 ** rng.uniform(-1, 1)
        psi, poisson = 10 ** rng.uniform(np.log10(0.03), np.log10(8)), rng.uniform(0, 0.5)
        state = mdr.indent(profile, mdr.Medium(E_star, 2 * E_star * depth / ratio / np.pi), depth)
        speed = float(np.sqrt(2 * (state.stored_energy + state.plastic_work) / mass))
        kappa = 2 * (1 - poisson) / (2 - poisson)
        along = psi * friction * speed / kappa
        masses = mass, heavier * mass
        return cls(profile, E_star, depth / ratio, poisson, *masses, speed, along, friction, depth)

    def solve(self, **tolerance):
        """The `ObliqueImpact`."""
        medium = mdr.Medium(
            self.E_star, 2 * self.E_star * self.critical_depth / np.pi, poisson=self.poisson
        )
        given = self.profile, medium, self.mass, self.speed, self.tangential_speed, self.friction
        return mdr.oblique_impact(*given, tangential_mass=self.tangential_mass, **tolerance)


#: Columns of the table.
HEAD = (
    "tolerance", "with stick", "tolerance met", "error of velocity: median / 99 % / largest",
    "within 10⁻⁴", "covered by what is said, worst ratio", "error of force: median / 99 % / largest",
    "within 10⁻⁴", "covered, worst ratio",
)  # fmt: skip


def chain(case, cells, steps):
    """W′/W₀ and the largest tangential force (N) by cells under a polygon, and so many steps of a branch.

    The normal load of a cell is the mean over its linear profile, and it sticks or slips as a whole; a cell
    that is covered in part gains load in that part. Steps are Verlet's. Errors are of second order.
    """
    width, lower, rise = _polygon(case, cells)
    kappa = 2 * (1 - case.poisson) / (2 - case.poisson)
    rate, inertia = 2 * case.E_star / case.mass, 2 * kappa * case.E_star / case.tangential_mass

    def compressions(depth):
        below = np.maximum(depth - lower, 0.0)
        return np.where(below < rise, below**2 / (2 * rise), below - rise / 2)

    depth, speed, slip_speed, load, yielded = (
        0.0,
        case.speed,
        case.tangential_speed,
        0.0 * width,
        0.0 * width,
    )
    plastic_depth, compressed, normal, along, forces, times = 0.0, load, 0.0, 0.0, [0.0], [0.0]
    # Loading takes one to two times this over two, and unloading as well.
    dt, turned = 2 * case.depth / case.speed / steps, False
    while depth > plastic_depth or speed > 0:
        speed -= rate * normal * dt / 2
        slip_speed -= inertia * along * dt / 2
        rise_of_depth = speed * dt
        depth += rise_of_depth
        if depth - case.critical_depth > plastic_depth:
            plastic_depth = depth - case.critical_depth
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
            dt, turned = 2 * np.sqrt((depth - plastic_depth) / (rate * normal)) / steps, True
    return np.array(
        [
            slip_speed / case.tangential_speed,
            2 * kappa * case.E_star * _peak(np.array(times), np.array(forces)),
        ]
    )


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
    """Widths of cells, depths (m) of their inner ends, and rises along them: even in radius and depth."""
    top = float(case.profile.contact_radius(1.003 * case.depth))
    x = top * np.sort(np.append(np.linspace(0, 1, 20001), np.geomspace(1e-9, 1, 5001)))
    g = np.maximum.accumulate(case.profile.reduced(np.minimum(x, top)))
    length = x / top + g / case.depth
    edge = np.interp(np.linspace(0.0, length[-1], cells + 1), length, x)
    g = np.maximum.accumulate(case.profile.reduced(edge))
    return np.diff(edge), g[:-1], np.maximum(np.diff(g), 1e-12 * case.depth)


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


def random_impacts(count):
    """So many of the `Case`s by turns of all shapes."""
    rng = np.random.default_rng(38)
    return [Case.random(SHAPES[i % len(SHAPES)], rng) for i in range(count)]


def table(count=300, tolerances=(5e-4, 1e-4, 1e-5), cells=2000):
    """Rows of text under `HEAD`, one for each tolerance."""
    cases = random_impacts(count)
    references = [limits(case, cells) for case in cases]
    for tolerance in tolerances:
        columns = (np.array(column) for column in zip(*misses(cases, tolerance, references), strict=True))
        velocity, force, said_velocity, said_force, met = columns
        texts = [f"{tolerance:g}", f"{velocity.size} of {count}", f"{np.mean(met):.0%}"]
        for off, said in ((velocity, said_velocity), (force, said_force)):
            middle, most = np.quantile(off, (0.5, 0.99))
            share = off / said
            texts += [f"{middle:.0e} / {most:.0e} / {off.max():.0e}", f"{np.mean(off <= 1e-4):.1%}"]
            texts += [f"{np.mean(share <= 1):.1%}, {share.max():.1f}"]
        yield texts


def main():
    for row in table():
        print(" | ".join(row), flush=True)


if __name__ == "__main__":
    main()
