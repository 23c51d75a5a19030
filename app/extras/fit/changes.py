"""Changes of a state by the fit: a curve is taken, samples are chosen, and the medium is fitted."""

import re
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.fit.indentation import IndentationFit
from mdr_core.results.units import written

from ...quantities import ASSETS, QUANTITIES, Quantity, in_words
from ...state import State, checked, medium, profile
from .measured import (
    CONSTANTS,
    FITTED,
    OF_MEDIUM,
    PLACED,
    SUBTRACTED,
    Measured,
    offered,
    read_curve,
    with_curve,
)

#: Parameters that a fit holds unless they are freed.
DEFAULT_FIXED = ("eta", "work_of_adhesion", "baseline", "tilt", "drag")
#: The measured example.
SILICA = ASSETS / "silica.csv"


def quantity_of(name: str) -> Quantity:
    """Quantity of the page that a parameter of a fit is."""
    names = {"hardness": "volume_hardness"} | {placed: f"fit.{placed}" for placed in PLACED}
    return QUANTITIES[names.get(name, name)]


def take(state: State, curve: Measured | None) -> State:
    """Compare with a measured curve, or with none; what a fit holds is the default again.

    The hardness of the fit is that of the page.
    """
    tiles = ("residual",) if curve else tuple(tile for tile in state.tiles if tile != "residual")
    placed = {"fit.contact_point": 0.0, "fit.baseline": 0.0, "fit.fixed": DEFAULT_FIXED}
    placed |= {f"fit.{name}": 0.0 for name in SUBTRACTED}
    placed["fit.hardness"] = CONSTANTS.get(state.plasticity, "q_c")
    return with_curve(state, curve).replace(tiles=tiles, **placed)


def silica(state: State) -> State:
    """Compare with the measured example, under the cone with the area of its Berkovich tip.

    Its depths count from first contact, and glass has a constant hardness.
    """
    fixed = tuple(name for name in FITTED if name not in ("E_star", *CONSTANTS.values()))
    state = state.replace(shape="cone", cone_slope=mdr.Cone.from_half_angle(70.3).slope)
    curve = read_curve(SILICA.read_bytes(), "Fused silica, Berkovich tip.csv")
    depth, state = float(curve.data[0].max()), take(state, curve)
    pressed = {"drive": "depth", "max_depth": checked("max_depth", depth), "at": 1.0}
    return state.replace(**pressed, **{"fit.fixed": fixed, "fit.hardness": "hardness"})


def fit(state: State) -> State:
    """Fit medium and position to the measured curve; press to its depth."""
    made = medium(state)
    names = offered(state)
    for name in FITTED:
        if name not in (*state["fit.curve"].fitted, *state["fit.fixed"]):
            raise ValueError(
                f"the {quantity_of(name).label} needs the times of the samples: leave it as it is"
            )
    held = [name for name in names if name in state["fit.fixed"]]
    fixed = {name: state[f"fit.{name}"] if name in PLACED else getattr(made, name) for name in held}
    asked = dict.fromkeys(names) | fixed
    if fixed.get(state["fit.hardness"]) == 0 and made.q_c == np.inf:
        asked["q_c"] = np.inf
    _refuse_hardness(state, asked)
    if state["fit.depth_noise"] > 0:
        asked["depth_noise"] = state["fit.depth_noise"]
    found = _found(state, asked)
    numbers = {f"fit.{name}": float(getattr(found, name)) for name in PLACED}
    numbers["max_depth"] = float(np.max(found.path.depth))
    choices = {"drive": "depth"}
    for name, (choice, option) in OF_MEDIUM.items():
        if name in asked and name not in fixed:
            value = float(getattr(found.medium, name))
            there = 0 < value < np.inf
            choices[choice] = option if there else "none"
            numbers |= {quantity_of(name).name: value} if there else {}
    numbers = {name: checked(name, value) for name, value in numbers.items()}
    subtracted = tuple(state[f"fit.{name}"] for name in SUBTRACTED)
    curve = state["fit.curve"]
    curve = Measured(curve.name, curve.curve, found, subtracted, curve.range(state))
    fitted = {"fit.curve": curve, "fit.note": _note(curve)}
    return state.replace(at=1.0, **fitted, **choices, **numbers)


