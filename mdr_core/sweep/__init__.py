"""Ensembles of impacts and indentations over named dimensions of xarray, in memory or with dask.

Parameters are numbers or DataArrays, which broadcast by the names of their dimensions. Results of dask
arrays are lazy: `compute` solves them chunk by chunk, on the cores of a machine, or on a cluster with a
``dask.distributed.Client``. This example sums a stream that does not fit in memory::

    speed = xr.DataArray(0.1 * dask.array.random.weibull(2.0, 10**9, chunks=10**6), dims="particle")
    stream = sweep.impacts(Sphere, radius=1e-5, E_star=1e9, q_c=10.0, mass=1e-12, speed=speed,
                           quantities=("restitution", "damaged_area"))
    total = stream.damaged_area.sum().compute()

This example writes a long run to disk. The same script continues the run after it was killed. A store gets
its name when it is complete. Chunks of a region are written in any order, so that a region with a missing
number is not complete. Complete regions are skipped::

    store = Path("stream.zarr")
    if not store.exists():
        new, encoding = Path("new.zarr"), {name: {"_FillValue": numpy.nan} for name in stream}
        stream.to_zarr(new, mode="w", compute=False, encoding=encoding)
        new.rename(store)
    for start in range(0, 10**9, 10**7):
        region = {"particle": slice(start, start + 10**7)}
        done = xr.open_zarr(store).isel(region)
        if done.isnull().any().to_array().any():
            stream.isel(region).to_zarr(store, region=region)

During a sweep of arrays in memory, tqdm shows the progress if it is installed and the output is a terminal.
For dask arrays, ``dask.diagnostics.ProgressBar()`` shows it.

Ctrl-C stops a run in this process, ``client.cancel`` a run on a cluster; the regions on disk remain. With
``invalid="nan"`` the results of invalid particles are NaN, so that their regions are computed again.

An example:

>>> from mdr_core import FlatPunch, sweep
>>> import xarray as xr
>>> depth = xr.DataArray([0.1, 0.2], dims="path")
>>> table = sweep.indentations(FlatPunch, radius=0.5, E_star=1.0, depth=depth)
>>> print(table.force.values.round(9))  # 2E* a d
[0.1 0.2]
"""

from collections.abc import Iterable
from functools import partial
from importlib import import_module
from inspect import isclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base import check
from ..base.results import quantities_of
from ..show.progress import tracked_chunks
from ..show.quantities import QUANTITIES, described
from ..show.report import imported
from ..solver.applicability import check_reached
from ..solver.contact.adhesion import first_contacts
from ..solver.contact.indentation import Indentation
from ..solver.contact.yielding import yield_rule
from ..solver.impacts.impact import impact
from ..solver.impacts.result import Impact
from ..solver.medium.hardness import HardnessLaw
from ..solver.medium.medium import Medium
from ..solver.medium.structure import Structure, structure_of
from ..solver.oblique.oblique_impact import ObliqueImpact, oblique_impact
from ..solver.profiles.profile import Profile, check_known
from .arguments import (
    InvalidParticles,
    check_alignment,
    check_shape_parameters,
    hardness_parameters,
    indices,
    labelled,
)

if TYPE_CHECKING:
    import xarray

    #: Type of a parameter.
    Given = float | np.floating[Any] | xarray.DataArray
    Shape = type[Profile] | Profile

__all__ = ["impacts", "indentations", "oblique_impacts"]

#: Number of entries solved at a time, with some MB; viscous and oblique impacts take seconds.
_BLOCK = 2**14


def __dir__():
    return __all__


