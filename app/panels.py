"""What stands around the plots: readouts, the indenter's drawing, notes and help, as safe HTML."""

from html import escape

import numpy as np

from .shapes import SHAPES
from .units import digits, written

#: Slope beyond which a half-space and small slopes are an approximation.
SMALL_SLOPE = 0.3

EQUATIONS = (
    ("(1)", "springs of stiffness Δk = E* Δx, independent of each other"),
    ("(2)", "1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂"),
    ("(3)", "g(x) = x ∫₀ˣ z′(r)/√(x² − r²) dr, the equivalent 1D profile"),
    ("(10)", "σ_zz(r) = (1/π) ∫ᵣ^∞ q′(x)/√(x² − r²) dx"),
    ("(11)", "F = π a² σ_c = π q_c a: hardness σ_c = q_c/a"),
    ("(12)", "a spring carries q = E* u, but never more than π q_c/2"),
    ("(16)", "a = 2d/(π s) for a cone; in general g(a) = d"),
    ("(17) (18)", "q(x) = E*(d − g(x)), at most π q_c/2"),
    ("(19)", "d_c = π q_c/(2E*), the depth where yield starts"),
    ("(20)", "F_c = π q_c²/(2E* s) for a cone"),
    ("(21)", "a − c = q_c/(E* s) for a cone; in general g(c) = d − d_c"),
    ("(22)", "F = F_c + (2q_c/s)(d − d_c) for a cone, d > d_c"),
)

KEYS = (
    "Numbers can be typed (2.5, 3e-6, 250 MPa) or dragged; on a slider arrow keys step, Page Up and "
    "Page Down leap, Home and End go to the ends, a double click resets."
)

MODEL = (
    "A rigid indenter on a half-space, at small slopes; the yield criterion is non-local, hardness "
    "inversely proportional to the contact radius (class b of the paper). Equation numbers are those of "
    "V. L. Popov, Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46."
)


def readouts(run):
    """The strip of numbers above the plots."""
    state, onset = run.state, run.onset
    rows = (
        ("F", "force", written(state.force, "force")),
        ("a", "contact radius", written(state.contact_radius, "length")),
        ("c", "plastic radius", written(state.plastic_radius, "length")),
        ("d", "depth", written(state.depth, "length")),
        ("d/d_c", "relative depth", digits(state.depth / onset.depth)),
        ("d_c", "depth at onset", written(onset.depth, "length")),
        ("F_c", "force at onset", written(onset.force, "force")),
        ("p_m", "mean pressure", written(run.mean_pressure, "pressure")),
        ("W_p", "plastic work", written(state.plastic_work, "energy")),
        ("U", "stored energy", written(state.stored_energy, "energy")),
    )
    cells = "".join(
        f'<div title="{label}"><dt><i>{_subscript(symbol)}</i> {label}</dt><dd>{_number(text)}</dd></div>'
        for symbol, label, text in rows
    )
    return f'<dl class="readouts" aria-label="Results">{cells}</dl>'


def _number(text):
    number, _, unit = text.rpartition(" ") if text[-1].isalpha() else (text, "", "")
    return f"{number}<small> {unit}</small>"


def _subscript(symbol):
    head, *tail = symbol.split("_")
    return head + "".join(f"<sub>{part}</sub>" for part in tail) if "/" not in symbol else "d/d<sub>c</sub>"


def sketch(run, shape):
    """A small drawing of the indenter z(r), its height stretched to fit, with its formulas."""
    profile, a = run.scene.profile, run.deepest.contact_radius
    width, height, half = 132, 64, 1.5 * a
    r = np.unique(np.concatenate([np.linspace(0, half, 60), [min(profile.wall, half)]]))
    z = profile.height(r)
    finite = np.isfinite(z)
    top = z[finite].max() or 1.0
    x, y = r[finite] / half * (width / 2 - 4), height - 8 - z[finite] / top * (height - 16)
    if not finite.all():
        x, y = np.append(x, x[-1]), np.append(y, 4)
    x, y = np.concatenate([-x[::-1], x]) + width / 2, np.concatenate([y[::-1], y])
    points = " ".join(f"{px:.1f},{py:.1f}" for px, py in zip(x, y, strict=True))
    described = SHAPES[shape]
    return (
        f'<figure class="sketch"><svg width="{width}" height="{height}" role="img" '
        f'aria-label="Profile of the indenter: {escape(described.label)}">'
        f'<line x1="0" x2="{width}" y1="{height - 7}" y2="{height - 7}"/><polygon points="{points}"/></svg>'
        f"<figcaption>{escape(described.height)}<br>{escape(described.reduced)}</figcaption></figure>"
    )


def onset(run):
    """Where yield starts in this medium."""
    depth = written(run.onset.depth, "length")
    return f'<p class="note">Yield starts at d<sub>c</sub> = π q<sub>c</sub>/(2E*) = {depth} (19)</p>'


def validity(run):
    """One line on how far the assumptions hold for this scene."""
    slope = digits(run.largest_slope, 2)
    if run.largest_slope <= SMALL_SLOPE:
        kind, remark = "", "small"
    else:
        kind, remark = " beyond", f"beyond {SMALL_SLOPE} small slopes on a half-space are an approximation"
    return f'<p class="status{kind}" role="status">Slopes within the contact reach {slope}: {remark}.</p>'


def sources(preset):
    """The preset's numbers, each with where it comes from."""
    rows = "".join(
        f"<dt>{escape(what)} = {escape(value)}</dt><dd>{escape(source)}</dd>"
        for what, value, source in preset.sources
    )
    return f"<details><summary>Where the preset's numbers come from</summary><dl>{rows}</dl></details>"


def equations():
    """The model in the paper's equations, folded."""
    rows = "".join(f"<dt>{number}</dt><dd>{escape(text)}</dd>" for number, text in EQUATIONS)
    return (
        f"<details><summary>Equations and help</summary><p>{escape(MODEL)}</p>"
        f'<dl class="equations">{rows}</dl><p>{escape(KEYS)}</p></details>'
    )
