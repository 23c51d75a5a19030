"""Time of the hot calls as ratios to NumPy's own functions in the same process.

    python -m tests.benchmarks.speed

Medians of several runs; 10⁶ depths or impacts, 500 radii, N nodes of a transform.
"""

from statistics import median
from time import perf_counter

import numpy as np

import mdr_core as mdr

from ..shapes import SHAPES, name

MEDIUM = mdr.Medium(1e9, 1.0)
MILLION = np.linspace(1e-9, 1e-5, 10**6)


def seconds(call, runs=7):
    """Median time of a call."""
    times = []
    for _ in range(runs):
        start = perf_counter()
        call()
        times.append(perf_counter() - start)
    return median(times)


def main():
    power = seconds(lambda: np.power(MILLION, 1.5))
    arccosh = seconds(lambda: np.arccosh(1 + MILLION)) / MILLION.size
    print(f"np.power(x, 1.5), 10⁶ doubles: {power * 1e3:.1f} ms; np.arccosh: {arccosh * 1e9:.1f} ns each")
    print("\nindent(...) over 10⁶ depths, ratio to np.power; fields of one state at 500 radii, ms")
    for shape in SHAPES:
        force, radius = (
            seconds(lambda q=quantity, s=shape: getattr(mdr.indent(s, MEDIUM, MILLION), q), runs=3) / power
            for quantity in ("force", "contact_radius")
        )
        state = mdr.indent(shape, MEDIUM, 3 * MEDIUM.critical_depth)
        r = np.linspace(0, 1, 500) * state.contact_radius
        pressure = seconds(lambda s=state, r=r: s.pressure(r), runs=21) * 1e3
        print(f"{name(shape):20} force {force:6.1f}   radius {radius:6.1f}   pressure {pressure:.2f} ms")
    cone = mdr.indent(mdr.Cone(0.3), MEDIUM, 3 * MEDIUM.critical_depth)
    r = np.linspace(0.01, 0.99, 10**6) * cone.contact_radius
    ratio = seconds(lambda: cone.pressure(r)) / 1e6 / arccosh
    print(f"\nCone pressure per radius, ratio to np.arccosh: {ratio:.1f}")
    print("\nimpact(...), 10⁵ at once, time of 10⁶ as ratio to np.power")
    speed = np.geomspace(1e-4, 10, 10**5)
    for shape in SHAPES[:3]:
        restitution, contact_time = (
            10
            * seconds(lambda q=q, s=shape: getattr(mdr.impact(s, MEDIUM, 1e-6, speed), q), runs=1)
            / power
            for q in ("restitution", "contact_time")
        )
        print(f"{name(shape):20} restitution {restitution:7.1f}   contact time {contact_time:7.1f}")
    print("\nstress_from_line_load at all of N nodes")
    for count in (10**3, 2 * 10**4, 10**5):
        x = np.linspace(0, 1, count)
        time = seconds(lambda x=x: mdr.abel.stress_from_line_load(x, 1 - x * x, x), runs=3)
        print(f"N = {count:7d}  {time * 1e3:8.1f} ms")


if __name__ == "__main__":
    main()
