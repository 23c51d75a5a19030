"""Oblique impacts on the page: what is drawn and read is what the core says."""

import re
import time
from dataclasses import replace

import numpy as np
import pytest

import mdr_core as mdr
from app import columns, export, friction, link, readouts
from app.drives import DRIVES, follow
from app.explorer import FROM_FILE, Explorer
from app.page import Page
from app.presets import PRESETS
from app.view import View
from mdr_core.results.figures import SPRINGS

from .conftest import DROP, ELASTIC
from .test_columns import assert_all_is_drawn


def oblique(label=ELASTIC, **changes):
    explorer = Explorer(label)
    explorer.choose("drive", "oblique")
    explorer.param.update(**{"body": "solid", "attack": 0.9, "friction": 0.5} | changes)
    explorer.accept()
    return explorer


def solved(explorer):
    return DRIVES["oblique"].in_time(explorer.scene())


@pytest.fixture(scope="module")
def ball():
    explorer = oblique()
    return explorer, solved(explorer)


def cells(way):
    return {symbol: values for symbol, _, _, values in readouts.cells(way)}


@pytest.mark.parametrize("label", PRESETS)
def test_a_move_is_right_to_three_digits(label):
    explorer = oblique(label)
    rough, full = follow(explorer.scene(), 1.3), solved(explorer)
    assert (bool(rough.pending), bool(full.pending)) == (True, False)
    hit = explorer.scene().solve()
    for name, value in (("W_f", hit.friction_work), ("F_x,max", hit.max_tangential_force)):
        assert float(cells(full)[name]) == value
        assert float(cells(rough)[name]) == pytest.approx(float(value), rel=2e-3)
    # Of the speed with which it comes.
    size = explorer.incoming_speed
    assert friction.ends(rough)[0] == pytest.approx(float(hit.tangential_velocity), abs=1e-3 * size)
    assert full.oblique.tangential_velocity[-1] == pytest.approx(
        float(hit.tangential_velocity), abs=1e-4 * size
    )


def test_numbers_of_the_rebound_are_those_of_the_ball(ball):
    _, way = ball
    found, drive = cells(way), way.scene.drive
    body = mdr.Ball(drive.mass, float(way.scene.profile.body_radius))
    assert drive.tangential_mass == pytest.approx(float(body.tangential_mass))
    hit = way.oblique.impact
    speed, spin = body.rebound(hit, drive.tangential_speed)
    assert found["V_x"] == pytest.approx(float(speed), rel=1e-12)
    assert found["Ω"] == pytest.approx(float(spin), rel=1e-12)
    assert found["α_r"] == pytest.approx(np.arctan2(float(hit.normal.rebound_speed), float(speed)))
    assert found["e_t"] == pytest.approx(float(hit.tangential_restitution), rel=1e-12)
    html = readouts.heads(readouts.cells(way))
    assert len(set(re.findall(r' popover id="([^"]+)"', html))) == len(readouts.cells(way))
    # A tip that belongs to no ball has no radius to turn about; what cannot turn has no spin.
    assert "RΩ" in cells(follow(oblique(shape="cone").scene(), 1.0))
    assert not {"Ω", "RΩ"} & cells(follow(oblique(body="block").scene(), 1.0)).keys()


def test_springs_lean_as_far_as_they_are_loaded_and_stick_where_the_core_says(ball):
    _, way = ball
    view, m = View(way), way.oblique
    spacing = 2 * view.end["x"] / SPRINGS
    share = m.stick_radius[1:-1] / m.contact_radius[1:-1]
    i = 1 + int(np.argmin(np.abs(share - 0.6)))
    rows = columns.springs(view, i)
    # The feet of the springs, of which each is drawn by nine points.
    stick, slip = (np.abs(rows[name][0][::9]) for name in ("sticks", "slips"))
    assert stick.max() == pytest.approx(m.stick_radius[i], abs=1.5 * spacing)
    assert stick.min() < spacing
    assert slip.min() > stick.max()
    assert not rows["elastic"][0].size
    # Their springs carry the force: along the surface κE* times how far they lean.
    r = np.linspace(0, float(m.contact_radius[i]), 4001)
    lean, _ = friction.leaning(way, i, r)
    medium = way.scene.medium
    force = 2 * medium.tangential_ratio * medium.E_star * np.trapezoid(lean, r)
    assert force == pytest.approx(m.tangential_force[i], rel=0.01)


