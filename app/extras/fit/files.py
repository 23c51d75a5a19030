"""A fit as a file: JSON with the samples, and CSV of its numbers, in SI."""

import csv
import json
from io import StringIO
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.fit.parameters import PARAMETERS

from .measured import SUBTRACTED, Measured


def contents(curve: Measured) -> dict[str, Any]:
    """Numbers of a fit with units and standard errors, misfits, remarks, and what was fitted."""
    found = curve.fit
    numbers = {}
    for name in PARAMETERS:
        about = PARAMETERS[name].quantity.attributes
        error = found.standard_errors.get(name)
        numbers[name] = about | {"value": found.to_dict()[name], "standard_error": error}
    noise = float(np.max(found.force_noise))
    numbers["force_noise"] = {
        "units": "N",
        "long_name": "noise of the force",
        "symbol": "σ_F",
        "value": noise,
    }
    noise = found.depth_noise
    numbers["depth_noise"] = {
        "units": "m",
        "long_name": "noise of the depth",
        "symbol": "σ_d",
        "value": noise,
    }
    chi = found.reduced_chi_square
    numbers["reduced_chi_square"] = {"units": "1", "long_name": "reduced χ²", "symbol": "χ²", "value": chi}
    for name, units, value in zip(SUBTRACTED, ("m/s", "m/N"), curve.subtracted, strict=True):
        about = {"long_name": f"{name}, subtracted from the depth", "symbol": ""}
        numbers[name] = {"units": units} | about | {"value": value}
    for letter, each in found.classes.items():
        about = {"long_name": f"misfit of class ({letter}) over the largest force", "symbol": ""}
        numbers[f"misfit_{letter}"] = {"units": "1"} | about | {"value": each.misfit}
    first, last = curve.chosen
    return {
        "version": f"mdr_core {mdr.__version__}",
        "file": curve.name,
        "samples": {"first": first, "last": last, "of": len(curve.curve), "fitted": found.depth.size},
        "numbers": numbers,
        "remarks": [*curve.curve.remarks, *found.remarks],
        "limits": [each.sentence for each in found.path.limits if each.exceeded],
    }


def as_json(curve: Measured) -> str:
    """The fit with its scene and samples as JSON; what is not finite is null."""
    found = curve.fit
    scene = mdr.Scene(found.profile, found.medium, mdr.DepthPath(float(np.max(found.path.depth))))
    samples = {"depth": found.depth, "force": found.force, "time": found.time, "residuals": found.residuals}
    samples = {name: values for name, values in samples.items() if values is not None}
    units = {"depth": "m", "time": "s"}
    told = contents(curve) | {"scene": json.loads(scene.to_json())}
    told["curve"] = {
        name: {"units": units.get(name, "N"), "values": values.tolist()} for name, values in samples.items()
    }
    return json.dumps(_finite(told), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _finite(value):
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    if value is None or isinstance(value, str | int):
        return value
    return float(value) if np.isfinite(value) else None


def as_csv(curve: Measured) -> str:
    """The numbers of the fit as a table; a number without a standard error was held or measured."""
    told, text = contents(curve), StringIO()
    samples = "samples {first} to {last} of {of}, {fitted} fitted".format(**told["samples"])
    lines = [f"{told['version']}: fit to {told['file']}, {samples}", *told["remarks"], *told["limits"]]
    text.writelines(f"# {line}\n" for line in lines)
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["name", "quantity", "symbol", "value", "standard error", "unit"])
    for name, each in told["numbers"].items():
        error = each.get("standard_error")
        shown = [repr(float(each["value"])), "" if error is None else repr(float(error))]
        writer.writerow([name, each["long_name"], each["symbol"], *shown, each["units"]])
    return text.getvalue()
