"""*Fit a measurement*: the link to its page, and what becomes of links of fits on the explorer."""

from typing import Any

from ..extra import Extra, Pairs
from ..parts import Part, text
from ..plot import View

#: What a link of a fit on the explorer had: names of today, and those of version 0.6.
_FORMER = ("fixed", "fit_note", "contact_point", "baseline", "tilt", "drag", "depth_noise")
_LINK = '<a href="?fit">Fit a measurement</a>'
_NOTE = (
    f"This link was made with a fit. Measured curves have a page of their own: {_LINK}. "
    "The scene is that of the fit."
)


def of_fit(name: str) -> bool:
    """Whether a name in a link is one of a fit."""
    return name.startswith("fit.") or name in _FORMER


def translated(pairs: Pairs) -> Pairs:
    """A link without what is of a fit, which is said."""
    kept = [pair for pair in pairs if not of_fit(pair[0])]
    # The residual was a plot of the fit.
    kept = [(n, " ".join(t for t in v.split() if t != "residual") if n == "tiles" else v) for n, v in kept]
    return kept if len(kept) == len(pairs) else [*kept, ("fit.former", "1")]


def header(page: Any, view: View) -> Part:
    return text("fit", _LINK, "way")


def notes(view: View) -> dict[str, str]:
    return {"first": f'<p class="former">{_NOTE}</p>' if view.state["fit.former"] else ""}


EXTRA = Extra(
    "fit",
    order=5,
    values={"fit.former": ""},
    of_view=("fit.former",),
    header=header,
    translated=translated,
    notes=notes,
)
