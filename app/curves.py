"""Force and radii over depth: two plots over one depth axis."""

import holoviews as hv
import numpy as np

from .plotting import ELASTIC, INK, PAPER, YIELDED, Axis, Declared, tooltips

_NOTHING = np.zeros(2)


_LINE = hv.Curve((_NOTHING, _NOTHING), "d", "y")
_AREA = hv.Area((_NOTHING, _NOTHING), "d", "y")
_POINT = hv.Scatter((_NOTHING, _NOTHING), "d", "y")
_UNLOADING = _LINE.relabel("unloading").opts(color=ELASTIC, line_width=1.8, line_dash="dashed")
_NOW = _POINT.relabel("now").opts(marker="circle", size=10, color=INK, line_color=PAPER, line_width=1.5)

_FORCE = Declared(
    "force",
    hv.Overlay(
        [
            _AREA.relabel("plastic work").opts(color=YIELDED, alpha=0.13, line_alpha=0),
            _AREA.relabel("stored energy").opts(color=ELASTIC, alpha=0.22, line_alpha=0),
            _UNLOADING,
            _LINE.relabel("elastic").opts(color=ELASTIC, line_width=2.2, tools=["hover"]),
            _LINE.relabel("yielding").opts(color=YIELDED, line_width=3, tools=["hover"]),
            _POINT.relabel("onset").opts(
                marker="diamond", size=11, color=PAPER, line_color=YIELDED, line_width=2, show_legend=False
            ),
            _NOW,
            hv.Labels(([0.0], [0.0], [""]), label="names").opts(
                text_font_size="12px", text_color=INK, text_font_style="italic", text_align="left"
            ),
        ]
    ),
    title="Force and depth",
    hatched=["plastic work"],
    together={
        "paths": {
            "plastic work": "F",
            "elastic": "elastic",
            "yielding": "yielding",
            "unloading": "unloading",
        }
    },
)

_RADII = Declared(
    "radii",
    hv.Overlay(
        [
            _AREA.relabel("zone").opts(color=YIELDED, alpha=0.13, line_alpha=0, show_legend=False),
            _UNLOADING,
            _LINE.relabel("contact radius a").opts(color=ELASTIC, line_width=2.2, tools=["hover"]),
            _LINE.relabel("plastic zone c").opts(color=YIELDED, line_width=3, tools=["hover"]),
            _NOW,
        ]
    ),
    title="Contact and plastic zone",
    together={
        "paths": {"zone": "zone", "contact radius a": "a", "plastic zone c": "c", "unloading": "unloading"}
    },
)


class _Paths:
    """One quantity along loading and unloading, end to end."""

    def __init__(self, run, quantity):
        parts = {name: getattr(run, name) for name in ("elastic", "yielding", "unloading")}
        self.depth = np.concatenate([part.depth for part in parts.values()])
        self.values = np.concatenate([getattr(part, quantity) for part in parts.values()])
        self.stretch = np.repeat(list(parts), [len(part) for part in parts.values()])

    def only(self, *names):
        """The values on some stretches, not a number elsewhere."""
        return np.where(np.isin(self.stretch, names), self.values, np.nan)


class ForceView:
    """Force over depth: loading, unloading, the onset of yield, the present state, the work."""

    def __init__(self):
        self.heading = _FORCE.heading
        self.figure, self.layers = _FORCE.copy()
        self.d = Axis("d, indentation depth", "length", self.figure.xaxis, self.figure.x_range)
        self.force = Axis("F, normal force", "force", self.figure.yaxis, self.figure.y_range)

    def update(self, run):
        """Draw the curves and the present state of a run."""
        layers, d, force = self.layers, self.d, self.force
        onset, deepest, state = run.onset, run.deepest, run.state
        # An onset that lies little deeper than the path is kept in the picture.
        ahead = onset.depth <= 2.5 * deepest.depth
        d.fit(1.02 * (max(deepest.depth, onset.depth) if ahead else deepest.depth))
        force.fit(1.05 * (max(deepest.force, onset.force) if ahead else deepest.force))

        paths = _Paths(run, "force")
        layers["paths"].show(
            x=d(paths.depth),
            F=force(paths.values if run.yielded else paths.only()),
            elastic=force(paths.only("elastic")),
            yielding=force(paths.only("yielding")),
            unloading=force(paths.only("unloading")),
        )
        layers["onset"].show(x=[d(onset.depth)], y=[force(onset.force)])
        layers["now"].show(x=[d(state.depth)], y=[force(state.force)])

        # Under the unloading curve, from the present state back to where the load is gone.
        released = run.unloading[run.unloading.depth <= state.depth]
        layers["stored energy"].show(
            x=d(np.concatenate([[state.depth] * 2, released.depth])),
            y=force(np.concatenate([[0.0, state.force], released.force])),
        )
        self._name(run)
        tooltips(self.figure, [("d", f"@x {d.unit.name}"), ("F", f"$y {force.unit.name}")])

    def _name(self, run):
        d, force = self.d, self.force
        right, up = 0.02 * d.limits[1], 0.035 * force.limits[1]
        # To the left of its point where the picture ends on the right.
        side = right if d(run.onset.depth) < 0.85 * d.limits[1] else -8.5 * right
        names = [(d(run.onset.depth) + side, force(run.onset.force) - up, "(d_c, F_c)")]
        if run.yielded:
            names.append((d(run.state.plastic_depth) - 2.2 * right, up, "d_p"))
        x, y, text = (list(column) for column in zip(*names, strict=True))
        self.layers["names"].show(x=np.array(x), y=np.array(y), text=text)


class RadiiView:
    """Contact radius and radius of the plastic zone, over the depth axis of the force."""

    def __init__(self, force):
        self.heading = _RADII.heading
        self.figure, self.layers = _RADII.copy()
        self.figure.x_range = force.figure.x_range
        self.d = Axis("d, indentation depth", "length", self.figure.xaxis, force.figure.x_range)
        self.radius = Axis("a, c, radius", "length", self.figure.yaxis, self.figure.y_range)
        self.force = force

    def update(self, run):
        """Draw the curves and the present state of a run; the force comes first, it sets the depth axis."""
        layers, d, radius, state = self.layers, self.d, self.radius, run.state
        d.follow(self.force.d)
        radius.fit(1.15 * run.deepest.contact_radius)
        a, c = _Paths(run, "contact_radius"), _Paths(run, "plastic_radius")
        # Unloading closes the contact and leaves the plastic zone as it is.
        remains = [np.nan, run.deepest.plastic_radius, run.deepest.plastic_radius]
        absent = np.full(3, np.nan)
        columns = {
            "a": (a.only("elastic", "yielding"), absent),
            "c": (c.only("yielding"), absent),
            "zone": (np.where(c.stretch == "unloading", 0.0, c.values), absent),
            "unloading": (a.only("unloading"), remains if run.yielded else absent),
        }
        layers["paths"].show(
            x=d(np.concatenate([a.depth, [np.nan, 0.0, run.deepest.depth]])),
            **{name: radius(np.concatenate(parts)) for name, parts in columns.items()},
        )
        radii = [state.contact_radius] + ([state.plastic_radius] if run.yielded else [])
        layers["now"].show(x=d([state.depth] * len(radii)), y=radius(radii))
        tooltips(self.figure, [("d", f"@x {d.unit.name}"), ("radius", f"$y {radius.unit.name}")])
