"""The sweep: its columns are those of one scene at a time, its limits those of the paper."""

import numpy as np
import pytest

from app import export, link, sweep
from app.drives import follow
from app.explorer import Explorer
from app.presets import OPENING, PRESETS

from .conftest import DROP


def swept(explorer, **choices):
    for name, option in choices.items():
        explorer.choose(name, option)
    asked = sweep.asked(explorer)
    (found,) = sweep.found(follow(explorer.scene(), 1.0), asked)
    return asked, found


def one(explorer, name, value, quantity):
    """A quantity of the scene with another value of one number, as the page itself would show it."""
    other = Explorer()
    link.restore(other, link.arguments(link.query(explorer)))
    if name == "energy":
        name, value = "speed", (2 * value / other.mass) ** 0.5
    other.param.update(**{name: float(value)})
    way = follow(other.scene(), 1.0)
    return float(getattr(way.hit or way.deepest, quantity))


@pytest.mark.parametrize("drive", ["impact", "depth", "force"])
def test_every_number_is_swept_as_one_scene_at_a_time(drive):
    explorer = Explorer(OPENING)
    explorer.choose("drive", drive)
    for name in explorer.options("swept"):
        asked, found = swept(explorer, swept=name, against="plastic_work", sweep_axes="log_x")
        numbers, values = found.rows["this scene"]
        assert (numbers[0], numbers[-1]) == pytest.approx((asked.low, asked.high), rel=1e-12)
        for k in (0, 50, 80):
            expected = one(explorer, name, numbers[k], "plastic_work")
            # Inverse functions are found to some units of rounding, times a condition of some tens.
            assert values[k] == pytest.approx(expected, rel=1e-11, abs=1e-11 * values.max()), name
        x, y = (float(part[0]) for part in found.rows["present value"])
        assert x == explorer.number(name)
        assert np.interp(x, numbers, values) == pytest.approx(y, rel=2e-2)


def test_a_viscous_impact_is_swept_over_its_relaxation_time_at_rest():
    explorer = Explorer(DROP)
    explorer.choose("damping", "tau")
    explorer.tau = 1e-5
    asked, found = swept(explorer, swept="tau", against="restitution")
    numbers, values = found.rows["this scene"]
    assert not sweep.quick(asked)
    assert values[20] == pytest.approx(one(explorer, "tau", numbers[20], "restitution"), rel=1e-9)
    # The limit of fast impacts is without viscosity.
    assert sweep.FAST not in found.rows
    explorer.choose("damping", "none")
    assert "tau" not in explorer.options("swept")
    assert explorer.option("swept") == "energy"


@pytest.mark.parametrize(("shape", "power"), [("cone", 1.0), ("paraboloid", 2 / 3)])
def test_the_damaged_area_comes_to_the_fast_limit_and_its_power_of_the_energy(shape, power):
    """Popov (2015), Eq. (24): A = 4W/(π q_c s) of a cone; class (b) in general 2/(n + 1)."""
    explorer = Explorer(DROP)
    explorer.choose("shape", shape)
    explorer.choose("swept", "energy")
    explorer.type("energy_from", "10 kJ")
    explorer.type("energy_to", "1 MJ")
    _, found = swept(explorer, against="damaged_area")
    (W, area), (_, fast) = found.rows["this scene"], found.rows[sweep.FAST]
    if shape == "cone":
        np.testing.assert_allclose(fast, 4 * W / (np.pi * explorer.q_c * explorer.cone_slope), rtol=1e-12)
    slopes = np.diff(np.log(area)) / np.diff(np.log(W))
    # What is missing of the limit falls as d_c/d.
    assert slopes[-1] == pytest.approx(power, rel=2e-2)
    assert abs(slopes[-1] - power) < abs(slopes[0] - power)
    assert abs(area[-1] / fast[-1] - 1) < abs(area[0] / fast[0] - 1) < 0.2
    for name, i in (("a", 2), ("c", 0)):
        law = np.diff(np.log(found.rows[sweep.CLASSES[name]][1])) / np.diff(np.log(W))
        np.testing.assert_allclose(law, 2 / ({"cone": 1, "paraboloid": 2}[shape] + i), rtol=1e-9)
    assert "outside of the range" in found.note


def test_what_cannot_be_solved_ends_the_curve_and_is_said():
    explorer = Explorer("Flat steel punch on glass-fibre epoxy")
    explorer.choose("drive", "force")
    _, found = swept(explorer, swept="max_force", against="depth")
    numbers, values = found.rows["this scene"]
    most = np.pi * explorer.q_c * explorer.flat_punch_radius
    np.testing.assert_array_equal(np.isfinite(values), numbers < most)
    assert "the whole flat face yields" in found.note


def test_a_range_is_typed_and_is_in_the_link_and_begins_anew_with_a_preset():
    explorer = Explorer(DROP)
    explorer.plots = ["sweep"]
    explorer.choose("swept", "speed")
    explorer.type("speed_from", "5 mm/s")
    explorer.choose("sweep_axes", "linear")
    other = Explorer()
    link.restore(other, link.arguments(link.query(explorer)))
    theirs, ours = sweep.asked(other), sweep.asked(explorer)
    assert (theirs.swept, theirs.low, theirs.axes) == ("speed", 0.005, "linear")
    assert (theirs.high, theirs.against) == (ours.high, ours.against)
    with pytest.raises(ValueError, match="out of bounds"):
        explorer.type("speed_from", "1000 km/s")
    high = explorer.number("speed_to")
    explorer.reset("speed_from")
    assert explorer.number("speed_from") < PRESETS[DROP].values["speed"] < high
    explorer.type("speed_from", "5 mm/s")
    explorer.load(DROP)
    assert explorer.speed_from is None


def test_a_drive_that_is_not_swept_says_so():
    explorer = Explorer()
    explorer.choose("drive", "path")
    way = follow(explorer.scene(), 1.0)
    (found,) = sweep.found(way, sweep.asked(explorer))
    assert found.rows == {}
    assert "press to a depth" in found.note
    assert export.sweep_python(explorer) == ""
    assert "not swept" in export.sweep_csv(way, explorer)


@pytest.mark.parametrize(
    ("drive", "name"),
    [("impact", "energy"), ("impact", "nu_1"), ("depth", "cone_slope"), ("force", "q_c")],
)
def test_the_sweep_is_taken_away_as_csv_and_python(drive, name, capsys):
    explorer = Explorer()
    explorer.choose("drive", drive)
    asked, found = swept(explorer, swept=name)
    text = export.sweep_csv(follow(explorer.scene(), 1.0), explorer)
    rows = [line.split(",") for line in text.splitlines() if not line.startswith("#")]
    assert {len(row) for row in rows} == {len(rows[0])}
    column = next(k for k, head in enumerate(rows[0]) if head.startswith(asked.against))
    numbers, values = np.array(rows[1:], float)[:, [0, column]].T
    shown = found.rows["this scene"]
    np.testing.assert_array_equal(numbers, shown[0])
    np.testing.assert_array_equal(values[np.isfinite(shown[1])], shown[1][np.isfinite(shown[1])])
    capsys.readouterr()
    exec("import mdr_core as mdr\n" + export.sweep_python(explorer), {})
    printed = capsys.readouterr().out.replace("[", " ").replace("]", " ").replace(",", " ").split()
    printed = [float(each.removeprefix("np.float64(").removesuffix(")")) for each in printed]
    # Printed with eight digits.
    np.testing.assert_allclose(printed, values, rtol=1e-7)
