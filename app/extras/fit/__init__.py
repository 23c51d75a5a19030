"""*Fit a measurement*: upload of a curve, choice of its columns, and fit of the medium."""

import re
from contextlib import suppress
from html import escape
from typing import Any

import numpy as np
import panel as pn

import mdr_core as mdr
from mdr_core.reading import SIZES, UnknownColumns

from ...extra import Extra
from ...fields import Upload
from ...parts import Parts, Text
from ...plot import Overlay, View
from ...quantities import ASSETS, QUANTITIES, Quantity
from ...shared.widgets import button, field, tools
from ...state import State, checked, medium, profile, with_derived
from ...ui import WIDE, html, indexed, marked, show
from ...units import written
from .drawn import MEASURED, RESIDUAL, measured, reach
from .measured import (
    CONSTANTS,
    FITTED,
    OF_MEDIUM,
    PLACED,
    SUBTRACTED,
    Curve,
    Measured,
    agrees,
    offered,
    read_curve,
    with_curve,
)

#: The option for no column; a list shows an option of the value None as empty.
_NO_COLUMN = -1
#: The option for a unit that is still to be chosen.
_NO_UNIT = "unit?"
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
    pressed = {"drive": "depth", "max_depth": checked("max_depth", depth), "progress": 1.0}
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
    samples, time = state["fit.curve"].samples(state), state["fit.curve"].time
    found = mdr.fit_indentation(profile(state), *samples, time=time, **asked)
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
    curve = Measured(state["fit.curve"].name, state["fit.curve"].curve, found, subtracted)
    fitted = {"fit.curve": curve, "fit.note": _note(curve)}
    return with_derived(state.replace(progress=1.0, **fitted, **choices, **numbers))


def _refuse_hardness(state: State, asked: dict[str, Any]) -> None:
    """Refuse a constant that is held and is not on the page, and what is fitted with q_c alone."""
    constant = state["fit.hardness"]
    if asked.get("q_c") == np.inf:
        return
    if asked[constant] == 0:
        raise ValueError(
            f"the fit holds the {quantity_of(constant).label}, and the page has another hardness: choose "
            "the same for both, or do not hold it"
        )
    if constant == "q_c":
        return
    if state.adhesion == "work":
        raise ValueError(
            "with adhesion a fit is of an elastic medium: choose yield none, and hold the hardness"
        )
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
    return f"fit to {curve.name}: {', '.join(texts)}"[:300]


def result(state: State) -> str:
    """Result of the fit as HTML."""
    curve = state["fit.curve"]
    if curve is None or curve.fit is None:
        note = state["fit.note"] if curve is None else ""
        return f"This link was made with a {marked(note)}." if note else ""
    text = "The page has other values than this fit."
    if agrees(state):
        text = "The fitted values have been put into the form; Undo restores yours."
    # The verdict stands above the table.
    table = re.sub(r"<tr><th[^>]*>(class of hardness|the class presumes)<.*?</tr>", "", curve.report)
    table = re.sub(r"(?<![\w/])-(?=\d)", "−", indexed(_in_words(table)))
    return f"{text}<p>{escape(curve.verdict)}</p>{table}" if curve.verdict else text + table


def _in_words(text: str) -> str:
    """A report or remark of the core with symbols and words for its names of parameters."""
    for name in ("contact_point", "depth_noise", "force_noise", "work_of_adhesion"):
        text = text.replace(name, name.replace("_", " "))
    return re.sub(r"\beta\b", "η", text.replace("E_star", "E*"))


def unloading(state: State) -> str:
    """Numbers of Oliver and Pharr for the curve where it lies, as HTML; empty without an unloading.

    They need first contact: found by a fit, or held by who knows it. Empty beside a fit that tells them.
    """
    if state["fit.curve"].fit is not None and "Oliver and Pharr" in state["fit.curve"].report:
        return ""
    known = state["fit.curve"].fit is not None or "contact_point" in state["fit.fixed"]
    curve = state["fit.curve"].placed(state)
    with suppress(ValueError):
        text = mdr.oliver_pharr(profile(state), curve.depth, curve.force)._repr_html_()
        if not known:
            return "Oliver and Pharr's numbers need first contact: fit it, or hold it where it is known."
        return indexed(text.replace("OliverPharr: one unloading", "Unloading: Oliver and Pharr"))
    return ""


