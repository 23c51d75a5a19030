"""How often a fault of an unloading is said, and good records are remarked on, by kinds of faults.

    python -m tests.benchmarks.unloadings [seed]

prints the table, which is a part of assets/fits.md.
"""

import sys
from collections import Counter
from dataclasses import dataclass

import numpy as np

import mdr_core as mdr

#: Kinds of remarks that are a doubt about E* or H; others say what was done.
DOUBTS = {"zero", "creep", "units", "no unloading"}
#: Largest deviation of E* or H that counts as right beside that many standard errors.
RIGHT, ERRORS = 0.03, 2.0
TIPS = (
    mdr.Cone.berkovich(),
    mdr.Cone(0.3),
    mdr.RoundedCone(0.358, 60e-9),
    mdr.Paraboloid(2e-6),
    mdr.Sphere(3e-6),
)


@dataclass
class Specimen:
    """A simulated record without a fault: a tip, depths (m) and forces (N) of its loading and unloading."""

    tip: object
    loading: tuple
    unloading: tuple
    noise: float
    random: np.random.Generator

    def record(self, *more, air=None):
        """Depth and force with noise: of air, of the loading, of what is between, and of the unloading."""
        parts = [*([air] if air else []), self.loading, *more, self.unloading]
        depth, force = (np.concatenate(each) for each in zip(*parts, strict=True))
        top = self.loading[1].max()
        return depth, force + self.noise * top * self.random.normal(size=force.size)


def specimen(seed):
    """A random medium of each class, tip, depth, number of samples and noise up to 0.2 % of the force."""
    random = np.random.default_rng(seed)
    tip = TIPS[random.integers(len(TIPS))]
    E, deep = 10 ** random.uniform(9, 11.3), 10 ** random.uniform(-6.9, -5.9)
    kinds = (
        {},
        {"hardness": E * random.uniform(0.03, 0.13)},
        {"q_c": E * deep * 10 ** random.uniform(-2, -0.5)},
    )
    medium = mdr.Medium(E, **kinds[random.integers(3)])
    count, back = int(10 ** random.uniform(2, 3)), int(10 ** random.uniform(2, 3))
    dead = float(mdr.indent(tip, medium, [0.0, deep]).plastic_depth[-1])
    loading = np.linspace(0.0, deep, count)
    unloading = np.linspace(deep, dead + 0.4 * (deep - dead), back + 1)[1:]
    force = mdr.indent(tip, medium, np.append(loading, unloading)).force
    noise = random.choice([0.0, 2e-4, 5e-4, 1e-3, 2e-3])
    return Specimen(tip, (loading, force[:count]), (unloading, force[count:]), noise, random)


