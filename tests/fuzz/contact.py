"""Random calls: indentations and impacts without time."""

import numpy as np

import mdr_core as mdr

from .source import finite

QUANTITIES = ("force", "contact_radius", "plastic_radius", "plastic_depth", "stored_energy", "plastic_work",
              "stiffness")  # fmt: skip
RESULTS = ("max_depth", "max_force", "contact_radius", "plastic_radius", "plastic_depth", "damaged_area",
           "restitution", "rebound_speed", "contact_time", "stored_energy", "plastic_work",
           "viscous_work")  # fmt: skip


def states(source, result):
    finite(result.depth, *(getattr(result, name) for name in QUANTITIES))
    if np.ndim(result.depth):
        if not len(result):
            return
        result = result[-1]
    r = source.numbers(-12, -3)
    finite(result.pressure(r), infinite=True)
    finite(result.line_load(r), result.surface(r), result.imprint(r))


def indentations(source):
    shape, medium = source.shape(), source.medium()
    states(source, mdr.indent(shape, medium, source.numbers(-12, -4)))


def force_paths(source):
    """The depth of a force has that force."""
    shape, medium, force = source.shape(), source.medium(), source.numbers(-12, 3)
    result = mdr.indent_to_force(shape, medium, force)
    states(source, result)
    # Close to the plateau of a wide flat face the depth resolves the force no better.
    np.testing.assert_allclose(result.force, np.asarray(force, dtype=float), rtol=1e-6, atol=1e-60)


def many_depths(source):
    """Paths of hundreds of states; the last is that of the deepest and the last alone."""
    shape, medium = source.shape(), source.medium()
    depth = np.sort(10.0 ** source.rng.uniform(-12, -5, 200))
    result = mdr.indent(shape, medium, depth)
    finite(*(getattr(result, name) for name in QUANTITIES))
    alone = mdr.indent(shape, medium, depth[-1])
    for name in QUANTITIES:
        np.testing.assert_allclose(getattr(result, name)[-1], getattr(alone, name), rtol=1e-9)
    # Where all of a flat face yields it is constant.
    assert np.all(np.diff(result.force) >= -1e-13 * result.force[1:]), "the force falls on the way down"


def many_forces(source):
    shape, medium = source.shape(), source.medium()
    force = 10.0 ** source.rng.uniform(-10, 1, 200)
    result = mdr.indent_to_force(shape, medium, force)
    finite(*(getattr(result, name) for name in QUANTITIES))
    np.testing.assert_allclose(result.force, force, rtol=1e-6)


def checked(hit):
    """Finite numbers, and an energy ledger that closes."""
    finite(*(getattr(hit, name) for name in RESULTS))
    energy = hit.mass * hit.speed**2 / 2
    lost = (hit.plastic_work + hit.viscous_work) / energy
    np.testing.assert_allclose(hit.restitution**2 + lost, 1.0, rtol=1e-7, err_msg="energy ledger")
    return hit


def hits(source, viscous, number):
    shape, medium = source.shape(), source.medium(viscous)
    before = source.number(-10, -6) if source.chance(0.2) else 0.0
    return checked(mdr.impact(shape, medium, number(-12, 0), number(-4, 2), plastic_depth=before))


def dry_impacts(source):
    hit = hits(source, False, source.numbers)
    if np.all(np.isfinite(hit.medium.critical_depth)) and source.chance(0.3):
        finite(*vars(hit.fast_limit).values())


def many_impacts(source, viscous=False, count=200):
    """Hundreds of indenters, media, masses and speeds in one call, and one of them alone."""
    shape, medium = source.shapes(count), source.media(count, viscous)
    mass, speed = source.column(count, -12, 0), source.column(count, -4, 2)
    hit = checked(mdr.impact(shape, medium, mass, speed, plastic_depth=np.zeros(count)))
    i = source.rng.integers(count)
    alone = mdr.impact(*(part.entries(i) for part in (shape, medium)), hit.mass[i], hit.speed[i])
    for name in RESULTS:
        one, other = getattr(hit, name)[i], getattr(alone, name)
        np.testing.assert_allclose(one, other, rtol=1e-6 if viscous else 1e-9, err_msg=name)