class Fitting:
    """The part of the side."""

    def __init__(self, page: Any):
        self._apply, self._placed, self._curve, select = page.apply, None, None, pn.widgets.Select
        # A file whose columns are asked for, and its table.
        self._asked = None
        kinds = (
            ".csv,.txt,.dat,.tab,text/csv,.xls,.xlsx,.jpk-force,.jpk-force-map,.jpk-qi-data,.h5,.ibw,.zip"
        )
        self.file = Upload("CSV file of a measured curve: depth, force", kinds, self._read)
        self.silica, self.remove, self.fit = map(button, ("Fused silica", "Remove", "Fit"))
        self.columns = {role: field(select, "column", label=f"Column of {role}") for role in SIZES}
        self.units = {
            role: field(select, "unit", label=f"Unit of {role}", options=list(sizes))
            for role, sizes in SIZES.items()
        }
        names = {quantity_of(name).label: name for name in FITTED}
        self.fixed = field(pn.widgets.CheckBoxGroup, "fixed", inline=False, options=names)
        self.about, self.said = html(), html("", "note", "said")
        # What was refused of a file and of a fit.
        self.not_taken, self.not_fitted = html(), html()
        self.unloading = html("", "note", "unloading")
        self.place, self.noise = page.numbers(), page.numbers()
        rows = (pn.Row(self.columns[role], self.units[role], **WIDE) for role in SIZES)
        self._columns = pn.Column(*rows, visible=False, **WIDE)
        self._rest = pn.Column(
            Parts(Text("title", object="<h2>Position and background</h2>"), self.place,
                  page.choices.part("fit.hardness")),
            html("<h2>Fixed parameters</h2>", "title"), self.fixed, Parts(self.noise), self.fit,
            self.not_fitted, self.said, self.unloading, visible=False, **WIDE,
        )  # fmt: skip
        note = html(
            "Load a table of depth and force to compare with the model. <i>Explore</i> sets the indenter."
        )
        buttons = tools(self.silica, self.remove)
        parts = (note, Parts(self.file), buttons, self.not_taken, self.about, self._columns, self._rest)
        self.view = pn.Column(*parts, **WIDE)
        self.silica.on_click(lambda event: self._change(silica, self.not_taken))
        self.remove.on_click(lambda event: self._change(lambda state: take(state, None), self.not_taken))
        self.fit.on_click(lambda event: self._change(fit, self.not_fitted))
        for role in SIZES:
            for widget in (self.columns[role], self.units[role]):
                widget.param.watch(lambda event, role=role: self._correct(role, event.new), "value")
        self.fixed.param.watch(lambda event: self._hold(event.new), "value")

    def _hold(self, names):
        """Hold parameters; those that the curve does not offer stay as they are."""

        def change(state):
            others = [
                name for name in state["fit.fixed"] if state["fit.curve"] and name not in offered(state)
            ]
            kept = tuple(name for name in FITTED if name in (*names, *others))
            return state.replace(**{"fit.fixed": kept})

        self._apply(change)

    def _change(self, change, where):
        """Apply a change; if it is refused say so, and which curve stays."""

        def refuse(text):
            text = f"Refused: {text}."
            if where is self.not_taken and self._curve is not None:
                text += f" What is shown is still {self._curve.name}."
            # What is asked for stands there before the request.
            self._show_columns()
            show(where, object=f'<span class="refused" role="alert">{escape(text)}</span>')

        self._forget()
        self._asked = None
        self._apply(change, refuse)
        self._show_columns()

    def _forget(self):
        for each in (self.not_taken, self.not_fitted):
            show(each, object="")

    def _read(self, file, columns=None):
        def change(state):
            try:
                return take(state, read_curve(file.read(), file.name, columns))
            except UnknownColumns as error:
                self._asked = file, error.table
                raise

        self._change(change, self.not_taken)

    def _correct(self, role, chosen):
        if self._asked:
            roles = {each: (self.columns[each].value, self.units[each].value) for each in SIZES}
            given = {
                each: pair for each, pair in roles.items() if pair[0] != _NO_COLUMN and pair[1] != _NO_UNIT
            }
            if {"depth", "force"} <= set(given):
                self._read(self._asked[0], {"time": None} | given)
            return
        curve, chosen = self._curve, None if chosen == _NO_COLUMN else chosen
        # A list that is set to what the curve has.
        if curve is None or chosen == _NO_UNIT or chosen in (curve.curve.columns[role] or (None,)):
            return

        def change(state):
            return with_curve(state, curve.corrected(role, chosen))

        self._change(change, self.not_taken)

    def _show_columns(self):
        """Columns and units of the curve, or the choice of those that are asked for."""
        show(self._columns, visible=bool(self._asked or self._curve))
        if not self._columns.visible:
            return
        table = self._asked[1] if self._asked else self._curve.curve.table
        # A column without a name is known by its first numbers.
        firsts = {k: ", ".join(f"{x:.3g}" for x in values[:3]) for k, values in table.values.items()}
        heads = {f"{k + 1}: {head or f'{firsts[k]} …'}": k for k, head in table.heads.items()}
        for role, sizes in SIZES.items():
            column = None if self._asked else self._curve.curve.columns[role]
            nothing = {"none, rows in order": _NO_COLUMN} if role == "time" else {"column?": _NO_COLUMN}
            optional = nothing if column is None or role == "time" else {}
            number, unit = column or (_NO_COLUMN, _NO_UNIT)
            show(self.columns[role], options=heads | optional, value=number)
            show(self.units[role], options=[*[_NO_UNIT] * (column is None), *sizes], value=unit)

    def show(self, view: View) -> None:
        state = view.state
        curve = state["fit.curve"]
        if curve is not self._curve:
            self._curve = curve
            self._forget()
        self._show_columns()
        show(self._rest, visible=curve is not None)
        show(self.remove, disabled=curve is None)
        show(self.said, object=result(state))
        if curve is None:
            show(self.about, object=result(state))
            return
        numbers = [f"fit.{name}" for name in (*PLACED, *SUBTRACTED)]
        placed = curve, profile(state), state["fit.fixed"], *(state[name] for name in numbers)
        if placed != self._placed:
            self._placed, self.unloading.object = placed, unloading(state)
        about = f"<b>{escape(curve.name)}</b>: {escape(curve.note)}. A link does not contain the curve."
        show(self.about, object=about)
        depth, force = (float(np.max(np.abs(part))) for part in curve.data)
        likes = {"fit.contact_point": depth, "fit.baseline": force, "fit.drift": 1e-10}
        # A frame gives by some hundredth of the depth.
        likes["fit.frame"] = 0.01 * depth / force if force else 0.0
        names = [f"fit.{name}" for name in curve.known((*PLACED, *SUBTRACTED))]
        self.place.update(state, names, likes)
        options = {quantity_of(name).label: name for name in offered(state)}
        show(
            self.fixed,
            options=options,
            value=[name for name in state["fit.fixed"] if name in offered(state)],
        )
        self.noise.update(state, ["fit.depth_noise"], {"fit.depth_noise": depth})