def impacts(
    shape: "Shape",
    *,
    E_star: "Given",
    q_c: "Given | None" = None,
    hardness: "Given | HardnessLaw | None" = None,
    f_c: "Given | None" = None,
    eta: "Given" = 0.0,
    work_of_adhesion: "Given" = 0.0,
    mass: "Given",
    speed: "Given",
    plastic_depth: "Given" = 0.0,
    impedance: "Given" = np.inf,
    stiffness: "Given" = np.inf,
    structure: Structure | None = None,
    quantities: str | Iterable[str] = ("restitution",),
    invalid: str = "raise",
    **shape_parameters: "Given",
) -> "xarray.Dataset":
    """Solve impacts of free bodies (`mdr_core.impact`) over named dimensions.

    Parameters
    ----------
    shape : type or Profile
        Class of the indenters, with its parameters given by name, or a single indenter.
    E_star, q_c, hardness, f_c, eta, work_of_adhesion : float or DataArray
        Effective modulus (Pa), constants of the hardness (N/m, Pa, N), viscosity (Pa·s) and work of
        adhesion (J/m²) of the `Medium`, with its defaults. `hardness` may be one `HardnessLaw` for all.
    mass, speed : float or DataArray
        Mass (kg) and speed (m/s) at first contact.
    plastic_depth : float or DataArray
        Plastic depth (m) of the imprint before the impact.
    impedance, stiffness : float or DataArray
        Impedance (N·s/m) of the plate or rod, or stiffness (N/m) of the support, that carries the medium,
        as in `Structure`; infinite, the default, is rigid.
    structure : Structure, optional
        One structure for all impacts, instead of both. With modes, impacts are solved one by one.
    quantities : sequence of str
        Names of quantities of `Impact`: "restitution", "max_depth", "damaged_area", "contact_time", …
    invalid : {"raise", "nan"}
        Particles with parameters outside the range of `impact` raise an error with their index ("raise"),
        or have NaN for results ("nan"). In the second case, the attribute ``invalid_count`` is the number
        of these particles, and ``invalid`` has the index, value and reason of the first ones. Results of
        dask arrays have no such attributes: count the NaN. A single number out of range, and a solver that
        does not converge, always raise an error.
    **shape_parameters : float or DataArray
        Parameters of the class, such as ``radius=`` of a `Sphere`.

    Returns
    -------
    xarray.Dataset
        The quantities over all dimensions of the parameters; lazy if a parameter is a dask array.

    Raises
    ------
    ValueError
        If a parameter or a quantity is unknown or missing, an array has no names of dimensions, sizes or
        coordinates differ, or a value is outside the range of `impact`; for lazy arrays when they are
        computed.

    Examples
    --------
    >>> from mdr_core.sweep import impacts
    >>> import xarray as xr
    >>> from mdr_core import Sphere
    >>> speed = xr.DataArray([0.1, 1.0, 10.0], dims="speed")
    >>> radius = xr.DataArray([1e-6, 1e-5], dims="radius")
    >>> table = impacts(Sphere, radius=radius, E_star=1e9, q_c=10.0, mass=1e-12, speed=speed)
    >>> dict(table.sizes), table.restitution.round(4).values.tolist()[1]
    ({'radius': 2, 'speed': 3}, [1.0, 0.5426, 0.1184])
    """
    parameters = {"E_star": E_star, "eta": eta, "work_of_adhesion": work_of_adhesion}
    constants, common = hardness_parameters(q_c, hardness, f_c)
    parameters |= constants | {"mass": mass, "speed": speed, "plastic_depth": plastic_depth}
    if structure_of(structure).rigid:
        parameters |= {"impedance": impedance, "stiffness": stiffness}
    elif np.all(np.isinf(impedance)) and np.all(np.isinf(stiffness)):
        common |= {"structure": structure}
    else:
        raise check.MDRError(
            "impedance and stiffness are parameters of a structure: give them, or a structure"
        )
    return _sweep(Impact, _hit, common, shape, parameters, shape_parameters, quantities, invalid)


