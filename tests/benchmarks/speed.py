"""Time of what is called a million times, beside textbook formulas in NumPy in the same process.

python -m tests.benchmarks.speed
"""

from dataclasses import fields, replace

import numpy as np

import mdr_core as mdr
from mdr_core.solver.profiles.radius_table import OneLength

from ..shapes import SHAPES, name
from .harness import seconds
from .tables import time

MEDIUM, WET = mdr.Medium(1e9, q_c=10.0), mdr.Medium(1e9, q_c=10.0, eta=3.0)


def rows(count=10**6, shapes=SHAPES):
    """What, how long, and against what: force, dry impacts and viscous ones of shapes."""
    depths = np.linspace(1e-9, 1e-6, count)
    # A quick look does not judge times.
    runs = 5 if count > 1000 else 1
    # The elastic forces of textbooks, at the depth and beyond the plastic one: a difference of curves.
    d_c = MEDIUM.critical_depth
    books = {
        "cone": lambda: (depths**2 - np.maximum(depths - d_c, 0) ** 2) * (2e9 / np.pi / 0.3),
        "paraboloid": lambda: (depths**1.5 - np.maximum(depths - d_c, 0) ** 1.5) * (4e9 / 3 * 1e-5**0.5),
    }
    book = {what: seconds(call) for what, call in books.items()}
    for what, taken in book.items():
        yield f"{count} textbook forces of a {what}, NumPy", time(taken), ""
    for shape in shapes:
        taken = seconds(lambda s=shape: mdr.indent(s, MEDIUM, depths).force, runs=min(runs, 3))
        yield f"{count} forces, {name(shape)}", time(taken), _ratio(taken, book["paraboloid"])
    speeds = np.geomspace(1e-4, 0.3, count)
    for shape in shapes:
        few = speeds if name(shape) in ("Cone", "Paraboloid") else speeds[:: max(1, count // 10**4)]
        hits = _impacts(shape, MEDIUM, few)
        taken = seconds(lambda h=hits: h().restitution, runs=1) * count / few.size
        yield (
            f"{count} dry impacts, restitution, {name(shape)}",
            time(taken),
            _ratio(taken, book["paraboloid"]),
        )
        taken = seconds(lambda h=hits: h().contact_time, runs=1) * count / few.size
        yield (
            f"{count} dry impacts, contact time, {name(shape)}",
            time(taken),
            _ratio(taken, book["paraboloid"]),
        )
    yield from _ensembles(count)
    yield from _oblique(count // 10)
    for shape in shapes:
        taken = seconds(lambda s=shape: mdr.impact(s, WET, 1e-9, 0.1).restitution, runs=runs)
        yield f"one viscous impact, {name(shape)}", time(taken), ""
        many = speeds[:: max(1, count // 1000)]
        hits = _impacts(shape, WET, many)
        viscous = seconds(lambda h=hits: h().restitution, runs=1) / many.size
        yield f"one of {many.size} viscous impacts, {name(shape)}", time(viscous), ""
        yield from _on_plate(shape, many, viscous, runs)
    yield from _on_modes(runs)


def _on_plate(shape, speeds, viscous, runs):
    """Impacts on a plate, beside as many viscous ones in the same run."""
    middle = mdr.impact(shape, MEDIUM, 1e-9, 0.1)
    plate = mdr.Structure(float(1e-9 / middle.contact_time))
    taken = seconds(lambda: mdr.impact(shape, MEDIUM, 1e-9, 0.1, structure=plate).restitution, runs=runs)
    yield f"one impact on a plate, {name(shape)}", time(taken), ""
    many = seconds(lambda: mdr.impact(shape, MEDIUM, 1e-9, speeds, structure=plate).restitution, runs=1)
    taken = many / speeds.size
    yield (
        f"one of {speeds.size} impacts on a plate, {name(shape)}",
        time(taken),
        f"{taken / viscous:.2g} × a viscous one",
    )


def _on_modes(runs):
    """Impacts on plates by 100 modes, beside one of the same body on a viscous half-space."""
    laminate = 131.4233, 3.867273, 77.27888, 8.921508, 1580 * 2.69e-3
    for what, structure, ball, medium, mass, speed in (
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
        wet = replace(medium, eta=1e3)
        viscous = seconds(
            lambda b=ball, w=wet, m=mass, v=speed: mdr.impact(b, w, m, v).restitution, runs=runs
        )
        given = ball, medium, mass, speed
        taken = seconds(lambda g=given, s=structure: mdr.impact(*g, structure=s).restitution, runs=runs)
        yield f"one impact by 100 modes, {what}", time(taken), f"{taken / viscous:.2g} × a viscous one"


def _ensembles(count):
    """Impacts of particles that differ in size, medium, mass and speed, beside those of paraboloids."""
    random = np.random.default_rng(1)
    size, *rest = random.uniform(0.8, 1.25, (4, count))
    medium, mass = mdr.Medium(1e9 * rest[0], q_c=10.0 * rest[1]), 1e-9 * rest[2]
    speed = np.minimum(random.lognormal(np.log(0.05), 1.5, count), 5.0)
    tip = mdr.Sampled(5e-7 * np.arange(61), 5e-8 * np.arange(61) + 1e-7 * np.arange(61.0) ** 2)
    paraboloids = [mdr.Paraboloid(1e-5 * size)]
    others = [
        type(s)(*(getattr(s, f.name) * size for f in fields(s))) for s in SHAPES if isinstance(s, OneLength)
    ]
    units = None
    for shape in (*paraboloids, *others, tip):
        what = "impacts on one Sampled tip" if shape is tip else f"different impacts, {name(shape)}"
        hits = mdr.impact(shape, medium, mass, speed)
        taken = (
            seconds(lambda s=shape: _damage(mdr.impact(s, medium, mass, speed)), runs=3),
            # Some of them, each time anew, for a quantity is computed once.
            seconds(lambda h=hits: h[::10].contact_time, runs=1) * 10,
        )
        units = units or taken
        for asked, own, unit in zip(
            ("depth, restitution, area", "contact time"), taken, units, strict=True
        ):
            yield f"{count} {what}: {asked}", time(own), f"{own / unit:.2g} × paraboloids"


def _oblique(count):
    """Balls at random angles of attack, d/d_c up to some 50, together and one by one."""
    random = np.random.default_rng(1)
    radius, friction = random.uniform(1e-5, 5e-5, count), random.uniform(0.1, 0.5, count)
    speed, along = mdr.at_angle(random.uniform(5, 50, count), np.radians(random.uniform(0, 85, count)))
    mass, q_c = 2650 * 4 / 3 * np.pi * radius**3, 10 ** random.uniform(2.5, 3.5, count)
    given = mass, speed, along, friction

    def solved(i, tolerance):
        profile, medium = mdr.Paraboloid(radius[i]), mdr.Medium(4e9, q_c=q_c[i])
        own = (value[i] for value in given)
        return mdr.oblique_impact(
            profile, medium, *own, tangential_mass=2 / 7 * mass[i], tolerance=tolerance
        )

    hits = solved(slice(None), 5e-4)
    taken = seconds(lambda: solved(slice(None), 5e-4), runs=1)
    some = np.arange(0, count, max(1, count // 100))
    singles = [solved(i, 1e-5) for i in some]
    one = np.median([seconds(lambda i=i: solved(i, 1e-5), runs=1) for i in some])
    miss = [
        abs(hit.velocity_change - hits.velocity_change[i]) / along[i]
        for i, hit in zip(some, singles, strict=True)
    ]
    slips = f"{np.mean(hits.slips_throughout):.0%} slip throughout"
    deepest = np.max(hits.max_depth / hits.medium.critical_depth)
    error = f"error of the velocity {np.median(miss):.1g}, 99 % below {np.quantile(miss, 0.99):.1g}"
    yield f"{count} oblique impacts, Paraboloid, d/d_c to {deepest:.2g}", time(taken), f"{slips}; {error}"
    yield "one oblique impact, the median of these, to 10⁻⁵", time(one), ""


def _damage(hits):
    return hits.max_depth, hits.restitution, hits.damaged_area


def _impacts(shape, medium, speeds):
    return lambda: mdr.impact(shape, medium, 1e-9, speeds)


def _ratio(taken, unit):
    return f"{taken / unit:.2g} × the paraboloid's formula"


if __name__ == "__main__":
    for row in rows():
        print("{:55} {:>8}   {}".format(*row), flush=True)
