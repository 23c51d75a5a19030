"""Random calls: shapes, media, transforms, scaling laws."""

import numpy as np

import mdr_core as mdr

from .source import COUNTS, ODD, SCALARS, Source, finite


def shapes(source):
    shape = source.shape()
    finite(shape.height(source.numbers()), shape.reduced(source.numbers()), infinite=True)
    finite(shape.contact_radius(source.numbers()))


def odd_shapes(source):
    name = source.pick((*SCALARS, "Sampled", "Smooth"))
    count = COUNTS.get(name, 2 if name == "Sampled" else 1)
    shape = getattr(mdr, name)(*(source.pick(ODD) for _ in range(count)))
    finite(shape.contact_radius(1e-9), shape.reduced(1e-9), infinite=True)


def inverses(source):
    """A depth, its contact radius and the depth of that; a height from a reduced one."""
    shape, depth = source.shape(), source.numbers(-12, -6)
    radius, known = shape.contact_radius(depth), np.minimum(shape.known_radius, shape.wall)
    depth = np.asarray(depth, dtype=float)
    # The largest x with g(x) ≤ d, up to the rounding of x.
    inner, outer = (np.minimum(radius * (1 + side * 1e-14), known) for side in (-1, 1))
    assert np.all(shape.reduced(inner) <= depth * (1 + 1e-12) + 1e-290), "too far out"
    # Radii that underflow have lost their digits.
    end = (outer == known) | (radius < 1e-290)
    assert np.all((shape.reduced(outer) >= depth * (1 - 1e-12) - 1e-300) | end), "too far in"
    if source.chance(0.1):
        height = mdr.abel.height_from_reduced(lambda x: x * x, source.numbers(-9, 3))
        finite(height, mdr.abel.kappa(source.numbers(-2, 3)))


def media(source):
    odd = Source(source.rng, 0.3)
    if odd.chance(0.5):
        medium = mdr.Medium(odd.numbers(3, 12), odd.numbers(-6, 6), odd.numbers(-6, 6))
    else:
        medium = mdr.Medium.from_bodies(odd.numbers(3, 12), odd.number(-1, 0), odd.number(3, 12))
    finite(medium.critical_depth, medium.relaxation_time, medium.yield_line_load, infinite=True)


def transforms(source):
    odd = Source(source.rng, 0.1)
    x = np.cumsum(10.0 ** odd.rng.uniform(-9, 0, odd.rng.integers(0, 6)))
    if odd.chance(0.1):
        x = odd.pick(
            ([], [1.0], [2.0, 1.0], [0.0, np.nan], 1.0, None, x[None], [0, 0, 1, 1], [0.0, 5e-324])
        )
    x = x * 10.0 ** odd.rng.uniform(-70, 70) if odd.chance(0.1) and isinstance(x, np.ndarray) else x
    values = odd.numbers() if odd.chance(0.1) else odd.rng.normal(size=np.size(x))
    if odd.chance(0.1) and isinstance(values, np.ndarray) and values.dtype.kind == "f":
        values = np.asarray(values, dtype=float) * 10.0 ** odd.rng.uniform(-70, 70)
    kind = odd.rng.random()
    if kind < 0.5:
        axis, between = odd.pick(("auto", "straight", "even")), odd.pick(("linear", "cubic"))
        stress = mdr.abel.stress_from_line_load(x, values, odd.numbers(), axis, between)
        finite(stress, infinite=True)
    else:
        finite(mdr.abel.line_load_from_stress(x, values, odd.numbers()), infinite=True)
    finite(mdr.abel.reduce_slope(np.sqrt if odd.chance(0.1) else np.tanh, odd.numbers()))


def scalings(source):
    odd = Source(source.rng, 0.02)
    count = odd.rng.integers(0, 6)
    energy, radius = (
        odd.column(count, -50, 50) if count else [],
        odd.column(count, -50, 50) if count else [],
    )
    if odd.chance(0.2):
        energy = np.nextafter(10.0 ** odd.rng.uniform(-9, 1), np.arange(count))
    if odd.chance(0.1):
        energy, radius = odd.numbers(), odd.numbers()
    result = mdr.hardness_class(energy, radius, odd.number(-1, 1))
    finite(result.slope, result.slope_error)
    law = mdr.ScalingLaw(odd.pick(("a", "b", "c", "d", None, ["a"])), odd.number(-50, 50))
    finite(law.radius, law.depth, law.area, law.volume, law.restitution)