def oblique_impacts(
    shape: "Shape",
    *,
    E_star: "Given",
    q_c: "Given | None" = None,
    hardness: "Given | HardnessLaw | None" = None,
    f_c: "Given | None" = None,
    eta: "Given" = 0.0,
    poisson: "Given" = 0.5,
    mass: "Given",
    speed: "Given",
    tangential_speed: "Given",
    friction: "Given",
    tangential_mass: "Given | None" = None,
    quantities: str | Iterable[str] = ("friction_work", "plastic_work"),
    invalid: str = "raise",
    tolerance: float = 5e-4,
    **shape_parameters: "Given",
) -> "xarray.Dataset":
    """Solve oblique impacts (`mdr_core.oblique_impact`) over named dimensions.

    Parameters, result and errors are as in `impacts`. Additional parameters are Poisson's ratio of the
    `Medium`, and the tangential speed (m/s), the coefficient of friction, the tangential mass (kg) and the
    `tolerance` of `oblique_impact`. Quantities are those of `ObliqueImpact`. Viscous impacts are solved one
    by one.

    Examples
    --------
    >>> from mdr_core.sweep import oblique_impacts
    >>> import numpy as np
    >>> import xarray as xr
    >>> from mdr_core import Paraboloid
    >>> attack = xr.DataArray(np.radians([30.0, 60.0, 90.0]), dims="attack")
    >>> normal, along = 10.0 * np.sin(attack), (10.0 * np.cos(attack)).round(9)
    >>> given = {"E_star": 1e9, "mass": 1e-9, "speed": normal, "tangential_speed": along}
    >>> table = oblique_impacts(Paraboloid, radius=1e-4, friction=0.1, **given)
    >>> (table.friction_work * 1e9).round(3).values  # nJ; in full slip 2µmv(v_t − µv)
    array([8.16, 7.16, 0.  ])
    """
    parameters = {"E_star": E_star, "eta": eta, "poisson": poisson, "mass": mass}
    constants, law = hardness_parameters(q_c, hardness, f_c)
    parameters |= constants | {"speed": speed, "tangential_speed": tangential_speed, "friction": friction}
    parameters["tangential_mass"] = mass if tangential_mass is None else tangential_mass
    hit = partial(_hit_at_angle, tolerance=tolerance)
    return _sweep(ObliqueImpact, hit, law, shape, parameters, shape_parameters, quantities, invalid)


def indentations(
    shape: "Shape",
    *,
    E_star: "Given",
    q_c: "Given | None" = None,
    hardness: "Given | HardnessLaw | None" = None,
    f_c: "Given | None" = None,
    work_of_adhesion: "Given" = 0.0,
    depth: "Given",
    quantities: str | Iterable[str] = ("force",),
    invalid: str = "raise",
    **shape_parameters: "Given",
) -> "xarray.Dataset":
    """Solve first loadings (`mdr_core.indent`) over named dimensions: each depth on a virgin medium.

    Parameters, result and errors are as in `impacts`. Depths (m), negative above the surface, replace mass
    and speed. Quantities are those of `Indentation`: "force", "contact_radius", "mean_pressure", …

    Examples
    --------
    >>> from mdr_core.sweep import indentations
    >>> import xarray as xr
    >>> from mdr_core import Cone
    >>> slope = xr.DataArray([0.1, 0.2], dims="cone")
    >>> print(indentations(Cone, slope=slope, E_star=1e9, depth=1e-6).force.round(6).values)  # N
    [0.006366 0.003183]
    """
    parameters = {"E_star": E_star, "work_of_adhesion": work_of_adhesion, "depth": depth}
    constants, law = hardness_parameters(q_c, hardness, f_c)
    parameters |= constants
    return _sweep(Indentation, _press, law, shape, parameters, shape_parameters, quantities, invalid)


def _sweep(kind, solve, common, shape, parameters, shape_parameters, quantities, invalid):
    """Return the dataset of quantities of a class of results, from `solve` for arrays of parameters.

    `common` may have a law of hardness and a structure, which are those of all entries.
    """
    xarray = imported("xarray", "mdr_core.sweep")
    names = [quantities] if isinstance(quantities, str) else list(quantities)
    # The parameter is the plastic depth before the impact, the quantity the plastic depth after it.
    known = [name for name in quantities_of(kind) if name not in parameters or name == "plastic_depth"]
    for name in names or [""]:
        check.one_of("quantity", name, known)
    check.one_of("invalid", invalid, ("raise", "nan"))
    check_shape_parameters(shape, shape_parameters)
    parameters = shape_parameters | parameters
    given = {name: labelled(xarray, name, value) for name, value in parameters.items()}
    check_alignment(xarray, given)
    refused = InvalidParticles(given, invalid)

    def block(*values):
        values, places = dict(zip(given, values, strict=False)), values[len(given) :]
        return _in_blocks(
            partial(solve, **common), shape, values, shape_parameters, names, partial(refused.add, places)
        )

    lazily = {"dask": "parallelized", "output_dtypes": [float] * len(names)}
    dims, arrays = [[] for _ in names], (*given.values(), *indices(xarray, given))
    results = xarray.apply_ufunc(block, *arrays, output_core_dims=dims, keep_attrs=False, **lazily)
    results = results if len(names) > 1 else [results]
    attributes = _attributes(kind, shape, given)
    attributes |= {name: described(each) for name, each in common.items()}
    dataset = xarray.Dataset(dict(zip(names, results, strict=True)), attrs=attributes)
    if invalid == "nan" and not dataset.chunks:
        dataset.attrs |= {"invalid_count": refused.count, "invalid": refused.listed}
    for name in names:
        dataset[name].attrs = QUANTITIES[name].attributes
    return dataset


