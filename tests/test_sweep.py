"""Ensembles over named dimensions: the numbers of single impacts, lazily, on two processes, to disk."""

import io
import os
import signal
import sys
import textwrap
import warnings
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core import sweep
from mdr_core.show import progress
from mdr_core.show.quantities import described

from .approx import approx

xr = pytest.importorskip("xarray")

SPEED = xr.DataArray(np.geomspace(1e-2, 1.0, 5), dims="speed")
RADIUS = xr.DataArray([1e-6, 1e-5, 1e-4], dims="radius", coords={"radius": [1, 10, 100]})
SPHERES = {"E_star": 1e9, "q_c": 10.0, "mass": 1e-12, "radius": RADIUS, "speed": SPEED}
REST = {"radius": 1e-5, "E_star": 1e9, "q_c": 10.0, "mass": 1e-12}
ONE = mdr.impact(mdr.Sphere(1e-5), mdr.Medium(1e9, q_c=10.0), 1e-12, 0.1)
ALL = [name for name in ONE.to_dict() if name not in ("mass", "speed")]


@pytest.mark.parametrize("eta", [0.0, 1.0])
def test_every_entry_is_the_impact_of_its_parameters(eta):
    table = sweep.impacts(mdr.Sphere, **SPHERES, eta=eta, quantities=ALL)
    assert dict(table.sizes) == {"radius": 3, "speed": 5}
    for place, speed in enumerate(SPEED.values):
        hit = mdr.impact(mdr.Sphere(1e-5), mdr.Medium(1e9, q_c=10.0, eta=eta), 1e-12, speed)
        for name in ALL:
            # Dry ones differ by rounding; viscous ones come in steps of their own.
            expected = approx(float(getattr(hit, name)), rel=1e-9 if eta else 1e-12, abs=0.0)
            assert float(table[name].sel(radius=10)[place]) == expected, name


def test_entries_with_adhesion_viscosity_and_plates_are_solved_apart():
    """With each other they are refused by `impact`, which solves all entries in one way."""
    given = {
        "work_of_adhesion": [0.1, 0.0, 0.0, 0.0, 0.1], "eta": [0.0, 10.0, 0.0, 0.0, 0.0],
        "impedance": [np.inf, np.inf, 1e-3, np.inf, 1e-3], "hardness": [0.0, 0.0, 0.0, 1e8, 0.0],
        "q_c": [10.0, 10.0, 10.0, 0.0, 10.0],
    }  # fmt: skip
    arrays = {name: xr.DataArray(values, dims="kind") for name, values in given.items()}
    one = {"radius": 1e-5, "E_star": 1e9, "mass": 1e-10, "speed": 1.0}
    table = sweep.impacts(mdr.Sphere, **one, **arrays, invalid="nan")
    # Adhesion on a plate is not modelled.
    assert table.invalid_count == 1
    assert np.isnan(table.restitution.values[4])
    for i, found in enumerate(table.restitution.values[:4]):
        own = {name: values[i] for name, values in given.items()}
        structure = mdr.Structure(own.pop("impedance"))
        hit = mdr.impact(mdr.Sphere(1e-5), mdr.Medium(1e9, **own), 1e-10, 1.0, structure=structure)
        assert found == approx(hit.restitution, rel=1e-9)


@pytest.mark.parametrize(
    "structure",
    [
        mdr.Structure(stiffness=1e6),
        mdr.Structure.plate(2e-3, 70e9, 0.3, 2700.0),
        mdr.Structure.modal(800.0, 0.05),
    ],
)
def test_a_structure_is_that_of_all_impacts_and_of_the_dataset(structure):
    """Restitution of impacts on a structure against single ones; the attributes describe the structure."""
    given = {"E_star": 1e9, "mass": 1e-3}
    table = sweep.impacts(mdr.Sphere, radius=1e-3, **given, q_c=1e5, speed=SPEED, structure=structure)
    for found, speed in zip(table.restitution.values, SPEED.values, strict=True):
        hit = mdr.impact(mdr.Sphere(1e-3), mdr.Medium(1e9, q_c=1e5), 1e-3, speed, structure=structure)
        assert found == approx(hit.restitution, rel=1e-9)
    assert table.attrs["structure"] == described(structure)


