"""Export of a fit in SI: JSON with its samples, CSV of its numbers, and a scene in the explorer."""

import json
from dataclasses import asdict, replace
from math import floor, log10
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.measurements.fit.parameters import PARAMETERS
from mdr_core.show.csv_text import csv_text

from ..explorer import link
from ..explorer.state import checked, preset_state
from .choices import CORRECTIONS, NUMBERS, TIPS, slope_of

#: Units of corrections in SI.
_UNITS = {"drift": "m/s", "frame": "m/N", "depth_noise": "m"}


def contents(found: Any, about: dict[str, Any], corrections: dict[str, float]) -> dict[str, Any]:
    """Return the numbers of a fit with units and errors, its remarks, and its samples.

    `about` has the `file`, the number of the `curve` and its `length`, `remarks`, and `E` with its error.
    """
    fit, quoted = found.fit, found.quoted
    text = f"effective modulus to quote, {quoted.source or 'none'}"
    rows = [("quoted", text, "E*", "Pa", quoted.value, quoted.standard_error)]
    if about["E"] is not None:
        rows.append(("E_sample", "Young's modulus of the sample", "E", "Pa", *about["E"]))
    values = fit.to_dict()
    for name, each in PARAMETERS.items():
        q = each.quantity
        rows.append((name, q.long_name, q.symbol, q.unit, values[name], fit.standard_errors.get(name)))
    rows.append(("force_noise", "noise of the force", "σ_F", "N", float(np.max(fit.force_noise)), None))
    rows.append(("reduced_chi_square", "reduced χ²", "χ²", "1", float(fit.reduced_chi_square), None))
    for name in CORRECTIONS:
        value = float(fit.depth_noise) if name == "depth_noise" else corrections.get(name, 0.0)
        rows.append((name, NUMBERS[name].label, NUMBERS[name].symbol, _UNITS[name], value, None))
    for letter, each in fit.classes.items():
        text = f"misfit of class ({letter}) over the largest force"
        rows.append((f"misfit_{letter}", text, "", "1", float(each.misfit), None))
    keys = "long_name", "symbol", "units", "value", "standard_error"
    first, last = found.ends
    samples = {"first": first, "last": last, "of": about["length"], "fitted": int(fit.depth.size)}
    doubt = {"source": quoted.source, "reason": quoted.reason, "kind": quoted.kind}
    return {
        "version": f"mdr_core {mdr.__version__}",
        "file": about["file"],
        "curve": about["curve"],
        "samples": samples,
        "quoted": doubt | {"remedy": [asdict(each) for each in quoted.remedy]},
        "numbers": {row[0]: dict(zip(keys, row[1:], strict=True)) for row in rows},
        "remarks": [each.to_dict() for each in about["remarks"]],
        "limits": [each.sentence for each in fit.path.limits if each.exceeded],
    }


