"""Pressure: fields on square grids beside boundary elements, and radii next to the plastic zone."""

import math

import numpy as np
from scipy.integrate import quad

import mdr_core as mdr

from . import exact, peers
from .harness import ELEMENTS, TOLERANCES, Method, Problem, ladder
from .shapes import CONE, ELASTIC, PARABOLOID, SOFT, solver

_DEEP = 1e8 * SOFT.critical_depth


def problems(quick=False):
    """The easy problems are fields of an elastic contact, the hard one is a yielded cone."""
    return (
        _field("elastic cone, field on a grid", CONE, quick),
        _field("elastic paraboloid, field on a grid", PARABOLOID, quick),
        _yielded(quick),
    )


def _field(title, profile, quick):
    depth = 1e-6

    def error(pressure):
        return peers.Square(profile, ELASTIC, depth, math.isqrt(pressure.size)).error(pressure)

    methods = []
    for n in (32,) if quick else (64, 128, 256, 512):
        square = peers.Square(profile, ELASTIC, depth, n)
        methods += solver(
            profile, lambda shape, r=square.r: mdr.indent(shape, ELASTIC, depth).pressure(r), f"{n}²"
        )
        methods += peers.boundary_elements(square, "pressure")
    return Problem("pressure", "easy", title, 1, error, tuple(methods))


def _yielded(quick):
    """Radii in the plastic zone, from the axis on, where elastic pressures hardly differ."""
    c, a = (float(CONE.contact_radius(d)) for d in (_DEEP - SOFT.critical_depth, _DEEP))
    r = c * np.geomspace(1e-9, 0.99, 1000)
    probes = r[::50]
    reference = exact.pressure(CONE, SOFT, _DEEP, probes)

    def error(pressure):
        return reference.error(pressure if len(pressure) == len(probes) else pressure[::50])

    methods = [
        *solver(CONE, lambda shape: mdr.indent(shape, SOFT, _DEEP).pressure(r)),
        Method("difference of curves", "", lambda: lambda: _difference(a, c, r)),
        Method("mdr_core, samples", "line load at 0, c and a", lambda: lambda: _by_samples(a, c, r)),
        *ladder(
            "scipy quad", "epsrel = {:g}", TOLERANCES, lambda tol: _quad(a, c, probes, tol), len(probes)
        ),
        *ladder("chain", "n = {}", ELEMENTS[: 2 if quick else None], lambda n: _chain(n, a, r)),
    ]
    return Problem("pressure", "hard", "cone, 10⁸ critical depths deep", len(r), error, tuple(methods))


def _difference(a, c, r):
    """The textbooks' elastic pressures, one subtracted from the other."""
    curves = np.arccosh(np.maximum(a / r, 1)) - np.arccosh(np.maximum(c / r, 1))
    return SOFT.E_star * CONE.slope / 2 * curves


def _by_samples(a, c, r):
    """The transform of a line load given by its kinks."""
    load = SOFT.yield_line_load
    return -mdr.abel.stress_from_line_load([0.0, c, a], [load, load, 0.0], r)


def _quad(a, c, radii, tolerance):
    """Popov (2015), Eq. (10), as it stands, one radius after the other."""
    slope = SOFT.E_star * CONE.slope / 2

    def load(x, r):
        return slope / math.sqrt((x - r) * (x + r))

    return np.array([quad(load, c, a, (r,), epsabs=0, epsrel=tolerance)[0] for r in radii.tolist()])


def _chain(n, a, r):
    row = mdr.Foundation(CONE, SOFT, n, a * (1 + 1 / n)).advance(_DEEP)
    right = row.x > 0
    return -mdr.abel.stress_from_line_load(row.x[right], row.line_load[right], r)
