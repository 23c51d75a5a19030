"""Restitution and contact time of impacts: energy balance, quadratures, time stepping, chain."""

import numpy as np

import mdr_core as mdr

from . import exact
from .harness import Method, Problem
from .shapes import CONE, PARABOLOID, SOFT, by_quadrature
from .stepping import Curve, chained, integrated, stepped

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

    methods = [
        Method(family, "", lambda shape=shape: lambda: _solved(shape, speeds, attribute))
        for family, shape in (("mdr_core", profile), ("mdr_core, quadrature", by_quadrature(profile)))
    ]

    def looped(family, setting, run, *how):
        return Method(
            family,
            setting,
            lambda: lambda: _loop(profile, probes, quantity, lambda curve: run(curve, *how)),
            items=len(probes),
        )

    for solver, tolerances in (("RK45", (1e-3, 1e-6)), ("DOP853", (1e-3, 1e-6, 1e-9, 1e-12))):
        for tolerance in tolerances:
            methods.append(
                looped("solve_ivp " + solver, f"rtol = {tolerance:g}", stepped, solver, tolerance)
            )
    for tolerance in (1e-3, 1e-6, 1e-9) if quantity == "contact time" else ():
        methods.append(looped("scipy quad", f"epsrel = {tolerance:g}", integrated, tolerance))
    # It makes both quantities at once: a quick look needs one of them.
    quick_ones = (1e-4,) if quantity == "restitution" else ()
    for tolerance in quick_ones if quick else (1e-4, 1e-6, 1e-8):
        methods.append(
            Method(
                "chain_impact",
                f"tolerance = {tolerance:g}",
                lambda tol=tolerance: lambda: chained(profile, SOFT, _MASS, probes, tol, attribute),
                items=len(probes),
            )
        )
    return Problem(quantity, case, title, len(speeds), error, tuple(methods))


def _solved(shape, speeds, attribute):
    return getattr(mdr.impact(shape, SOFT, _MASS, speeds), attribute)


def _loop(profile, speeds, quantity, run):
    hits = [run(Curve(profile, SOFT, _MASS, speed)) for speed in speeds.tolist()]
    return np.array(hits)[:, list(_QUANTITIES).index(quantity)]