def test_forces_hodograph_and_energy(ball):
    _, way = ball
    view, drive = View(way), way.scene.drive
    rows = friction.forces_still(view)
    (t, along), (_, normal) = rows["force along Fₓ"], rows["normal force F"]
    assert np.all(np.abs(along) <= drive.friction * normal * (1 + 1e-9) + 1e-9 * normal.max())
    # Momentum along the surface, by the trapezoidal rule over 120 instants.
    change = np.trapezoid(along, t) / drive.tangential_mass
    W = way.oblique.tangential_velocity
    assert W[0] - W[-1] == pytest.approx(change, rel=2e-3)
    hodograph = friction.hodograph_still(view)
    drawn = [np.isfinite(hodograph[name][0]) for name in ("something sticks", "all slips")]
    assert np.all(drawn[0] | drawn[1])
    assert hodograph["path before"][1][1] == -drive.speed
    top = columns.energy_still(view)["kinetic"][1]
    energy = drive.mass * drive.speed**2 / 2 + drive.tangential_mass * drive.tangential_speed**2 / 2
    np.testing.assert_allclose(top[: len(top) // 2], energy, rtol=1e-3)
    work = columns.energy_still(view)["friction"][1]
    assert work[: len(work) // 2][-1] == pytest.approx(float(way.oblique.impact.friction_work), rel=1e-3)


def test_maw_s_curve_and_the_present_impact_on_it(monkeypatch):
    monkeypatch.setattr(friction, "_PLACES", 4)
    explorer = oblique(attack=0.3, friction=0.3)
    way = follow(explorer.scene(), 1.0)
    *_, found = friction.maw(way)
    x, y = found.rows["elastic (Maw)"]
    chi = float(way.scene.medium.tangential_ratio) * 7 / 4
    # Of a solid ball: where all slips ψ₂ = ψ₁ − 4χ, from ψ₁ = 4χ − 1 on.
    np.testing.assert_allclose(y[-2:], x[-2:] - 4 * chi, atol=1e-6)
    (before,), (after,) = friction.maw_still(View(way))["this impact"]
    assert before > 4 * chi - 1
    assert after == pytest.approx(before - 4 * chi, abs=2e-3)
    assert friction.maw_still(View(follow(oblique(friction=0.0).scene(), 1.0))) == {}


def test_friction_has_its_lights_and_says_what_is_not_given():
    explorer = oblique()
    way = follow(explorer.scene(), 1.0)
    said = {text: level for level, text in readouts.lights(way, explorer)}
    for limit in way.scene.solve().limits[-3:]:
        assert said[limit.sentence] == limit.level
    explorer.choose("elasticity", "modulus")
    lights = readouts.lights(follow(explorer.scene(), 1.0), explorer)
    assert ("note", "Friction along the surface is that of ν = ½; ν is not given with E*.") in list(lights)


def test_angle_and_components_mean_the_same_and_survive_link_file_and_undo():
    explorer = oblique(DROP)
    scene = explorer.scene()
    explorer.choose("aim", "components")
    drive = explorer.scene().drive
    assert drive.speed == pytest.approx(scene.drive.speed, rel=1e-12)
    assert drive.tangential_speed == pytest.approx(scene.drive.tangential_speed, rel=1e-12)
    other = Explorer()
    link.restore(other, link.arguments(link.query(explorer)))
    assert other.scene() == explorer.scene()
    explorer.accept()
    explorer.undo()
    assert explorer.aim == "angle"
    for body in ("block", "solid", "hollow"):
        explorer.body = body
        link.load_scene(other, link.scene_file(follow(explorer.scene(), 1.0)))
        assert (other.preset, other.body) == (FROM_FILE, body)
        assert other.scene().drive == explorer.scene().drive
    straight = replace(scene, drive=mdr.FreeObliqueImpact(1.0, 1.0, 0.0, 0.3))
    link.load_scene(other, straight.to_json())
    assert other.scene().drive == straight.drive
    with pytest.raises(ValueError, match="other than a block or a ball"):
        link.load_scene(
            other, replace(scene, drive=mdr.FreeObliqueImpact(1.0, 1.0, 1.0, 0.3, 0.5)).to_json()
        )


def test_looking_at_the_other_impact_keeps_body_and_normal_speed():
    explorer = Explorer(DROP)
    before = explorer.scene().drive
    explorer.choose("drive", "oblique")
    drive = explorer.scene().drive
    assert (drive.mass, drive.speed) == pytest.approx((before.mass, before.speed), rel=1e-12)
    explorer.choose("drive", "impact")
    assert explorer.scene().drive.speed == pytest.approx(before.speed, rel=1e-12)


def test_snippet_and_curves_come_to_the_state(ball, capsys):
    explorer, way = ball
    way, values = replace(way, now=90), {}
    exec(export.python(way), values)
    # The rebound angle is that of the page.
    angle = next(value for name, _, _, value in readouts.cells(way) if name == "α_r")
    assert float(capsys.readouterr().out.splitlines()[1]) == pytest.approx(np.degrees(angle), rel=1e-3)
    assert values["hit"].friction_work == way.oblique.impact.friction_work
    drawn, found = way.oblique.tangential_force, values["motion"].tangential_force
    assert found[90] == pytest.approx(drawn[90], abs=1e-3 * np.max(np.abs(drawn)))
    lines = [row.split(",") for row in export.csv(way, explorer).splitlines() if not row.startswith("#")]
    table = dict(zip(lines[0], np.array(lines[1:], float).T, strict=True))
    np.testing.assert_array_equal(table["tangential force F_x (N)"], drawn)
    np.testing.assert_array_equal(table["friction work W_f (J)"], way.oblique.friction_work)


@pytest.mark.filterwarnings("ignore:Widget.name is deprecated:PendingDeprecationWarning")
def test_at_rest_the_page_has_the_exact_numbers():
    page = Page()
    assert "forces" not in page.grid.names
    page.explorer.load(ELASTIC)
    page.explorer.choose("drive", "oblique")
    assert {"forces", "hodograph"} <= set(page.grid.names)
    assert page.way.pending
    page._settled()
    until = time.monotonic() + 60
    while page.way.pending and time.monotonic() < until:
        time.sleep(0.05)
    assert page.way.oblique.impact.friction_work == page.explorer.scene().solve().friction_work
    page.explorer.choose("drive", "depth")
    assert not {"forces", "hodograph"} & set(page.grid.names)


@pytest.mark.parametrize("damping", ["none", "tau"])
def test_every_plot_of_every_state_can_be_drawn(damping):
    explorer = oblique(DROP)
    explorer.choose("damping", damping)
    explorer.param.update(axes="ratio")
    way = follow(explorer.scene(), 1.0)
    view = View(way, [way], chosen=explorer.choices)
    assert_all_is_drawn(view, 17)


def test_an_oblique_impact_in_the_browser(explorer):
    explorer.choose("Preset", ELASTIC)
    explorer.pick("oblique impact")
    state = Explorer(ELASTIC)
    state.choose("drive", "oblique")
    hit = state.scene().solve()
    explorer.wait("explorer.row('hodograph', 'now')?.[0].length === 1")
    explorer.wait("!explorer.model('packet').tags[3][0].includes('so far')")
    _, force = explorer.row("forces", "force along Fₓ")
    unit = explorer.axis("forces")["labels"][1]
    assert unit.endswith("(N)")
    assert np.max(np.abs(force)) == pytest.approx(float(hit.max_tangential_force), rel=1e-3)
    assert explorer.readout("W_f").endswith("µJ")
    assert np.isfinite(explorer.row("springs", "slips")[0]).any()
