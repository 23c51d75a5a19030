"""The 1D foundation and the contact pressure: two plots over one radius axis."""

import holoviews as hv
import numpy as np

from .plotting import ELASTIC, FREE, INK, YIELDED, Axis, Declared, tooltips

SPRINGS = 60
#: A spring's rest length in units of the depth axis, and the number of its bends.
_REST, _BENDS = 1.5, 7
_NOTHING = np.zeros(2)


_LINE = hv.Curve((_NOTHING, _NOTHING), "x", "z")
#: The vertical lines at ±a and ±c, with their names: the same in both plots.
_MARKERS = (
    hv.VLines(_NOTHING, label="a line").opts(
        color=INK, line_width=1, line_dash="dashed", show_legend=False
    ),
    hv.VLines(_NOTHING, label="c line").opts(
        color=YIELDED, line_width=1.2, line_dash="dotted", show_legend=False
    ),
    hv.Labels((_NOTHING, _NOTHING, ["", ""]), label="names").opts(
        text_font_size="12px", text_color=INK, text_font_style="italic", text_baseline="top"
    ),
)

_SPRINGS = Declared(
    "springs",
    hv.Overlay(
        [
            hv.Area((_NOTHING, _NOTHING), "x", "z", label="indenter").opts(
                color="#c9ced6", alpha=0.55, line_alpha=0, show_legend=False
            ),
            _LINE.relabel("base").opts(color=INK, line_width=2, show_legend=False),
            _LINE.relabel("free").opts(color=FREE, line_width=0.8),
            _LINE.relabel("elastic").opts(color=ELASTIC, line_width=1.4),
            _LINE.relabel("yielded").opts(color=YIELDED, line_width=2.2),
            _LINE.relabel("residual imprint").opts(color=YIELDED, line_width=1.4, line_dash="dotted"),
            _LINE.relabel("profile g(x)").opts(color=INK, line_width=1.8),
            *_MARKERS,
        ]
    ),
    title="1D foundation: springs under g(x), (1) (3)",
    together={
        "outline": {"profile g(x)": "g", "indenter": "g", "residual imprint": "imprint"},
        "row": {name: name for name in ("free", "elastic", "yielded")},
    },
)

_PRESSURE = Declared(
    "pressure",
    hv.Overlay(
        [
            hv.VSpans((_NOTHING, _NOTHING), label="plastic zone r < c").opts(
                color=YIELDED, alpha=0.13, line_alpha=0, show_legend=True
            ),
            hv.Area((_NOTHING, _NOTHING), "r", "p", label="area").opts(
                color=ELASTIC, alpha=0.12, line_alpha=0, show_legend=False
            ),
            hv.Curve((_NOTHING, _NOTHING), "r", "p", label="−σ_zz(r)").opts(
                color=ELASTIC, line_width=2, tools=["hover"]
            ),
            hv.Curve((_NOTHING, _NOTHING), "r", "p", label="mean, F/(πa²)").opts(
                color=INK, line_width=1, line_dash="dotdash"
            ),
            *_MARKERS,
            hv.Labels(([0.0], [0.0], [""]), ["r", "p"], "text", label="note").opts(
                text_font_size="11px", text_color="#4a515b", text_baseline="top", text_align="center"
            ),
        ]
    ),
    title="Contact pressure from the springs, (10)",
    together={"stress": {"−σ_zz(r)": "p", "area": "p"}},
)


def _show_radii(layers, x, state, top):
    """Draw the lines at a and c, and write their names at the height `top`."""
    a, c = x(state.contact_radius), x(state.plastic_radius)
    layers["a line"].show(x=[-a, a] if a > 0 else [])
    layers["c line"].show(x=[-c, c] if c > 0 else [])
    width = x.limits[1]
    names = [(r, name) for r, name in ((a, "a"), (c, "c")) if r > 0]
    if len(names) == 2 and a - c < 0.06 * width:
        # Too close to stand side by side: each on the outside of its line.
        places = [a + 0.025 * width, c - 0.025 * width]
    else:
        places = [r + 0.025 * width for r, _ in names]
    layers["names"].show(x=places, y=[top] * len(names), text=[name for _, name in names])


