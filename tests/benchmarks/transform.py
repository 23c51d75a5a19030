"""From the line load to the pressure, Popov (2015), Eq. (10): samples, and PyAbel beside them."""

from functools import partial

import numpy as np

import mdr_core as mdr

from . import exact, peers
from .harness import Method, Problem
from .shapes import CONE, ELASTIC, PARABOLOID, QUARTIC, SOFT

#: Errors are taken at about so many radii, of this part of the contact.
_PROBES, _PART = 400, (0.05, 0.95)


def problems(quick=False):
    """Smooth loads, and one with a kink between the samples."""
    return (
        _problem("easy", "paraboloid, smooth load", PARABOLOID, ELASTIC, 1e-6, quick),
        _problem("easy", "fourth power, smooth load", QUARTIC, ELASTIC, 1e-6, quick),
        _problem(
            "hard", "yielded cone, kink between samples", CONE, SOFT, 2.7 * SOFT.critical_depth, quick
        ),
    )


def _problem(case, title, profile, medium, depth, quick):
    state = mdr.indent(profile, medium, depth)
    a = float(state.contact_radius)

    def even(count):
        return np.arange(count) / (count - 1) * a

    def probed(r):
        chosen = np.flatnonzero((r > _PART[0] * a) & (r < _PART[1] * a))
        return chosen[:: max(1, len(chosen) // _PROBES)]

    def error(pressure):
        r = even(len(pressure))
        rows = probed(r)
        return exact.pressure(profile, medium, depth, r[rows]).error(pressure[rows])

    methods = []
    for count in (101, 401) if quick else (51, 101, 1001, 10_001, 100_001):
        r = even(count)
        for family, (nodes, *how) in _samples(state, r).items():
            call = partial(mdr.abel.stress_from_line_load, nodes, state.line_load(nodes), r, *how)
            methods.append(Method(family, f"N = {count}", lambda call=call: lambda: -call()))
        if 101 <= count <= 1001:
            methods += peers.abel_transforms(r, state.line_load(r))
        methods.append(
            Method(
                "mdr_core, profile known",
                f"N = {count}",
                lambda r=r: lambda: _known(profile, medium, depth, r),
            )
        )
    return Problem("transform", case, title, 1, error, tuple(methods))


def _samples(state, r):
    """Nodes by family, with axis and interpolation where not by default.

    Even nodes, even ones with the kink, and as many that crowd at the rim; even ones with a cubic,
    for a load that is known to be smooth.
    """
    a, c = float(state.contact_radius), float(state.plastic_radius)
    nodes = {"mdr_core, even samples": (r,)}
    if c > 0:
        nodes["mdr_core, kink known"] = (np.sort(np.append(r, c)),)
    else:
        nodes["mdr_core, graded samples"] = (a * np.sin(np.pi / 2 * r / a),)
        nodes["mdr_core, cubic"] = r, "even", "cubic"
    return nodes


def _known(profile, medium, depth, r):
    return mdr.indent(profile, medium, depth).pressure(r)
