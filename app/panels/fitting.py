"""The tab *Fit a measurement*: upload of a curve, choice of its columns, and fit of the medium."""

from collections.abc import Callable
from dataclasses import replace
from html import escape

import numpy as np
import panel as pn

import mdr_core as mdr

from ..solve import turning_point
from ..state import State, checked, medium, profile, with_derived
from ..state.files import FITTED, SIZES, Measured, agrees, read_curve
from ..state.quantities import QUANTITIES, USED
from ..state.units import fitting, written
from ..ui import WIDE, button, field, html, indexed, marked, on_upload, plain, show, upload
from .controls import Choices, Numbers

#: Name and description of the example.
_MADE = "A made curve, no measurement"
_EXAMPLE = (
    "This tip on a medium of 1.3 E* and 0.8 q_c, which begins at a tenth of the depth, with 0.4 % noise."
)


def take(state: State, curve: Measured | None) -> State:
    """Compare with a measured curve, or with none."""
    tiles = ("residual",) if curve else tuple(tile for tile in state.tiles if tile != "residual")
    return state.replace(curve=curve, contact_point=0.0, baseline=0.0, fit_note="", tiles=tiles)


def example(state: State) -> Measured:
    """Synthetic curve: the present tip on another medium, with noise."""
    tip, made, depth = profile(state), medium(state), float(turning_point(state).depth)
    other = mdr.Medium(1.3 * made.E_star, 0.8 * made.q_c)
    back = depth - 0.8 * min(depth, other.critical_depth)
    path = np.append(np.linspace(-0.05, 1, 240) * depth, np.linspace(depth, back, 160))
    force = mdr.indent(tip, other, path).force
    force = force + 0.004 * force.max() * np.random.default_rng(1).standard_normal(path.size)
    units = fitting(depth, "length"), fitting(force.max(), "force")
    columns = (path + 0.1 * depth) / units[0].factor, force / units[1].factor
    rows = [f"{x:.6g}; {y:.6g}" for x, y in zip(*columns, strict=True)]
    text = "\n".join([f"depth ({units[0].name}); force ({units[1].name})", *rows])
    return read_curve(text.encode(), _MADE)


def fit(state: State) -> State:
    """Fit medium and position to the measured curve; press to its depth."""
    made = medium(state)
    fixed = {name: state[name] if name in FITTED[2:] else getattr(made, name) for name in state.fixed}
    asked = dict.fromkeys(FITTED) | fixed
    if state.noise == "given":
        asked["depth_noise"] = state.depth_noise
    found = mdr.fit_indentation(profile(state), *state.curve.data, **asked)
    numbers = {name: float(getattr(found, name)) for name in FITTED[2:]}
    numbers["max_depth"] = float(np.max(found.path.depth))
    choices = {"drive": "depth"}
    if "E_star" not in fixed:
        choices["elasticity"], numbers["E_star"] = "modulus", float(found.medium.E_star)
    if "q_c" not in fixed:
        yields = bool(np.isfinite(found.medium.q_c))
        choices["plasticity"] = "q_c" if yields else "none"
        numbers |= {"q_c": float(found.medium.q_c)} if yields else {}
    numbers = {name: checked(name, value) for name, value in numbers.items()}
    curve = replace(state.curve, fit=found, asked=asked)
    state = state.replace(curve=curve, progress=1.0, fit_note=_note(curve), **choices, **numbers)
    return with_derived(state)


def _note(curve: Measured) -> str:
    """Summary of a fit for links and reports."""
    found, texts = curve.fit, []
    for name, error in found.standard_errors.items():
        value = getattr(found.medium if name in FITTED[:2] else found, name)
        known = QUANTITIES[name]
        texts.append(
            f"{known.symbol} = {written(float(value), known.kind)} ± {written(float(error), known.kind, 2)}"
        )
    return f"fit to {curve.name}: {', '.join(texts)}; χ² = {float(found.reduced_chi_square):.3g}"[:300]


def result(state: State) -> str:
    """Result of the fit as HTML."""
    curve = state.curve
    if curve is None or curve.fit is None:
        note = state.fit_note if curve is None else ""
        return f"This page was made with a {marked(note)}." if note else ""
    text = "What is set on the page is not this fit any more."
    if agrees(state):
        text = "Its values are those set on the page; Undo takes it back."
    return text + indexed(plain(curve.fit._repr_html_()))


