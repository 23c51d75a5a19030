"""The problems of the report, each with its exact answer and the methods that answer it."""

import math

import numpy as np
from scipy.integrate import quad

import mdr_core as mdr

from . import exact, peers
from .harness import ELEMENTS, TOLERANCES, Method, Problem, ladder
from .stepping import STEPPING, stepped
from .stepping import exact as viscous

CONE = mdr.Cone(0.1)
ELASTIC, SOFT, WET = mdr.Medium(1e9), mdr.Medium(1e9, q_c=1e-3), mdr.Medium(1e9, q_c=6.0, eta=2.0)
_DEEP = 1e8 * SOFT.critical_depth
_MASS = 1e-9


def problems(quick=False):
    """All of them; `quick` in small sizes."""
    yield _field(quick)
    yield _pressure(quick)
    fast = mdr.indent(CONE, SOFT, np.array([[5e5], [2e6]]) * SOFT.critical_depth)
    ends = np.sqrt(2 * (fast.stored_energy + fast.plastic_work) / _MASS).ravel()
    for index, quantity in ((1, "restitution"), (2, "contact time")):
        yield _impacts("cone, 10⁶ critical depths deep", SOFT, ends, quantity, index, quick)
        # Its references take longest, and the report on accuracy has them too.
        if not quick:
            yield _impacts(
                "viscous medium, 100 critical depths deep", WET, (0.5, 2.0), quantity, index, quick
            )


def _field(quick):
    """The pressure of an elastic cone on square grids, beside boundary elements."""
    depth, methods = 1e-6, []

    def error(pressure):
        return peers.Square(CONE, ELASTIC, depth, math.isqrt(pressure.size)).error(pressure)

    for n in (32,) if quick else (64, 128, 256):
        square = peers.Square(CONE, ELASTIC, depth, n)

        def prepare(r=square.r):
            return lambda: mdr.indent(CONE, ELASTIC, depth).pressure(r)

        methods += [Method("mdr_core", f"{n}²", prepare), *peers.boundary_elements(square)]
    return Problem("pressure", "elastic cone, field on a grid", 1, error, tuple(methods))


def _pressure(quick):
    """Radii in the plastic zone, from the axis on, where elastic pressures hardly differ."""
    c, a = (float(CONE.contact_radius(d)) for d in (_DEEP - SOFT.critical_depth, _DEEP))
    r = c * np.geomspace(1e-9, 0.99, 1000)
    probes = r[::50]
    reference = exact.pressure(CONE, SOFT, _DEEP, probes)
    slope = SOFT.E_star * CONE.slope / 2

    def error(pressure):
        return reference.error(pressure if len(pressure) == len(probes) else pressure[::50])

    def difference():
        return slope * (np.arccosh(np.maximum(a / r, 1)) - np.arccosh(np.maximum(c / r, 1)))

    def load(x, r):
        return slope / math.sqrt((x - r) * (x + r))

    def as_it_stands(tolerance):
        return np.array(
            [quad(load, c, a, (each,), epsabs=0, epsrel=tolerance)[0] for each in probes.tolist()]
        )

    def chain(n):
        row = mdr.Foundation(CONE, SOFT, n, a * (1 + 1 / n)).advance(_DEEP)
        right = row.x > 0
        return -mdr.abel.stress_from_line_load(row.x[right], row.line_load[right], r)

    methods = (
        Method("mdr_core", "", lambda: lambda: mdr.indent(CONE, SOFT, _DEEP).pressure(r)),
        Method("difference of curves", "", lambda: difference),
        *ladder("scipy quad", "epsrel = {:g}", TOLERANCES, as_it_stands, len(probes)),
        *ladder("chain", "n = {}", ELEMENTS[: 2 if quick else None], chain),
    )
    return Problem("pressure", "cone, 10⁸ critical depths deep", len(r), error, methods)


def _impacts(title, medium, ends, quantity, index, quick):
    """One of the numbers of fast impacts of a cone: at once, and in a loop over some of them."""
    speeds = np.linspace(*ends, 100 if quick else 1000)
    step = len(speeds) // 2
    probes = speeds[::step].tolist()
    if medium.eta > 0:
        # References of 50 digits take seconds, ones that do for a quick look less.
        reference = viscous(CONE, medium, _MASS, probes, 24 if quick else 50)[index]
    else:
        reference = exact.impacts(CONE, medium, _MASS, tuple(probes))[index]
    attribute = quantity.replace(" ", "_")

    def error(values):
        return reference.error(values if len(values) == len(probes) else values[::step])

    def steps(method):
        return lambda tol: np.array([stepped(CONE, medium, _MASS, v, method, tol)[index] for v in probes])

    def chain(tolerance):
        hits = [mdr.chain_impact(CONE, medium, _MASS, speed, tolerance=tolerance) for speed in probes]
        return np.array([getattr(hit, attribute) for hit in hits])

    def solved():
        return getattr(mdr.impact(CONE, medium, _MASS, speeds), attribute)

    methods = [Method("mdr_core", "", lambda: solved)]
    for method, tolerances in STEPPING.items():
        methods += ladder("solve_ivp " + method, "rtol = {:g}", tolerances, steps(method), len(probes))
    # It makes both quantities at once: a quick look needs one of them.
    quick_ones = (1e-4,) if quantity == "restitution" else ()
    tolerances = quick_ones if quick else (1e-4, 1e-6)
    methods += ladder("chain_impact", "tolerance = {:g}", tolerances, chain, len(probes))
    return Problem(quantity, title, len(speeds), error, tuple(methods))