def as_json(found: Any, told: dict[str, Any]) -> str:
    """Return `contents` with scene and samples as JSON; values that are not finite become null."""
    fit = found.fit
    scene = mdr.Scene(fit.profile, fit.medium, mdr.scene.DepthPath(float(np.max(fit.path.depth))))
    samples = {"depth": fit.depth, "force": fit.force, "time": fit.time, "residuals": fit.residuals}
    units = {"depth": "m", "time": "s"}
    columns = {
        name: {"units": units.get(name, "N"), "values": values.tolist()}
        for name, values in samples.items()
        if values is not None
    }
    all_of_it = told | {"scene": json.loads(scene.to_json()), "samples_fitted": columns}
    return json.dumps(_finite(all_of_it), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    if value is None or isinstance(value, str | int):
        return value
    return float(value) if np.isfinite(value) else None


def as_csv(found: Any, told: dict[str, Any]) -> str:
    """Return the numbers of `contents` as CSV; numbers without an error were held or measured."""
    samples = "samples {first} to {last} of {of}, {fitted} fitted".format(**told["samples"])
    lines = [f"{told['version']}: fit to {told['file']}, {samples}"]
    lines += [each["text"] for each in told["remarks"]] + told["limits"]
    rows = [["name", "quantity", "symbol", "value", "standard error", "unit"]]
    for name, each in told["numbers"].items():
        numbers = _float(each["value"]), _float(each["standard_error"])
        rows.append([name, each["long_name"], each["symbol"], *numbers, each["units"]])
    return csv_text(lines, rows)


def _float(value: Any) -> float | None:
    return None if value is None else float(value)


def table_of(rows: list[Any], settings: dict[str, str], moduli: tuple[Any, Any] | None) -> mdr.CurveTable:
    """Return the fitted curves as a table, with Young's modulus from ν and the material of the tip."""
    columns = {name: [getattr(row, name) for row in rows] for name in ("E", "E_error", "H", "H_error")}
    E, E_error, H, H_error = (np.array(column, float) for column in columns.values())
    table = mdr.CurveTable(
        settings=settings, file=[row.file for row in rows], number=[row.number for row in rows],
        E_star=E, E_star_error=E_error, hardness=H, hardness_error=H_error,
        quoted=[row.source for row in rows], reason=[row.reason for row in rows],
        remarks=[""] * len(rows), results=[],
    )  # fmt: skip
    try:
        return table.sample_modulus(*moduli) if moduli else table
    except ValueError as error:
        return replace(table, settings=settings | {"sample": f"no E: {error}"})


def rounded(value: float, error: float | None) -> float:
    """Round a number to its displayed digits: to two digits of its error, or to four without an error.

    Examples
    --------
    >>> rounded(84.5312e9, 0.42e9)
    84530000000.0
    """
    if value == 0 or not np.isfinite(value):
        return value
    digits = 4
    if error and np.isfinite(error) and 1e-6 * abs(value) < error < abs(value):
        digits = max(1, floor(log10(abs(value))) - floor(log10(error)) + 2)
    return float(f"{value:.{digits - 1}e}")


#: Choices of the explorer for each kind of sample, and the name of its constant there and in the fit.
_MEDIA = {
    "constant": ({"plasticity": "constant"}, "volume_hardness", "hardness"),
    "composite": ({"plasticity": "q_c"}, "q_c", "q_c"),
    "line": ({"plasticity": "line"}, "f_c", "f_c"),
    "gel": ({"plasticity": "none"}, "", ""),
    "viscous": ({"plasticity": "none", "damping": "eta"}, "eta", "eta"),
    "sticky": ({"plasticity": "none", "adhesion": "work"}, "work_of_adhesion", "work_of_adhesion"),
}


def explorer_query(found: Any, tip: str, sizes: dict[str, float], medium: str) -> str:
    """Return tip, medium and depth of a fit as the query of a scene. Raises ValueError without a scene."""
    if tip == "measured":
        raise ValueError("a measured tip is not part of the link: open its file in the explorer")
    fit, shape = found.fit, "cone" if tip in ("berkovich", "cube_corner") else tip
    values, errors = fit.to_dict(), fit.standard_errors
    choices, number, name = _MEDIA[medium]
    # As deep as the curve, so that its force is visible.
    numbers = {
        "E_star": rounded(values["E_star"], errors.get("E_star")),
        "max_depth": rounded(float(np.max(fit.path.depth)), None),
    }
    if number and (np.isfinite(fit.medium.q_c) or number in ("eta", "work_of_adhesion")):
        numbers[number] = rounded(values[name], errors.get(name))
    elif number:
        choices = {"plasticity": "none"}
    if shape == "cone" and not TIPS[tip].numbers:
        numbers["cone_slope"] = fit.profile.slope
    for each, value in sizes.items():
        key = {"half_angle": "slope", "radius": "tip_radius" if tip == "rounded_cone" else "radius"}[each]
        numbers[f"{shape}_{key}"] = slope_of(value) if each == "half_angle" else value
    state = preset_state().replace(elasticity="modulus", damping="none", adhesion="none", shape=shape)
    numbers = {each: checked(each, value) for each, value in numbers.items()}
    return link.write(state.replace(**choices).replace(**numbers))
