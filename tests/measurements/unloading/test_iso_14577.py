"""Elastic work ratio, creep and Martens hardness against closed forms, energies and quadrature."""

import numpy as np
import pytest
import scipy

import mdr_core as mdr

from ...approx import approx
from ...said import remark_of
from .test_creep import record, triangle

TIP, E, DEEP = mdr.Cone.berkovich(), 70e9, 400e-9
MEDIA = {
    "class (a)": mdr.Medium(E, hardness=9e9),
    "class (b)": mdr.Medium(E, q_c=2e3),
    "class (c)": mdr.Medium(E, f_c=1e-3),
}


def pressed(tip, medium, back=0.0, first=0.0, samples=400):
    """Depths and forces of a loading to `DEEP` and an unloading to the depth `back`."""
    depth = np.append(np.linspace(first, DEEP, samples), np.linspace(DEEP, back, samples))
    return depth, mdr.indent(tip, medium, depth).force


@pytest.mark.parametrize("tip", [TIP, mdr.Paraboloid(1e-6), mdr.FlatPunch(1e-7), mdr.PowerLaw(1.0, 0.5)])
@pytest.mark.parametrize("back", [0.0, 0.38 * DEEP])
def test_an_elastic_contact_gives_back_all_work(tip, back):
    """To the error of the trapezoid rule of 400 samples; also where the last 14 % are extrapolated."""
    medium = mdr.Medium(E)
    if mdr.indent(tip, medium, [back]).force[0] > 0.2 * mdr.indent(tip, medium, [DEEP]).force[0]:
        assert mdr.oliver_pharr(tip, *pressed(tip, medium, back)).elastic_work_ratio is None
    else:
        result = mdr.oliver_pharr(tip, *pressed(tip, medium, back), epsilon=0.4)
        assert result.elastic_work_ratio == approx(1.0, abs=2e-5)


@pytest.mark.parametrize("medium", MEDIA.values(), ids=MEDIA)
def test_of_a_medium_that_yields_it_is_the_stored_energy_over_all_work(medium):
    """By the ledger of energies, and by quadrature of the force; also from 12 % of the depth on."""
    depth, force = pressed(TIP, medium)
    state = mdr.indent(TIP, medium, depth)[399]
    ratio = state.stored_energy / (state.stored_energy + state.plastic_work)
    dead = float(mdr.indent(TIP, medium, [0.0, DEEP])[-1].plastic_depth)

    def unloaded(h):
        return mdr.indent(TIP, medium, [0.0, DEEP, h]).force[-1]

    total, _ = scipy.integrate.quad(lambda h: mdr.indent(TIP, medium, h).force, 0.0, DEEP, epsrel=1e-6)
    back, _ = scipy.integrate.quad(unloaded, dead, DEEP, epsrel=1e-6, points=[0.9 * DEEP])
    # Of the quadrature, near first contact and where contact is lost.
    assert ratio == approx(back / total, rel=2e-4)
    # The trapezoid rule of an unloading by some tens of samples.
    assert mdr.oliver_pharr(TIP, depth, force).elastic_work_ratio == approx(ratio, rel=2e-3)
    late = mdr.oliver_pharr(TIP, *pressed(TIP, medium, first=0.12 * DEEP))
    assert late.elastic_work_ratio == approx(ratio, rel=2e-3)


def test_without_the_beginning_of_the_loading_there_is_no_work_of_it():
    """From half of the depth on, and of an unloading alone."""
    depth, force = pressed(TIP, MEDIA["class (a)"])
    for part in (slice(200, None), slice(399, None)):
        result = mdr.oliver_pharr(TIP, depth[part], force[part])
        assert result.elastic_work_ratio is None
        assert result.hardness > 0


@pytest.mark.parametrize("cycles", [False, True])
@pytest.mark.parametrize("timed", [False, True])
def test_an_unloading_that_has_hardly_begun_gives_a_modulus_and_no_works(cycles, timed):
    """It ends at 95 % of the force. The power law of an elastic cone is exact, so that E* is."""
    depth, force = pressed(TIP, mdr.Medium(E), back=np.sqrt(0.95) * DEEP)
    time = 0.1 * np.arange(depth.size) if timed else None
    result = mdr.oliver_pharr(TIP, depth, force, time=time, cycles=cycles, epsilon=2 - 4 / np.pi)
    assert result.E_star == approx(E, rel=1e-9)
    assert np.all(np.isnan([result.elastic_work_ratio, result.indentation_creep, result.martens_hardness]))
    remark = remark_of(result, "left out")
    assert "95 % of the largest force" in remark
    assert "nan" not in repr(result)