def good(of):
    """Nothing, long air, a loading that is seen from 0.9 or 21 % of the depth on, or a hold."""
    depth, force = of.loading
    choice = of.random.integers(5)
    if choice == 1:
        away = np.linspace(-0.3 * depth[-1], 0, depth.size // 3, endpoint=False)
        return of.record(air=(away, 0 * away))
    if choice in (2, 3):
        late = depth >= (0.009, 0.21)[choice - 2] * depth[-1]
        of.loading = depth[late], force[late]
    hold = (np.full(30, depth[-1]), np.full(30, force[-1])) if choice == 4 else (depth[:0], depth[:0])
    return of.record(hold)


def little_air(of):
    """5 to 18 samples, over 2.5 to 15 % of the depth, which counts from their first."""
    depth, _ = of.loading
    count = int(of.random.integers(6, 19))
    length = max(depth[-1] * of.random.uniform(0.025, 0.15), 1.02 * 0.025 * depth[-1])
    away = np.linspace(-length, 0, count, endpoint=False)
    d, F = of.record(air=(away, 0 * away))
    return d + length, F


def no_air(of):
    """A depth that is set to 0 at 1.5 to 20 % of the largest force."""
    depth, force = of.loading
    start = int(np.argmax(force >= of.random.uniform(0.015, 0.2) * force[-1]))
    of.loading = depth[start:], force[start:]
    d, F = of.record()
    return d - depth[start], F


def retreat(of, share, length, samples):
    """A preload to a share of the force, back into the air over a length (m), and the loading."""
    depth, force = of.loading
    start = max(int(np.argmax(force >= share * force[-1])), 3)
    air = np.linspace(0, -length, samples)
    back = depth[start::-1], force[start::-1]
    parts = back, (air, 0 * air), (air[::-1], 0 * air)
    d, F = of.record(air=tuple(map(np.concatenate, zip(*parts, strict=True))))
    return d - depth[start], F


def preload(of):
    """A preload of 1 to 5 % where the depth is set to 0, back by 5 to 20 % of the depth into the air."""
    length = of.random.uniform(0.05, 0.2) * of.loading[0][-1]
    return retreat(of, of.random.uniform(0.01, 0.05), length, int(of.random.integers(10, 60)))


def lift_off(of):
    """A contact at 0.1 to 1 % of the force, and a lift-off by 20 to 60 % of the depth before loading."""
    length = of.random.uniform(0.2, 0.6) * of.loading[0][-1]
    return retreat(of, of.random.uniform(0.001, 0.01), length, int(of.random.integers(30, 100)))


def creep(of):
    """A depth that creeps at the start of the unloading, logarithmic or viscous, without times."""
    (_, force), (depth, F) = of.loading, of.unloading
    share = of.random.uniform(0.15, 0.8)
    top, count = of.loading[0][-1], depth.size
    upper = int(np.argmax(F / force[-1] < 0.9)) or 2
    rate = share * (top - depth[upper]) / upper
    step = np.arange(1, count + 1)
    if of.random.random() < 0.5:
        age = of.random.uniform(0.05, 0.4) * count
        crept = rate * age * np.log1p(step / age)
    else:
        crept = rate * np.cumsum(F / force[-1])
    of.unloading = depth + crept, F
    return of.record()


def units(of):
    """Depths or forces a thousand times too large or small."""
    d, F = of.record()
    scale = of.random.choice([1e3, 1e-3, 1e6, 1e-6])
    return (scale * d, F) if of.random.random() < 0.7 else (d, scale * F)


FAULTS = {
    "little air": little_air,
    "no air": no_air,
    "preload": preload,
    "lift-off": lift_off,
    "creep": creep,
    "units": units,
}


def outcome(make, seed):
    """ "right", "said", "silent", "refused", or None where the record without a fault has no unloading."""
    try:
        true = mdr.oliver_pharr(specimen(seed).tip, *specimen(seed).record())
    except ValueError:
        return None
    of = specimen(seed)
    try:
        result = mdr.oliver_pharr(of.tip, *make(of))
    except ValueError:
        return "refused"
    said = DOUBTS & {remark.kind for remark in result.remarks}
    right = all(
        abs(getattr(result, name) - getattr(true, name))
        <= max(RIGHT * getattr(true, name), ERRORS * result.standard_errors[name])
        for name in ("E_star", "hardness")
    )
    if make is good:
        return "said" if said or not right else "right"
    return "said" if said else "right" if right else "silent"


def table(first=0, count=60):
    """The table as Markdown: of each kind of fault how often it is silent, said, refused and right."""
    heads = "silent", "said", "right", "refused"
    rows = [f"| record | {' | '.join(heads)} |", "| --- | --- | --- | --- | --- |"]
    for name, make in {"good": good, **FAULTS}.items():
        counts, seed = Counter(), first
        while sum(counts.values()) < count:
            counts[outcome(make, seed)] += 1
            del counts[None]
            seed += 1
        rows.append(f"| {name} | {' | '.join(str(counts[head]) for head in heads)} |")
    return "\n".join(rows)


if __name__ == "__main__":
    print(table(int(sys.argv[1]) if len(sys.argv) > 1 else 0))
