"""Random cases of every shape and every class and sum of hardness, and their deviations from the springs.

`deviations` compares all quantities of one case with `slow_reference`. A case is known by its seed.
"""

from dataclasses import dataclass

import numpy as np

import mdr_core as mdr

from .slow_reference import Impact, Springs, State

E = 1e10
#: Constants that are not 0: the elastic medium, the classes (a), (b), (c), and their sums.
SUMS = ("", "a", "b", "c", "ab", "bc", "ac", "abc")
#: Bounds of the deviations: those of the reference, whose differences of depths have twelve digits.
BOUNDS = {
    "plastic depth": 1e-12, "contact radius": 1e-11, "plastic radius": 1e-9, "force": 1e-9,
    "stored energy": 1e-9, "mean pressure": 1e-9, "line load": 1e-9, "pressure": 1e-6,
    "pressure at c": 1e-4, "surface": 1e-8, "imprint": 1e-8, "stiffness": 1e-5, "energy": 1e-8,
    "plastic work": 1e-8, "force path": 1e-9, "max depth": 1e-8, "restitution": 1e-7, "contact time": 5e-7,
}  # fmt: skip


def _sampled(rng):
    """A random convex polygon, sharp or with a flat face."""
    count = rng.integers(2, 8)
    r = np.append(0.0, np.cumsum(10 ** rng.uniform(-7.5, -6.3, count)))
    slope = np.sort(10 ** rng.uniform(-2, -0.3, count)) * np.linspace(1, 1.2, count)
    slope[0] *= rng.random() < 0.7
    return mdr.Sampled(r, np.append(0.0, np.cumsum(slope * np.diff(r))))


def _smooth(rng):
    """A tip that is given by its slope, with and without an end."""
    length, slope = 10 ** rng.uniform(-6.5, -5.5), rng.uniform(0.1, 0.4)
    end = length * rng.uniform(0.5, 0.95)
    return [
        mdr.Smooth(lambda r: slope * np.tanh(r / length)),
        mdr.Smooth(lambda r: slope * (1 + r / length)),
        mdr.Smooth(lambda r: r / np.sqrt((length - r) * (length + r)), radius=end),
        mdr.Smooth(lambda r: slope * np.tan(r / length), radius=end),
        mdr.Smooth(lambda r: slope * (r / length) ** 3),
    ][rng.integers(5)]


def _radius(rng):
    return 10 ** rng.uniform(-7, -5.5)


#: Random tips by the name of their shape.
TIPS = {
    "Cone": lambda rng: mdr.Cone(rng.uniform(0.05, 0.5)),
    "Paraboloid": lambda rng: mdr.Paraboloid(_radius(rng)),
    "PowerLaw": lambda rng: mdr.PowerLaw(0.1 * 1e-6 ** (1 - (n := rng.uniform(1, 5))), n),
    "Sphere": lambda rng: mdr.Sphere(_radius(rng)),
    "Hyperboloid": lambda rng: mdr.Hyperboloid(rng.uniform(0.05, 0.5), _radius(rng)),
    "RoundedCone": lambda rng: mdr.RoundedCone(_radius(rng), rng.uniform(0.05, 0.5)),
    "ParabolicPunch": lambda rng: mdr.ParabolicPunch(10 * _radius(rng), _radius(rng)),
    "TruncatedCone": lambda rng: mdr.TruncatedCone(0.3 * _radius(rng), rng.uniform(0.05, 0.5)),
    "TruncatedParaboloid": lambda rng: mdr.TruncatedParaboloid(0.3 * _radius(rng), _radius(rng)),
    "RoundedPunch": lambda rng: mdr.RoundedPunch(0.3 * _radius(rng), _radius(rng)),
    "FlatPunch": lambda rng: mdr.FlatPunch(_radius(rng)),
    "Sampled": _sampled,
    "Smooth": _smooth,
}