@pytest.mark.parametrize(("end", "said"), [(0.12, True), (0.005, False)])
def test_a_work_below_the_last_force_is_said_to_be_extrapolated(end, said):
    depth, force = pressed(TIP, mdr.Medium(E), back=np.sqrt(end) * DEEP)
    result = mdr.oliver_pharr(TIP, depth, force)
    assert result.elastic_work_ratio == approx(1.0, abs=2e-5)
    assert any(f"ends at {100 * end:g} % of the largest force" in each for each in result.remarks) == said


def test_air_and_holds_after_the_unloading_are_no_part_of_the_works():
    """90 nm of air, and a hold at 10 % of the force in which the depth drifts by a fifth of the largest."""
    depth, force = pressed(TIP, MEDIA["class (a)"])
    expected = mdr.oliver_pharr(TIP, depth, force).elastic_work_ratio
    stop = 400 + int(np.argmax(force[400:] < 0.1 * force.max()))
    away = np.linspace(-90e-9, 0, 90, endpoint=False)
    drift = np.linspace(0, 0.2 * DEEP, 60)
    depth = np.concatenate([away, depth[:stop], depth[stop] + drift, drift[-1] + depth[stop:]])
    force = np.concatenate([0 * away, force[:stop], force[stop] + 0 * drift, force[stop:]])
    # What is below 10 % of the force is extrapolated, to 0.5 % of the work; the drift would be 6 % of it.
    assert mdr.oliver_pharr(TIP, depth, force).elastic_work_ratio == approx(expected, rel=0.01)


@pytest.mark.parametrize("kind", ["logarithmic", "viscous"])
def test_creep_is_the_growth_of_the_depth_in_the_hold(kind):
    """Between the samples at both ends of the hold of 10 s; also of indices in the place of times."""
    time, depth, force = record(0.3, kind)
    expected = (depth[300] - depth[200]) / depth[200]
    for moments in (time, None):
        result = mdr.oliver_pharr(TIP, depth, force, time=moments)
        assert result.indentation_creep == approx(expected, rel=1e-9)
    noisy = force + 2e-3 * force.max() * np.random.default_rng(1).normal(size=force.size)
    # Noise of 0.2 % moves the ends of the hold by a sample, 0.5 % of the depth in the loading.
    assert mdr.oliver_pharr(TIP, depth, noisy, time=time).indentation_creep == approx(expected, abs=6e-3)


def test_work_of_a_hold_is_a_part_of_the_whole_work():
    """A hold in which the depth grows by δ adds F δ to the work, and leaves the unloading as it is."""
    depth, force = pressed(TIP, MEDIA["class (a)"])
    expected = mdr.oliver_pharr(TIP, depth, force).elastic_work_ratio
    total, delta = scipy.integrate.trapezoid(force[:400], depth[:400]), 20e-9
    held = DEEP + np.linspace(0, delta, 50)
    depth = np.concatenate([depth[:400], held, depth[400:] + delta])
    force = np.concatenate([force[:400], np.full(50, force.max()), force[400:]])
    result = mdr.oliver_pharr(TIP, depth, force)
    assert result.elastic_work_ratio == approx(expected * total / (total + force.max() * delta), rel=1e-9)
    assert result.indentation_creep == approx(delta / DEEP, rel=1e-9)


@pytest.mark.parametrize("noise", [0.0, 2e-3])
def test_without_a_hold_there_is_no_creep(noise):
    for seed in range(5):
        time, depth, force = triangle(400, noise, seed)
        for moments in (time, None):
            assert mdr.oliver_pharr(TIP, depth, force, time=moments).indentation_creep is None


