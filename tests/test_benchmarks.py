"""The quick benchmark runs, and every method is as exact as it is said to be. Times are not judged."""

import json
from xml.etree import ElementTree

import pytest

pytest.importorskip("mpmath")

from .benchmarks.chart import figure
from .benchmarks.report import collect
from .benchmarks.tables import document, summary

# Relative errors that each family may have, at its coarsest setting.
BOUNDS = {
    "mdr_core": 3e-14,
    "mdr_core, quadrature": 3e-14,
    "mdr_core, profile known": 1e-14,
    "mdr_core, kink known": 1e-13,
    "mdr_core, samples": 1e-6,
    "mdr_core, even samples": 2e-3,
    "mdr_core, graded samples": 2e-3,
    "mdr_core, cubic": 1e-5,
    "difference of curves": 1e-6,
    "scipy quad": 2e-2,
    "solve_ivp RK45": 1e-2,
    "solve_ivp DOP853": 1e-2,
    "chain": 2e-2,
    "chain_impact": 2e-3,
    "tamaas": 2e-2,
    "ContactMechanics": 2e-2,
}


@pytest.fixture(scope="module")
def results():
    return collect(quick=True)


def test_every_method_is_as_exact_as_its_family(results):
    for record in results["records"]:
        bound = BOUNDS.get(record["family"], 2e-2)
        assert record["error"] <= bound, (record["question"], record["family"], record["setting"])


def test_every_question_has_an_easy_and_a_hard_case(results):
    questions = "force", "pressure", "restitution", "contact time", "transform"
    cases = {(record["question"], record["case"]) for record in results["records"]}
    assert cases >= {(question, case) for question in questions for case in ("easy", "hard")}


def test_a_finer_setting_is_more_exact(results):
    for family in ("chain", "solve_ivp DOP853"):
        for question in ("force", "pressure", "contact time"):
            for case in ("easy", "hard"):
                errors = [
                    r["error"]
                    for r in results["records"]
                    if (r["family"], r["question"], r["case"]) == (family, question, case)
                    and not r["title"].startswith("elastic paraboloid")
                ]
                assert errors == sorted(errors, reverse=True)


def test_report_is_written_from_what_was_measured(results):
    assert json.loads(json.dumps(results, allow_nan=False)) == results
    svg = figure(results)
    ElementTree.fromstring(svg)
    assert len(svg.encode()) < 60_000
    text = document(results) + summary(results)
    assert "nan" not in text
    assert all(record["family"] in text for record in results["records"])
