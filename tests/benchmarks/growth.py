"""How cost grows with the number of things, what memory it takes, and how far the floors are."""

import tracemalloc

import numpy as np

import mdr_core as mdr

from .harness import exponent, seconds
from .shapes import CONE, SOFT

_DEEP = 1e8 * SOFT.critical_depth
_SPEEDS = 1e-4, 10.0


def floors(quick=False):
    """Time (s) for one number of what no answer can do without: a copy, a power, a logarithm."""
    x = np.linspace(1.0, 2.0, 10**4 if quick else 10**6)
    target = np.empty_like(x)
    calls = {
        "memory copy": lambda: np.copyto(target, x),
        "np.power": lambda: np.power(x, 1.5, out=target),
        "np.arccosh": lambda: np.arccosh(x, out=target),
    }
    return {name: seconds(call) / x.size for name, call in calls.items()}


def _depths(n):
    depths = np.linspace(1e-9, 1e-6, n)
    return lambda: mdr.indent(CONE, SOFT, depths).force


def _power_depths(n):
    shape, depths = mdr.PowerLaw(1.0, 1.5), np.linspace(1e-9, 1e-6, n)
    return lambda: mdr.indent(shape, mdr.Medium(1e9), depths).force


def _radii(n):
    state = mdr.indent(CONE, SOFT, _DEEP)
    r = np.linspace(0.01, 0.99, n) * state.contact_radius
    return lambda: state.pressure(r)


def _springs(n):
    row = mdr.Foundation(CONE, SOFT, n // 2 * 2, 1.01 * float(CONE.contact_radius(_DEEP)))
    return lambda: row.advance(_DEEP)


def _impacts(quantity):
    def prepare(n):
        speeds = np.geomspace(*_SPEEDS, n)
        return lambda: getattr(mdr.impact(CONE, SOFT, 1e-9, speeds), quantity)

    return prepare


def _nodes(n):
    x = np.linspace(0.0, 1.0, n)
    return lambda: mdr.abel.stress_from_line_load(x, 1 - x * x, x)


# What is counted: how it is prepared, the largest number, and the floor it is compared with.
_COUNTED = {
    "force of a cone, depths": (_depths, 10**6, "memory copy"),
    "force of a power law, depths": (_power_depths, 10**6, "np.power"),
    "pressure of a cone, radii": (_radii, 10**6, "np.arccosh"),
    "restitution of a cone, impacts": (_impacts("restitution"), 10**6, "np.power"),
    "contact time of a cone, impacts": (_impacts("contact_time"), 10**5, "np.power"),
    "transform, nodes and radii": (_nodes, 10**5, "np.arccosh"),
    "chain, elements": (_springs, 10**6, "memory copy"),
}


def growth(floor, quick=False):
    """One record for each count: times, fitted exponent, peak memory and distance to the floor."""
    records = []
    for name, (prepare, largest, nearest) in _COUNTED.items():
        largest = 1000 if quick else largest
        sizes = np.geomspace(100, largest, 5).astype(int)
        times = [seconds(prepare(n), runs=1 if n > 10**5 else 3) for n in sizes]
        records.append(
            {
                "what": name,
                "sizes": sizes.tolist(),
                "seconds": times,
                "exponent": exponent(sizes, times),
                "bytes_each": _peak(prepare(largest)) / largest,
                "floor": nearest,
                "floors": times[-1] / largest / floor[nearest],
            }
        )
    return records


def _peak(call):
    """Largest memory (bytes) that a call takes beyond what was there."""
    tracemalloc.start()
    call()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def million(quick=False):
    """Seconds for a million fast impacts, 5·10⁵ to 2·10⁶ critical depths deep, all of them solved."""
    speeds = np.linspace(0.9, 3.6, 1000 if quick else 10**6)
    return {
        quantity: 10**6 / speeds.size * seconds(_many(speeds, quantity), runs=1)
        for quantity in ("restitution", "contact_time")
    }


def _many(speeds, quantity):
    return lambda: getattr(mdr.impact(CONE, SOFT, 1e-9, speeds), quantity)
