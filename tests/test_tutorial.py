"""The page *A first hour* runs, and says what it says that it says."""

import contextlib
import io
import os
import runpy
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

SCRIPT = Path(mdr.__file__).parents[1] / "assets" / "docs" / "examples" / "first_hour.py"


@pytest.mark.slow
def test_the_first_hour_shows_what_it_describes(tmp_path, monkeypatch):
    for package in ("pandas", "xarray"):
        pytest.importorskip(package)
    plt = pytest.importorskip("matplotlib.pyplot")
    plt.switch_backend("Agg")
    monkeypatch.setattr(plt, "show", lambda: None)
    monkeypatch.chdir(tmp_path)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        names = runpy.run_path(os.fspath(SCRIPT))
    said = printed.getvalue()
    # A curve, springs beside their pressure, a measurement with its fit, an impact.
    assert len(plt.get_fignums()) == 4
    plt.close("all")
    # In the plastic zone all springs carry π q_c/2 (theory, section 4).
    state, gold = names["state"], names["gold"]
    assert state.line_load(0.9 * state.plastic_radius) == pytest.approx(gold.yield_line_load, rel=1e-12)
    assert "cotangent of the half-angle" in said
    # The modulus of fused silica, 72 GPa with 0.17, under diamond, within the error of the calibration.
    assert names["fit"].quoted.value == pytest.approx(69.6e9, rel=0.005)
    # Of a constant hardness, which fits clearly better.
    assert min(names["fit"].classes, key=lambda letter: names["fit"].classes[letter].misfit) == "a"
    # A thick block gives all energy back, a plate does not: exp(-1.72 λ), here to 4.2 % (limits).
    assert names["block"].restitution == pytest.approx(1.0, abs=1e-9)
    plate, ball, speed = names["plate"], names["ball"], names["speed"]
    stiffness = 4 / 3 * 10e9 * ball.radius**0.5
    lam = 4.1e-3**0.6 * (stiffness**2 * speed) ** 0.2 / plate.impedance
    assert np.exp(-1.72 * lam) == pytest.approx(names["hit"].restitution, rel=0.0425)