def compute(state: State, before: View | None, known: dict) -> Curve | None:
    curve = state["fit.curve"]
    return None if curve is None else curve.placed(state)


def check(state: State) -> str:
    unknown = not set(state["fit.fixed"]) <= set(FITTED)
    return "a parameter that the fit holds, in this link, is not known" * unknown


def told(view: View) -> list[tuple[str, str]]:
    curve = view.state["fit.curve"]
    if curve is None:
        return []
    text = f"<p>{escape(curve.name)}: {escape(curve.note)}. A link does not contain the curve.</p>"
    if curve.fit is None:
        return [("The measured curve", text)]
    remarks = "".join(f"<p>{marked(_in_words(remark))}</p>" for remark in curve.fit.remarks)
    return [(f"Fit to {escape(curve.name)}", text + indexed(_in_words(curve.report)) + remarks)]


EXTRA = Extra(
    "fit",
    order=5,
    values={"fit.curve": None, "fit.fixed": DEFAULT_FIXED, "fit.note": ""},
    former={key: f"fit.{key}" for key in (*PLACED, "depth_noise", "fixed")} | {"fit_note": "fit.note"},
    tab="Fit a measurement",
    plots=(RESIDUAL,),
    overlays=(Overlay("force", MEASURED, measured, reach=reach),),
    check=check,
    compute=compute,
    side=Fitting,
    told=told,
)
