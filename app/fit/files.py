"""A fit as a file: JSON with the samples, and CSV of its numbers, in SI."""

import json
from dataclasses import asdict
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.fit.indentation import IndentationFit
from mdr_core.fit.parameters import PARAMETERS

from .. import tables
from .setting import CORRECTIONS, Setting

#: Units of corrections in SI.
_UNITS = {"drift": "m/s", "frame": "m/N", "depth_noise": "m"}


def contents(setting: Setting, fit: IndentationFit, told: dict[str, Any]) -> dict[str, Any]:
    """Numbers of a fit with units and standard errors, misfits, remarks, and what was fitted.

    `told` has what is told of the fit, all remarks, the numbers of the first and last sample, how many
    there are, and Young's modulus of the sample with its error, or None.
    """
    quoted = told["told"].quoted
    numbers = {
        "quoted": {
            "units": "Pa", "long_name": f"effective modulus to quote, {quoted.source or 'none'}",
            "symbol": "E*", "value": quoted.value, "standard_error": quoted.standard_error,
        }
    }  # fmt: skip
    if told["E"] is not None:
        value, error = told["E"]
        about = {"units": "Pa", "long_name": "Young's modulus of the sample", "symbol": "E"}
        numbers["E_sample"] = about | {"value": value, "standard_error": error}
    values = fit.to_dict()
    for name, each in PARAMETERS.items():
        error = fit.standard_errors.get(name)
        numbers[name] = each.quantity.attributes | {"value": values[name], "standard_error": error}
    chi = fit.reduced_chi_square
    others = {
        "force_noise": ("N", "noise of the force", "σ_F", float(np.max(fit.force_noise))),
        "reduced_chi_square": ("1", "reduced χ²", "χ²", float(chi)),
    }
    for name, known in CORRECTIONS.items():
        value = float(fit.depth_noise) if name == "depth_noise" else setting.corrections.get(name, 0.0)
        others[name] = (_UNITS[name], known.label, known.symbol, value)
    for letter, each in fit.classes.items():
        text = f"misfit of class ({letter}) over the largest force"
        others[f"misfit_{letter}"] = ("1", text, "", float(each.misfit))
    for name, (unit, long_name, symbol, value) in others.items():
        numbers[name] = {"units": unit, "long_name": long_name, "symbol": symbol, "value": value}
    first, last = told["samples"]
    return {
        "version": f"mdr_core {mdr.__version__}",
        "file": setting.file,
        "curve": setting.curve,
        "samples": {"first": first, "last": last, "of": told["count"], "fitted": int(fit.depth.size)},
        "quoted": {
            "source": quoted.source,
            "reason": quoted.reason,
            "kind": quoted.kind,
            "remedy": [asdict(each) for each in quoted.remedy],
        },
        "numbers": numbers,
        "remarks": [each.to_dict() for each in told["remarks"]],
        "limits": [each.sentence for each in fit.path.limits if each.exceeded],
    }


def as_json(setting: Setting, fit: IndentationFit, told: dict[str, Any]) -> str:
    """The fit with its scene and samples as JSON; what is not finite is null."""
    scene = mdr.Scene(fit.profile, fit.medium, mdr.DepthPath(float(np.max(fit.path.depth))))
    samples = {"depth": fit.depth, "force": fit.force, "time": fit.time, "residuals": fit.residuals}
    samples = {name: values for name, values in samples.items() if values is not None}
    units = {"depth": "m", "time": "s"}
    all_of_it = contents(setting, fit, told) | {"scene": json.loads(scene.to_json())}
    all_of_it["samples_fitted"] = {
        name: {"units": units.get(name, "N"), "values": values.tolist()} for name, values in samples.items()
    }
    return json.dumps(_finite(all_of_it), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    if value is None or isinstance(value, str | int):
        return value
    return float(value) if np.isfinite(value) else None


def as_csv(setting: Setting, fit: IndentationFit, told: dict[str, Any]) -> str:
    """The numbers of the fit as a table; a number without a standard error was held or measured."""
    found = contents(setting, fit, told)
    samples = "samples {first} to {last} of {of}, {fitted} fitted".format(**found["samples"])
    lines = [
        f"{found['version']}: fit to {found['file']}, {samples}",
        *(each["text"] for each in found["remarks"]),
        *found["limits"],
    ]
    rows = [["name", "quantity", "symbol", "value", "standard error", "unit"]]
    for name, each in found["numbers"].items():
        shown = map(_float, (each["value"], each.get("standard_error")))
        rows.append([name, each["long_name"], each["symbol"], *shown, each["units"]])
    return tables.as_csv(lines, rows)


def _float(value: Any) -> float | None:
    return None if value is None else float(value)


def map_csv(file: str, rows: list[tuple[Any, ...]]) -> str:
    """E* and its error of each curve of a map as a table."""
    written = [["curve", "E* (Pa)", "standard error (Pa)", "source, or why there is no number"]]
    for number, value, error, reason in rows:
        written.append(
            [
                number + 1,
                _float(value),
                _float(error),
                reason,
            ]
        )
    return tables.as_csv([f"mdr_core {mdr.__version__}: curves of {file}"], written)