def test_martens_hardness_of_an_elastic_cone():
    """F = 2/π E* d²/s over 26.43 d²; at the begin of a hold, where the depth grows in it."""
    depth, force = pressed(TIP, mdr.Medium(E))
    closed = 2 / np.pi * E / TIP.slope / 26.43
    assert mdr.oliver_pharr(TIP, depth, force).martens_hardness == approx(closed, rel=1e-12)
    held = DEEP + np.linspace(0, 20e-9, 50)
    depth = np.concatenate([depth[:400], held, depth[400:] + 20e-9])
    force = np.concatenate([force[:400], np.full(50, force.max()), force[400:]])
    assert mdr.oliver_pharr(TIP, depth, force).martens_hardness == approx(closed, rel=1e-12)


@pytest.mark.parametrize(
    ("tip", "has"),
    [
        (mdr.Cone.from_half_angle(70.21), True),
        (mdr.Cone.from_half_angle(70.39), True),
        (mdr.Cone.from_half_angle(70.15), False),
        (mdr.Cone.from_half_angle(70.45), False),
        (mdr.Paraboloid(1e-6), False),
    ],
)
def test_martens_hardness_is_of_pyramids(tip, has):
    """The print of others says why they have none."""
    result = mdr.oliver_pharr(tip, *pressed(tip, MEDIA["class (a)"]))
    assert (result.martens_hardness is not None) == has
    assert ("martens_hardness" in result.to_dict()) == has
    assert ("Berkovich and Vickers pyramids" in repr(result)) != has
    assert ("Martens hardness HM" in repr(result)) == has


def two_cycles():
    """The first with a hold of its peak, the second without."""
    path = [(0, 200), (200, 200), (200, 60), (60, 400), (400, 120)]
    depth = 1e-9 * np.concatenate([np.linspace(*pair, 150) for pair in path])
    force = mdr.indent(TIP, MEDIA["class (a)"], depth).force
    return depth, force


def test_each_unloading_has_its_own_and_nan_where_it_lacks_one():
    """Over all work that was done before: class (a) under a cone is self-similar, so both are equal."""
    result = mdr.oliver_pharr(TIP, *two_cycles(), cycles=True)
    once = mdr.oliver_pharr(TIP, *pressed(TIP, MEDIA["class (a)"])).elastic_work_ratio
    assert result.elastic_work_ratio == approx([once, once], rel=2e-3)
    assert result.martens_hardness[0] == approx(result.martens_hardness[1], rel=1e-9)
    assert result.indentation_creep[0] == approx(0.0, abs=1e-12)
    assert np.isnan(result.indentation_creep[1])
    assert result[1].indentation_creep is None
    assert result[0].indentation_creep == result.indentation_creep[0]
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    table, dataset = result.to_pandas(), result.to_xarray()
    assert pandas.isna(table["indentation_creep"]).tolist() == [False, True]
    assert isinstance(dataset, xarray.Dataset)
    assert dataset["elastic_work_ratio"].dims == ("unloading",)


def test_a_smaller_loading_after_a_larger_one_has_no_work_of_its_own():
    path = [(0, 400), (400, 150), (150, 390), (390, 150)]
    depth = 1e-9 * np.concatenate([np.linspace(*pair, 150) for pair in path])
    force = mdr.indent(TIP, MEDIA["class (a)"], depth).force
    result = mdr.oliver_pharr(TIP, depth, force, cycles=True)
    assert np.isfinite(result.elastic_work_ratio).tolist() == [True, False]
    assert np.isfinite(result.martens_hardness).tolist() == [True, False]


def test_what_a_record_lacks_has_no_place_in_tables():
    """A cone of another angle without a hold has the ratio of works alone."""
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    tip = mdr.Cone(0.3)
    for cycles in (False, True):
        result = mdr.oliver_pharr(tip, *pressed(tip, MEDIA["class (a)"]), cycles=cycles)
        assert result.indentation_creep is None
        for names in (result.to_dict(), result.to_pandas().columns, result.to_xarray().variables):
            assert "elastic_work_ratio" in names
            assert not {"indentation_creep", "martens_hardness"} & set(names)


def test_results_over_depth_have_none_of_them():
    depth = np.linspace(10e-9, DEEP, 50)
    state = mdr.indent(TIP, mdr.Medium(E), depth)
    over = mdr.oliver_pharr(TIP, depth, state.force, stiffness=state.stiffness)
    assert not {"elastic_work_ratio", "indentation_creep", "martens_hardness"} & set(over.to_dict())
    assert over.elastic_work_ratio is None
    assert "Martens" not in repr(over)
    assert "Martens" not in repr(over[-1])
