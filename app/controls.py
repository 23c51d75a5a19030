"""The controls: Panel widgets over what can be set, each with its symbol, name, unit and an explanation."""

from html import escape
from math import atan, degrees

import panel as pn
import param

from .drives import DRIVES
from .explorer import FROM_FILE
from .parts import JS, WIDE, button, explained, field, fill, html, linked, marked, symbol, tools, upload
from .presets import PRESETS
from .quantities import ABOUT, CHOICES, ENDS, LABELS, NUMBERS, SHAPES, Scale, shape_quantities
from .units import UNITS, digits, entry, written

#: Standard acceleration of free fall (m/s²).
_GRAVITY = 9.80665
#: Choices of the form; others stand above the plots that they are of.
_FORM = ("elasticity", "plasticity", "damping", "drive", "inertia", "surface", "prescribed", "aim", "body")


def _about(quantity):
    low, high = (written(bound, quantity.kind, 2) for bound in quantity.bounds)
    units = ", ".join(unit.name for unit in UNITS[quantity.kind] if unit.name)
    rows = [linked(quantity.help), f"<em>{linked(quantity.equation)}</em>" if quantity.equation else ""]
    rows.append(f"Usual: {marked(quantity.typical)}." if quantity.typical else "")
    rows.append(f"From {low} to {high}" + (f"; units {units}." if units else "."))
    return "".join(f"<p>{row}</p>" for row in rows if row)


class Number(pn.custom.JSComponent):
    """A quantity that is typed with its unit, or dragged on its scale."""

    label, spoken, about = param.String(), param.String(), param.String()
    text, said, refused = param.String(), param.String(), param.Boolean()
    position, steps, answered = param.Integer(), param.Integer(Scale.STEPS), param.Integer()

    _esm = JS["quantity"]

    def __init__(self, explorer, name, attempt):
        quantity = NUMBERS[name]
        self.explorer, self.key, self.kind, self.attempt = explorer, name, quantity.kind, attempt
        super().__init__(
            label=f"{symbol(quantity.symbol)} {marked(quantity.label)}",
            spoken=f"{quantity.symbol}, {quantity.label}",
            about=_about(quantity),
            steps=Scale.STEPS if quantity.span >= 0 else 0,
            css_classes=["number"],
            **WIDE,
        )
        self.on_msg(self._asked)
        explorer.param.watch(lambda event: self.show(), name)
        self.show()

    def _asked(self, event):
        said = ""
        with pn.io.hold():
            try:
                said = self.attempt(lambda: self._change(event.data)) or ""
                self.refused = False
            except ValueError as error:
                said, self.refused = str(error), "text" in event.data
            self.param.update(said=said, answered=self.answered + 1)
            self.show()

    def _change(self, message):
        if isinstance(message.get("text"), str):
            return self.explorer.type(self.key, message["text"])
        if isinstance(message.get("position"), int | float):
            self.explorer.slide(self.key, message["position"])
        elif "reset" in message:
            self.explorer.reset(self.key)
        return ""

    def forget(self):
        """Say no more what was refused, or how it was read."""
        self.param.update(said="", refused=False)

    def show(self):
        """Show the value as it stands."""
        value = self.explorer.number(self.key)
        position = self.explorer.scale(self.key).position(value)
        self.param.update(text=entry(value, self.kind), position=position)