def _found(state: State, asked: dict[str, Any]) -> IndentationFit:
    """Fit to the chosen samples; refusals are in words of the page."""
    curve, used = state["fit.curve"], state["fit.curve"].used(state)
    depth, force = curve.samples(state)
    _refuse_range(state, asked, depth, used)
    origin = asked["contact_point"]
    if origin is not None and origin >= depth[used].max():
        deepest = written(float(depth[used].max()), "length")
        raise ValueError(
            f"the contact point z_0 = {written(origin, 'length')} is held, and the samples reach only to "
            f"{deepest}: let the fit find it, or type a smaller one"
        )
    time = None if curve.time is None else curve.time[used]
    try:
        return mdr.fit_indentation(profile(state), depth[used], force[used], time=time, **asked)
    except ValueError as error:
        raise ValueError(in_page_words(in_words(error))) from None


def _refuse_range(state: State, asked: dict[str, Any], depth: Any, used: Any) -> None:
    """Refuse samples that need those before them: a medium remembers the largest depth, and rates."""
    first = int(np.argmax(used))
    if asked.get("eta", 0.0) != 0 and first:
        raise ValueError(
            "with viscosity the force depends on all samples before: begin the range at sample 1, or hold "
            "the viscosity at 0"
        )
    largest, within = float(depth[: first + 1].max()), float(depth[used].max())
    # As for noise of the depth, a thousandth of the range hardly counts.
    if asked.get("q_c") != np.inf and largest - within > 1e-3 * np.ptp(depth[used]):
        raise ValueError(
            f"the samples before the range reach deeper, {written(largest, 'length')}, than those in it, "
            f"{written(within, 'length')}, and what yielded there is not fitted: begin the range at the "
            "largest depth or before"
        )


def choose_samples(state: State, first: int, last: int) -> State:
    """Fit the samples from one to another, numbers from 1 on."""
    count = len(state["fit.curve"].curve)
    if not 1 <= first < last <= count:
        raise ValueError(f"samples {first} to {last} are not two of 1 to {count}, the first one before")
    chosen = () if (first, last) == (1, count) else (str(first), str(last))
    state = state.replace(**{"fit.samples": chosen})
    if np.count_nonzero(state["fit.curve"].used(state)) < 2:
        step = state["fit.curve"].step
        raise ValueError(f"samples {first} to {last} are too few: one in {step} is taken")
    return state


def choose_part(state: State, part: str) -> State:
    """Fit all samples, or those up to the largest depth or from it on."""
    curve = state["fit.curve"]
    count, top = len(curve.curve), curve.deepest(state)
    ends = {"All": (1, count), "Loading": (1, top), "Unloading": (top, count)}
    return choose_samples(state, *ends[part])


def _refuse_hardness(state: State, asked: dict[str, Any]) -> None:
    """Refuse a constant that is held and is not on the page, and what is fitted with q_c alone."""
    constant = state["fit.hardness"]
    if asked.get("q_c") == np.inf:
        return
    if state.adhesion == "work" and asked["work_of_adhesion"] != 0:
        raise ValueError(
            "with adhesion a fit is of an elastic medium: choose yield none, and hold the hardness"
        )
    if asked[constant] == 0:
        raise ValueError(
            f"the fit holds the {quantity_of(constant).label}, and the page has another hardness: choose "
            "the same for both, or do not hold it"
        )
    if constant == "q_c":
        return
    if asked.get("eta", 0) != 0:
        raise ValueError(
            "with viscosity a fit is of a hardness ∝ 1/a: choose that one, or viscosity none, and hold it"
        )


def _note(curve: Measured) -> str:
    """Summary of a fit for links and reports."""
    found, values, texts = curve.fit, curve.fit.to_dict(), []
    for name, error in found.standard_errors.items():
        symbol, kind = quantity_of(name).symbol, quantity_of(name).kind
        texts.append(f"{symbol} = {written(values[name], kind)} ± {written(float(error), kind, 2)}")
    # Without a given noise χ² is not known.
    if np.isfinite(found.reduced_chi_square):
        texts.append(f"χ² = {float(found.reduced_chi_square):.3g}")
    part = ", samples {} to {}".format(*curve.chosen) if curve.of_part else ""
    return f"fit to {curve.name}{part}: {', '.join(texts)}"[:300]


def in_page_words(text: str) -> str:
    """A report, remark or refusal of the core with symbols and words for its names of parameters."""
    for name in ("contact_point", "depth_noise", "force_noise", "work_of_adhesion"):
        text = text.replace(name, name.replace("_", " "))
    text = text.replace("or free baseline", "or do not hold the baseline")
    return re.sub(r"\beta\b", "η", text.replace("E_star", "E*"))