class SpringsView:
    """The 1D springs under the 1D profile (Popov 2015, Figs. 1 and 2), drawn by state."""

    def __init__(self):
        self.heading = _SPRINGS.heading
        self.figure, self.layers = _SPRINGS.copy()
        figure = self.figure
        self.x = Axis("x, coordinate of the springs", "length", figure.xaxis, figure.x_range)
        self.z = Axis("z, height", "length", figure.yaxis, figure.y_range)

    def update(self, run):
        """Draw the present state of a run."""
        x, z, layers = self.x, self.z, self.layers
        profile, state = run.scene.profile, run.state
        half = x.fit(1.25 * run.deepest.contact_radius, below=1.0)
        scale = z.fit(run.deepest.depth, below=_REST)

        spots = half * (np.arange(SPRINGS) + 0.5) / (SPRINGS / 2) - half
        imprint = np.maximum(state.plastic_depth - profile.reduced(spots), 0.0)
        depth = state.depth - profile.reduced(spots)
        contact = (np.abs(spots) <= state.contact_radius) & (depth >= imprint)
        top = -np.where(contact, depth, imprint)
        kind = np.where(imprint > 0, 2, np.where(contact & (depth > 0), 1, 0))
        xs, zs = _zigzag(spots, top, -_REST * scale, half / SPRINGS)
        shown = {
            name: np.where(np.repeat(kind == number, len(xs) // SPRINGS), z(zs), np.nan)
            for number, name in enumerate(("free", "elastic", "yielded"))
        }
        layers["row"].show(x=x(xs), **shown)

        # From beyond the sides and the top of the picture, so that its area closes out of sight.
        fine = _outline(profile, 1.1 * half)
        far = np.clip(profile.reduced(fine) - state.depth, None, 3 * scale)
        far[[0, -1]] = 3 * scale
        residual = np.maximum(state.plastic_depth - profile.reduced(fine), 0.0)
        residual = -residual if run.yielded else np.full_like(fine, np.nan)
        layers["outline"].show(x=x(fine), g=z(far), imprint=z(residual))
        layers["base"].show(x=x([-half, half]), y=z([-_REST * scale] * 2))
        _show_radii(layers, x, state, 0.97 * z.limits[1])


class PressureView:
    """Contact pressure −σ_zz along a diameter, over the same axis as the springs."""

    def __init__(self, springs):
        self.heading = _PRESSURE.heading
        self.figure, self.layers = _PRESSURE.copy()
        figure = self.figure
        # One axis for both plots, so that a and c stand under each other.
        figure.x_range = springs.figure.x_range
        self.springs = springs
        self.r = Axis("r, radius along a diameter", "length", figure.xaxis, figure.x_range)
        self.p = Axis("−σ_zz, contact pressure", "pressure", figure.yaxis, figure.y_range)

    def update(self, run):
        """Draw the present state of a run; the springs come first, they set the axis."""
        layers, p, state = self.layers, self.p, run.state
        x = self.r
        x.follow(self.springs.x)
        half = x.limits[1] * x.unit.factor
        r = _radii(run, state, half)
        pressure = state.pressure(r)
        largest, clipped = _ceiling(run, half)
        end = p.fit(1.05 * largest)
        shown = np.minimum(pressure, 2 * end)
        both, values = np.concatenate([-r[::-1], r]), np.concatenate([shown[::-1], shown])
        layers["stress"].show(x=x(both), p=p(values))
        mean, a, c = run.mean_pressure, state.contact_radius, state.plastic_radius
        if a > 0:
            layers["mean, F/(πa²)"].show(x=x([-a, a]), y=p([mean, mean]))
        else:
            layers["mean, F/(πa²)"].hide()
        if c > 0:
            layers["plastic zone r < c"].show(x0=x([-c]), x1=x([c]))
        else:
            layers["plastic zone r < c"].hide()
        _show_radii(layers, x, state, 0.97 * p.limits[1])
        note = clipped if not np.all(np.isfinite(pressure)) else ""
        layers["note"].show(x=[0.0], y=[0.9 * p.limits[1]], text=[note])
        tooltips(self.figure, [("r", f"@x {x.unit.name}"), ("−σ_zz", f"@p {p.unit.name}")])


def _zigzag(spots, top, base, half_width):
    """Springs from `base` to `top` as one line with gaps."""
    along = np.concatenate([[0, 0.12], 0.12 + 0.76 * (np.arange(_BENDS) + 0.5) / _BENDS, [0.88, 1, np.nan]])
    across = np.zeros_like(along)
    across[2:-3] = np.where(np.arange(_BENDS) % 2, 0.8, -0.8) * half_width
    xs = spots[:, None] + across
    zs = base + (top[:, None] - base) * along
    return xs.ravel(), zs.ravel()


def _outline(profile, half):
    """Coordinates x from −half to half, with the profile's kinks and its wall among them."""
    kinks = [zone.kink for zone in profile.zones]
    wall = [profile.wall, profile.wall * (1 + 1e-9)] if profile.wall < half else []
    positive = np.unique(np.concatenate([np.linspace(0, half, 81), kinks, wall]))
    positive = positive[positive <= half]
    return np.concatenate([-positive[:0:-1], positive])


def _radii(run, state, half):
    """Radii from 0 to `half`, dense where the pressure has an edge: at 0, c, a and at kinks."""
    edges = {0.0, half, float(state.plastic_radius), float(state.contact_radius)}
    edges |= {zone.kink for zone in run.scene.profile.zones if zone.kink < state.contact_radius}
    edges = np.array(sorted(edge for edge in edges if edge <= half))
    spread = (1 - np.cos(np.linspace(0, np.pi, 80))) / 2
    return np.unique((edges[:-1, None] + np.diff(edges)[:, None] * spread).ravel())


def _ceiling(run, half):
    """The largest pressure to draw, and what to say where the pressure goes beyond it."""
    pressure = run.deepest.pressure(_radii(run, run.deepest, half))
    finite = np.isfinite(pressure)
    largest = float(np.max(pressure[finite], initial=0.0))
    if finite.all():
        return largest, ""
    where = "at the axis" if not finite[0] else "at the rim r = a"
    ceiling = min(largest, 4 * run.deepest_mean_pressure)
    return ceiling, f"picture clipped: −σ_zz → ∞ {where}"
