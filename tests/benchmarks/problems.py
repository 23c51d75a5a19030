"""The problems of the report, each with its exact answer and the methods that answer it."""

import math

import numpy as np
from scipy.integrate import quad

import mdr_core as mdr

from . import exact, peers
from .harness import ELEMENTS, TOLERANCES, Method, Problem, ladder
from .stepping import STEPPING, stepped
from .stepping import exact as viscous

CONE, DEPTH, MASS = mdr.Cone(0.1), 1e-6, 1e-9
ELASTIC, WET = mdr.Medium(1e9), mdr.Medium(1e9, q_c=6.0, eta=2.0)
#: Media by the depth of 1 µm over their critical depth.
YIELDING = {
    name: mdr.Medium(1e9, q_c=2 * 1e9 * DEPTH / (np.pi * ratio))
    for name, ratio in (("5", 5), ("10⁴", 1e4), ("10⁸", 1e8))
}


def problems(quick=False):
    """All of them; `quick` in small sizes."""
    for name, medium in YIELDING.items():
        title = f"cone, {name} critical depths deep"
        yield _force(title, medium)
        yield _forces(title, medium, 1000 if quick else 10**6)
        # From 0.8 to 1.25 of the depth.
        state = mdr.indent(CONE, medium, np.array([[0.8], [1.25]]) * DEPTH)
        ends = np.sqrt(2 * (state.stored_energy + state.plastic_work) / MASS).ravel()
        yield _impacts(title, medium, ends, quick)
    # Its references take longest, and the report on accuracy has them too.
    if not quick:
        yield _impacts("viscous medium, 100 critical depths deep", WET, (0.5, 2.0), quick)
    yield _field(quick)
    yield _pressure(quick)


def _force(title, medium):
    """One force of a cone. The plain formula is the difference of two elastic curves."""
    E_star, slope, q_c = medium.E_star, CONE.slope, medium.q_c

    def plain():
        critical = math.pi * q_c / (2 * E_star)
        return 2 * E_star / (math.pi * slope) * (DEPTH**2 - max(DEPTH - critical, 0.0) ** 2)

    methods = (
        Method("plain formula", "", lambda: plain),
        Method("mdr_core", "", lambda: lambda: mdr.indent(CONE, medium, DEPTH).force),
    )
    return Problem("force", title, 1, exact.force(CONE, medium, [DEPTH]).error, methods)


