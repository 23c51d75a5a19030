"""Arguments of sweeps: parameters as labelled arrays, shapes, hardness, and invalid particles."""

import re
from dataclasses import MISSING, fields
from inspect import isclass
from itertools import combinations

import numpy as np

from ..base import check
from ..show.quantities import QUANTITIES
from ..solver.medium.hardness import HardnessLaw
from ..solver.profiles.profile import Profile
from ..solver.profiles.sampled import Sampled
from ..solver.profiles.smooth import Smooth

#: Number of listed invalid particles.
_LISTED = 5


def labelled(xarray, name, value):
    """Return a parameter as a DataArray of numbers in the SI unit."""
    unit = QUANTITIES[name].unit if name in QUANTITIES else ""
    if not isinstance(value, xarray.DataArray):
        value = check.in_unit(name, value, unit)
        if np.ndim(value):
            raise check.MDRError(
                f"{name} is an array without names of dimensions: give an xarray.DataArray"
            )
        return xarray.DataArray(check.number(name, value))
    # The attribute may come from another array in a computation: only prefixed units raise an error.
    stated = getattr(value.data, "units", value.attrs.get("units", unit))
    factors, own = (re.split("[/·* ]", text.replace("kg", "g")) for text in (str(stated), unit))
    multiple = str(stated) != unit and len(factors) == len(own) and all(map(str.endswith, factors, own))
    if hasattr(value.data, "units") or (unit and multiple):
        raise check.MDRError(
            f"{name} is given in {stated}: give numbers in {unit or 'no unit'}, with these units in .attrs"
        )
    return value


def check_alignment(xarray, given):
    """Raise an error with two names if sizes or coordinates of arrays differ along a dimension."""
    try:
        xarray.align(*given.values(), join="exact")
    except ValueError:
        for one, other in combinations(given, 2):
            try:
                xarray.align(given[one], given[other], join="exact")
            except ValueError as error:
                raise check.MDRError(f"{one} and {other} are not aligned: {error}") from None
        raise


def indices(xarray, given):
    """Return indices along each dimension as DataArrays; lazy if a parameter is a dask array."""
    places = {}
    for value in given.values():
        for dim, size in value.sizes.items():
            places.setdefault(dim, np.arange(size))
            if value.chunks and isinstance(places[dim], np.ndarray):
                # Only dask arrays have chunks.
                import dask.array

                places[dim] = dask.array.arange(size, chunks=value.chunksizes[dim])
    return [xarray.DataArray(place, dims=dim) for dim, place in places.items()]


def check_shape_parameters(shape, given):
    """Raise an error unless this is a profile or its class, with exactly the parameters of the class."""
    if not (isinstance(shape, Profile) or (isclass(shape) and issubclass(shape, Profile))):
        raise TypeError(f"shape must be a class of indenters or an indenter, got {check.shown(shape)}")
    if not isclass(shape) and shape.shape:
        raise check.MDRError(
            "parameters of the shape are arrays without names of dimensions: give its class"
        )
    if isclass(shape) and issubclass(shape, Sampled | Smooth):
        raise check.MDRError(
            f"parameters of {shape.__name__} cannot be swept: give an indenter, not the class"
        )
    own = {field.name: field for field in fields(shape)} if isclass(shape) else {}
    name = shape.__name__ if isclass(shape) else f"the {type(shape).__name__} given"
    for unknown in given.keys() - own.keys():
        names = ", ".join(own) or "no free parameters"
        raise check.MDRError(f"{unknown} is not a parameter of the sweep or of {name}, which has {names}")
    for missing in own.keys() - given.keys():
        if own[missing].default is MISSING:
            raise check.MDRError(f"{name} needs its {missing}")


def hardness_parameters(q_c, hardness, f_c):
    """Return the given constants of the hardness, q_c = ∞ without any; and a law, which does not vary."""
    if isinstance(hardness, HardnessLaw):
        if hardness.shape:
            name, size = check.shown(hardness), hardness.shape
            raise check.MDRError(
                f"hardness {name} has arrays of shape {size}, without names of dimensions: a sweep has "
                "one law for all entries; give a law of single numbers"
            )
        constants, law = {"q_c": q_c, "f_c": f_c}, {"hardness": hardness}
        return {name: value for name, value in constants.items() if value is not None}, law
    constants = {"q_c": q_c, "hardness": hardness, "f_c": f_c}
    given = {name: value for name, value in constants.items() if value is not None}
    return given or {"q_c": np.inf}, {}


class InvalidParticles:
    """Handler of invalid particles: the first raises an error, or they are counted and listed."""

    def __init__(self, given, invalid):
        self.dims = {name: value.dims for name, value in given.items()}
        self.invalid, self.count, self.listed = invalid, 0, []

    def add(self, places, error, index):
        """Record the entries of an error at indices of a block, which is at `places` of the ensemble."""
        name = error.argument
        number = error.values.ndim == 0
        if number and not self.dims.get(name):
            raise error
        all_dims = dict.fromkeys(dim for dims in self.dims.values() for dim in dims)
        entries = [0] * len(index[0]) if number else np.flatnonzero(error.bad)
        self.count += len(entries)
        starts = [place.flat[0] for place in places]
        for entry, *place in zip(entries, *index, strict=True):
            place = dict(zip(all_dims, map(int, np.add(place, starts)), strict=True))
            own = [place[dim] for dim in self.dims.get(name) or place]
            raises, remark = self.invalid == "raise", ", ".join(f"{dim} {i}" for dim, i in place.items())
            text = error.message(entry, own, (len(entries) - 1) * raises)
            text += f" (at {remark})" if len(place) > 1 else ""
            if raises:
                raise check.MDRError(text) from None
            if len(self.listed) == _LISTED:
                break
            self.listed.append(text)