def test_dimensions_are_matched_by_name():
    """Whatever the order of the axes: what positions would mix up, or refuse."""
    both = xr.DataArray(np.outer([1e-12, 1e-11, 1e-10], np.ones(5)), dims=("radius", "speed"))
    table = sweep.impacts(mdr.Sphere, **SPHERES | {"mass": both.T})
    again = sweep.impacts(mdr.Sphere, **SPHERES | {"mass": both})
    xr.testing.assert_allclose(table.transpose(*again.dims), again, rtol=1e-12)
    with pytest.raises(ValueError, match=r"radius and mass are not aligned: .*radius"):
        sweep.impacts(mdr.Sphere, **SPHERES | {"mass": both.assign_coords(radius=[1, 2, 3])})
    with pytest.raises(ValueError, match=r"mass and speed are not aligned: .*speed"):
        sweep.impacts(mdr.Sphere, **SPHERES | {"mass": both[:, :4]})


def test_erosion_over_the_angle_of_attack():
    """Where all slips friction takes 2μmv(W − μv); steep ones stick, and lose less than they could."""
    attack = xr.DataArray(np.radians([20.0, 45.0, 89.0]), dims="attack")
    v, along, mu = 2.0 * np.sin(attack), 2.0 * np.cos(attack), 0.2
    names = ["friction_work", "tangential_velocity", "restitution"]
    given = {"E_star": 1e9, "mass": 1e-9, "speed": v, "tangential_speed": along, "friction": mu}
    table = sweep.oblique_impacts(mdr.Paraboloid, radius=1e-4, **given, quantities=names)
    slips = (2 * mu * 1e-9 * v * (along - mu * v))[:2]
    np.testing.assert_allclose(table.friction_work[:2], slips, rtol=1e-8)
    assert table.friction_work[2] < 0.5e-9 * along[2] ** 2
    assert table.friction_work.attrs["units"] == "J"
    # Of a ball, and a medium with another ν.
    ball = sweep.oblique_impacts(
        mdr.Paraboloid(1e-4), **given, poisson=0.3, tangential_mass=2e-9 / 7, quantities=names,
        tolerance=1e-5,
    )  # fmt: skip
    hit = mdr.oblique_impact(
        mdr.Paraboloid(1e-4), mdr.Medium(1e9, poisson=0.3), 1e-9, float(v[2]), float(along[2]), mu,
        tangential_mass=2e-9 / 7,
    )  # fmt: skip
    for name in names:
        assert float(ball[name][2]) == approx(float(getattr(hit, name)), rel=1e-12), name


def test_numbers_alone_make_numbers():
    one = sweep.impacts(mdr.Cone(0.3), E_star=1e9, q_c=10.0, mass=1e-9, speed=0.1, quantities="max_depth")
    hit = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0), 1e-9, 0.1)
    assert one.max_depth.shape == ()
    assert float(one.max_depth) == approx(float(hit.max_depth), rel=1e-14)


def test_results_say_what_they_are():
    table = sweep.impacts(mdr.Sphere, **SPHERES, quantities=("damaged_area", "restitution"))
    assert table.damaged_area.attrs == {"units": "m²", "long_name": "damaged area", "symbol": "A"}
    assert table.restitution.attrs["units"] == "1"
    assert table.attrs["indenter"] == "Sphere"
    assert table.attrs["E_star"] == 1e9
    assert table.attrs["speed"] == "over speed"
    assert table.attrs["version"] == f"mdr_core {mdr.__version__}"
    assert table.radius.values.tolist() == [1, 10, 100]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"quantities": ("restitution", "colour")}, "quantity = 'colour' must be one of"),
        ({"slope": 1.0}, "slope is not a parameter of the sweep or of Sphere, which has radius"),
        ({"radius": None}, "radius must be one real number, got None"),
        ({"speed": np.ones(3)}, "speed is an array without names of dimensions"),
        ({"speed": SPEED.assign_attrs(units="mm/s")}, "speed is given in mm/s: give numbers in m/s"),
        ({"structure": mdr.Structure.modal([800.0], [0.05]), "impedance": 1.0}, "impedance"),
        ({"speed": SPEED - 0.1}, r"speed\[0\] = -0.09 m/s must be finite and positive"),
    ],
)
def test_what_is_wrong_is_named(change, says):
    with pytest.raises(ValueError, match=says):
        sweep.impacts(mdr.Sphere, **SPHERES | change)


