"""The plots, each declared once: what is drawn, in which colour and pattern, over which axes."""

import holoviews as hv
import numpy as np

from .plotting import (
    BODY,
    ELASTIC,
    FREE,
    HELD,
    INK,
    LOSS,
    PAPER,
    SPEED,
    YIELDED,
    Plot,
    area,
    curve,
    encoded,
    names,
    points,
    verticals,
)

#: The vertical lines at ±a and ±c, with their names: the same in both plots over the radius.
_RADII = (
    verticals("a line", color=INK, line_width=1, line_dash="dashed", show_legend=False),
    verticals("c line", color=YIELDED, line_width=1.2, line_dash="dotted", show_legend=False),
    names("names", text_baseline="top"),
)
_NOW = {"marker": "circle", "size": 10, "color": INK, "line_color": PAPER, "line_width": 1.5}
_HELD = {"color": HELD, "line_width": 1.4, "line_dash": "dotdash"}
_TOOLS = {"tools": ["hover"]}


def _overlay(*elements):
    return hv.Overlay(list(elements))


_SPRINGS = Plot(
    "springs",
    "1D foundation",
    "springs",
    _overlay(
        area("indenter", color=BODY, alpha=0.55, show_legend=False),
        curve("base", color=INK, line_width=2, show_legend=False),
        curve("free", color=FREE, line_width=0.9, line_dash="dotted"),
        curve("elastic", color=ELASTIC, line_width=1.3),
        curve("yielded", color=YIELDED, line_width=2.4),
        curve("residual imprint", color=YIELDED, line_width=1.4, line_dash="dotted"),
        curve("profile g(x)", color=INK, line_width=1.8),
        *_RADII,
    ),
    ("x", "z"),
)

_FORCE = Plot(
    "force",
    "Force and depth",
    "force",
    _overlay(
        area("dissipated", color=YIELDED, alpha=0.13),
        area("recoverable", color=ELASTIC, alpha=0.25),
        curve("held", **_HELD),
        curve("unloading", color=ELASTIC, line_width=1.8, line_dash="dashed", **_TOOLS),
        curve("elastic", color=ELASTIC, line_width=2.2, **_TOOLS),
        curve("yielding", color=YIELDED, line_width=3, **_TOOLS),
        points("onset", marker="diamond", size=11, color=PAPER, line_color=YIELDED, line_width=2).opts(
            show_legend=False
        ),
        points("now", **_NOW),
        names("names", text_align="left"),
    ),
    ("d", "F"),
    hatched=("dissipated",),
)

_PRESSURE = Plot(
    "pressure",
    "Contact pressure",
    "pressure",
    _overlay(
        area("plastic zone r < c", color=YIELDED, alpha=0.13),
        area("area", color=ELASTIC, alpha=0.12, show_legend=False),
        curve("held", **_HELD),
        curve("−σ_zz(r)", color=ELASTIC, line_width=2, **_TOOLS),
        curve("mean, F/(πa²)", color=INK, line_width=1, line_dash="dotdash"),
        *_RADII,
        names("note", text_font_size="11px", text_font_style="normal", text_baseline="top"),
    ),
    ("x", "p"),
)

_ZONE = Plot(
    "radii",
    "Contact and plastic zone",
    "radii",
    _overlay(
        area("zone", color=YIELDED, alpha=0.13, show_legend=False),
        curve("held a", **_HELD),
        curve("held c", **(_HELD | {"line_dash": "dotted"})),
        curve("unloading", color=ELASTIC, line_width=1.8, line_dash="dashed"),
        curve("contact radius a", color=ELASTIC, line_width=2.2, **_TOOLS),
        curve("plastic zone c", color=YIELDED, line_width=3, **_TOOLS),
        points("now", **_NOW),
    ),
    ("d", "a"),
)

_MOTION = Plot(
    "motion",
    "Impact over time",
    "motion",
    _overlay(
        curve("held", **_HELD),
        curve("depth d", color=SPEED, line_width=2.2, **_TOOLS),
        curve("force F", color=ELASTIC, line_width=2.2, line_dash="dashed", **_TOOLS),
        verticals("time line", color=INK, line_width=1, line_dash="dashed", show_legend=False),
        points("now", **_NOW),
        points("force now", marker="diamond", size=11, color=INK, show_legend=False),
    ),
    ("t", "d", "F"),
    right=("force F", "force now", "held"),
)

_ENERGY = Plot(
    "energy",
    "Where the energy is",
    "energy",
    _overlay(
        area("plastic", color=YIELDED, alpha=0.45),
        area("viscous", color=LOSS, alpha=0.5),
        area("stored", color=ELASTIC, alpha=0.45),
        area("kinetic", color=SPEED, alpha=0.3),
        verticals("time line", color=INK, line_width=1, line_dash="dashed", show_legend=False),
    ),
    ("t", "E"),
    hatched=("plastic", "viscous"),
)


def _map():
    image = hv.Image(np.zeros((2, 2)), bounds=(-1, -1, 1, 1), kdims=["x", "y"], vdims="p", label="image")
    # A white that stays white in the dark.
    ring = curve("a ring", color="#fefefe", line_width=1.2, line_dash="dashed", show_legend=False)
    zone = curve("c ring", color="#fefefe", line_width=1.2, line_dash="dotted", show_legend=False)
    options = {"cmap": "cividis", "colorbar": True, "clim": (0, 1)}
    return Plot(
        "map",
        "Contact pressure over the plane",
        "pressure",
        _overlay(image.opts(**options), ring, zone),
        ("x", "x"),
    )


_SPEED = Plot(
    "speed",
    "Speed against error",
    "elements",
    _overlay(
        points("used on this page", marker="circle", size=20, color=PAPER, line_color=INK, line_width=1.5),
        curve("chain line", color=YIELDED, line_width=1.4, line_dash="dashed", show_legend=False),
        points("chain", marker="diamond", size=9, color=YIELDED, line_color=PAPER),
        points("closed form", marker="square", size=10, color=ELASTIC, line_color=PAPER),
        points("scalar ODE", marker="triangle", size=11, color=SPEED, line_color=PAPER),
        names("names", text_align="left", text_font_style="normal"),
    ).opts(hv.opts.Overlay(logx=True, logy=True, xlim=(1e-5, 10), ylim=(1e-17, 1))),
    (),
)

#: Every plot of the page, in its order.
PLOTS = {plot.name: plot for plot in (_SPRINGS, _FORCE, _MOTION, _PRESSURE, _ZONE, _ENERGY, _map(), _SPEED)}

# One axis for both plots, so that what belongs together stands under each other.
for _lower, _upper in (("pressure", "springs"), ("radii", "force"), ("energy", "motion")):
    PLOTS[_lower].figure.x_range = PLOTS[_upper].figure.x_range

#: What is built in a browser at the same time: the rest is, when it is seen for the first time.
DOCUMENTS = [
    encoded([PLOTS[name] for name in group])
    for group in (("springs", "force", "pressure", "radii"), ("motion", "energy"), ("map",), ("speed",))
]
