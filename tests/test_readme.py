"""The limits of the model and the table of supported combinations: each cell is run."""

import re
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

from .laws import NixGao

LIMITS = (Path(__file__).parents[1] / "assets" / "docs" / "limits.md").read_text(encoding="utf-8")
#: In one line, wherever the page breaks its lines.
TEXT = " ".join(LIMITS.split())
#: Answers of the table by function and column.
TABLE = {
    name: ["yes" if cell == "no effect" else cell.split()[0] for cell in cells.split(" | ")]
    for name, cells in re.findall(r"^\| [^|]+ \| `(\w+)` \| (.*) \|$", LIMITS, re.MULTILINE)
}
TIP = mdr.Paraboloid(radius=1e-5)
DEPTH = np.array([0.0, 5e-8, 1e-7, 5e-8])
FORCE = np.array([0.0, 1e-4, 2e-4, 1e-4])
TIME = np.linspace(0.0, 1.0, 4)
#: What each column adds to a medium with E*, beginning with those of the hardness.
COLUMNS = [
    [{"hardness": 1e8}, {"q_c": 100.0}, {"hardness": 1e8, "q_c": 100.0}, {}],
    [{"f_c": 1e-4}, {"hardness": 1e8, "q_c": 100.0, "f_c": 1e-4}],
    [{"hardness": NixGao(1e8, 1e-6)}],
    [{"q_c": 100.0, "eta": 1e3}, {"eta": 1e3}],
    [{"q_c": 100.0, "work_of_adhesion": 0.01}, {"work_of_adhesion": 0.01}],
]
DRIVES = {
    "indent": lambda medium: mdr.indent(TIP, medium, DEPTH).force,
    "indent_to_force": lambda medium: mdr.indent_to_force(TIP, medium, FORCE).depth,
    "indent_in_time": lambda medium: mdr.indent_in_time(TIP, medium, DEPTH, TIME).force,
    "creep": lambda medium: mdr.creep(TIP, medium, FORCE, TIME).depth,
    "impact": lambda medium: mdr.impact(TIP, medium, 1e-11, 0.3).restitution,
    "oblique_impact": lambda medium: (
        mdr.oblique_impact(TIP, medium, 1e-11, 0.3, 0.3, 0.2, tolerance=1e-3).tangential_velocity
    ),
}


def test_the_restitution_on_a_plate_is_the_exponential_in_the_range_that_is_said():
    """exp(−1.72 λ) against impacts of paraboloids, and the ball on the laminate of `Structure`."""
    laminate = mdr.Structure.laminate(D11=293.0, D12=87.9, D22=293.0, D66=102.55, mass_per_area=6.4)
    hit = mdr.impact(mdr.Sphere(5e-3), mdr.Medium(10e9), 4.1e-3, 5.0, structure=laminate)
    assert f"returns with {hit.restitution:.2f} of its speed" in TEXT
    lam, mass, speed, E, R = np.append(np.linspace(0.01, 1, 100), 2.0), 1e-3, 1.0, 1e9, 1e-2
    k = 4 / 3 * E * np.sqrt(R)
    plates = mdr.Structure(impedance=mass**0.6 * (k**2 * speed) ** 0.2 / lam)
    e = mdr.impact(mdr.Paraboloid(R), mdr.Medium(E), mass, speed, structure=plates).restitution
    *within, beyond = np.exp(-1.72 * lam) / e - 1
    assert f"exp(−1.72 λ), within {100 * max(map(abs, within)):.1f} % up to λ = 1" in TEXT
    assert f"{100 * beyond:.0f} % too large" in TEXT


