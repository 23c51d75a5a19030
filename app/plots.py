"""The plots. Each is one entry of `PLOTS`: its rows with their looks, and two functions that fill them.

`still` gives columns that stay while a scene is played, `moving` those of one of its states; see `columns`.
A row has a role, which is its colour (`ROLES`).
"""

from collections.abc import Callable
from dataclasses import dataclass, field

from . import columns
from .view import View

#: Colours of the roles, light and dark: Okabe–Ito; they mean the same thing in every plot.
ROLES = {
    "free": ("#8a8f98", "#828a95"),
    "elastic": ("#0072b2", "#56b4e9"),
    "yielded": ("#d55e00", "#f0913a"),
    "held": ("#aa4499", "#dd8fd0"),
    "speed": ("#009e73", "#35c79b"),
    "loss": ("#b8860b", "#e0c04c"),
    "ink": ("#22272e", "#e4e7eb"),
    "body": ("#c9ced6", "#3a4049"),
    "paper": ("#ffffff", "#181b20"),
    "chalk": ("#fefefe", "#fefefe"),
}


@dataclass(frozen=True)
class Row:
    """One area, line, mark or label of a plot; `look` has its style, `legend` whether it is named there.

    A line with a `symbol` answers to the pointer, with its values on the axis `axis` (0 x, 1 y, 2 right).
    """

    kind: str
    name: str
    role: str = "ink"
    legend: bool = True
    symbol: str = ""
    axis: int = 1
    look: dict = field(default_factory=dict)


def area(name, role, alpha, hatch=" ", legend=True):
    return Row("areas", name, role, legend, look={"alpha": alpha, "hatch": hatch})


def line(name, role, width=2.0, dash="solid", symbol="", axis=1, legend=True):
    return Row("lines", name, role, legend, symbol, axis, {"width": width, "dash": dash})


def mark(name, role="ink", edge="paper", marker="circle", size=10, axis=1, legend=True):
    return Row("marks", name, role, legend, axis=axis, look={"edge": edge, "marker": marker, "size": size})


def label(name):
    return Row("labels", name, legend=False)


@dataclass(frozen=True, eq=False)
class Plot:
    """A plot: title, formula, keys of its axes (x, y, and one on the right), rows, and their columns."""

    title: str
    formula: str
    axes: tuple[str, ...]
    rows: tuple[Row, ...]
    still: Callable[[View], dict] = lambda view: {}
    moving: Callable[[View, int], dict] = lambda view, i: {}
    log: bool = False
    image: bool = False


_RADII = (
    line("at a", "ink", 1.0, "dashed", legend=False),
    line("at c", "yielded", 1.3, "dotted", legend=False),
    label("a"),
    label("c"),
)
_HELD = {"role": "held", "width": 1.4}

#: Every plot of the page, in its order.
PLOTS = {
    "springs": Plot(
        "1D foundation", "(17) (18)  q = E*(d − g(x)) ≤ (π/2) q_c", ("x", "z"),
        (
            area("profile g(x)", "body", 0.55),
            line("free", "free", 0.9),
            line("elastic", "elastic", 1.4),
            line("yielded", "yielded", 2.4),
            line("residual imprint", "yielded", 1.4, "dotted"),
            *_RADII,
        ),
        moving=columns.springs,
    ),
    "force": Plot(
        "Force and depth", "(20) (22)  F = 2E* ∫ a(s) ds,  d_p < s < d", ("d", "F"),
        (
            area("dissipated", "yielded", 0.13, "/"),
            area("recoverable", "elastic", 0.25),
            line("held", **_HELD, dash="dotdash", symbol="F"),
            line("unloading", "elastic", 1.8, "dashed", "F"),
            line("elastic", "elastic", 2.2, symbol="F"),
            line("yielding", "yielded", 3.0, symbol="F"),
            mark("onset of yield", "paper", "yielded", "diamond", 11),
            mark("now"),
            label("dₚ"),
        ),
        columns.force_still, columns.force,
    ),
    "motion": Plot(
        "Impact over time", "m d²d/dt² = −F", ("t", "d", "F"),
        (
            line("held", **_HELD, dash="dotdash", symbol="F", axis=2),
            line("depth d", "speed", 2.2, symbol="d"),
            line("force F", "elastic", 2.2, "dashed", "F", axis=2),
            line("time", "ink", 1.0, "dashed", legend=False),
            mark("now"),
            mark("F now", marker="diamond", size=11, axis=2, legend=False),
        ),
        columns.motion_still, columns.motion,
    ),
    "pressure": Plot(
        "Contact pressure", "(10)  σ_zz(r) = (1/π) ∫ q′(x) dx/√(x² − r²)", ("r", "p"),
        (
            area("plastic zone r < c", "yielded", 0.13),
            area("below", "elastic", 0.12, legend=False),
            line("held", **_HELD, dash="dotdash", symbol="−σzz"),
            line("−σzz(r)", "elastic", 2.0, symbol="−σzz"),
            line("mean F/(πa²)", "ink", 1.0, "dotdash", "mean"),
            *_RADII,
            label("beyond"),
        ),
        columns.pressure_still, columns.pressure,
    ),
    "radii": Plot(
        "Contact and plastic zone", "(16) (21)  g(a) = d,  g(c) = d − d_c", ("d", "a"),
        (
            area("zone", "yielded", 0.13, legend=False),
            line("held a", **_HELD, dash="dotdash", symbol="a"),
            line("held c", **_HELD, dash="dotted", symbol="c"),
            line("unloading", "elastic", 1.8, "dashed", "a"),
            line("contact radius a", "elastic", 2.2, symbol="a"),
            line("plastic zone c", "yielded", 3.0, symbol="c"),
            mark("now"),
            mark("c now", legend=False),
        ),
        columns.radii_still, columns.radii_marks,
    ),
    "energy": Plot(
        "Where the energy is", "m v²/2 + U + W_p + W_v = m v_0²/2", ("t", "E"),
        (
            area("plastic", "yielded", 0.45, "/"),
            area("viscous", "loss", 0.5, "\\"),
            area("stored", "elastic", 0.45),
            area("kinetic", "speed", 0.3),
            line("time", "ink", 1.0, "dashed", legend=False),
        ),
        columns.energy_still, columns.energy,
    ),
    "map": Plot(
        "Contact pressure over the plane", "(10)  −σ_zz(√(x² + y²))", ("plane x", "plane y"),
        (line("contact radius a", "chalk", 1.2, "dashed"), line("plastic zone c", "chalk", 1.2, "dotted")),
        moving=columns.plane, image=True,
    ),
    "speed": Plot(
        "Speed against error", "(1)  Δk = E* Δx,  Δγ = 4η Δx", (),
        (
            line("chains", "yielded", 1.4, "dashed", legend=False),
            mark("used on this page", "paper", "ink", size=20),
            mark("chain", "yielded", marker="diamond", size=10),
            mark("closed form", "elastic", marker="square"),
            mark("scalar ODE", "speed", marker="triangle", size=11),
        ),
        log=True,
    ),
}  # fmt: skip
