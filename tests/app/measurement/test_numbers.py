"""The quoted number of measured curves, against other programs, with its remarks and remedies."""

import json
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import curve_fit

import mdr_core as mdr

from ...approx import approx
from ..measuring import DATA, buttons, opened, saved, silica_in


class Case(NamedTuple):
    """A measurement: its curve, kind of sample, tip and numbers; the kinds of remarks, and buttons.

    `expected` is E* (Pa), None for no number; `within` is a share of it, or "error" for two of its errors.
    """

    curve: str
    medium: str
    tip: str
    numbers: dict
    kinds: set
    offered: set
    expected: object = None
    within: object = "error"


BERKOVICH, PARABOLOID, R = "berkovich", "paraboloid", {"radius": 1e-5}
#: Handbooks: steel of 210 GPa and ν = 0.3 under diamond, and fused quartz, of which silica is made.
STEEL, QUARTZ = 192e9, 69.6e9
REFERENCE = json.loads((DATA / "reference.json").read_text(encoding="utf-8"))


def nanite(name, *path):
    """E* (Pa) of a curve by nanite, or by the reference in time."""
    found = REFERENCE[name]
    for each in path:
        found = found[each]
    return found["E_star"]


GEL_IN_TIME = nanite("map2x2-2", "in_time")
#: Radius (m) of the rounded tip.
ROUND = 1e-7
CONES = {"berkovich": 70.3, "cube_corner": 42.28, "rounded_cone": np.degrees(1.227)}


def unloading(name, tip):
    """E* (Pa) by Oliver and Pharr: a power law by SciPy from 95 to 40 % of the force, with ε = 0.75."""
    curve = mdr.read_curve(mdr.example("silica.csv") if name == "silica" else DATA / f"{name}.csv")
    top = int(np.argmax(curve.force))
    depth, force = 1e9 * curve.depth[top:], curve.force[top:] / curve.force.max()
    end = int(np.argmax(force < 0.4))
    used = slice(0, end), force[:end] < 0.95
    depth, force = depth[used[0]][used[1]], force[used[0]][used[1]]
    deepest = depth.max()
    start = 1.0, 0.5 * deepest, 1.5

    def law(h, B, end, m):
        return B * np.maximum((h - end) / deepest, 0.0) ** m

    (B, end, m), _ = curve_fit(law, depth, force, start, maxfev=20_000)
    h = 1e9 * curve.depth[top]
    stiffness = m * B * ((h - end) / deepest) ** (m - 1) / deepest * curve.force.max() * 1e9
    contact_depth = 1e-9 * h - 0.75 * curve.force.max() / stiffness
    slope = 1 / np.tan(np.radians(CONES[tip]))
    # A rounded cone is a cone that begins half of R times the square of its slope deeper.
    rounding = 0.5 * ROUND * slope**2 if tip == "rounded_cone" else 0.0
    return stiffness / (2 * (contact_depth + rounding) / slope)


#: Another range of the unloading and another exponent are worth some per cent.
RANGE = 0.05
DEPTH = {"Look at the unit of depth"}
UNITS = DEPTH | {"Look at the unit of force"}
CLASS, TIP = {"Take class (a), constant hardness"}, {"Choose another tip"}
CASES = [
    Case("steel", "gel", BERKOVICH, {}, {"drift", "misfit"},
         {"Take glass, metal or ceramic", "Subtract a drift of 862 pm/s"}),
    Case("steel", "constant", BERKOVICH, {}, {"drift", "misfit", "creep"},
         {"Subtract a drift of 1.10 nm/s"}),
    Case("steel", "composite", BERKOVICH, {}, {"tip", "misfit", "creep"}, TIP | CLASS, STEEL),
    Case("map2x2-2", "gel", PARABOLOID, R, {"misfit"}, set()),
    Case("map2x2-2", "sticky", PARABOLOID, R, {"adhesion"}, set(), GEL_IN_TIME),
    Case("map2x2-2", "viscous", PARABOLOID, R, set(), set(), GEL_IN_TIME),
    Case("quartz", "gel", BERKOVICH, {}, {"misfit"}, {"Take glass, metal or ceramic"}),
    Case("quartz", "constant", BERKOVICH, {}, {"errors"}, set(), unloading, RANGE),
    Case("nial", "constant", BERKOVICH, {}, {"misfit"}, set(), unloading, RANGE),
    Case("nial", "line", BERKOVICH, {}, {"tilt", "misfit"},
         {"Free the baseline", "Free the tilt of the baseline"} | CLASS, unloading, RANGE),
    Case("qi-noisy-2", "gel", PARABOLOID, R, {"misfit", "vague"}, {"Hold the effective modulus"}),
    Case("silica", "constant", "cube_corner", {"poisson": 0.17}, set(), set(), unloading, RANGE),
    Case("silica", "constant", "rounded_cone", {"half_angle": 1.227, "radius": ROUND}, set(), set(),
         unloading, RANGE),
    # The loading of a sample that yields is softer than its unloading, here by 13 %.
    Case("silica", "gel", BERKOVICH, {}, {"units", "unloading"}, UNITS, QUARTZ, 0.2),
    Case("silica_pm", "constant", BERKOVICH, {"frame": 1e-8}, {"units", "misfit"}, DEPTH),
    Case("silica", "constant", BERKOVICH, {"poisson": 0.2, "tip_modulus": 1e9}, set(), set(),
         unloading, RANGE),
]  # fmt: skip


def data(name):
    if not name.startswith("silica"):
        return (DATA / f"{name}.csv").read_bytes()
    return silica_in(name[7:] or "nm")


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.curve} {case.medium} {case.tip}")
def test_number_remarks_and_buttons(case):
    page = opened(data(case.curve), case.medium, case.tip, f"{case.curve}.csv", **case.numbers)
    quoted = page.found.quoted
    assert {each["kind"] for each in json.loads(saved(page, "json"))["remarks"]} == case.kinds
    results = page.results
    assert set(buttons(results.above, results.below, results.remarks)) == case.offered
    if case.expected is None:
        assert quoted.value is None
        return
    expected = case.expected(case.curve, case.tip) if callable(case.expected) else case.expected
    within = 2 * quoted.standard_error if case.within == "error" else case.within * expected
    assert quoted.value == approx(expected, abs=within)