def _forces(title, medium, count):
    """Many forces of a cone at once, by the same formula in NumPy."""
    depth = DEPTH * np.linspace(0.8, 1.25, count)
    probes = slice(None, None, count // 20)
    reference = exact.force(CONE, medium, depth[probes])

    def plain():
        critical = np.pi * medium.q_c / (2 * medium.E_star)
        factor = 2 * medium.E_star / (np.pi * CONE.slope)
        return factor * (depth**2 - np.maximum(depth - critical, 0.0) ** 2)

    methods = (
        Method("plain formula", "", lambda: plain),
        Method("mdr_core", "", lambda: lambda: mdr.indent(CONE, medium, depth).force),
    )
    return Problem("force", title, count, lambda force: reference.error(force[probes]), methods)


def plain_impacts(medium, speed):
    """Restitution and contact time of a cone that yields: one formula for each stage of the impact.

    With φ = k d², the force is k d² up to d_c, k d_c (2d − d_c) up to the largest depth, and k ℓ(ℓ + 2d_p)
    on the way back, with the live depth ℓ. Gauss's rule integrates the first and the last stage.
    """
    k, critical = 2 * medium.E_star / (np.pi * CONE.slope), np.pi * medium.q_c / (2 * medium.E_star)
    energy = MASS * speed**2 / 2
    plastic = np.sqrt(energy / (k * critical) - critical**2 / 12) - critical / 2
    restitution = np.sqrt(k * critical**2 * (critical / 3 + plastic) / energy)
    u, weights = np.polynomial.legendre.leggauss(12)
    u, weights = (u[:, None] + 1) / 2, weights / 2
    elastic = weights @ (critical / np.sqrt(speed**2 - 2 * k / (3 * MASS) * (critical * u) ** 3))
    omega = np.sqrt(2 * k * critical / MASS)
    left = np.sqrt(speed**2 - 2 * k / (3 * MASS) * critical**3)
    yielding = np.arctan2(left, omega * critical / 2) / omega
    # ℓ = d_c (1 − u²), because the velocity begins as a square root.
    live = critical * (1 - u**2)
    square = (critical**2 + critical * live + live**2) / 3 + plastic * (critical + live)
    unloading = weights @ np.sqrt(2 * MASS * critical / (k * square))
    return restitution, elastic + yielding + unloading


def _impacts(title, medium, ends, quick):
    """Restitution and contact time of impacts of a cone: at once, and in a loop over some of them."""
    speeds = np.linspace(*ends, 100 if quick else 1000)
    step = len(speeds) // 2
    probes = speeds[::step].tolist()
    dry = medium.eta == 0
    if dry:
        _, *references = exact.impacts(CONE, medium, MASS, tuple(probes))
    else:
        _, *references = viscous(CONE, medium, MASS, probes, 50)

    def error(found):
        found = [each if len(each) == len(probes) else each[::step] for each in found]
        return max(reference.error(each) for reference, each in zip(references, found, strict=True))

    def steps(method):
        return lambda tol: list(
            zip(*(stepped(CONE, medium, MASS, v, method, tol)[1:] for v in probes), strict=True)
        )

    def chain(tolerance):
        hits = [mdr.chain_impact(CONE, medium, MASS, speed, tolerance=tolerance) for speed in probes]
        return [hit.restitution for hit in hits], [hit.contact_time for hit in hits]

    def solved():
        hits = mdr.impact(CONE, medium, MASS, speeds)
        return hits.restitution, hits.contact_time

    methods = [Method("mdr_core", "", lambda: solved)]
    if dry:
        methods.insert(0, Method("plain formula", "", lambda: lambda: plain_impacts(medium, speeds)))
    for method, tolerances in STEPPING.items():
        methods += ladder("solve_ivp " + method, "rtol = {:g}", tolerances, steps(method), len(probes))
    if not dry:
        methods += ladder("chain_impact", "tolerance = {:g}", (1e-4, 1e-6), chain, len(probes))
    return Problem("restitution and contact time", title, len(speeds), error, tuple(methods))


def _field(quick):
    """The pressure of an elastic cone on square grids, also by boundary elements."""
    methods, slope = [], ELASTIC.E_star * CONE.slope / 2

    def error(pressure):
        return peers.Square(CONE, ELASTIC, DEPTH, math.isqrt(pressure.size)).error(pressure)

    for n in (32,) if quick else (64, 128, 256):
        square = peers.Square(CONE, ELASTIC, DEPTH, n)

        def plain(square=square):
            return slope * np.arccosh(np.maximum(square.radius / square.r, 1))

        def solved(square=square):
            return mdr.indent(CONE, ELASTIC, DEPTH).pressure(square.r)

        methods += [
            Method("plain formula", f"{n}²", lambda plain=plain: plain),
            Method("mdr_core", f"{n}²", lambda solved=solved: solved),
            *peers.boundary_elements(square),
        ]
    return Problem("pressure", "elastic cone, field on a grid", 1, error, tuple(methods))


def _pressure(quick):
    """Pressures in the plastic zone and near the axis, a small difference of elastic pressures."""
    medium = YIELDING["10⁸"]
    c, a = (float(CONE.contact_radius(d)) for d in (DEPTH - medium.critical_depth, DEPTH))
    r = c * np.geomspace(1e-9, 0.99, 1000)
    probes = r[::50]
    reference = exact.pressure(CONE, medium, DEPTH, probes)
    slope = medium.E_star * CONE.slope / 2

    def error(pressure):
        return reference.error(pressure if len(pressure) == len(probes) else pressure[::50])

    def plain():
        return slope * (np.arccosh(np.maximum(a / r, 1)) - np.arccosh(np.maximum(c / r, 1)))

    def load(x, r):
        return slope / math.sqrt((x - r) * (x + r))

    def by_quad(tolerance):
        return np.array(
            [quad(load, c, a, (each,), epsabs=0, epsrel=tolerance)[0] for each in probes.tolist()]
        )

    def chain(n):
        row = mdr.Foundation(CONE, medium, n, a * (1 + 1 / n)).advance(DEPTH)
        right = row.x > 0
        return -mdr.abel.stress_from_line_load(row.x[right], row.line_load[right], r)

    methods = (
        Method("plain formula", "", lambda: plain),
        Method("mdr_core", "", lambda: lambda: mdr.indent(CONE, medium, DEPTH).pressure(r)),
        *ladder("scipy quad", "epsrel = {:g}", TOLERANCES, by_quad, len(probes)),
        *ladder("chain", "n = {}", ELEMENTS[: 2 if quick else None], chain),
    )
    return Problem("pressure", "cone, 10⁸ critical depths deep", len(r), error, methods)