def test_shapes_are_classes_with_their_parameters_or_one_indenter():
    rest = {"E_star": 1e9, "mass": 1e-12, "speed": SPEED}
    with pytest.raises(ValueError, match="Hyperboloid needs its tip_radius"):
        sweep.impacts(mdr.Hyperboloid, slope=0.3, **rest)
    with pytest.raises(ValueError, match="cannot be swept: give an indenter"):
        sweep.impacts(mdr.Sampled, **rest)
    with pytest.raises(ValueError, match="give its class"):
        sweep.impacts(mdr.Sphere([1.0, 2.0]), **rest)
    with pytest.raises(ValueError, match=r"radius is not a parameter .* the Sphere given"):
        sweep.impacts(mdr.Sphere(1.0), radius=1.0, **rest)
    with pytest.raises(TypeError, match="shape must be a class of indenters"):
        sweep.impacts("sphere", **rest)
    tip = mdr.Sampled([0.0, 1e-6, 2e-6], [0.0, 1e-7, 3e-7])
    assert sweep.impacts(tip, **rest).restitution.shape == (5,)


def test_units_are_converted_told_or_not_touched():
    """A number is converted; a unit that an array has of what it was computed of says nothing."""
    pint = pytest.importorskip("pint")
    ureg = pint.UnitRegistry()
    plain = sweep.impacts(mdr.Sphere, **SPHERES)
    mass = xr.DataArray(SPHERES["mass"], attrs={"units": "m"})
    change = {"E_star": 1.0 * ureg.GPa, "speed": SPEED.assign_attrs(units="m/s"), "mass": mass}
    xr.testing.assert_identical(sweep.impacts(mdr.Sphere, **SPHERES | change), plain)
    with pytest.raises(ValueError, match="speed is given in"):
        sweep.impacts(mdr.Sphere, **SPHERES | {"speed": SPEED * ureg("mm/s")})


class TestInvalid:
    """Particles that a check refuses, at the third and the seventh place."""

    SPEED = xr.DataArray([0.1, 0.2, -1.0, 0.3, 0.4, 0.5, np.nan, 1e9], dims="particle")

    @pytest.mark.parametrize("before", [0, 40_000])
    @pytest.mark.parametrize(
        ("start", "place", "says"),
        [(0, 2, "-1 m/s must be"), (3, 3, "nan m/s must be"), (7, 0, r"1e\+09 m/s presses deeper")],
    )
    def test_an_error_has_the_index_in_the_stream(self, before, start, place, says):
        """Also behind so many valid ones that the stream is solved in blocks."""
        valid = xr.DataArray(np.full(before, 0.1), dims="particle")
        speed = xr.concat([valid, self.SPEED[start:]], "particle")
        with pytest.raises(ValueError, match=rf"speed\[{before + place}\] = {says}"):
            sweep.impacts(mdr.Sphere, **REST, speed=speed)

    def test_nan_counted_and_listed(self):
        radius = xr.DataArray([1e-5, -1.0], dims="radius")
        given = REST | {"radius": radius, "speed": self.SPEED}
        table = sweep.impacts(mdr.Sphere, **given, invalid="nan", quantities=("restitution", "max_depth"))
        valid = [0, 1, 3, 4, 5]
        alone = sweep.impacts(mdr.Sphere, **REST, speed=self.SPEED[valid])
        np.testing.assert_allclose(table.restitution[0, valid], alone.restitution, rtol=1e-13)
        for name in ("restitution", "max_depth"):
            assert table[name].isnull().sum() == table.attrs["invalid_count"] == 11
        assert len(table.attrs["invalid"]) == 5
        reasons = " | ".join(table.attrs["invalid"])
        assert "Sphere radius[1] = -1 m must be finite and positive" in reasons
        assert "(at radius 1, particle 0)" in reasons
        xr.testing.assert_identical(
            sweep.impacts(mdr.Sphere, **REST, speed=0.1 + 0 * radius, invalid="nan").restitution[0],
            sweep.impacts(mdr.Sphere, **REST, speed=0.1).restitution,
        )

    def test_every_ensemble(self):
        depth = xr.DataArray([1e-9, np.inf], dims="depth")
        table = sweep.indentations(mdr.Cone(0.3), E_star=1e9, depth=depth, invalid="nan")
        assert "depth[1] = inf m must be finite" in table.attrs["invalid"][0]
        friction = xr.DataArray([0.1, -0.1], dims="particle")
        given = {"E_star": 1e9, "mass": 1e-12, "speed": 1.0, "tangential_speed": 10.0, "friction": friction}
        table = sweep.oblique_impacts(mdr.Paraboloid(1e-5), **given, invalid="nan")
        assert table.friction_work.isnull().values.tolist() == [False, True]
        assert "friction[1] = -0.1 must be not negative" in table.attrs["invalid"][0]

    def test_what_is_no_particle_raises(self, monkeypatch):
        """A number that is out of range, an unknown choice, and a solver that fails."""
        speed = self.SPEED[:2]
        with pytest.raises(ValueError, match="E_star = -1 Pa must be finite"):
            sweep.impacts(mdr.Sphere, **REST | {"E_star": -1.0}, speed=speed, invalid="nan")
        with pytest.raises(ValueError, match="invalid = 'drop' must be one of 'raise', 'nan'"):
            sweep.impacts(mdr.Sphere, **REST, speed=speed, invalid="drop")

        def fails(*_, **__):
            raise ValueError("no convergence")

        monkeypatch.setattr(sweep, "impact", fails)
        with pytest.raises(ValueError, match="no convergence"):
            sweep.impacts(mdr.Sphere, **REST, speed=speed, invalid="nan")


