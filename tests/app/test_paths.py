"""Paths on the page, without a browser: their vertices as text, and what is drawn of them."""

from dataclasses import replace

import numpy as np
import pytest

import mdr_core as mdr
from app import columns, export, link, readouts
from app.drives import DRIVES, drive_of, follow
from app.explorer import Explorer
from app.quantities import CHOICES
from app.vertices import read_path, write
from app.view import View, phase

PATTERNS = [pattern for pattern in CHOICES["pattern"] if pattern != "own"]


def path(pattern, viscous=False, shape="cone"):
    explorer = Explorer()
    explorer.choose("shape", shape)
    if viscous:
        explorer.choose("damping", "tau")
    explorer.choose("drive", "path")
    explorer.choose("pattern", pattern)
    return explorer


def solved(explorer, progress=1.0):
    way = follow(explorer.scene(), progress)
    return DRIVES["path"].in_time(way.scene) if way.pending else way


def test_every_drive_of_the_form_is_in_the_table():
    assert set(DRIVES) == set(CHOICES["drive"])


@pytest.mark.parametrize("pattern", PATTERNS)
def test_a_pattern_goes_as_deep_as_what_was_there_before(pattern):
    way = solved(path(pattern))
    assert float(way.deepest.depth) == pytest.approx(Explorer().max_depth, rel=1e-9)
    assert way.progress[way.peak] == 1.0
    assert np.all(np.diff(way.progress) >= 0)
    assert drive_of(way.scene) is DRIVES["path"]


def test_hysteresis_yields_once_a_cycle_and_reloads_elastically():
    way = solved(path("cycles"))
    rows = columns.force(View(way), len(way) - 1)
    yielding, elastic = rows["yielding"], rows["elastic"]
    peaks = Explorer().max_depth * np.arange(1, 6) / 5
    stretches = np.split(yielding[0], np.flatnonzero(np.isnan(yielding[0])))
    ends = [[part[~np.isnan(part)][k] for part in stretches] for k in (0, -1)]
    np.testing.assert_allclose(ends, [peaks[:-1], peaks[1:]], rtol=1e-9)
    # One goes back elastically to where the cycle before began to unload.
    assert np.nanmax(elastic[0]) == pytest.approx(peaks[-2], rel=1e-9)