def test_a_fit_of_a_layer_is_too_stiff_by_what_is_said():
    """Force on a bonded incompressible layer by Dimitriadis et al. (Biophys. J. 82, 2002, 2798)."""
    h, R, E = 1e-6, 2.5e-6, 1e4
    ratios = []
    for held in ({}, {"contact_point": 0.0}):
        for share in (0.05, 0.3):
            depth = np.linspace(0, share * h, 200)
            chi = np.sqrt(R * depth) / h
            series = 1 + 1.133 * chi + 1.283 * chi**2 + 0.769 * chi**3 + 0.0975 * chi**4
            force = 4 / 3 * E * np.sqrt(R) * depth**1.5 * series
            fit = mdr.fit_indentation(mdr.Paraboloid(R), depth, force, q_c=np.inf, **held)
            ratios.append(f"{fit.medium.E_star / E:.3g}")
    (text,) = re.findall(r"For a ball with R = 2\.5 h.*?Adhesion", TEXT)
    assert re.findall(r"\d\.\d\d", text) == ratios


def test_the_table_has_all_drives():
    assert set(TABLE) == {*DRIVES, "fit_indentation"}
    assert {len(row) for row in TABLE.values()} == {len(COLUMNS) + 1}
    assert {cell for row in TABLE.values() for cell in row} == {"yes", "no"}
    assert [name for name, row in TABLE.items() if row[-1] == "yes"] == ["oblique_impact"]


@pytest.mark.parametrize("column", range(len(COLUMNS)))
@pytest.mark.parametrize("name", DRIVES)
def test_a_drive_takes_a_medium_where_the_table_says_so(name, column):
    solve, answer = DRIVES[name], TABLE[name][column]
    for given in COLUMNS[column]:
        medium = mdr.Medium(E_star=1e9, **given)
        if answer == "no":
            with pytest.raises(ValueError, match=r"adhesion|creep\(\) does not support"):
                solve(medium)
        else:
            assert np.all(np.isfinite(solve(medium)))


@pytest.mark.parametrize("name", ["indent", "indent_to_force"])
def test_a_slow_path_does_not_depend_on_the_viscosity(name):
    """The table's "no effect"."""
    media = [mdr.Medium(E_star=1e9, q_c=100.0, eta=eta) for eta in (0.0, 1e3)]
    assert re.search(rf"`{name}` .*no effect", LIMITS)
    assert np.array_equal(*map(DRIVES[name], media))


@pytest.mark.parametrize("other", [{"eta": 1e3}, {"hardness": 1e8}, {"f_c": 1e-4}])
def test_adhesion_goes_with_q_c_alone(other):
    """Note (1) of the table."""
    with pytest.raises(ValueError, match="adhesion"):
        mdr.indent(TIP, mdr.Medium(E_star=1e9, work_of_adhesion=0.01, **other), 1e-8)


def test_an_impact_with_adhesion_has_no_motion_in_time():
    hit = mdr.impact(TIP, mdr.Medium(E_star=1e9, work_of_adhesion=0.01), 1e-11, 0.3)
    with pytest.raises(ValueError, match="motion"):
        hit.motion(10)


FITS = {
    "elastic": ({"q_c": np.inf}, "yes yes"),
    "q_c": ({"q_c": None}, "yes no"),
    "H": ({"hardness": None}, "no no"),
    "f_c": ({"f_c": None}, "no no"),
    "H, q_c": ({"hardness": None, "q_c": None}, "no no"),
}


@pytest.mark.parametrize("name", FITS)
def test_a_fit_takes_viscosity_and_adhesion_where_the_notes_say_so(name):
    """Notes (2) and (3) of the table."""
    given, answers = FITS[name]
    depth = np.append(np.linspace(0, 1e-7, 30), np.linspace(1e-7, 3e-8, 20))
    force = mdr.indent(TIP, mdr.Medium(E_star=1e9, q_c=20.0), depth).force
    force = force + 1e-9 * np.random.default_rng(1).normal(size=50)
    mdr.fit_indentation(TIP, depth, force, **given)
    others = {"eta": None, "time": np.linspace(0, 1, 50)}, {"work_of_adhesion": None}
    for other, answer in zip(others, answers.split(), strict=True):
        if answer == "no":
            with pytest.raises(ValueError, match=next(iter(other))):
                mdr.fit_indentation(TIP, depth, force, **given, **other)
        else:
            mdr.fit_indentation(TIP, depth, force, **given, **other)