def test_an_ensemble_of_none():
    assert sweep.impacts(mdr.Sphere, **REST, speed=SPEED[:0]).restitution.shape == (0,)


def test_a_long_stream_is_that_of_its_parts():
    """Also at the ends of the blocks in which it is solved, whatever their lengths."""
    speed = xr.DataArray(np.geomspace(1e-2, 1.0, 40_000), dims="particle")
    whole = sweep.impacts(mdr.Sphere, **REST, speed=speed)
    parts = [
        sweep.impacts(mdr.Sphere, **REST, speed=speed[rows]) for rows in (slice(7001), slice(7001, None))
    ]
    xr.testing.assert_allclose(whole, xr.concat(parts, "particle"), rtol=1e-13)


class Terminal(io.StringIO):
    """An error output that a person looks at."""

    def isatty(self):
        return True


@pytest.mark.parametrize("kind", [io.StringIO, Terminal])
def test_progress_is_shown_at_a_terminal(monkeypatch, kind):
    """As the number of entries or curves that are done, and nothing in a pipe."""
    pytest.importorskip("tqdm")
    monkeypatch.setattr(progress, "_DELAY", 0.0)
    monkeypatch.setattr(sys, "stderr", kind())
    count = sweep.impacts(mdr.Sphere, **SPHERES).restitution.size
    depth = np.linspace(0.0, 60e-9, 50)
    force = mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9), depth).force
    mdr.fit_indentation(mdr.Cone(0.3), [depth] * 3, [force] * 3, q_c=np.inf)
    shown = sys.stderr.getvalue()
    assert (f"/{count}" in shown) == ("0/3" in shown) == (kind is Terminal)


