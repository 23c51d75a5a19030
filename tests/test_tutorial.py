"""The tutorial runs, and what it saves is labelled."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import mdr_core as mdr

from .approx import approx

ROOT = Path(mdr.__file__).parents[1]


@pytest.mark.slow
def test_the_tutorial_saves_a_labelled_curve(tmp_path):
    xarray = pytest.importorskip("xarray")
    for package in ("pandas", "matplotlib"):
        pytest.importorskip(package)
    environment = os.environ | {"MPLBACKEND": "Agg", "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(ROOT / "assets" / "tutorial.py")]
    run = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    # The figure of the README, under a sphere of 200 nm at 10 nm.
    assert "Indentation: 300 states" in run.stdout
    # The limit of a slope of 70.3.
    assert "no angle" in run.stdout
    # The unloading of silica, and the remark on the fit of it.
    assert "hardness H               9.24" in run.stdout
    assert "not of class (b)" in run.stdout
    assert (tmp_path / "curve.png").stat().st_size > 1000
    with xarray.open_dataset(tmp_path / "curve.nc") as saved:
        assert saved["force"].attrs["units"] == "N"
        assert saved["depth"].attrs["long_name"] == "indentation depth"
        assert float(saved["force"][199]) == approx(13.347e-6, rel=1e-4)
        assert "Sphere" in saved.attrs["indenter"]
