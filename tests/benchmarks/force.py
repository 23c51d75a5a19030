"""Force at given depths: closed form, quadratures, differences of curves, chain, boundary elements."""

import numpy as np
from scipy.integrate import quad

import mdr_core as mdr

from . import exact, peers
from .harness import ELEMENTS, TOLERANCES, Method, Problem, ladder
from .shapes import CONE, ELASTIC, PARABOLOID, SOFT, SPHERE, solver


def problems(quick=False):
    """The easy and the hard problems."""
    return (
        _problem("easy", "elastic cone", CONE, ELASTIC, (0.5e-6, 1e-6), quick),
        _problem("easy", "elastic paraboloid", PARABOLOID, ELASTIC, (0.5e-6, 1e-6), quick),
        _problem("hard", "sphere, 10⁸ critical depths deep", SPHERE, SOFT, (1e-4, 2e-4), quick),
    )


def _problem(case, title, profile, medium, depths, quick):
    depths = np.linspace(*depths, 100 if quick else 1000)
    probes = depths[:: len(depths) // 10]
    at_probes = exact.loading_force(profile, medium, probes)

    def error(forces):
        if isinstance(forces, tuple):
            # The method found, or was given, a depth of its own.
            depth, force = forces
            return exact.loading_force(profile, medium, [depth]).error(force)
        return at_probes.error(forces if len(forces) == len(probes) else forces[:: len(depths) // 10])

    def quadrature(tolerance):
        return _quad(profile, medium, probes, tolerance)

    def chain(n):
        return _chain(profile, medium, probes, n)

    methods = [
        *solver(profile, lambda shape: mdr.indent(shape, medium, depths).force),
        Method("difference of curves", "", lambda: lambda: _difference(profile, medium, depths)),
        *ladder("scipy quad", "epsrel = {:g}", TOLERANCES, quadrature, len(probes)),
        *ladder("chain", "n = {}", ELEMENTS[: 2 if quick else None], chain, len(probes)),
    ]
    if medium is ELASTIC:
        for n in (32,) if quick else (64, 128, 256):
            methods += peers.boundary_elements(peers.Square(profile, medium, depths[-1], n), "force")
    return Problem("force", case, title, len(depths), error, tuple(methods))


def _difference(profile, medium, depths):
    """φ(d) − φ(d_p) with the textbooks' elastic curves."""
    lower = np.maximum(depths - medium.critical_depth, 0.0)
    return _curve(profile, medium, depths) - _curve(profile, medium, lower)


def _curve(profile, medium, depth):
    E = medium.E_star
    if isinstance(profile, mdr.Cone):
        return 2 * E * depth**2 / (np.pi * profile.slope)
    if isinstance(profile, mdr.Paraboloid):
        return 4 / 3 * E * np.sqrt(profile.radius) * depth**1.5
    R, a = profile.radius, profile.contact_radius(depth)
    return E * ((a**2 + R**2) / 2 * np.log((R + a) / (R - a)) - a * R)


def _quad(profile, medium, depths, tolerance):
    """The line load summed over the contact, one depth after the other."""
    forces = []
    for depth in depths:
        a, c = (float(profile.contact_radius(max(s, 0.0))) for s in (depth, depth - medium.critical_depth))
        cap = min(depth, medium.critical_depth)
        outside = quad(
            lambda x, depth=depth: depth - float(profile.reduced(x)), c, a, epsabs=0, epsrel=tolerance
        )
        forces.append(2 * medium.E_star * (cap * c + outside[0]))
    return np.array(forces)


def _chain(profile, medium, depths, n):
    row = mdr.Foundation(profile, medium, n, 1.01 * float(profile.contact_radius(depths[-1])))
    forces = []
    for depth in depths:
        row = row.advance(depth)
        forces.append(row.force)
    return np.array(forces)
