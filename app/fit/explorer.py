"""The way from a fit to the explorer: its tip, medium and depth, in the digits that are shown."""

from math import floor, log10

import numpy as np

from mdr_core.fit.indentation import IndentationFit

from .. import link
from ..state import checked, preset_state
from .setting import TIPS, Setting, slope_of

#: The options and the number of the explorer for the constant that a kind of sample has.
_OPTIONS = {
    "constant": ({"plasticity": "constant"}, "volume_hardness", "hardness"),
    "composite": ({"plasticity": "q_c"}, "q_c", "q_c"),
    "line": ({"plasticity": "line"}, "f_c", "f_c"),
    "gel": ({"plasticity": "none"}, "", ""),
    "viscous": ({"plasticity": "none", "damping": "eta"}, "eta", "eta"),
    "sticky": ({"plasticity": "none", "adhesion": "work"}, "work_of_adhesion", "work_of_adhesion"),
}


def rounded(value: float, error: float | None) -> float:
    """A number in the digits that are shown: two of its error, or four without one.

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


def explorer_query(setting: Setting, fit: IndentationFit) -> str:
    """Tip, medium and depth of a fit as the query of a scene. Raises ValueError if there is none."""
    values, errors = fit.to_dict(), fit.standard_errors
    options, number, name = _OPTIONS[setting.medium]
    numbers = {"E_star": rounded(values["E_star"], errors.get("E_star"))}
    # As deep as the curve, so that its force is seen.
    numbers["max_depth"] = rounded(float(np.max(fit.path.depth)), None)
    if name and np.isfinite(fit.medium.q_c) | (number in ("eta", "work_of_adhesion")):
        numbers[number] = rounded(values[name], errors.get(name))
    elif setting.kind.letter:
        options = {"plasticity": "none"}
    shape, sizes = _shape(setting)
    state = preset_state().replace(elasticity="modulus", damping="none", adhesion="none")
    state = state.replace(shape=shape, **options)
    return link.write(state.replace(**{each: checked(each, v) for each, v in (sizes | numbers).items()}))


def _shape(setting: Setting) -> tuple[str, dict[str, float]]:
    """Shape of the explorer and its numbers."""
    if setting.tip == "measured":
        raise ValueError("a measured tip is opened from its own file")
    names = TIPS[setting.tip].numbers
    if setting.tip in ("berkovich", "cube_corner"):
        return "cone", {"cone_slope": setting.profile.slope}
    sizes = {f"{setting.tip}_{name}": getattr(setting, name) for name in names}
    if "half_angle" in names:
        sizes[f"{setting.tip}_slope"] = slope_of(sizes.pop(f"{setting.tip}_half_angle"))
    if setting.tip == "rounded_cone":
        sizes["rounded_cone_tip_radius"] = sizes.pop("rounded_cone_radius")
    return setting.tip, sizes