def test_the_curve_is_drawn_as_one_goes():
    view = View(solved(path("reload")))
    middle, end = (columns.force(view, i) for i in (view.way.peak // 2, len(view.way) - 1))
    names = ("elastic", "yielding", "unloading")
    drawn = [sum(np.isfinite(rows[name][0]).sum() for name in names) for rows in (middle, end)]
    assert 0 < drawn[0] < drawn[1]
    assert len(columns.force_still(view)["path ahead"][0]) == len(view.way)


@pytest.mark.parametrize("name", ["depth", "force"])
def test_the_load_is_gone_at_a_step(name):
    """The contact radius comes down to that of the imprint and then falls, within a trace of depth."""
    explorer = path("reload")
    explorer.choose("prescribed", name)
    way = solved(explorer)
    a, c, depth = way.states.contact_radius, way.states.plastic_radius, way.states.depth
    gone = np.flatnonzero((a[1:] == 0) & (a[:-1] > 0))
    assert len(gone) == 2
    np.testing.assert_allclose(a[gone], c[gone], rtol=1e-6)
    assert np.all(np.abs(depth[gone] - depth[gone + 1]) < 1e-6 * depth.max())
    assert phase(way, len(way) - 1) == "load gone"


def test_depth_and_force_prescribe_the_same_states():
    explorer = path("cycles")
    depth = [row[0] for row in explorer.path]
    explorer.choose("prescribed", "force")
    assert isinstance(explorer.scene().drive, mdr.ForcePath)
    np.testing.assert_allclose(explorer.scene().solve().depth, depth, rtol=1e-9, atol=1e-20)
    explorer.choose("prescribed", "depth")
    np.testing.assert_allclose([row[0] for row in explorer.path], depth, rtol=1e-9, atol=1e-20)


@pytest.mark.parametrize("shape", ["cone", "sphere", "flat_punch"])
def test_a_held_ramp_of_a_viscous_medium_is_that_of_the_core(shape):
    explorer = path("hold", viscous=True, shape=shape)
    way = solved(explorer)
    assert not way.pending
    time, medium = way.motion.time, explorer.medium()
    exact = mdr.indent_in_time(explorer.profile(), medium, way.states.depth, time)
    # What the page asks of the chain is 3·10⁻³.
    np.testing.assert_allclose(way.force, exact.force, atol=3e-3 * exact.force.max())
    assert "error of the chain" in readouts.heads(readouts.cells(way))
    # At the end of the hold the dashpots carry nothing: F of the springs alone.
    still = mdr.indent(explorer.profile(), medium, way.states.depth)
    assert way.force[-1] == pytest.approx(float(still.force[-1]), rel=1e-3)
    # All that has been put in is in the ledger, by the trapezoidal rule over 24 steps a piece.
    motion = way.motion
    work = np.sum((way.force[1:] + way.force[:-1]) / 2 * np.diff(way.states.depth))
    ledger = motion.stored_energy + motion.plastic_work + motion.viscous_work
    assert ledger[-1] == pytest.approx(work, rel=0.02)


@pytest.mark.parametrize("shape", ["cone", "sphere"])
def test_the_pressure_of_the_chain_is_that_of_the_core(shape):
    """Away from the rim it is the core's; elements between 300 places are straight."""
    way = solved(path("hold", viscous=True, shape=shape))
    for i in (way.peak // 2, way.peak, len(way) - 1):
        state = way.states[i]
        a = float(state.contact_radius)
        r = a * np.linspace(0.02, 0.98, 40)
        exact = mdr.indent_in_time(
            way.scene.profile, way.scene.medium, way.states.depth[: i + 1], way.motion.time[: i + 1]
        )[-1]
        p = state.pressure(r)
        np.testing.assert_allclose(p, exact.pressure(r), atol=3e-3 * p.max())
        assert np.isinf(state.pressure(a)) == (i <= way.peak)


def test_the_surface_beside_a_ramp_is_that_of_the_springs():
    """While nothing lets go dashpots do not move the surface; between 300 places it is straight."""
    way = solved(path("hold", viscous=True))
    for i in (way.peak // 2, len(way) - 1):
        state = way.states[i]
        still = mdr.indent(way.scene.profile, way.scene.medium, way.states.depth[: i + 1])[-1]
        r = float(state.contact_radius) * np.array([0.5, 1.01, 1.5, 3.0])
        np.testing.assert_allclose(state.surface(r), still.surface(r), rtol=1e-3)
        np.testing.assert_allclose(state.imprint(r), still.imprint(r), rtol=1e-9, atol=1e-15)


def test_creep_is_first_shown_without_dashpots_and_then_in_time():
    explorer = path("creep", viscous=True)
    first = follow(explorer.scene(), 1.0)
    assert first.pending
    assert "without dashpots" in phase(first, first.now)
    way = solved(explorer)
    assert not way.pending
    assert np.all(np.diff(way.states.depth) > 0)
    assert way.force[-1] == pytest.approx(first.force[-1])
    # It creeps towards what the springs alone carry.
    assert 0.7 < way.states.depth[-1] / first.states.depth[-1] < 1


_TAKEN = [("reload", False), ("cycles", True), ("hold", False), ("hold", True)]


@pytest.mark.parametrize(("pattern", "viscous"), _TAKEN)
def test_a_path_is_in_the_link_the_scene_file_and_the_snippet(pattern, viscous, capsys):
    explorer = path(pattern, viscous)
    other = Explorer()
    link.restore(other, link.arguments(link.query(explorer)))
    assert other.scene() == explorer.scene()
    way = solved(explorer)
    link.load_scene(other, link.scene_file(way))
    assert other.scene().drive == explorer.scene().drive
    assert other.drive == "path"
    for now in (len(way) // 3, way.peak, len(way) - 2):
        values = {}
        exec(export.python(replace(way, now=now)), values)
        # Another chain, of the tolerance of its own.
        tolerance = 3e-3 * way.force.max() if viscous and pattern == "hold" else 1e-9 * way.force.max()
        assert float(values["state"].force) == pytest.approx(float(way.force[now]), abs=tolerance)
    capsys.readouterr()
    assert "vertices" in readouts.summary(explorer)
    data = [line for line in export.csv(way, explorer).splitlines() if not line.startswith("#")]
    assert len(data) == 1 + len(way)


def test_vertices_are_typed_as_text():
    shown = [(1e-8, 0.0), (5e-9, 1e-3)]
    assert write(shown, "depth") == "10 nm, 0 ms\n5 nm, 1 ms"
    typed = "0 nm, 0\n10, 1\n\n10 nm; 2\n0,005 µm\t3 ms\n2.5 nm at 0.004 s"
    np.testing.assert_allclose(
        read_path(typed, "depth", shown),
        [(0, 0), (1e-8, 1e-3), (1e-8, 2e-3), (5e-9, 3e-3), (2.5e-9, 4e-3)],
        rtol=1e-14,
    )
    # A line that is left alone keeps the digits that are not shown.
    third = [(1e-8 / 3,), (1e-8,)]
    assert read_path(write(third, "depth") + "\n5 nm", "depth", third) == [*third, (5e-9,)]


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("10 nm\n5 bananas", "Line 2: “5 bananas” is not a number"),
        ("10 nm, 1 ms, 3", "Line 1: .* more than a depth and a time"),
        ("10 nm, 1 ms\n5 nm", "a time at each vertex, or at none"),
        ("10 nm, 1 ms\n5 nm, 1 ms", "does not increase"),
        ("10 nm, 1 ms", "in time 2 at least"),
        ("0 nm\n-5 nm", "largest depth of a path is out of bounds"),
        ("10 nm\n" * 61, "1 to 60 vertices"),
        ("", "1 to 60 vertices"),
    ],
)
def test_what_is_no_path_is_refused(typed, said):
    with pytest.raises(ValueError, match=said):
        read_path(typed, "depth", [(1e-8,)])


def test_a_path_drawn_by_hand_is_kept_while_other_drives_are_looked_at():
    explorer = Explorer()
    explorer.choose("drive", "path")
    explorer.param.update(path=[(2e-9,), (1e-9,), (3e-9,)], pattern="own")
    explorer.accept()
    explorer.choose("drive", "impact")
    explorer.choose("drive", "path")
    assert [row[0] for row in explorer.path] == [2e-9, 1e-9, 3e-9]
    explorer.load(explorer.preset)
    explorer.choose("drive", "path")
    assert float(explorer.solved().depth) == pytest.approx(Explorer().max_depth)


@pytest.mark.parametrize("prescribed", ["depth", "force"])
@pytest.mark.parametrize("vertices", [(1.0,), (1.0, 0.6), (1.0, 0.0)])
def test_a_path_of_one_or_two_vertices_ends_there(prescribed, vertices):
    explorer = path("reload")
    explorer.choose("prescribed", prescribed)
    most = max(row[0] for row in explorer.path)
    explorer.param.update(path=[(most * share,) for share in vertices], pattern="own")
    again = Explorer()
    link.restore(again, link.arguments(link.query(explorer)))
    assert again.scene() == explorer.scene()
    way = solved(again)
    found = way.states.depth if prescribed == "depth" else way.force
    assert found[0] == 0
    assert found[-1] == pytest.approx(most * vertices[-1], abs=1e-9 * most)
    assert max(found) == pytest.approx(most, rel=1e-9)
    exec(export.python(way), {})
    # As a file it is a press to the same state.
    opened = Explorer()
    link.load_scene(opened, link.scene_file(way))
    state, asked = follow(opened.scene(), opened.progress).state, way.states[len(way) - 1]
    assert opened.drive == prescribed
    assert float(state.depth) == pytest.approx(float(asked.depth), rel=1e-4)