class Controls:
    """The form: built once for a session, its parts shown where they are used.

    `attempt` makes a change and tells the person if it is refused.
    """

    def __init__(self, explorer, attempt, tell):
        self.explorer, self.attempt, self.tell, self.numbers = explorer, attempt, tell, {}
        self.choices, self.rows, self._above = {}, {}, []
        self._list("preset", {label: label for label in PRESETS})
        self._list("shape", {f"{s.label}{' (CSV)' * (key == 'sampled')}": key for key, s in SHAPES.items()})
        for name, texts in CHOICES.items():
            options = {text: option for option, text in texts.items()}
            if name in _FORM:
                self._radio(name, options)
            else:
                self._list(name, options, "beside")
        noted = ("sources", "sketch", "tip", "slope", "elasticity", "plasticity", "damping", "drive")
        self.notes = {name: html() for name in noted}
        self.tip = upload("tip", ".csv,.txt,text/csv")
        #: Parts of the form that only some drives have.
        self.parts = {"again": button("Hit again", width=90, margin=(4, 0))}
        self.heads = {title: html(f"<h2>{title}</h2>") for title in ("Indenter", "Medium", "Drive")}
        self.heads["tip"] = html("or a measured tip, as CSV (r, z):")
        self.form = pn.Column(css_classes=["form"], **WIDE)

    def _list(self, name, options, *classes):
        """A choice from a list, with a question mark beside it that says what is chosen."""
        widget = self._choosing(name, pn.widgets.Select, *classes, options=options)
        look = f'class="help" aria-label="What is {LABELS[name]}?"'
        about = explained("about", "?", linked(ABOUT[name]), look)
        self.rows[name] = tools(widget, pn.pane.HTML(about, width=26, margin=0))

    def _radio(self, name, options):
        """A choice of which all options are seen; its name says what is chosen."""
        widget = self._choosing(name, pn.widgets.RadioBoxGroup, options=options, inline=True)
        legend = html(explained("about", LABELS[name], linked(ABOUT[name])), "legend")
        self.rows[name] = pn.Row(legend, widget, css_classes=["fieldset"], **WIDE)

    def _choosing(self, name, kind, *classes, **options):
        def choose(event):
            self.tell(lambda: self.explorer.choose(name, event.new))
            widget.value = self.explorer.option(name)

        widget = self.choices[name] = field(kind, *classes, name=LABELS[name], **options)
        widget.param.watch(choose, "value")
        return widget

    def number(self, name):
        """The control of a number, made when it is used for the first time."""
        if name not in self.numbers:
            self.numbers[name] = Number(self.explorer, name, self.attempt)
        return self.numbers[name]

    def show(self, way):
        """Everything that is used, with its values, beside the trajectory that it makes."""
        explorer = self.explorer
        for name, widget in self.choices.items():
            shown = {"value": explorer.option(name)}
            if name in ("preset", "swept", "against"):
                texts = CHOICES.get(name, {FROM_FILE: "Scene from a file"})
                shown["options"] = {texts.get(option, option): option for option in explorer.options(name)}
            # Telling a widget what it knows takes a good part of a move.
            if any(getattr(widget, part) != value for part, value in shown.items()):
                widget.param.update(**shown)
        self._write(way)
        notes, heads = self.notes, self.heads
        rows = [self.rows["preset"], notes["sources"], heads["Indenter"], self.rows["shape"]]
        rows += [heads["tip"], self.tip, notes["tip"], notes["sketch"]]
        rows += [self.number(name) for name, _ in shape_quantities(explorer.shape)]
        rows += [notes["slope"], heads["Medium"]]
        for choice in ("elasticity", "plasticity", "damping"):
            rows += [*self._used(choice), notes[choice]]
        rows += [heads["Drive"], *self._used("drive"), notes["drive"]]
        for part in DRIVES[explorer.drive].form:
            rows += self._used(part) if part in CHOICES else [self.parts[part]]
        fill(self.form, rows)
        for names, above in self._above:
            fill(above, [part for name in names for part in self._used(name)])
        for name in ENDS.keys() & self.numbers.keys():
            # It may follow what its number was loaded as.
            self.numbers[name].show()

    def _used(self, name):
        """A choice with the numbers that its option uses, or a number."""
        return [*[self.rows[name]] * (name in CHOICES), *map(self.number, self.explorer.numbers([name]))]

    def above(self, names):
        """What stands above a plot: choices and numbers."""
        above = pn.Column(css_classes=["above"], **WIDE)
        self._above.append((names, above))
        return above

    def _write(self, way):
        explorer, preset, made = self.explorer, PRESETS.get(self.explorer.preset), way.scene.medium
        altered = "Altered. " if explorer.altered else ""
        rows = "".join(
            f"<dt>{marked(f'{what} = {value}')}</dt><dd>{escape(where)}</dd>"
            for what, value, where in (preset.sources.values() if preset else ())
        )
        title = f"{altered}Where the preset's numbers come from"
        origin = f"<details><summary>{title}</summary><dl>{rows}</dl></details>"
        bodies = explorer.elasticity != "modulus"
        texts = {
            "sources": origin if preset else f"{altered}A scene from a file.",
            "tip": escape(explorer.tip_note if explorer.shape == "sampled" else ""),
            "slope": marked(_half_angle(explorer)),
            "drive": marked(_drop(explorer)),
            "elasticity": linked(f"E* = {written(made.E_star, 'pressure')} (2)") if bodies else "",
            "plasticity": linked(_yield(explorer, made)),
            "damping": linked(_damping(explorer, made, way.motion is not None)),
        }
        for name, text in texts.items():
            self.notes[name].object = text


def _half_angle(explorer):
    slope = getattr(explorer, f"{explorer.shape}_slope", None)
    if slope is None:
        return ""
    angle = degrees(atan(slope))
    return f"Half-angle {digits(90 - angle)}°, flank {digits(angle)}° to the surface"


def _drop(explorer):
    if explorer.drive != "impact":
        return ""
    energy, height = explorer.mass * explorer.speed**2 / 2, explorer.speed**2 / (2 * _GRAVITY)
    fallen = written(height, "length")
    return f"Energy m v_0²/2 = {written(energy, 'energy')}; fallen from v_0²/(2 g) = {fallen} without drag"


def _yield(explorer, medium):
    if explorer.plasticity == "none":
        return "Nothing yields: q_c = ∞"
    depth = written(medium.critical_depth, "length")
    if explorer.plasticity == "hardness":
        return f"q_c = σ_c a_c = {written(medium.q_c, 'yield constant')} (11); d_c = {depth} (19)"
    return f"Yield starts at d_c = π q_c/(2E*) = {depth} (19)"


def _damping(explorer, medium, timed):
    if explorer.damping == "none":
        return ""
    if explorer.damping == "tau":
        text = f"η = {written(medium.eta, 'viscosity')}"
    else:
        text = f"τ = 4η/E* = {written(medium.relaxation_time, 'time')} (1)"
    return text if timed else f"{text}; no effect here: pressing is infinitely slow"