class Fitting:
    """The tab *Fit a measurement*."""

    def __init__(self, choices: Choices, apply_or_raise: Callable[..., None], apply: Callable[..., None]):
        self._apply, select = apply, pn.widgets.Select
        self.file = upload("CSV file of a measured curve: depth, force", ".csv,.txt,.dat,text/csv")
        self.made, self.remove, self.fit = map(button, ("Example", "Remove", "Fit"))
        roles = ("depth", "force", "time")
        self.columns = {role: field(select, "column", label=f"Column of {role}") for role in roles}
        self.units = {
            role: field(select, "unit", label=f"Unit of {role}", options=list(sizes))
            for role, sizes in SIZES.items()
        }
        names = {QUANTITIES[n].label: n for n in FITTED}
        self.fixed = field(pn.widgets.CheckBoxGroup, "fixed", options=names, inline=False)
        self.about, self.said = html(), html("", "note", "said")
        self.place, self.noise = Numbers(apply_or_raise), Numbers(apply_or_raise)
        pairs = [
            pn.Row(*(part[role] for part in (self.columns, self.units) if role in part), **WIDE)
            for role in roles
        ]
        self._rest = pn.Column(
            *pairs, html("<h2>Where it lies</h2>", "title"), self.place,
            html("<h2>What a fit leaves as it is</h2>", "title"), self.fixed,
            choices.row("noise"), self.noise, self.fit, self.said, visible=False, **WIDE,
        )  # fmt: skip
        note = html(
            "Depth and force as CSV, drop or choose: it lies over the model, and a medium can be fitted."
        )
        buttons = pn.Row(self.made, self.remove, css_classes=["tools"], **WIDE)
        self.view = pn.Column(note, self.file, buttons, self.about, self._rest, visible=False, **WIDE)
        self._watch()

    def _watch(self):
        on_upload(self.file, lambda data: self._take(lambda state: read_curve(data, self.file.filename)))
        self.made.on_click(lambda event: self._take(example))
        self.remove.on_click(lambda event: self._take(lambda state: None))
        self.fit.on_click(lambda event: self._apply(fit, lambda text: self._refuse(self.said, text)))
        for part in (self.columns, self.units):
            for role, widget in part.items():
                widget.param.watch(lambda event, role=role: self._correct(role, event.new), "value")
        self.fixed.param.watch(
            lambda event: self._apply(lambda state: state.replace(fixed=tuple(event.new))), "value"
        )

    def _refuse(self, where, text):
        where.object = f'<span class="refused">{escape(text)}</span>'

    def _take(self, make):
        self._apply(
            lambda state: take(state, make(state)), refused=lambda text: self._refuse(self.about, text)
        )

    def _correct(self, role, chosen):
        def change(state):
            curve = state.curve
            if curve is None or chosen in (curve.columns[role], curve.units.get(role)):
                return state
            return state.replace(curve=curve.corrected(role, chosen), fit_note="")

        self._apply(change, refused=lambda text: self._refuse(self.about, text))

    def show(self, state: State) -> None:
        curve = state.curve
        show(self._rest, visible=curve is not None)
        show(self.remove, disabled=curve is None)
        show(self.fixed, value=list(state.fixed))
        show(self.said, object=result(state))
        if curve is None:
            show(self.about, object=result(state))
            return
        made = f" {marked(_EXAMPLE)}" if curve.name == _MADE else ""
        show(self.about, object=f"<b>{escape(curve.name)}</b>: {escape(curve.note)}.{made}")
        depth, force = (float(np.max(np.abs(part))) for part in curve.data)
        likes = {"contact_point": depth, "baseline": force, "frame_compliance": depth / (force or 1.0)}
        self.place.show(state, list(FITTED[2:]), likes)
        self.noise.show(state, USED["noise"][state.noise])
        heads = {f"{k + 1}: {head}".rstrip(": "): k for k, head in enumerate(curve.heads)}
        for role, widget in self.columns.items():
            options = heads | ({"none, rows in order": -1} if role == "time" else {})
            if widget.options != options or widget.value != curve.columns[role]:
                widget.param.update(options=options, value=curve.columns[role])
        for role, widget in self.units.items():
            show(widget, value=curve.units[role])
