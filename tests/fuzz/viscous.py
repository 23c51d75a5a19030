"""Random calls: viscous impacts, paths in time, the chain of elements."""

import numpy as np

import mdr_core as mdr

from .contact import hits, many_impacts
from .source import finite


def viscous_impacts(source):
    hit = hits(source, True, source.number)
    if source.chance(0.2):
        motion = hit.motion(source.pick((2, 17, np.int64(5))))
        finite(*vars(motion).values())


def many_viscous_impacts(source):
    many_impacts(source, viscous=True, count=100)


def timed(source):
    shape, medium = source.shape(), source.medium(viscous=True)
    time = np.cumsum(10.0 ** source.rng.uniform(-6, 1, 4))
    path = 10.0 ** source.rng.uniform(-10, -5, 4)
    press = mdr.indent if source.chance(0.5) else mdr.indent_to_force
    result = press(shape, medium, path, time=time, tolerance=1e-2)
    finite(result.force, result.contact_radius, result.stored_energy, result.plastic_depth)


_STARTS = (0, "row", (), np.zeros(3), mdr.Foundation(mdr.Cone(1.0), mdr.Medium(1e9), 4, 1e-3))


def _pressed(source, shape, medium):
    """A chain that has been pressed and left again."""
    row = mdr.Foundation(shape, medium, 40, shape.contact_radius(1e-9))
    return row.advance(10.0 ** source.rng.uniform(-11, -9), source.number(-6, 2)).advance(-1e-9)


def foundations(source):
    shape, medium = source.shape(), source.medium(source.chance(0.5))
    n = 40 if source.chance(0.8) else source.pick((2, 100, 41, -2, 1e9, 0, 2.5, "4", np.int32(60)))
    deepest = 10.0 ** source.rng.uniform(-11, -6)
    width = np.minimum(shape.contact_radius(deepest) * 10.0 ** source.rng.uniform(0, 1), shape.known_radius)
    width = source.number(-8, -3) if source.chance(0.1) else width
    row = mdr.Foundation(
        shape, medium, n, width, nodes=() if source.chance(0.8) else source.numbers(-9, -5)
    )
    for _ in range(4):
        dt = np.inf if source.chance(0.3) else source.number(-8, 2)
        depth = source.number(-11, -6) if source.chance(0.1) else deepest * source.rng.uniform(-0.2, 1)
        row = row.advance(depth, dt)
    finite(row.force, row.stored_energy, row.plastic_work, row.viscous_work, row.line_load, row.elastic)


def chains(source):
    shape, medium = source.shape(), source.medium(source.chance(0.7))
    tolerance = 0.1 if source.chance(0.9) else source.number(-2, 0)
    n = None if source.chance(0.9) else source.pick((40, np.int64(4), 16.0, 0, 3, -2, "20", 1e9, True))
    start = None if source.chance(0.9) else source.pick((*_STARTS, _pressed(source, shape, medium)))
    body = source.number(-12, 0), source.number(-4, 2)
    hit = mdr.chain_impact(shape, medium, *body, start=start, n=n, tolerance=tolerance)
    finite(hit.max_depth, hit.max_force, hit.restitution, hit.contact_time, hit.plastic_work)
