"""The quick benchmark runs, and every method is as exact as it is said to be. Times are not judged."""

import json
from xml.etree import ElementTree

import numpy as np
import pytest

pytest.importorskip("mpmath")
pytest.importorskip("dask")

from .benchmarks import accuracy, beside_lammps, fits, oblique
from .benchmarks.chart import figure
from .benchmarks.report import collect
from .benchmarks.tables import document, summary

# Relative errors that each family may have, at its coarsest setting.
BOUNDS = {
    "mdr_core": 1e-12,
    "difference of curves": 1e-6,
    "chain_impact": 2e-4,
}


@pytest.fixture(scope="module")
def results():
    return collect(quick=True)


@pytest.mark.slow
def test_every_method_is_as_exact_as_its_family(results):
    for record in results["records"]:
        # What others are set to, by coarse grids and loose tolerances.
        bound = BOUNDS.get(record["family"], 2e-2)
        assert record["error"] <= bound, (record["question"], record["family"], record["setting"])


def test_a_finer_setting_is_more_exact(results):
    for family in ("chain", "solve_ivp DOP853"):
        for question in ("pressure", "contact time"):
            for title in {r["title"] for r in results["records"]}:
                errors = [
                    r["error"]
                    for r in results["records"]
                    if (r["family"], r["question"], r["title"]) == (family, question, title)
                ]
                assert errors == sorted(errors, reverse=True)


def test_report_is_written_from_what_was_measured(results):
    assert json.loads(json.dumps(results, allow_nan=False))["records"] == results["records"]
    svg = figure(results)
    ElementTree.fromstring(svg)
    assert len(svg.encode()) < 60_000
    text = document(results) + summary(results)
    assert "nan" not in text
    assert all(record["family"] in text for record in results["records"])


@pytest.mark.slow
def test_dry_impacts_keep_what_is_promised():
    for _, depth, restitution, time in accuracy.dry_impacts((1 + 1e-5, 2e8)):
        assert max(float(depth), float(restitution)) <= 1e-10
        assert float(time) <= 1e-9


@pytest.mark.slow
def test_viscous_impacts_keep_what_is_promised():
    for row in accuracy.punch_impacts():
        # 10⁻⁸ at the ends of the range of relaxation times.
        assert max(map(float, row[1:])) <= (1e-8 if "0.0001" in row[0] or "10000" in row[0] else 1e-9), row
    for row in accuracy.viscous_impacts():
        assert max(map(float, row[1:])) <= 1e-9, row


@pytest.mark.slow
def test_the_chain_covers_its_errors():
    for row in accuracy.chain_impacts((0.0, 1.0, 1e3), tolerance=1e-4):
        said, missed = map(float, row[1:])
        assert missed <= said <= 1e-4, row


@pytest.mark.slow
@pytest.mark.parametrize(
    "hardness",
    [
        pytest.param(name, marks=[] if name in ("(b)", "(a) + (b) + (c)") else pytest.mark.full)
        for name in oblique.CLASSES
    ],
)
def test_oblique_impacts_keep_what_is_promised(hardness):
    """Within the tolerance, and errors never ten times too small, in one impact of each shape."""
    cases = oblique.random_impacts(12, oblique.CLASSES[hardness])
    references = [oblique.limits(case, 1000) for case in cases]
    found = list(oblique.misses(cases, 1e-4, references))
    assert len(found) >= 6
    for miss in found:
        assert max(miss.velocity / miss.said_velocity, miss.force / miss.said_force) <= 10, miss
    # 95 in 100 of many; one in twelve may be another.
    assert sum(miss.velocity > miss.said_velocity for miss in found) <= 1


def test_fits_keep_what_is_promised():
    """E* within 1 %, q_c within 0.5 % in all of 40 media; widths of 40 pulls are known to 11 %."""
    _, _, E, q_c, *pulls, _ = fits.row(fits.PROFILES[1], 0.0, 40)
    worst = [float(cell.split()[2]) for cell in (E, q_c)]
    assert worst[0] < 1
    assert worst[1] < 0.5
    assert all(0.6 < float(width) < 1.4 for width in pulls)


@pytest.mark.parametrize("angle", [2, 10, 60])
def test_the_ball_that_lammps_is_given_rebounds_as_from_a_chain(angle):
    """The third angle slips throughout: (1 − V′/V) tan ψ = 2 μ."""
    own, error = beside_lammps.by_oblique_impact(angle)
    chain, unsure = beside_lammps.by_chain(angle, cells=500)
    assert abs(own.speed - chain.speed) <= error + unsure < 1e-5
    slips = abs((1 - own.speed) * np.tan(np.radians(angle)) - 2 * beside_lammps.FRICTION) < 1e-9
    assert slips == (angle == 60)


@pytest.fixture
def lammps():
    try:
        return beside_lammps.lammps()
    except ImportError as reason:
        pytest.skip(str(reason))


def test_lammps_takes_the_ball_as_we_do(lammps):
    """Where all slips its options agree with the closed form, to the rounding of some thousand steps."""
    own, _ = beside_lammps.by_oblique_impact(60)
    for option in beside_lammps.OPTIONS:
        assert np.allclose(beside_lammps.by_lammps(60, option, 2000), own, rtol=0, atol=1e-9)


def test_mindlin_gains_energy_near_the_normal(lammps):
    """Half as many steps change it by a thousandth of what is claimed."""
    fine, coarse = (beside_lammps.by_lammps(2, "mindlin", steps) for steps in (4000, 2000))
    assert fine.energy > 1.005
    assert abs(fine.energy - coarse.energy) < 5e-6


@pytest.mark.parametrize("limited", [False, True])
@pytest.mark.parametrize("damping", beside_lammps.DAMPINGS)
def test_lammps_and_scipy_give_the_same_restitution(lammps, damping, limited):
    """10⁻⁴: the error of LAMMPS's first step into the contact, of 4000."""
    expected = beside_lammps.rebound(beside_lammps.coefficient(0.5, damping), limited)
    assert abs(beside_lammps.restitution(0.5, damping, limited, 4000) - expected) < 1e-4


def test_tsuji_s_coefficient_is_too_small_by_a_root_of_two():
    """Times √2 it gives what is asked until the overlap is 0, within the fit of its polynomial."""
    for asked in beside_lammps.ASKED:
        alpha = beside_lammps.coefficient(asked, "tsuji")
        assert abs(beside_lammps.rebound(np.sqrt(2) * alpha, False) - asked) < 6e-4
        assert beside_lammps.rebound(alpha, False) > asked + 0.02
