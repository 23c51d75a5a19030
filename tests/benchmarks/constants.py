"""Cuts and nodes of quadratures: errors of contact time and plastic work with others.

python -m tests.benchmarks.constants

For `NODES` (contact_time.py), `TRANSITIONS`, `scales` and `_NODES` (yielding.py):
the largest relative error over impacts of five shapes with a transition depth, from far
below it to far above, against much denser cuts, or more nodes; for `_NODES` (creep_loading.py) that of the
work of the dashpots in creep. For the shares of steps in `motion_solver`: how many steps viscous impacts
take, and their largest errors against steps of a much lower tolerance.
"""

from contextlib import ExitStack, contextmanager
from unittest.mock import patch

import numpy as np

import mdr_core as mdr
from mdr_core.solver.contact import creep_loading, yielding
from mdr_core.solver.contact.yielding import RadiusCap, YieldRule
from mdr_core.solver.impacts import collocation_steps, contact_time, motion_solver

SHAPES = (
    mdr.Sphere(1e-6),
    mdr.Hyperboloid(0.3, 1e-6),
    mdr.RoundedCone(1e-6, 0.3),
    mdr.TruncatedCone(1e-6, 0.3),
    mdr.ParabolicPunch(1e-5, 1e-6),
)
MEDIA = {
    "q_c": mdr.Medium(1e9, q_c=5.0),
    "q_c, 10⁷ critical depths": mdr.Medium(1e9, q_c=5e-6),
    "H, q_c, f_c": mdr.Medium(1e9, q_c=5.0, hardness=1e7, f_c=1e-7),
}
SPEEDS = np.geomspace(1e-6, 10.0, 60)
#: Values that are tried for each share of a step.
SHARES = {
    "_FIRST": (0.3, 0.5, 0.6, 0.7, 0.8, 1.0),
    "_STOPPING": (0.3, 0.5, 1.0, 1.5),
    "_RETURNED": (0.2, 0.3, 0.5, 0.7, 1.0),
    "_SAFETY": (0.8, 0.82, 0.85, 0.92, 0.95, 1.0),
    "_POWER": (22, 27, 28, 36, 50, 60),
    "_SHORTER": (0.1, 0.2, 0.5, 0.7),
    "_AGAIN": (0.8, 0.82, 0.88, 0.9, 0.93),
    "_NEAR": (0.9, 0.999),
}


def values(medium):
    """Contact times (s) and plastic work (J) of all impacts, an array for each shape."""
    # A sphere is not pressed as deep as its equator.
    speeds = SPEEDS if medium.q_c > 1 else SPEEDS / 300
    for shape in SHAPES:
        hit = mdr.impact(shape, medium, 1e-12, speeds)
        yield np.array([hit.contact_time, hit.plastic_work])


def error(medium, target, name, cuts, exact):
    """Largest relative errors of contact time and of plastic work with these cuts."""
    with patch.object(target, name, cuts):
        tried = [np.abs(got / right - 1) for got, right in zip(values(medium), exact, strict=True)]
    return [max(float(np.nanmax(part[i], initial=0.0)) for part in tried) for i in (0, 1)]


def table(what, medium, target, name, candidates, dense):
    """Prints the errors of the candidates."""
    with patch.object(target, name, dense), np.errstate(all="ignore"):
        exact = list(values(medium))
    print(f"{what}, contact time and plastic work:")
    with np.errstate(all="ignore"):
        for tried in candidates:
            time, work = error(medium, target, name, tried, exact)
            print(f"  {np.array2string(np.asarray(tried), precision=3):60} {time:9.1e} {work:9.1e}")


def creeps():
    """Works of the dashpots (J) under a force that is ramped, held and taken away, an array a shape."""
    time = np.array([0.0, 0.1, 1.0, 3.0, 3.2, 4.0]) * 1e-8
    for shape in (*SHAPES, mdr.Cone(0.3)):
        for medium in (mdr.Medium(1e9, eta=2.5), mdr.Medium(1e9, q_c=5.0, eta=2.5)):
            force = np.array([0.0, 0.1, 1.0, 1.0, 0.5, 0.0]) * 1e-5
            yield mdr.creep(shape, medium, force, time, tolerance=1e-10).viscous_work[1:]


