"""The controls: Panel widgets over what can be set, each with its symbol, name, unit and an explanation."""

import re
from html import escape
from math import atan, degrees
from pathlib import Path

import panel as pn
import param

from .drives import DRIVES
from .explorer import FROM_FILE
from .presets import PRESETS
from .quantities import ABOUT, CHOICES, ENDS, LABELS, NUMBERS, SHAPES, USED, Scale, shape_quantities
from .units import UNITS, digits, entry, written

JS = {path.stem: path.read_text(encoding="utf-8") for path in (Path(__file__).parent / "js").glob("*.js")}
WIDE = {"sizing_mode": "stretch_width", "margin": 0}


#: Standard acceleration of free fall (m/s²).
_GRAVITY = 9.80665


def indexed(text):
    """HTML in which every symbol such as d_c has its index."""
    return re.sub(r"(\b[a-zA-Z]|[αψσντηρ])_([a-zA-Z0-9]+)", r"<i>\1</i><sub>\2</sub>", text)


def marked(text):
    """A text as HTML, in which every symbol such as d_c has its index."""
    return indexed(escape(text))


def symbol(text):
    """A symbol as HTML: q_c with its index."""
    return marked(text) if "_" in text else f"<i>{escape(text)}</i>"


def linked(text):
    """A text as HTML in which equations, (11), and sections, § 9, lead to the theory."""
    led = r'<a href="?theory={}-\1" target="theory">\g<0></a>'
    text = re.sub(r"\(([1-9]\d?)\)", led.format("eq"), marked(text))
    return re.sub(r"§ (\d+)", led.format("section"), text)


def explained(key, label, about, look='class="word"'):
    """A label that says what it is about when it is pressed."""
    return f'<button {look} popovertarget="{key}">{label}</button><div popover id="{key}">{about}</div>'


def _beside(select, label, about):
    """A list with a question mark beside it that says what is chosen."""
    look = f'class="help" aria-label="What is {label}?"'
    mark = pn.pane.HTML(explained("about", "?", linked(about), look), width=26, margin=0)
    return pn.Row(select, mark, css_classes=["tools"], **WIDE)


def html(text, **options):
    """A piece of the page."""
    return pn.pane.HTML(text, **({"css_classes": ["note"]} | WIDE | options))


def _about(quantity):
    low, high = (written(bound, quantity.kind, 2) for bound in quantity.bounds)
    units = ", ".join(unit.name for unit in UNITS[quantity.kind] if unit.name)
    rows = [linked(quantity.help), f"<em>{linked(quantity.equation)}</em>" if quantity.equation else ""]
    rows.append(f"Usual: {marked(quantity.typical)}." if quantity.typical else "")
    rows.append(f"From {low} to {high}" + (f"; units {units}." if units else "."))
    return "".join(f"<p>{row}</p>" for row in rows if row)


def legend(plot, shown):
    """The legend of a plot, of those rows that are shown, as HTML."""
    return "".join(
        f'<span class="{row.role}"><i class="{row.kind} {_style(row)}"></i>{row.name}</span>'
        for row in plot.rows
        if row.legend and row.name in shown
    )


def _style(row):
    hatch = "hatch" if row.look.get("hatch", " ") != " " else ""
    return " ".join((hatch, row.look.get("dash", ""), row.look.get("marker", "")))


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
            label=f"{symbol(quantity.symbol)} {escape(quantity.label)}",
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

    def show(self):
        """Show the value as it stands."""
        value = self.explorer.number(self.key)
        position = self.explorer.scale(self.key).position(value)
        self.param.update(text=entry(value, self.kind), position=position)


#: Choices of the form; others stand above the plots that they are of.
_FORM = ("elasticity", "plasticity", "damping", "drive", "inertia", "surface", "prescribed", "aim", "body")

_SELECTS = {
    "preset": (
        "Preset",
        "A medium and an indenter that exist, with their numbers. Choosing one sets everything.",
    ),
    "shape": ("Shape", "What is pressed or hits: a body of revolution, which touches with its tip."),
}


