"""Restitution and contact time of impacts: energy balance, quadratures, time stepping, chain."""

import numpy as np

import mdr_core as mdr

from . import exact
from .harness import TOLERANCES, Problem, ladder
from .shapes import CONE, PARABOLOID, SOFT, solver
from .stepping import STEPPING, Curve, chained, integrated, stepped

_MASS = 1e-9
_QUANTITIES = {"restitution": "restitution", "contact time": "contact_time"}


def problems(quick=False):
    """Both quantities of slow impacts and of fast ones."""
    deep = "paraboloid, some critical depths deep", PARABOLOID, _speeds(PARABOLOID, 2, 8, quick)
    deepest = "cone, 10⁶ critical depths deep", CONE, _speeds(CONE, 5e5, 2e6, quick)
    return tuple(
        _problem(quantity, case, *state, quick)
        for case, state in (("easy", deep), ("hard", deepest))
        for quantity in _QUANTITIES
    )


def _speeds(profile, least, most, quick):
    """Speeds that press as deep as from so many to so many critical depths."""
    state = mdr.indent(profile, SOFT, np.array([[least], [most]]) * SOFT.critical_depth)
    ends = np.sqrt(2 * (state.stored_energy + state.plastic_work) / _MASS).ravel()
    return np.linspace(*ends, 100 if quick else 1000)


def _problem(quantity, case, title, profile, speeds, quick):
    step = len(speeds) // (2 if quick else 4)
    probes = speeds[::step]
    reference = exact.impacts(profile, SOFT, _MASS, tuple(probes.tolist()))[quantity == "contact time"]
    attribute = _QUANTITIES[quantity]

    def error(values):
        if len(values) > len(probes):
            values = values[::step]
        return reference.error(values)

    def looped(run):
        """The quantity from one impact after the other."""
        hits = [run(Curve(profile, SOFT, _MASS, speed)) for speed in probes.tolist()]
        return np.array(hits)[:, list(_QUANTITIES).index(quantity)]

    def steps(method):
        return lambda tolerance: looped(lambda curve: stepped(curve, method, tolerance))

    def quadrature(tolerance):
        return looped(lambda curve: integrated(curve, tolerance))

    def chain(tolerance):
        return chained(profile, SOFT, _MASS, probes, tolerance, attribute)

    methods = solver(profile, lambda shape: getattr(mdr.impact(shape, SOFT, _MASS, speeds), attribute))
    for method, tolerances in STEPPING.items():
        methods += ladder("solve_ivp " + method, "rtol = {:g}", tolerances, steps(method), len(probes))
    if quantity == "contact time":
        methods += ladder("scipy quad", "epsrel = {:g}", TOLERANCES, quadrature, len(probes))
    # It makes both quantities at once: a quick look needs one of them.
    quick_ones = (1e-4,) if quantity == "restitution" else ()
    tolerances = quick_ones if quick else (1e-4, 1e-6, 1e-8)
    methods += ladder("chain_impact", "tolerance = {:g}", tolerances, chain, len(probes))
    return Problem(quantity, case, title, len(speeds), error, tuple(methods))
