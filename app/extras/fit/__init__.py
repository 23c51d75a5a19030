"""*Fit a measurement*: upload of a curve, choice of its columns and samples, and fit of the medium."""

import re

from ...extra import Extra
from ...plot import Overlay, View
from ...state import State
from .changes import DEFAULT_FIXED, fit, quantity_of, silica, take
from .drawn import MEASURED, RESIDUAL, measured, reach
from .measured import FITTED, Curve
from .part import Fitting
from .words import result, told, unloading

__all__ = ["DEFAULT_FIXED", "EXTRA", "fit", "quantity_of", "result", "silica", "take", "unloading"]


def compute(state: State, before: View | None) -> Curve | None:
    curve = state["fit.curve"]
    return None if curve is None else curve.placed(state)


def check(state: State) -> str:
    unknown = not set(state["fit.fixed"]) <= set(FITTED)
    if unknown:
        return "a parameter that the fit holds, in this link, is not known"
    ends = state["fit.samples"]
    known = not ends or (len(ends) == 2 and all(re.fullmatch("[0-9]{1,8}", end) for end in ends))
    if known and (not ends or 1 <= int(ends[0]) < int(ends[1])):
        return ""
    return "the samples that the fit takes, in this link, are not two ascending numbers"


EXTRA = Extra(
    "fit",
    order=5,
    values={"fit.curve": None, "fit.fixed": DEFAULT_FIXED, "fit.note": "", "fit.samples": ()},
    tab="Fit a measurement",
    plots=(RESIDUAL,),
    overlays=(Overlay("force", MEASURED, measured, reach=reach),),
    check=check,
    compute=compute,
    side=Fitting,
    told=told,
)