class TestLazily:
    """On dask arrays."""

    @pytest.fixture(autouse=True)
    def _dask(self):
        pytest.importorskip("dask.array")

    @staticmethod
    def stream(count=4000, chunk=1000):
        speed = xr.DataArray(np.geomspace(1e-2, 1.0, count), dims="particle").chunk(particle=chunk)
        return sweep.impacts(
            mdr.Sphere,
            **SPHERES | {"speed": speed, "radius": 1e-5},
            quantities=("restitution", "max_depth"),
        )

    def test_a_part_of_a_stream_has_its_impacts(self):
        stream = self.stream()
        assert stream.chunks == {"particle": (1000,) * 4}
        found = stream.isel(particle=slice(0, 10)).compute(scheduler="synchronous")
        speeds = np.geomspace(1e-2, 1.0, 4000)[:10]
        hits = mdr.impact(mdr.Sphere(1e-5), mdr.Medium(1e9, q_c=10.0), 1e-12, speeds)
        np.testing.assert_allclose(found.restitution, hits.restitution, rtol=1e-12)
        np.testing.assert_allclose(found.max_depth, hits.max_depth, rtol=1e-12)

    def test_invalid_particles(self):
        """Errors have the index in the stream, not the one in a chunk."""
        speed = xr.DataArray(np.geomspace(1e-2, 1.0, 4000), dims="particle")
        speed[2345] = -1.0
        lazy = sweep.impacts(mdr.Sphere, **REST, speed=speed[1000:].chunk(particle=1000))
        with pytest.raises(ValueError, match=r"speed\[1345\] = -1 m/s must be"):
            lazy.compute(scheduler="synchronous")
        slope = xr.DataArray([0.2, 0.3], dims="cone")
        given = {"E_star": 1e9, "mass": 1e-12, "speed": speed.chunk(particle=1000), "slope": slope}
        lazy = sweep.impacts(mdr.Cone, **given)
        with pytest.raises(ValueError, match=r"speed\[2345\] = -1 m/s .*\(at cone 0, particle 2345\)"):
            lazy.compute(scheduler="synchronous")
        table = sweep.impacts(mdr.Cone, **given, invalid="nan").compute()
        assert table.restitution.isnull().any("cone").values.nonzero()[0].tolist() == [2345]
        assert "invalid" not in table.attrs

    def test_the_recipe_goes_on_where_it_was_killed_while_it_made_the_store(self, tmp_path, monkeypatch):
        """With all files of the store but its name, and with none, one, or half of them."""
        pytest.importorskip("zarr")
        lines = textwrap.dedent(sweep.__doc__[sweep.__doc__.index("    store = ") :].partition("\n\n")[0])
        recipe = lines.replace("10**9", "4000").replace("10**7", "1000")
        names = {"xr": xr, "numpy": np, "Path": Path, "stream": self.stream()}
        monkeypatch.chdir(tmp_path)

        def killed(*_):
            raise KeyboardInterrupt

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for kept in (None, 0, 1, 5):
                with monkeypatch.context() as patch:
                    patch.setattr(Path, "rename", killed)
                    with pytest.raises(KeyboardInterrupt):
                        exec(recipe, names)
                for file in sorted(file for file in Path("new.zarr").rglob("*") if file.is_file())[kept:]:
                    if kept is not None:
                        file.unlink()
                assert not Path("stream.zarr").exists()
            exec(recipe, names)
            xr.testing.assert_allclose(
                xr.open_zarr("stream.zarr").load(), self.stream().compute(), rtol=1e-13
            )

    @pytest.mark.parametrize("chunks", [1, 2, 3])
    def test_a_run_that_was_killed_between_chunks_leaves_no_holes(self, tmp_path, monkeypatch, chunks):
        """Whichever of the chunks of a region were written before."""
        pytest.importorskip("zarr")
        dask = pytest.importorskip("dask")
        store, stream, solved = tmp_path / "stream.zarr", self.stream(chunk=250), []

        def stopped(*given, **more):
            solved.append(1)
            if len(solved) > chunks:
                raise KeyboardInterrupt
            return mdr.impact(*given, **more)

        def fill():
            for start in range(0, 4000, 1000):
                region = {"particle": slice(start, start + 1000)}
                done = xr.open_zarr(store).isel(region)
                if done.isnull().any().to_array().any():
                    stream.isel(region).to_zarr(store, region=region)

        with warnings.catch_warnings(), dask.config.set(scheduler="synchronous"):
            warnings.simplefilter("ignore")
            stream.to_zarr(store, compute=False, encoding={name: {"_FillValue": np.nan} for name in stream})
            with monkeypatch.context() as patch:
                patch.setattr(sweep, "impact", stopped)
                with pytest.raises(KeyboardInterrupt):
                    fill()
            missing = int(xr.open_zarr(store).restitution.isnull().sum())
            assert missing == 4000 - 250 * chunks
            fill()
            assert not xr.open_zarr(store).isnull().any().to_array().any()

    @pytest.mark.full
    def test_a_lost_worker_changes_nothing(self):
        """One of two workers is killed in the middle: its chunks are solved again by the other."""
        distributed = pytest.importorskip("distributed")
        speed = xr.DataArray(np.geomspace(0.1, 1.0, 4000), dims="particle")
        given = REST | {"eta": 1.0}
        stream = sweep.impacts(mdr.Sphere, **given, speed=speed.chunk(particle=100))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with (
                distributed.LocalCluster(
                    n_workers=2, threads_per_worker=1, dashboard_address=None
                ) as cluster,
                distributed.Client(cluster) as client,
            ):
                chunks = client.persist(stream.restitution)
                futures = distributed.futures_of(chunks)
                distributed.wait(futures, return_when="FIRST_COMPLETED")
                os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)
                assert sum(future.done() for future in futures) < len(futures)
                restitution = chunks.compute()
        # Viscous impacts come in steps of their own, and chunks are the same.
        xr.testing.assert_allclose(
            restitution, sweep.impacts(mdr.Sphere, **given, speed=speed).restitution, rtol=1e-9
        )