def _in_blocks(solve, shape, values, own, names, refused):
    """Return arrays of the named quantities for arrays of parameters, in blocks.

    `own` are the parameters of the shape. Invalid entries are given to `refused`, and are NaN if it
    returns.
    """
    size = np.broadcast_shapes(*(np.shape(value) for value in values.values()))
    # Scalars are not repeated.
    varied = {k: np.broadcast_to(v, size).flat for k, v in values.items() if np.size(v) > 1}
    results = np.full((len(names), *size), np.nan)
    flat = results.reshape(len(names), -1)
    for rows in tracked_chunks(flat.shape[1], _BLOCK, "entries"):
        entries = np.arange(flat.shape[1])[rows]
        block = {k: varied[k][rows] if k in varied else np.ravel(v)[0] for k, v in values.items()}
        # Adhesion needs a separate solver.
        sticks = np.broadcast_to(np.asarray(block.get("work_of_adhesion", 0.0)) > 0, entries.shape)
        for chosen in (sticks, ~sticks):
            valid, part = entries[chosen], _some(block, chosen)
            while valid.size:
                others = {name: value for name, value in part.items() if name not in own}
                try:
                    profile = shape(**{name: part[name] for name in own}) if isclass(shape) else shape
                    result = solve(profile, **others)
                    for row, name in zip(flat, names, strict=True):
                        row[valid] = getattr(result, name)
                    break
                except check.InvalidEntries as error:
                    bad = np.broadcast_to(error.bad, valid.shape)
                    refused(error, np.unravel_index(valid[bad], size))
                # Some of the quantities may already be stored.
                flat[:, valid[bad]] = np.nan
                valid, part = valid[~bad], _some(part, ~bad)
    return tuple(results) if len(names) > 1 else results[0]


def _some(block, chosen):
    """Return the chosen entries of the arrays among the parameters of a block."""
    return {name: value[chosen] if np.ndim(value) else value for name, value in block.items()}


def _hit(
    profile, E_star, eta, work_of_adhesion, mass, speed, plastic_depth, impedance=np.inf, stiffness=np.inf,
    *, structure=None, **hardness,
):  # fmt: skip
    medium = Medium(E_star, eta=eta, work_of_adhesion=work_of_adhesion, **hardness)
    structure = Structure(impedance, stiffness) if structure_of(structure).rigid else structure
    return impact(profile, medium, mass, speed, plastic_depth=plastic_depth, structure=structure)


def _hit_at_angle(profile, E_star, eta, poisson, q_c=None, hardness=None, f_c=None, **given):
    medium = Medium(E_star, q_c=q_c, eta=eta, poisson=poisson, hardness=hardness, f_c=f_c)
    return oblique_impact(profile, medium, **given)


def _press(profile, E_star, work_of_adhesion, depth, **hardness):
    medium = Medium(E_star, work_of_adhesion=work_of_adhesion, **hardness)
    depth = check.finite_array("depth", depth, unit="m", most=check.LONGEST)
    shape = np.broadcast_shapes(profile.shape, medium.shape, depth.shape)
    depth = check_known(profile, np.broadcast_to(depth, shape))
    check_reached(profile, medium, depth)
    if np.any(np.asarray(work_of_adhesion) > 0):
        return Indentation(profile, medium, depth, *first_contacts(profile, medium, depth))
    interval, _ = yield_rule(profile, medium).loading(np.maximum(depth, 0.0))
    return Indentation(profile, medium, depth, interval)


def _attributes(kind, shape, given):
    """Return the attributes of the dataset: the parameters, or the dimensions of arrays."""
    profile = shape.__name__ if isclass(shape) else described(shape)
    varied = {name: "over " + " × ".join(value.dims) for name, value in given.items() if np.ndim(value)}
    fixed = {name: float(value) for name, value in given.items() if name not in varied}
    about = {"result": kind.__name__, "model": "MDR, V. L. Popov 2015", "indenter": profile}
    # The package is above its modules, so that none of them imports it.
    about["version"] = f"mdr_core {import_module('mdr_core').__version__}"
    return about | fixed | varied
