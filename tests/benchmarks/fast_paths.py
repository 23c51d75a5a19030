"""What each cache and fast path of the solver gains: time without it over time with it, in pairs.

python -m tests.benchmarks.fast_paths

A cache or a fast path stays if it gains more than a factor of 1.3 for the call that it is for.
"""

from contextlib import ExitStack
from dataclasses import dataclass
from statistics import median
from time import perf_counter
from unittest.mock import patch

import numpy as np

import mdr_core as mdr
from mdr_core import _check, hardness
from mdr_core.contact import adhesion, integrals, quadrature
from mdr_core.impacts import contact_time, energy_balance
from mdr_core.profiles.power import PowerLaw, kappa

DRY, HARD = mdr.Medium(1e9, 10.0), mdr.Medium(1e9, 10.0, hardness=1e7)
WET = mdr.Medium(1e9, 10.0, eta=3.0)
STICKY = mdr.Medium(1e9, 10.0, work_of_adhesion=0.01)
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
    return hardness, "_sharp_radii", hardness._sharp_radii.__wrapped__


def shapeless():
    """`Parameters.shape` computed each time."""
    return patch.object(_check.Parameters, "shape", property(_check.Parameters.shape.func))


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
    ("_sharp_radii kept, own law, impacts", lambda: patch.object(*sharp()), lambda: hits(CONE, OWN, 5)),
    ("PowerLaw._reduced_coefficient kept",
     without_coefficient,
     lambda: times(POWER, SPEEDS[::15], WET)),
    ("Parameters.shape kept, single states", shapeless, lambda: one_by_one(CONE)),
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