class Controls:
    """The form: built once for a session, its parts shown where they are used.

    `attempt` makes a change and tells the person if it is refused.
    """

    def __init__(self, explorer, attempt, tell):
        self.explorer, self.attempt, self.tell, self.numbers = explorer, attempt, tell, {}
        labels = {label or "Scene from a file": label for label in (*PRESETS, FROM_FILE)}
        look = {"css_classes": ["choice"], **WIDE}
        self.preset = pn.widgets.Select(name="Preset", options=labels, **look)
        self.preset.param.watch(self._load, "value")
        shapes = {f"{s.label}{' (CSV)' * (key == 'sampled')}": key for key, s in SHAPES.items()}
        self.choices = {"shape": pn.widgets.Select(name="Shape", options=shapes, **look)}
        for name, options in CHOICES.items():
            options = {text: option for option, text in options.items()}
            kind = pn.widgets.RadioBoxGroup if name in _FORM else pn.widgets.Select
            more = {"inline": True} if name in _FORM else {"css_classes": ["choice", "beside"]}
            self.choices[name] = kind(name=LABELS[name], options=options, **look | more)
        for name, widget in self.choices.items():
            widget.param.watch(lambda event, name=name: self._choose(name, event), "value")
        noted = ("sources", "sketch", "tip", "slope", "elasticity", "plasticity", "damping", "drive")
        self.notes = {name: html("") for name in noted}
        self.tip = pn.widgets.FileInput(accept=".csv,.txt,text/csv", css_classes=["file", "tip"], **WIDE)
        again = pn.widgets.Button(name="Hit again", css_classes=["button"], margin=(4, 0), width=90)
        #: Parts of the form that only some drives have.
        self.parts = {"again": again}
        self.heads = {title: html(f"<h2>{title}</h2>") for title in ("Indenter", "Medium", "Drive")}
        self.heads["tip"] = html("or a measured tip, as CSV (r, z):")
        self.rows = {"preset": _beside(self.preset, *_SELECTS["preset"])}
        for name, widget in self.choices.items():
            label, about = _SELECTS.get(name) or (LABELS[name], ABOUT[name])
            self.rows[name] = _beside(widget, label, about)
            if name in _FORM:
                legend = html(explained("about", label, linked(about)), css_classes=["legend"])
                self.rows[name] = pn.Row(legend, widget, css_classes=["fieldset"], **WIDE)
        self.form, self._above = pn.Column(css_classes=["form"], **WIDE), []

    def _load(self, event):
        # What is only shown is not loaded again: it may have been altered.
        if event.new != self.explorer.preset:
            self.tell(lambda: self.explorer.load(event.new))
        self.preset.value = self.explorer.preset

    def _choose(self, name, event):
        self.tell(lambda: self.explorer.choose(name, event.new))
        self.choices[name].value = self.explorer.option(name)

    def number(self, name):
        """The control of a number, made when it is used for the first time."""
        if name not in self.numbers:
            self.numbers[name] = Number(self.explorer, name, self.attempt)
        return self.numbers[name]

    def show(self, way):
        """Everything that is used, with its values, beside the trajectory that it makes."""
        explorer = self.explorer
        self.preset.value = explorer.preset
        for name, widget in self.choices.items():
            applies = name in ("swept", "against")
            some = {CHOICES[name][option]: option for option in explorer.options(name) if applies}
            widget.param.update(value=explorer.option(name), **{"options": some} if applies else {})
        self._write(way)
        notes, heads = self.notes, self.heads
        rows = [self.rows["preset"], notes["sources"], heads["Indenter"], self.rows["shape"]]
        rows += [heads["tip"], self.tip, notes["tip"], notes["sketch"]]
        rows += [self.number(name) for name, _ in shape_quantities(explorer.shape)]
        rows += [notes["slope"], heads["Medium"]]
        for choice in ("elasticity", "plasticity", "damping"):
            rows += [*self._choice(choice), notes[choice]]
        rows += [heads["Drive"], *self._choice("drive"), notes["drive"]]
        for part in DRIVES[explorer.drive].form:
            rows += self._choice(part) if part in CHOICES else [self.parts[part]]
        if rows != list(self.form):
            self.form[:] = rows
        self._show_above()

    def _choice(self, choice):
        numbers = map(self.number, USED[choice][getattr(self.explorer, choice)])
        return [self.rows[choice], *numbers]

    def above(self, names):
        """What stands above a plot: choices, each with the numbers that its option uses, and numbers."""
        row = pn.Column(css_classes=["above"], **WIDE)
        self._above.append((names, row))
        return row

    def _show_above(self):
        for names, row in self._above:
            parts = []
            for name in names:
                used = USED[name][self.explorer.option(name)] if name in USED else [name]
                parts += [*[self.rows[name]] * (name in USED), *map(self.number, used)]
                for end in (name for name in used if name in ENDS):
                    # It may follow what its number was loaded as.
                    self.number(end).show()
            if parts != list(row):
                row[:] = parts

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
