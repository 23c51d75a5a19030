"""Tables and numbers in texts are those of assets/benchmarks.json and of assets/accuracy.md."""

import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from .approx import approx

# The report imports what it measures with.
pytest.importorskip("mpmath")

from .benchmarks.report import ASSETS, PAGES, stored, table
from .benchmarks.tables import document, summary

MEASURED = stored()
STATEMENT = (ASSETS / "docs" / "statement_of_need.md").read_text(encoding="utf-8")
FOR_DEM = (ASSETS / "docs" / "for_dem.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_table_on_a_page_is_what_was_measured(page):
    assert table(page) == summary(MEASURED)


def test_the_report_is_what_was_measured():
    assert (ASSETS / "benchmarks.md").read_text(encoding="utf-8") == document(MEASURED)


def test_the_statement_of_need_has_the_worst_error_of_a_force():
    report = (ASSETS / "accuracy.md").read_text(encoding="utf-8")
    head, *rows = re.findall(r"^\| (?:regime|d =|elastic|\d).*\|$", report.partition("**bound**")[0], re.M)
    force = head.split(" | ").index("force")
    worst = max((row.split(" | ")[force].split()[0] for row in rows), key=float)
    assert len(rows) == 9
    assert f"Forces agree with 40-digit references to {worst}." in STATEMENT


def test_the_statement_of_need_fits_a_screen():
    words = STATEMENT.replace(table(ASSETS / "docs" / "statement_of_need.md"), "").split()
    assert 300 <= len(words) <= 400


def test_the_stiffnesses_of_the_page_for_dem_give_restitution_and_contact_time():
    """Laws with constant stiffnesses, integrated to their end; the tolerance is of the integration."""
    m, e, T = 2.0, 0.6, 3.0
    k_n, eta = m * (np.pi**2 + np.log(e) ** 2) / T**2, -2 * np.log(e) / T
    k_1 = m * (np.pi * (1 + e) / (2 * T)) ** 2
    k_2 = k_1 / e**2
    assert "k_n = m (π² + ln² e)/T², η_n0 = −2 ln e/T" in FOR_DEM
    assert "k₁ = m (π(1 + e)/(2T))², k₂ = k₁/e²" in FOR_DEM
    # The largest depth of a loading at speed 1, under the stiffer spring on the way back.
    deepest = np.sqrt(m / k_1)

    def dashpot(_, state):
        return state[1], -k_n / m * state[0] - eta * state[1]

    def walton_braun(_, state):
        d, v = state
        return v, -(k_1 * d if v > 0 else k_2 * (d - deepest) + k_1 * deepest) / m

    for law, left in ((dashpot, 0.0), (walton_braun, deepest * (1 - e**2))):

        def end(_, state, left=left):
            return state[0] - left if state[1] < 0 else 1.0

        end.terminal = True
        motion = solve_ivp(law, (0, 2 * T), (0.0, 1.0), events=end, rtol=1e-8, atol=1e-10, max_step=0.01)
        assert motion.t[-1] == approx(T, rel=1e-4)
        assert -motion.y[1, -1] == approx(e, rel=1e-4)
