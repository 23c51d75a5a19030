"""Dataset of a fit: `fit.to_xarray()`."""

import numpy as np

from ...base import check
from ...show.quantities import described
from ...show.report import attributes as attributes_of
from ...show.report import dimensions, imported
from .parameters import PARAMETERS

#: Fields of a fit with a value for each sample.
SAMPLES = ("depth", "force", "time", "residuals")


def dataset_of(fit, position=None):
    """Return the `xarray.Dataset` of an `IndentationFit`, with optional positions (m), (R, 2).

    It has parameters, errors and covariance. For each sample it has the measured values, the model and the
    residual.
    """
    xarray = imported("xarray", "to_xarray()")
    # Zarr does not specify texts of fixed length.
    dims, parameters = dimensions(fit), np.array(list(fit.standard_errors), object)
    variables = {}
    for name, value in fit.to_dict().items():
        variables[name] = dims, value, PARAMETERS[name.removesuffix("_error")].quantity.attributes
    for name in ("reduced_chi_square", "block_length"):
        variables[name] = dims, getattr(fit, name)
    noise = (*dims, "sample") if fit.force_noise.ndim > len(dims) else dims
    variables["force_noise"] = noise, fit.force_noise, {"units": "N"}
    samples = {name: getattr(fit, name) for name in SAMPLES}
    samples = {name: values for name, values in samples.items() if values is not None}
    for name, values in (samples | {"model": fit.force - fit.residuals}).items():
        units = {"depth": "m", "time": "s"}.get(name, "N")
        variables[name] = (*dims, "sample"), values, {"units": units}
    variables["covariance"] = (*dims, "parameter", "other_parameter"), fit.covariance
    attributes = attributes_of(fit) | {"indenter": described(fit.profile), "model": str(fit.model)}
    attributes["remarks"] = "\n".join(fit.remarks)
    attributes["depth_noise"] = fit.depth_noise
    if fit.invalid:
        attributes["invalid_count"] = len(fit.invalid)
        attributes["invalid"] = "\n".join(f"curve {i}: {text}" for i, text in fit.invalid.items())
    coordinates = {"parameter": parameters, "other_parameter": parameters}
    if position is not None:
        position = check.finite_array("position", position, unit="m", most=check.LONGEST)
        if position.shape != (*fit.shape, 2):
            raise check.MDRError(f"position {position.shape} must have x and y of each curve, (R, 2)")
        for name, values in zip("xy", np.moveaxis(position, -1, 0), strict=True):
            coordinates[name] = dims, values, {"units": "m", "long_name": f"position {name}"}
    return xarray.Dataset(variables, coordinates, attributes)
