"""What each cache and fast path of the solver gains: time without it over time with it, in pairs.

python -m tests.benchmarks.fast_paths

A cache or a fast path stays if it gains more than a factor of 1.3 for the call that it is for.
"""

import itertools
import sys
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from statistics import median
from time import perf_counter
from unittest.mock import patch

import numpy as np

import mdr_core as mdr
from mdr_core.base import check
from mdr_core.solver.contact import adhesion, creep_retreat, indentation, integrals, quadrature
from mdr_core.solver.impacts import contact_time, energy_balance, motion
from mdr_core.solver.numerics import gauss
from mdr_core.solver.own import law
from mdr_core.solver.profiles import radius_table
from mdr_core.solver.profiles.power import PowerLaw, kappa

from ..laws import Layered

DRY, HARD = mdr.Medium(1e9, q_c=10.0), mdr.Medium(1e9, q_c=10.0, hardness=1e7)
WET = mdr.Medium(1e9, q_c=10.0, eta=3.0)
STICKY = mdr.Medium(1e9, q_c=10.0, work_of_adhesion=0.01)
R = np.linspace(0, 2e-5, 400)
CONE, POWER = mdr.Cone(0.2), mdr.PowerLaw(1e3, 1.7)
TIP, ROUND = mdr.Sampled(R, R**2 / 2e-5), mdr.RoundedCone(1e-5, 0.2)
SMOOTH = mdr.Smooth(lambda r: 0.2 * np.tanh(r / 1e-6))
SPEEDS = np.geomspace(1e-3, 1.0, 300)


@dataclass(frozen=True)
class Wear(mdr.HardnessLaw):
    """A law of hardness of one's own."""

    def at(self, a):
        return 1e7 + 10.0 / a

    def rate(self, a):
        return -10.0 / a**2


OWN = mdr.Medium(1e9, hardness=Wear())
STEP = mdr.Medium(1e9, hardness=Layered(1e7, 0.5, 1e-7, 1e-3))


def times(profile, speeds=SPEEDS, medium=DRY):
    """Contact times of impacts."""
    return mdr.impact(profile, medium, 1e-9, speeds).contact_time


def one_by_one(profile, medium=DRY, count=20):
    """Forces of single states."""
    return [mdr.indent(profile, medium, depth).force for depth in np.linspace(1e-8, 1e-6, count)]


def hits(profile, medium=DRY, count=20, speeds=SPEEDS):
    """Impacts, one call each."""
    return [mdr.impact(profile, medium, 1e-9, speed).restitution for speed in speeds[-count:]]


def uncached(module, name):
    """Where a cached function of a module is called each time."""
    return patch.object(module, name, getattr(module, name).__wrapped__)


def onset_first(rule, target, before):
    """The first guess of a turning point without a table."""
    onset = rule.penetration(before, before)
    return np.where((onset > 0) & (onset < np.inf), onset, 1.0)


DEPTHS = np.linspace(1e-8, 1e-6, 2000)


def by_ratio(kind, profile, ratio):
    """`_similar_time` by quadrature, each time."""
    result = np.empty_like(ratio)
    for start in range(0, ratio.size, 256):
        rows = slice(start, start + 256)
        result[rows] = contact_time._ratio(*kind.at_ratio(profile, ratio[rows]))
    return result


def plain(profile, depth):
    """The profile itself."""
    return profile


def without_guess():
    """Where turning points are sought from the onset of yield on."""
    return patch.object(energy_balance, "_first_guess", onset_first)


def without_coefficient():
    """`PowerLaw._reduced_coefficient` computed each time."""
    new = property(lambda profile: kappa(profile.exponent) * profile.coefficient)
    return patch.object(PowerLaw, "_reduced_coefficient", new)


def sharp():
    """The module and name of radii where a law changes fast, and the function without its cache."""
    return law, "_known", law._known.__wrapped__


@contextmanager
def recomputed(owner, *names):
    """Where values that objects of a class keep are computed each time that they are read."""
    with ExitStack() as stack:
        for name in names:
            stack.enter_context(patch.object(owner, name, property(vars(owner)[name].func)))
        yield


@contextmanager
def uncached_everywhere(function):
    """Where a cached function of the core is called each time, in all modules that have imported it."""
    with ExitStack() as stack:
        for name, module in list(sys.modules.items()):
            if name.startswith("mdr_core") and vars(module).get(function.__name__) is function:
                stack.enter_context(patch.object(module, function.__name__, function.__wrapped__))
        yield


@contextmanager
def tables_for_one():
    """Where a single depth is enough for a table of the profile."""
    with patch.object(integrals, "_FEW", 0), patch.object(integrals, "_FEW_A_KINK", 0):
        yield


def no_tables():
    """Where no number of depths is enough for a table of the profile."""
    return patch.object(integrals, "_FEW", np.inf)