@dataclass(frozen=True)
class Case:
    """A tip, a medium, the largest depth (m), and the share of the live depth that is unloaded."""

    seed: int
    profile: mdr.Profile
    medium: mdr.Medium
    largest: float
    unloaded: float

    @classmethod
    def random(cls, seed):
        """The case of a seed; shapes and sums take turns."""
        rng = np.random.default_rng(seed)
        profile = list(TIPS.values())[seed % len(TIPS)](rng)
        letters = SUMS[(seed // len(TIPS)) % len(SUMS)]
        deepest = min(3e-7, 0.9 * float(profile.known_depth))
        largest = deepest * 10 ** rng.uniform(-1.5, 0)
        a = float(profile.contact_radius(largest))
        # Together the caps are a hundredth to twice the largest depth.
        shares = rng.dirichlet(np.ones(3)) * 10 ** rng.uniform(-2, 0.3)
        caps = {
            letter: 2 * E * largest * share / np.pi for letter, share in zip("abc", shares, strict=True)
        }
        given = {"hardness": caps["a"] / a, "q_c": caps["b"], "f_c": caps["c"] * a}
        used = {
            name: value
            for letter, (name, value) in zip("abc", given.items(), strict=True)
            if letter in letters
        }
        return cls(seed, profile, mdr.Medium(E, **used), largest, rng.uniform(0.05, 0.9))

    def __str__(self):
        return f"seed {self.seed}: {self.profile}, {self.medium}, {self.largest:.6g} m"


def deviations(case):
    """Relative deviations of the package from the springs, by quantity."""
    profile, medium, largest = case.profile, case.medium, case.largest
    reach = 1.5 * float(profile.contact_radius(largest))
    springs = Springs(profile, medium, reach)
    loaded = State(springs, largest, largest)
    depth = largest - case.unloaded * loaded.live
    path = mdr.indent(profile, medium, [largest, depth])
    result = {}

    def compare(quantity, value, expected, scale=None):
        size = abs(expected) if scale is None else scale
        miss = abs(value - expected) / size if size else abs(value)
        result[quantity] = max(result.get(quantity, 0.0), miss if np.isfinite(miss) else np.inf)

    for exact, state in zip((loaded, State(springs, depth, largest)), path, strict=True):
        _compare_state(compare, exact, state, largest)
    step = 1e-5 * loaded.live
    below, above = (State(springs, depth + side * step, largest).force for side in (-1, 1))
    compare("stiffness", path.stiffness[1], (above - below) / (2 * step))
    _compare_force_path(compare, case, springs, loaded.force)
    if profile.wall == np.inf:
        _compare_impact(compare, case, springs)
    return result


def _compare_state(compare, exact, state, largest):
    """Quantities and fields of one state."""
    a, c = exact.contact_radius, exact.plastic_radius
    compare("plastic depth", state.plastic_depth, exact.plastic_depth, largest)
    compare("contact radius", state.contact_radius, a)
    # c is as well known as d_p, of which it may be a small power.
    if exact.plastic_depth > 1e-3 * largest or not exact.plastic_depth:
        compare("plastic radius", state.plastic_radius, c)
    compare("force", state.force, exact.force)
    compare("stored energy", state.stored_energy, exact.stored_energy)
    compare("mean pressure", state.mean_pressure, exact.force / (np.pi * a**2))
    width = a - max(c, exact.springs.face)
    if width <= 1e-9 * a:
        return
    for x in (0.3 * a, a - 0.5 * width, 1.1 * a):
        compare("line load", state.line_load(x), exact.line_load(x), exact.springs.E * exact.live)
        compare("surface", state.surface(x), exact.surface(x), exact.live)
        compare("imprint", state.imprint(x), exact.imprint(x), largest)
    places = [a - 0.5 * width, a - 0.03 * width]
    places += [0.0, 0.5 * c] if c > 0 else [0.2 * a]
    for r in places:
        compare("pressure", state.pressure(r), exact.pressure(r))
    if c > 0:
        # The tangent at r = c is vertical on the inner side: 10⁻⁸ of the pressure in a unit of rounding.
        beside = state.pressure(c * (1 + 1e-12))
        for r in (np.nextafter(c, 0), c, np.nextafter(c, 1)):
            compare("pressure at c", state.pressure(r), beside)


def _compare_force_path(compare, case, springs, force):
    """The depth that `indent_to_force` finds carries the force, and no smaller one does."""
    if not force > 0 or case.profile.wall < np.inf:
        return
    found = float(mdr.indent_to_force(case.profile, case.medium, force).depth)
    compare("force path", State(springs, found, found).force, force)
    before = found * np.linspace(0.02, 0.999, 60)
    forces = springs.first_force(before) if "f_c" in _constants(case) else force
    compare("force path", max(force, np.max(forces)), force)


def _constants(case):
    return {name for name in ("hardness", "q_c", "f_c") if 0 < getattr(case.medium, name) < np.inf}


def _compare_impact(compare, case, springs):
    """Depth, restitution, energies and time of an impact that comes as deep as the case."""
    mass = 1e-12
    exact = Impact(springs, float(springs.radius(np.asarray(case.largest))), mass)
    hit = mdr.impact(case.profile, case.medium, mass, np.sqrt(2 * exact.work / mass))
    compare("max depth", hit.max_depth, case.largest)
    compare("restitution", hit.restitution, np.sqrt(exact.returned / exact.work))
    compare("energy", hit.stored_energy, exact.returned, exact.work)
    compare("plastic work", hit.plastic_work, exact.work - exact.returned, exact.work)
    compare("contact time", hit.contact_time, exact.contact_time)
