"""Times of a million forces or impacts, of viscous impacts and of impacts on structures, by shapes.

python -m tests.benchmarks.speed
"""

from dataclasses import replace

import numpy as np

import mdr_core as mdr

from .harness import seconds
from .tables import time

SHAPES = {
    "cone": mdr.Cone(0.3),
    "paraboloid": mdr.Paraboloid(1e-5),
    "sphere": mdr.Sphere(1e-5),
    "measured tip": mdr.Sampled(5e-7 * np.arange(61), 5e-8 * np.arange(61) + 1e-7 * np.arange(61.0) ** 2),
}
MEDIUM, MASS = mdr.Medium(1e9, q_c=10.0), 1e-9
WET = replace(MEDIUM, eta=3.0)


def by_shapes(count=10**6):
    """Rows of text, with their head: what is computed, and the time for each of `SHAPES`."""
    depths, speeds = np.linspace(1e-9, 1e-6, count), np.geomspace(1e-4, 0.3, count)
    some = speeds[:: max(1, count // 1000)]
    size, *rest = np.random.default_rng(1).uniform(0.8, 1.25, (4, count))
    media, masses = mdr.Medium(1e9 * rest[0], q_c=10.0 * rest[1]), MASS * rest[2]
    particles = {
        "cone": mdr.Cone(0.3 * size),
        "paraboloid": mdr.Paraboloid(1e-5 * size),
        "sphere": mdr.Sphere(1e-5 * size),
    }
    middle = mdr.impact(SHAPES["paraboloid"], MEDIUM, MASS, 0.1)
    plate = mdr.Structure(impedance=float(MASS / middle.contact_time))

    def hits(name, speed, medium=MEDIUM, **options):
        return mdr.impact(SHAPES[name], medium, MASS, speed, **options)

    def different(name):
        return mdr.impact(particles.get(name, SHAPES[name]), media, masses, speeds)

    calls = {
        f"{count:,} forces": lambda name: mdr.indent(SHAPES[name], MEDIUM, depths).force,
        f"{count:,} dry impacts, restitution": lambda name: hits(name, speeds).restitution,
        f"{count:,} dry impacts, contact time": lambda name: hits(name, speeds).contact_time,
        f"{count:,} different particles, restitution": lambda name: different(name).restitution,
        f"{count:,} different particles, contact time": lambda name: different(name).contact_time,
        "one viscous impact": lambda name: hits(name, 0.1, WET).restitution,
        f"{some.size} viscous impacts": lambda name: hits(name, some, WET).restitution,
        "one impact on a plate": lambda name: hits(name, 0.1, structure=plate).restitution,
        f"{some.size} impacts on a plate": lambda name: hits(name, some, structure=plate).restitution,
    }
    yield "", *SHAPES
    for what, call in calls.items():
        # Fractions of a second need more than one run.
        runs = 5 if what.startswith("one") else 1
        yield what, *(time(seconds(lambda n=name, c=call: c(n), runs)) for name in SHAPES)


def others(count=10**5, runs=5):
    """Rows of text: what is computed, its time, and what it is compared with."""
    yield from _on_modes(runs)
    yield from _oblique(count)


def _on_modes(runs):
    """Impacts on plates by 100 modes, and of the same body on a viscous half-space."""
    laminate = 131.4233, 3.867273, 77.27888, 8.921508, 1580 * 2.69e-3
    for what, structure, *given in (
        (
            "Sun and Chen's laminate", mdr.Structure.supported_plate(0.2, 0.2, *laminate),
            mdr.Paraboloid(6.35e-3), mdr.Medium(7.639e9), 8.537e-3, 3.0,
        ),
        (
            "a drop weight of ASTM D7136",
            mdr.Structure.supported_isotropic_plate(0.075, 0.125, 4.5e-3, 25e9, 0.3, 1600.0),
            mdr.Paraboloid(8e-3), mdr.Medium(10e9, q_c=4e5), 5.5, 1.0,
        ),
    ):  # fmt: skip
        ball, medium, *motion = given
        wet = replace(medium, eta=1e3)
        viscous = seconds(lambda b=ball, w=wet, m=motion: mdr.impact(b, w, *m).restitution, runs)
        taken = seconds(lambda g=given, s=structure: mdr.impact(*g, structure=s).restitution, runs)
        yield f"one impact by 100 modes, {what}", time(taken), f"{taken / viscous:.2g} × a viscous one"


def _oblique(count):
    """Balls at random angles of attack, together and one by one."""
    random = np.random.default_rng(1)
    radius, friction = random.uniform(1e-5, 5e-5, count), random.uniform(0.1, 0.5, count)
    speed, along = mdr.at_angle(random.uniform(5, 50, count), np.radians(random.uniform(0, 85, count)))
    mass, q_c = 2650 * 4 / 3 * np.pi * radius**3, 10 ** random.uniform(2.5, 3.5, count)

    def solved(i, tolerance):
        profile, medium = mdr.Paraboloid(radius[i]), mdr.Medium(4e9, q_c=q_c[i])
        motion = {"tangential_mass": 2 / 7 * mass[i], "tolerance": tolerance}
        return mdr.oblique_impact(profile, medium, mass[i], speed[i], along[i], friction[i], **motion)

    hits = solved(slice(None), 5e-4)
    taken = seconds(lambda: solved(slice(None), 5e-4), runs=1)
    deepest = np.max(hits.max_depth / hits.medium.critical_depth)
    slips = f"{np.mean(hits.slips_throughout):.0%} slip throughout; d/d_c up to {deepest:.2g}"
    yield f"{count:,} oblique impacts, paraboloid, tolerance 5·10⁻⁴", time(taken), slips
    some = range(0, count, max(1, count // 100))
    one = np.median([seconds(lambda i=i: solved(i, 1e-5), runs=1) for i in some])
    yield "one of these, the median, tolerance 10⁻⁵", time(one), ""


def main():
    for row in (*by_shapes(), *others()):
        print(" | ".join(row), flush=True)


if __name__ == "__main__":
    main()