def new_tip(count, calls=1, samples=400, medium=DRY):
    """Restitutions of impacts of a tip that is new, so that no table of it is kept, in so many calls."""
    r = np.linspace(0, 2e-5, samples)
    tip = mdr.Sampled(r, r**2 / (2e-5 + next(NUMBER) * 1e-12))
    speeds = np.geomspace(0.01, 0.2, count)
    return [mdr.impact(tip, medium, 1e-9, speeds).restitution for _ in range(calls)]


NUMBER = itertools.count()


def crept(profile, medium):
    """Depths of creep: a ramp, a hold, and a force that is taken away in steps."""
    time = np.append(np.linspace(0, 1e-7, 5), 1e-7 + np.linspace(1e-9, 1e-6, 40))
    force = np.append([0, 0.5, 1, 1, 1], np.linspace(0.9, 0, 40)) * 1e-4
    return mdr.creep(profile, medium, force, time)


def shapeless():
    """`Parameters.shape` computed each time."""
    return patch.object(check.Parameters, "shape", property(check.Parameters.shape.func))


#: What, without it, and the call that it is for.
PATHS = (
    ("_similar_time, 300 cones", lambda: patch.object(contact_time, "_similar_time", by_ratio),
     lambda: times(CONE)),
    ("_similar_time, 10⁵ cones", lambda: patch.object(contact_time, "_similar_time", by_ratio),
     lambda: times(CONE, np.geomspace(1e-3, 1.0, 10**5))),
    ("its coefficients kept, a cone", lambda: uncached(contact_time, "_table"), lambda: times(CONE, 0.1)),
    ("Tabulated, times of 300 samples", lambda: patch.object(integrals, "_tabulated", plain),
     lambda: times(TIP, SPEEDS / 5)),
    ("Tabulated, 20 viscous, samples", lambda: patch.object(integrals, "_tabulated", plain),
     lambda: times(TIP, SPEEDS[::15] / 5, WET)),
    ("Tabulated, 20 viscous, smooth", lambda: patch.object(integrals, "_tabulated", plain),
     lambda: times(SMOOTH, SPEEDS[::15], WET)),
    ("Tabulated, one time, samples", lambda: patch.object(integrals, "_tabulated", plain),
     lambda: times(TIP, 0.1)),
    ("Tabulated kept, 300 samples", lambda: patch.object(integrals, "_tabulated", integrals.Tabulated),
     lambda: times(TIP, SPEEDS / 5)),
    ("_first_guess (_inverses), 300 samples", without_guess,
     lambda: mdr.impact(TIP, DRY, 1e-9, SPEEDS / 5).restitution),
    ("_first_guess (_inverses), 10⁵ rounded cones",
     without_guess,
     lambda: mdr.impact(ROUND, DRY, 1e-9, np.geomspace(1e-3, 1.0, 10**5)).restitution),
    ("_zone_integrals kept, 20 states of samples", lambda: uncached(quadrature, "_zone_integrals"),
     lambda: one_by_one(TIP)),
    ("_zone_integrals kept, 2000 states at once", lambda: uncached(quadrature, "_zone_integrals"),
     lambda: mdr.indent(TIP, DRY, DEPTHS).force),
    ("_SHORT, 2000 states of rounded cones", lambda: patch.object(integrals, "_SHORT", ()),
     lambda: mdr.indent(ROUND, DRY, DEPTHS * 100).force),
    ("_growing_mean_slope kept, samples, H", lambda: uncached(integrals, "_growing_mean_slope"),
     lambda: one_by_one(TIP, HARD)),
    ("_ranges kept, samples, adhesion", lambda: uncached(adhesion, "_ranges"),
     lambda: one_by_one(TIP, STICKY)),
    ("_known kept, a smooth law", lambda: patch.object(*sharp()), lambda: times(CONE, 0.1, OWN)),
    ("_known kept, a step", lambda: patch.object(*sharp()), lambda: times(CONE, 0.1, STEP)),
    ("PowerLaw._reduced_coefficient kept",
     without_coefficient,
     lambda: one_by_one(POWER)),
    ("Parameters.shape kept, single states", shapeless, lambda: one_by_one(CONE)),
    ("_LONG, 2000 elastic states of rounded cones", lambda: patch.object(integrals, "_LONG", np.inf),
     lambda: mdr.indent(ROUND, mdr.Medium(1e9), DEPTHS * 100).force),
    ("_LONG, 10⁵ impacts of rounded cones", lambda: patch.object(integrals, "_LONG", np.inf),
     lambda: mdr.impact(ROUND, DRY, 1e-9, np.geomspace(1e-3, 1.0, 10**5)).restitution),
    ("_FEW, 1 impact of a new tip", tables_for_one, lambda: new_tip(1)),
    ("_FEW, 64 impacts of a new tip", tables_for_one, lambda: new_tip(64)),
    ("_FEW, 64 impacts of a new tip of 30 samples", tables_for_one, lambda: new_tip(64, samples=30)),
    ("_FEW, 60 impacts with adhesion", tables_for_one, lambda: new_tip(60, samples=100, medium=STICKY)),
    ("tables, 1000 impacts of a new tip of 30 samples", no_tables, lambda: new_tip(1000, samples=30)),
    ("tables, 8000 impacts of a new tip", no_tables, lambda: new_tip(8000)),
    ("tables, 10 times 64 impacts of a new tip of 30", no_tables, lambda: new_tip(64, 10, 30)),
    ("Indentation._quick, 20,000 states of samples", lambda: patch.object(indentation, "_MANY", np.inf),
     lambda: mdr.indent(TIP, DRY, np.linspace(1e-8, 1e-6, 20_000)).force),
    ("Indentation._quick, 10⁵ states of samples", lambda: patch.object(indentation, "_MANY", np.inf),
     lambda: mdr.indent(TIP, DRY, np.linspace(1e-8, 1e-6, 10**5)).force),
    ("Indentation._quick, 20,000 states, smooth", lambda: patch.object(indentation, "_MANY", np.inf),
     lambda: mdr.indent(SMOOTH, DRY, np.linspace(1e-8, 1e-6, 20_000)).force),
    ("dense_motion kept, two motions", lambda: uncached_everywhere(motion.dense_motion),
     lambda: (lambda hit: (hit.motion(50), hit.motion(200)))(mdr.impact(ROUND, WET, 1e-9, 0.1))),
    ("arrays of samples kept, 20 states",
     lambda: recomputed(mdr.Sampled, "_r", "_z", "_slope", "_bend"), lambda: one_by_one(TIP)),
    ("Sampled._g kept, 20 states", lambda: recomputed(mdr.Sampled, "_g"), lambda: one_by_one(TIP)),
    ("Sampled._slope_inside kept, 20 states", lambda: recomputed(mdr.Sampled, "_slope_inside"),
     lambda: one_by_one(TIP)),
    ("Smooth._mean_slope kept, 20 states", lambda: recomputed(mdr.Smooth, "_mean_slope"),
     lambda: one_by_one(SMOOTH, count=3)),
    ("Tabulated.table kept, 300 samples", lambda: recomputed(radius_table.Tabulated, "table"),
     lambda: times(TIP, SPEEDS[::100] / 5)),
    ("RadiusTable._inverses kept, 300 samples", lambda: recomputed(radius_table.RadiusTable, "_inverses"),
     lambda: mdr.impact(TIP, DRY, 1e-9, SPEEDS / 5).restitution),
    ("RadiusTable._inverses kept, one rounded cone",
     lambda: recomputed(radius_table.RadiusTable, "_inverses"), lambda: hits(ROUND)),
    ("_unit_table kept, a state", lambda: uncached_everywhere(radius_table._unit_table),
     lambda: mdr.indent(ROUND, DRY, 1e-6).force),
    ("_unit kept, 20 states", lambda: uncached_everywhere(radius_table._unit), lambda: one_by_one(ROUND)),
    ("gauss_legendre kept, 20 states", lambda: uncached_everywhere(gauss.gauss_legendre),
     lambda: one_by_one(ROUND)),
    ("gauss_legendre kept, a contact time", lambda: uncached_everywhere(gauss.gauss_legendre),
     lambda: times(ROUND, 0.1)),
    ("_rule kept, a contact time", lambda: uncached(contact_time, "_rule"), lambda: times(ROUND, 0.1)),
    ("tanh_sinh kept, a reduced height", lambda: uncached_everywhere(gauss.tanh_sinh),
     lambda: SMOOTH.reduced(1e-6)),
    ("Retreat.states kept, elements in creep", lambda: recomputed(creep_retreat.Retreat, "states"),
     lambda: crept(ROUND, WET).elements(np.linspace(0, 1e-6, 50))),
    ("Retreat.length kept, creep", lambda: recomputed(creep_retreat.Retreat, "length"),
     lambda: crept(ROUND, WET)),
    ("Retreat._edges kept, creep", lambda: recomputed(creep_retreat.Retreat, "_edges"),
     lambda: crept(ROUND, WET)),
    ("_parameters kept, 100 cones", lambda: uncached_everywhere(check._parameters),
     lambda: [mdr.Cone(slope=0.2 + 0.01 * i) for i in range(100)]),
    ("_is_double, 100 media", lambda: patch.object(check, "_is_double", lambda value: False),
     lambda: [mdr.Medium(1e9, q_c=10.0 + i) for i in range(100)]),
)  # fmt: skip


def gain(without, call, pairs=5):
    """Median over pairs of the time without a fast path over that with it."""
    ratios, took = [], 0.0
    call()
    for _ in range(pairs):
        start = perf_counter()
        call()
        middle = perf_counter()
        with ExitStack() as stack:
            stack.enter_context(without())
            begin = perf_counter()
            call()
            took = perf_counter() - begin
        ratios.append(took / (middle - start))
        if took > 0.5:
            # So long a time needs no median.
            break
    return median(ratios), took


def main():
    """Prints a line for each."""
    for what, without, call in PATHS:
        ratio, took = gain(without, call)
        print(f"{what:55} {ratio:8.2f}   {1e3 * took:9.1f} ms without", flush=True)


if __name__ == "__main__":
    main()
