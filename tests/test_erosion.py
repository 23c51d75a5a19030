"""The erosion example runs, and its sums are those of the impacts one by one."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

from .approx import approx

for package in ("xarray", "dask.array", "matplotlib"):
    pytest.importorskip(package)

ROOT = Path(mdr.__file__).parents[1]
SCRIPT = ROOT / "assets" / "erosion.py"


@pytest.mark.slow
def test_the_example_prints_and_paints(tmp_path):
    environment = os.environ | {"MPLBACKEND": "Agg", "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(SCRIPT), "--particles", "4000", "--chunk", "1000"]
    run = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    assert re.search(r"total damaged area [\d.]+ ± [\d.e-]+ mm² of 4e\+03 particles", run.stdout)
    assert re.search(r"took [\d.e+]+ s.* memory [\d.]+ GB", run.stdout)
    assert (tmp_path / "erosion.png").stat().st_size > 1000


@pytest.fixture
def erosion(monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    spec = importlib.util.spec_from_file_location("erosion", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_over_the_angle_of_attack(erosion, tmp_path, capsys):
    """Of constant hardness the maximum is where tan 2α = 2 m_t/(μ m); shallow impacts slip throughout."""
    works = erosion.at_all_angles(friction=0.2)
    best = float(works.attack[np.argmax(works.hard_friction_work.values)])
    assert best == approx(np.degrees(np.arctan(4 / 7 / 0.2)) / 2, abs=0.5)
    i, mass = 19, erosion.DENSITY * 4 / 3 * np.pi * 25e-6**3
    v, along = 30 * np.sin(np.radians(20.0)), 30 * np.cos(np.radians(20.0))
    hit = mdr.impact(mdr.Sphere(25e-6), mdr.Medium(**erosion.COMPOSITE), mass, v)
    impulse = 0.2 * mass * v * (1 + hit.restitution)
    assert works.friction_work[i] == approx(1e9 * impulse * (along - 3.5 * impulse / mass / 2))
    assert works.plastic_work[i] == approx(1e9 * hit.plastic_work)
    erosion.attack_picture(works, tmp_path / "attack.png")
    assert re.search(
        r"friction work, constant hardness: at most [\d.]+ nJ, at 35°", capsys.readouterr().out
    )
    assert (tmp_path / "attack.png").stat().st_size > 1000


def test_its_sums_are_those_of_the_impacts(erosion):
    given = erosion.stream(3000, chunk=1000)
    hits = mdr.sweep.impacts(mdr.Sphere, **given, quantities=erosion.QUANTITIES)
    kept = erosion.statistics(hits)
    mean, _ = (float(each.compute(scheduler="synchronous")) for each in kept["damaged_area"])
    # Seeded: the same particles again.
    radius, mass, speed = (given[name].values for name in ("radius", "mass", "speed"))
    medium = mdr.Medium(**erosion.COMPOSITE)
    areas = [
        mdr.impact(mdr.Sphere(r), medium, m, v).damaged_area
        for r, m, v in zip(radius[:200], mass[:200], speed[:200], strict=True)
    ]
    np.testing.assert_allclose(hits.damaged_area[:200], areas, rtol=1e-12)
    together = mdr.impact(mdr.Sphere(radius), medium, mass, speed)
    assert mean == approx(together.damaged_area.mean(), rel=1e-12)
    assert kept["histogram of restitution"].sum().compute() == 3000
