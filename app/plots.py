"""The plots. Each is one entry of `PLOTS`: its rows with their looks, and the functions that fill them.

`still` gives rows that stay while a scene is played, `moving` those of one of its states, see `columns`;
`resting` what takes longer than a move, see `Found`. A row has a role, which is its colour.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from mdr_core.results.figures import PRESSURE_ROWS, RADII, SPRING_ROWS, Row, area, label, line, mark, parts

from . import columns, comparison, friction, measured, references, section, surface, sweep
from .resting import Found
from .view import View


@dataclass(frozen=True, eq=False)
class Plot:
    """A plot: title, formula, keys of its axes (x, y, and one on the right or of colours), and rows.

    With a `button` (its text, and a key) it is shown on request, and only where all its axes are. `resting`
    gets the trajectory and the values of the `controls`, choices and numbers that stand above the plot; it
    yields what it has found so far, anew for each scene, with `of_state` for each state. An `image` has so
    many rows and columns of pixels. `below` is what stands below the plot, as HTML, `note` what
    depends on the view. `fitted` gives axes that depend on what is chosen; where `to_scale`, both have as
    many pixels for a metre. `asks` gives of the explorer what `resting` gets in place of the controls'
    values; what is `quick` is found at every move.
    """

    title: str
    formula: str
    axes: tuple[str, ...]
    rows: tuple[Row, ...]
    still: Callable[[View], dict] = lambda view: {}
    moving: Callable[[View, int], dict] = lambda view, i: {}
    resting: Callable[..., Iterator[Found]] | None = None
    of_state: bool = False
    button: tuple[str, str] | None = None
    controls: tuple[str, ...] = ()
    log: bool = False
    image: tuple[int, int] | None = None
    below: str = ""
    note: Callable[[View], str] | None = None
    fitted: Callable[[View], list] | None = None
    to_scale: Callable[[View], bool] | None = None
    asks: Callable[..., object] | None = None
    quick: Callable[..., bool] = lambda *values: False

    def values(self, explorer):
        """What `resting` gets beside the trajectory."""
        return [self.asks(explorer)] if self.asks else [getattr(explorer, n) for n in self.controls]


#: Scenes that can be held have each its own dashes.
DASHES = ("dotdash", "dashed", "dotted", "solid")


def _held(symbol, axis=1, what="", width=1.6, legend=True):
    """A row for each scene that may be held."""
    rows = enumerate(DASHES, 1)
    return [line(f"held {k}{what}", "held", width, dash, symbol, axis, legend) for k, dash in rows]


#: Every plot of the page, in its order.
PLOTS = {
    "springs": Plot(
        "1D foundation", "(17) (18)  q = E*(d − g(x)) ≤ (π/2) q_c", ("x", "z"),
        (*SPRING_ROWS, line("sticks", "stick", 2.4), line("slips", "slip", 1.4)),
        moving=columns.springs,
    ),
    "force": Plot(
        "Force and depth", "(20) (22)  F = 2E* ∫ a(s) ds,  d_p < s < d", ("d", "F"),
        (
            area("dissipated", "yielded", 0.13, "/"),
            area("recoverable", "elastic", 0.25),
            *_held("F"),
            *references.ROWS,
            line("path ahead", "free", 1.0),
            *parts("F"),
            line("measured", "measured", 1.4, symbol="F"),
            mark("onset of yield", "paper", "yielded", "diamond", 11),
            mark("now"),
            label("dₚ"),
        ),
        columns.force_still, columns.force, controls=("references",), note=references.note,
    ),
    "motion": Plot(
        "Depth and force over time", "a free body: m d²d/dt² = −F;  else as prescribed  § 9",
        ("t", "d", "F"),
        (
            *_held("F", axis=2),
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
        (*_held("−σzz"), *PRESSURE_ROWS, label("beyond")),
        columns.pressure_still, columns.pressure,
    ),
    "residual": Plot(
        "Residual", "ΔF = F_measured − F(d)  § 17", ("d", "ΔF"),
        (
            line("zero", "ink", 1.0, "dashed", legend=False),
            line("± noise", "free", 1.2, "dotted"),
            line("measured − model", "measured", 0.9, symbol="ΔF"),
            label("missing"),
        ),
        measured.residual_still,
    ),
    "radii": Plot(
        "Contact and plastic zone", "(16) (21)  g(a) = d,  g(c) = d − d_c", ("d", "a"),
        (
            area("zone", "yielded", 0.13, legend=False),
            *_held("a", what=" a"),
            *_held("c", what=" c", width=0.9, legend=False),
            line("unloading", "elastic", 1.8, "dashed", "a"),
            line("contact radius a", "elastic", 2.2, symbol="a"),
            line("plastic zone c", "yielded", 3.0, symbol="c"),
            mark("now"),
            mark("c now", legend=False),
        ),
        columns.radii_still, columns.radii_marks,
    ),
    "energy": Plot(
        "Where the energy is", "U + W_p + W_v + m v²/2 = ∫ F dd, or m v_0²/2  § 9", ("t", "E"),
        (
            area("friction", "slip", 0.6, "x"),
            area("plastic", "yielded", 0.45, "/"),
            area("viscous", "loss", 0.5, "\\"),
            area("stored", "elastic", 0.45),
            area("kinetic", "speed", 0.3),
            line("time", "ink", 1.0, "dashed", legend=False),
        ),
        columns.energy_still, lambda view, i: {"time": view.time(i, "E")},
    ),
    "forces": Plot(
        "Forces of an oblique impact", "|F_x| ≤ μ F,  § 13", ("t", "force"),
        (
            *_held("F"),
            line("most friction ±μF", "slip", 1.2, "dashed", "μF"),
            line("normal force F", "elastic", 2.2, symbol="F"),
            line("force along Fₓ", "stick", 2.2, symbol="Fₓ"),
            line("time", "ink", 1.0, "dashed", legend=False),
            mark("now"),
            mark("F now", marker="diamond", legend=False),
        ),
        friction.forces_still, friction.forces,
    ),
    "hodograph": Plot(
        "Hodograph of the contact point", "m_t dW = −F_x dt,  m dv = −F dt,  § 13", ("W", "v"),
        (
            *_held("−v"),
            line("path before", "free", 1.2, "dashed"),
            line("path after", "free", 1.2),
            line("all slips", "slip", 3.0, symbol="−v"),
            line("something sticks", "stick", 2.0, symbol="−v"),
            mark("now"),
        ),
        friction.hodograph_still, lambda view, i: {"now": view.mark(i, "W", "v")},
        to_scale=lambda view: True,
    ),
    "maw": Plot(
        "Speed along the surface, after over before", "ψ = κ W/(μ v_0),  § 13", ("ψ₁", "ψ₂"),
        (
            line("elastic (Maw)", "elastic", 2.2, symbol="ψ₂"),
            mark("this impact", "slip", "ink", "diamond", 12),
        ),
        friction.maw_still, resting=friction.maw, button=("ψ", "o"),
    ),
    "map": Plot(
        "Contact pressure over the plane", "(10)  −σ_zz(√(x² + y²))", ("plane x", "plane y", "p"),
        (line("contact radius a", "chalk", 1.2, "dashed"), line("plastic zone c", "chalk", 1.2, "dotted")),
        moving=columns.plane, image=(columns.PIXELS, columns.PIXELS), button=("Map", "m"),
        to_scale=lambda view: True,
    ),
    "surface": Plot(
        "Surface and imprint", "u(r) = ∫ (2/π) arcsin(a(s)/r) ds,  a(s) < r  § 7",
        ("section r", "section z"),
        (
            area("tip z(r)", "body", 0.55),
            area("medium", "free", 0.16, legend=False),
            line("undeformed", "free", 1.0, "dashed", legend=False),
            line("deformed surface", "elastic", 2.2, symbol="z"),
            line("residual imprint", "yielded", 2.0, "dotted", symbol="z"),
            *RADII,
        ),
        moving=surface.moving, button=("Surface", "u"), controls=("heights",), fitted=surface.axes,
        to_scale=lambda view: view.chosen["heights"] == "to_scale",
    ),
    "loglog": Plot(
        "Force and depth, logarithmic", "z ∝ rⁿ:  F ∝ d^(1 + 1/n), then d^(1/n)  § 6",
        ("log d", "log F"),
        (
            *_held("F"),
            *references.ROWS,
            *parts("F"),
            line("measured", "measured", 1.4, symbol="F"),
            mark("onset of yield", "paper", "yielded", "diamond", 11),
            mark("now"),
        ),
        columns.logarithmic_still, columns.logarithmic, button=("Log–log", "l"), log=True,
    ),
    "section": Plot(
        "Section under the tip", "σ(r, z): each increment of depth a flat punch of radius a(s)  § 7", (),
        (
            line("equal stress", "chalk", 0.6, legend=False),
            line("contact radius a", "chalk", 1.2, "dashed"),
            line("plastic zone c", "chalk", 1.2, "dotted"),
            mark("largest", "yielded", "chalk", "diamond", 12),
        ),
        resting=section.found, of_state=True, button=("Section", "e"), controls=("section",),
        image=section.SHAPE,
    ),
    "sweep": Plot(
        "Sweep", "one number over a range, all others as they are  § 10", (),
        (
            *(line(name, "ink", 1.4, dash, "y") for name, dash in sweep.LINES.items()),
            line("this scene", "elastic", 2.4, symbol="y"),
            mark("present value"),
        ),
        resting=sweep.found, button=("Sweep", "w"), controls=("swept", "against", "sweep_axes"),
        asks=sweep.asked, quick=sweep.quick,
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
        resting=comparison.found, button=("Speed", "s"), log=True, below=comparison.MEASURED,
    ),
}  # fmt: skip