def creep_table(candidates, dense):
    """Prints the largest errors of the works in creep, over the largest work, for numbers of nodes."""
    with patch.object(creep_loading, "_NODES", dense):
        exact = list(creeps())
    print("_NODES of creep, work of the dashpots:")
    for tried in candidates:
        with patch.object(creep_loading, "_NODES", tried):
            pairs = list(zip(creeps(), exact, strict=True))
        largest = max(np.max(np.abs(got - right)) / right[-1] for got, right in pairs)
        print(f"  {tried!s:60} {largest:9.1e}")


def viscous():
    """Shapes, media and speeds (m/s) of viscous impacts, elastic ones and such that yield."""
    for shape in (*SHAPES, mdr.Cone(0.3), mdr.FlatPunch(1e-6), mdr.PowerLaw(2e-4, 0.5)):
        for medium in (mdr.Medium(1e9), mdr.Medium(1e9, q_c=10.0)):
            speeds = np.geomspace(1e-4, 1.0, 9)
            time = mdr.impact(shape, medium, 1e-12, speeds).contact_time
            eta = np.geomspace(1e-4, 1e4, 9)[:, None] * time * medium.E_star / 4
            yield shape, mdr.Medium(medium.E_star, q_c=medium.q_c, eta=eta), speeds


@contextmanager
def counted(counts):
    """Where the numbers of steps that are tried are appended to a list."""
    solved = collocation_steps.Steps.solved

    def noted(steps):
        counts.append(len(steps.length))
        return solved(steps)

    with patch.object(collocation_steps.Steps, "solved", noted):
        yield


def stepped(problems):
    """Depths, restitutions, contact times and largest forces, of shape (4, …), one array a problem."""
    for shape, medium, speeds in problems:
        hit = mdr.impact(shape, medium, 1e-12, speeds)
        yield np.array([hit.max_depth, hit.restitution, hit.contact_time, hit.max_force])


def shares_table():
    """Prints numbers of steps, and errors, for values of each share of a step in `motion_solver`."""
    problems, present = list(viscous()), motion_solver.solve.__defaults__
    finer = {"_FIRST": 0.3, "_RETURNED": 0.2, "_STOPPING": 0.3}
    with ExitStack() as stack:
        stack.enter_context(patch.object(motion_solver.solve, "__defaults__", (1e-12,)))
        for name, share in finer.items():
            stack.enter_context(patch.object(motion_solver, name, share))
        exact = list(stepped(problems))
    print(f"shares of steps at the tolerance {present[0]:g}: steps; depth, e, time; largest force:")
    for name, tried in SHARES.items():
        for share in (getattr(motion_solver, name), *tried):
            counts = []
            with patch.object(motion_solver, name, share), counted(counts):
                pairs = zip(stepped(problems), exact, strict=True)
                errors = [np.abs(got / right - 1).max(axis=(1, 2)) for got, right in pairs]
            *three, force = np.max(errors, axis=0)
            print(f"  {name:12} {share:7.3f} {sum(counts):7} {max(three):9.1e} {force:9.1e}")


def main():
    """Prints the tables."""
    shares_table()
    for what, medium in MEDIA.items():
        counts = (14, 6), (20, 9), (28, 9), (28, 12), (28, 18), (40, 12)
        table(f"NODES, {what}", medium, contact_time, "NODES", counts, (56, 40))
    table("_NODES of RadiusCap", MEDIA["H, q_c, f_c"], yielding, "_NODES", (8, 12, 16, 20, 24, 32), 64)
    shares = ([], [1.0], [6.0], [0.5, 3.0], [1.0, 6.0], [2.0, 12.0], [1.0, 3.0, 9.0])
    shares = [np.array(share) for share in shares]
    dense = np.geomspace(0.1, 100.0, 17)
    for what, medium in MEDIA.items():
        table(f"TRANSITIONS, {what}", medium, yielding, "TRANSITIONS", shares, dense)
    creep_table((4, 6, 8, 12, 16), 40)
    for what, medium in MEDIA.items():
        rule = RadiusCap if medium.f_c else YieldRule
        first, factor = rule.scales[0], rule.scales[1] / rule.scales[0]
        tried = [first * factor ** np.arange(n) for n in (0, 1, 3, 6)]
        tried += [2 * rule.scales, rule.scales / 2, first * (factor**2) ** np.arange(3)]
        dense = first / factor * factor ** (np.arange(0, 64) / 8)
        table(f"scales of {rule.__name__}, {what}", medium, rule, "scales", tried, dense)


if __name__ == "__main__":
    main()
