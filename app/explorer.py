"""What one person has set: parameters in SI within bounds, choices, presets, undo; gives a `mdr.Scene`."""

import json
from dataclasses import replace
from math import inf, isclose

import param

import mdr_core as mdr

from .convert import CONVERT
from .drives import DRIVES
from .measured import Measured
from .presets import OPENING, PRESETS
from .quantities import CHOICES, ENDS, NUMBERS, QUANTITIES, SHAPES, USED, Scale, lowered, shape_quantities
from .trajectory import LAST_PROGRESS
from .units import fitting, read, written

#: What the preset is called when the scene came from a file.
FROM_FILE = ""
_MOST_UNDO = 100


class Explorer(param.Parameterized):
    """The state of one person's page.

    Every quantity is a parameter in SI, those of the shapes named as in "cone_slope"; every choice is one
    that says which of them are used. Whoever shows the state calls `accept` or `refuse` after a change.
    """

    preset = param.Selector(objects=[*PRESETS, FROM_FILE], default=OPENING)
    progress = param.Number(1.0, bounds=(0, LAST_PROGRESS), doc="0 first contact, 1 deepest, 2 load gone")
    samples = param.Tuple(None, length=2, allow_None=True, doc="radii and heights (m) of a measured tip")
    path = param.List([], doc="vertices of a path: depths or forces, each alone or with its time (SI)")
    tip_note = param.String(doc="what was done to the measured tip")
    measured = param.ClassSelector(class_=Measured, doc="a measured curve, and the fit to it")
    holds = param.List(["baseline", "frame_compliance"], item_type=str, doc="what a fit leaves as it is")
    hold = param.List([], item_type=str, doc="queries of the scenes that are held to compare with")
    plots = param.List([], item_type=str, doc="plots that are shown on request")
    dark = param.Boolean(False)
    shape = param.Selector(objects=list(SHAPES))

    #: Parameters that describe the view rather than the scene: undo leaves them alone.
    VIEW = ("progress", "hold", "plots", "dark", "heights", "references", "axes")

    def __init__(self, preset=OPENING):
        super().__init__()
        self.load(preset)
        self.settle()

    @property
    def choices(self):
        """The option of every choice."""
        return {name: getattr(self, name) for name in ("shape", *CHOICES)}

    def used(self):
        """Names of the numbers that the scene is made of, and of those that its drive asks for."""
        choices = [part for part in DRIVES[self.drive].form if part in USED]
        names = [name for name, _ in shape_quantities(self.shape)]
        return names + self.numbers(["elasticity", "plasticity", "damping", "drive", *choices])

    def numbers(self, names):
        """Names of numbers: of each choice out of some names those that its option uses."""
        return [n for name in names for n in (USED[name][self.option(name)] if name in USED else [name])]

    def options(self, name):
        """The options of a choice that apply to the scene, the one to begin with first."""
        drive = DRIVES[self.drive]
        if name == "preset":
            return [*PRESETS, *[FROM_FILE] * (self.preset == FROM_FILE)]
        if name not in ("swept", "against") or not drive.solver:
            return self.param[name].objects
        if name == "against":
            return list(drive.results)
        impact = "speed" in drive.solver
        idle = {"density"} if impact else {"density", "eta", "tau"}
        works = [name for name in self.used() if name not in idle]
        return ["energy"] * impact + sorted(works, key=lambda name: name not in drive.solver)

    def option(self, name):
        """The option of a choice; the first, where what was chosen does not apply."""
        chosen, options = getattr(self, name), self.options(name)
        return chosen if chosen in options else options[0]

    def number(self, name):
        """A number; an end of a range that is not set is about a third of the slider's reach away."""
        if name == "energy":
            return self.mass * self.speed**2 / 2
        if name not in ENDS or getattr(self, name) is not None:
            return getattr(self, name)
        swept, _, end = name.rpartition("_")
        scale = self.scale(swept)
        value = scale.low if end == "from" else scale.high
        if scale.logarithmic:
            value = min(3 * value, scale.middle) if end == "from" else max(value / 3, scale.middle)
        return NUMBERS[name].bounded(float(f"{value:.1g}"))

    def loaded(self, name):
        """What a number was loaded as; where it was not, what it is."""
        if name == "energy":
            return self.loaded("mass") * self.loaded("speed") ** 2 / 2
        return self.resets.get(name, self.number(name))

    def snapshot(self):
        """All that is set, at one moment."""
        values = {n: value for n, value in self.param.values().items() if n not in (*self.VIEW, "name")}
        return values, self.resets, self.sized

    def restore(self, snapshot):
        """Set everything to what it was."""
        values, self.resets, self.sized = snapshot
        self.param.update(**values)

    def settle(self):
        """Begin anew from what is set: there is nothing to undo."""
        self.past, self.future, self.mark, self._last = [], [], None, None
        self._kept, self._seen = self.snapshot(), {name: getattr(self, name) for name in self.VIEW}

    def accept(self):
        """Keep what is set now, and for undo what was before; changes of one `mark` count as one."""
        now, mark, self.mark = self.snapshot(), self.mark, None
        self._seen = {name: getattr(self, name) for name in self.VIEW}
        if now == self._kept:
            return
        if mark is None or mark != self._last:
            self.past = [*self.past[1 - _MOST_UNDO :], self._kept]
        self.future, self._last, self._kept = [], mark, now

    def refuse(self):
        """Go back to what was accepted last, the view too."""
        self.mark = None
        with param.parameterized.batch_call_watchers(self):
            self.param.update(**self._seen)
            self.restore(self._kept)

    def undo(self):
        """Take the last change back."""
        self._step(self.past, self.future)

    def redo(self):
        """Make it again."""
        self._step(self.future, self.past)

    def _step(self, source, target):
        if source:
            target.append(self._kept)
            self._kept, self._last = source.pop(), None
            self.restore(self._kept)

    def load(self, label):
        """Set everything to a preset, given by its label; a scene from a file to what it was loaded as."""
        if label == FROM_FILE:
            self.param.update(**self.resets)
            return
        preset = PRESETS[label]
        self.begin(preset.values, preset=label, progress=1.0, path=[], **preset.choices)

    def begin(self, numbers, resets=None, **choices):
        """Set numbers and choices, to which all is reset from now on; the ranges of sweeps begin anew."""
        self.resets, self.sized = resets or numbers, frozenset({choices["shape"]})
        self.param.update(**dict.fromkeys(ENDS) | choices | numbers)

    @property
    def altered(self):
        """Whether the preset, or the scene from a file, has been altered."""
        preset = PRESETS.get(self.preset)
        loaded = preset.choices | preset.values if preset else self.resets
        pairs = [(name, getattr(self, name), value) for name, value in loaded.items()]
        return any(
            now != was and not (name in QUANTITIES and isclose(now, was)) for name, now, was in pairs
        )

    def checked(self, name, value):
        """A value of a number, in SI, if it is within bounds; else ValueError."""
        quantity = NUMBERS[name]
        if quantity.bounded(value) != value:
            shown, low, high = (written(v, quantity.kind) for v in (value, *quantity.bounds))
            raise ValueError(f"{lowered(quantity.symbol)} = {shown} is out of bounds: {low} to {high}")
        return float(value)

    def scale(self, name):
        """The slider of a number as it stands."""
        return Scale(NUMBERS[name], self.loaded(name), self.number(name))

    def slide(self, name, position):
        """Set a number to a step of its slider; a drag counts as one change."""
        self.mark = name
        self.param.update(**{name: self.scale(name).value(position)})

    def type(self, name, text):
        """Set a number to what was typed; gives how it was read where that may surprise."""
        kind = NUMBERS[name].kind
        value, surprising = read(text, kind, fitting(self.number(name), kind))
        value = self.checked(name, value)
        if name not in ENDS:
            self.resets = {name: value} | self.resets
        self.param.update(**{name: value})
        return f"{text.strip()} in SI is {written(value, kind)}" if surprising else ""

    def reset(self, name):
        """Set a number to what it was loaded as."""
        self.param.update(**{name: None if name in ENDS else self.loaded(name)})

    def choose(self, name, option):
        """Take another option of a choice, with the numbers that mean the same where there are such."""
        options = self.param[name].objects
        if option not in options:
            raise ValueError(f"{option!r:.40} is not one of {', '.join(options)}")
        if option == self.option(name):
            return
        if name == "preset":
            self.load(option)
            return
        # A shape that has been looked at before keeps its values.
        kept = name not in CONVERT or (name == "shape" and option in self.sized)
        converted = {} if kept else CONVERT[name](self, option)
        converted = {k: float(v) if k in QUANTITIES else v for k, v in converted.items()}
        if name == "shape":
            self.sized |= {option}
        self.resets = self.resets | converted
        self.param.update(**{name: option}, **converted)

    def take_tip(self, samples, note):
        """Take the samples of a tip as the indenter, pressed no deeper than they reach."""
        tip = mdr.Sampled(*samples)
        changes = {}
        if self.drive == "depth" and self.max_depth > tip.known_depth:
            changes["max_depth"] = float(f"{tip.known_depth / 2:.3g}")
        self.resets = self.resets | changes
        self.param.update(samples=(tip.r, tip.z), tip_note=note, shape="sampled", **changes)

    def take_curve(self, curve):
        """Take a measured curve, or None, to compare with; it lies as it was measured."""
        self.param.update(measured=curve, contact_point=0.0, baseline=0.0)

    def hit_again(self, hit):
        """Let the body hit the imprint that it has left itself."""
        if not hit.plastic_depth_increase > 0:
            raise ValueError("nothing has yielded further: the next impact is the same as this one")
        left = self.checked("plastic_depth", float(hit.plastic_depth))
        self.resets = self.resets | {"plastic_depth": left}
        self.param.update(plastic_depth=left, surface="imprint")

    def profile(self):
        """The indenter."""
        if self.shape != "sampled":
            values = {q.name: getattr(self, name) for name, q in shape_quantities(self.shape)}
            return SHAPES[self.shape].build(**values)
        if self.samples is None:
            raise ValueError("load a tip first: a CSV file with radii r and heights z")
        return mdr.Sampled(*self.samples)

    def medium(self):
        """The medium."""
        numbers = [getattr(self, name) for name in USED["elasticity"][self.elasticity]]
        make = mdr.Medium if self.elasticity == "modulus" else mdr.Medium.from_bodies
        medium = make(*numbers)
        hardness = self.hardness * self.hardness_radius
        q_c = {"q_c": self.q_c, "hardness": hardness, "none": inf}[self.plasticity]
        eta = {"none": 0.0, "eta": self.eta, "tau": self.tau * medium.E_star / 4}[self.damping]
        return replace(medium, q_c=q_c, eta=eta)

    def scene(self):
        """What is to be modelled."""
        return mdr.Scene(self.profile(), self.medium(), DRIVES[self.drive].make(self))

    def solved(self):
        """The deepest state of the present scene, without its way there."""
        return DRIVES[self.drive].deepest(self.scene())

    def described(self):
        """The scene as JSON; if it cannot be made, what it would be made of."""
        try:
            return self.scene().to_json()
        except Exception as error:
            numbers = {name: getattr(self, name) for name in self.used()}
            return json.dumps({"choices": self.choices, "numbers": numbers, "error": str(error)})


for _name, _options in CHOICES.items():
    Explorer.param.add_parameter(_name, param.Selector(objects=list(_options)))
for _name, _q in QUANTITIES.items():
    _number = param.Number(_q.bounded(_q.default), bounds=_q.bounds, label=_q.label, doc=_q.help)
    Explorer.param.add_parameter(_name, _number)
for _name, _q in ENDS.items():
    _end = param.Number(None, bounds=_q.bounds, allow_None=True, doc=f"{_q.symbol}; None: as fits")
    Explorer.param.add_parameter(_name, _end)
