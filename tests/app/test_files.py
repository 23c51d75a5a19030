"""Files that are taken away and brought back say what the library says."""

import numpy as np
import pytest

import mdr_core as mdr
from app import export, link
from app.quantities import CHOICES
from app.tip import read_tip
from app.trajectory import follow

from .person import Person


@pytest.fixture
def person():
    return Person()


@pytest.mark.parametrize("drive", ["depth", "force"])
def test_scene_file_goes_down_and_up(person, drive):
    person.ask("choose", name="shape", option="hyperboloid")
    person.ask("choose", name="drive", option=drive)
    person.ask("stand", at=1.5)
    before = person.session.drawing.trajectory
    text = link.scene_file(before)
    assert mdr.Scene.from_json(text).solve()[-1].force == pytest.approx(before.state.force, rel=1e-9)
    other = Person()
    assert other.ask("upload", kind="scene", text=text)["notice"] == ""
    after = other.session.drawing.trajectory
    assert after.state.force == pytest.approx(before.state.force, rel=1e-5)
    assert after.scene.profile == before.scene.profile


@pytest.mark.parametrize(
    "drive", [mdr.DepthPath((1e-6, 3e-6, 2.9e-6)), mdr.ForcePath(1e-3), mdr.FreeImpact(1e-9, 2.0)]
)
@pytest.mark.parametrize("profile", [mdr.PowerLaw(3.0, 1.5), mdr.Sphere(1e-4), mdr.FlatPunch(1e-5)])
def test_scene_of_the_library_is_opened(person, profile, drive):
    scene = mdr.Scene(profile, mdr.Medium(1e9), drive)
    assert person.ask("upload", kind="scene", text=scene.to_json())["notice"] == ""
    way = person.session.drawing.trajectory
    result = scene.solve()
    expected = result.max_depth if isinstance(result, mdr.Impact) else np.max(result.depth)
    assert way.deepest.depth == pytest.approx(float(expected), rel=1e-9)


@pytest.mark.parametrize("drive", ["depth", "impact"])
def test_csv_says_what_the_library_says(person, drive):
    person.ask("choose", name="drive", option=drive)
    way = person.session.drawing.trajectory
    text = export.csv(way)
    head = [line for line in text.splitlines() if line.startswith("#")]
    assert "mdr_core" in head[0]
    assert any("q_c = 100.0 N/m" in line for line in head)
    names, rows = rows_of(text)
    assert all("(" in name for name in names)
    depth, force = (rows[:, names.index(name)] for name in ("depth d (m)", "force F (N)"))
    expected = mdr.indent(way.scene.profile, way.scene.medium, depth).force
    assert force == pytest.approx(expected, rel=1e-9, abs=1e-6 * force.max())
    names, rows = rows_of(export.pressure_csv(way))
    r, stress = rows[1:, 0], rows[1:, names.index("sigma_zz (Pa)")]
    assert -stress == pytest.approx(way.state.pressure(r), rel=1e-12)


def rows_of(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return lines[0].split(","), np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])


@pytest.mark.parametrize("drive", CHOICES["drive"])
@pytest.mark.parametrize("plasticity", ["q_c", "none"])
def test_python_snippet_reproduces_the_state(person, drive, plasticity):
    person.ask("choose", name="drive", option=drive)
    person.ask("choose", name="plasticity", option=plasticity)
    person.ask("stand", at=1.4)
    way = person.session.drawing.trajectory
    scope = {}
    exec(export.python(way), scope)
    if drive == "impact":
        assert scope["hit"].restitution == way.hit.restitution
    else:
        assert scope["state"].force == pytest.approx(way.state.force, rel=1e-9)
        assert scope["state"].plastic_radius == pytest.approx(way.state.plastic_radius, rel=1e-9)


def test_python_snippet_holds_a_measured_tip():
    tip = read_tip("r (um), z (um)\n0 0\n1 0.1\n2 0.4\n")
    scene = mdr.Scene(mdr.Sampled(*tip), mdr.Medium(1e9), mdr.DepthPath(1e-7))
    scope = {}
    exec(export.python(follow(scene, 1.0)), scope)
    assert scope["profile"] == scene.profile
