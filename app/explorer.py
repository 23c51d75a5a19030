"""What one person has set: parameters in SI within bounds, choices, presets, undo; gives a `mdr.Scene`."""

import json
from math import inf, isclose

import param

import mdr_core as mdr

from .convert import CONVERT
from .presets import OPENING, PRESETS
from .quantities import CHOICES, SURFACE, USED, Scale
from .shapes import QUANTITIES, SHAPES, shape_quantities
from .tip import MOST_IN_IMPACT
from .units import fitting, read, written

#: From first contact (0) over the deepest state (1) to the loss of contact (2) and the tip back at the
#: height of the undeformed surface.
LAST_PROGRESS = 2.2
#: What the preset is called when the scene came from a file.
FROM_FILE = ""
_MOST_UNDO = 100
_ALL_CHOICES = {"shape": {key: shape.label for key, shape in SHAPES.items()} | {"sampled": "Measured tip"}}
_ALL_CHOICES |= CHOICES


class Explorer(param.Parameterized):
    """The state of one person's page.

    Every quantity is a parameter in SI, those of the shapes named as in "cone_slope"; every choice is one
    that says which of them are used. Whoever shows the state calls `accept` or `refuse` after a change.
    """

    preset = param.Selector(objects=[*PRESETS, FROM_FILE], default=OPENING)
    progress = param.Number(
        1.0, bounds=(0, LAST_PROGRESS), doc="0 first contact, 1 deepest, 2 contact lost"
    )
    samples = param.Tuple(None, length=2, allow_None=True, doc="radii and heights (m) of a measured tip")
    tip_note = param.String(doc="what was done to the measured tip")
    hold = param.String(doc="query of the scene that is held to compare with")
    map = param.Boolean(False, doc="the pressure over the plane is shown")
    speed_plot = param.Boolean(False, doc="speed against error is shown")
    dark = param.Boolean(False)

    #: Parameters that describe the view rather than the scene: undo leaves them alone.
    VIEW = ("progress", "hold", "map", "speed_plot", "dark")

    def __init__(self, preset=OPENING):
        super().__init__()
        self.resets, self.sized = {}, frozenset()
        self.past, self.future, self.mark, self._last = [], [], None, None
        self.load(preset)
        self._kept = self.snapshot()

    @property
    def choices(self):
        """The option of every choice."""
        return {name: getattr(self, name) for name in _ALL_CHOICES}

    def used(self):
        """Names of the numbers that the choices use."""
        names = [name for name, _ in shape_quantities(self.shape)]
        return names + [n for choice, options in USED.items() for n in options[getattr(self, choice)]]

    # Undo, and refusal of what cannot be shown.

    def snapshot(self):
        """All that is set, at one moment."""
        values = {name: value for name, value in self.param.values().items() if name not in self.VIEW}
        del values["name"]
        return values, dict(self.resets), self.sized

    def restore(self, snapshot):
        """Set everything to what it was."""
        values, self.resets, self.sized = snapshot[0], dict(snapshot[1]), snapshot[2]
        self.param.update(**values)

    def accept(self):
        """Keep what is set now, and for undo what was before; changes of one `mark` count as one."""
        now, mark = self.snapshot(), self.mark
        if now != self._kept and (mark is None or mark != self._last):
            self.past = [*self.past[1 - _MOST_UNDO :], self._kept]
        if now != self._kept:
            self.future, self._last = [], mark
        self._kept, self.mark = now, None

    def refuse(self):
        """Go back to what was accepted last."""
        self.mark = None
        self.restore(self._kept)

    def settle(self):
        """Begin anew from what is set: there is nothing to undo."""
        self.past, self.future, self._kept = [], [], self.snapshot()

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

    # What can be changed.

    def load(self, label):
        """Set everything to a preset, given by its label; a scene from a file to what it was loaded as."""
        if label == FROM_FILE:
            self.param.update(**self.resets)
            return
        preset = PRESETS[label]
        self.resets, self.sized = dict(preset.values), frozenset({preset.choices["shape"]})
        self.param.update(preset=label, progress=1.0, **preset.choices, **preset.values)

    @property
    def altered(self):
        """Whether the preset has been altered."""
        if self.preset == FROM_FILE:
            now = {name: getattr(self, name) for name in self.resets}
            return any(
                now[n] != v and (isinstance(v, str) or not isclose(now[n], v))
                for n, v in self.resets.items()
            )
        preset = PRESETS[self.preset]
        numbers = (isclose(getattr(self, name), value) for name, value in preset.values.items())
        return not (
            all(numbers) and all(getattr(self, n) == option for n, option in preset.choices.items())
        )

    def checked(self, name, value):
        """A value of a number, in SI, if it is within bounds.

        Raises
        ------
        ValueError
            If it is not.
        """
        quantity = QUANTITIES[name]
        low, high = quantity.bounds
        if not low <= value <= high:
            shown, low, high = (written(v, quantity.kind) for v in (value, low, high))
            raise ValueError(f"{quantity.symbol} = {shown} is out of bounds: {low} to {high}")
        return float(value)

    def scale(self, name):
        """The slider of a number as it stands."""
        value = getattr(self, name)
        return Scale(QUANTITIES[name], self.resets.get(name, value), value)

    def slide(self, name, position):
        """Set a number to a step of its slider; a drag counts as one change."""
        self.mark = name
        self.param.update(**{name: self.scale(name).value(position)})

    def type(self, name, text):
        """Set a number to what was typed; gives how it was read where that may surprise."""
        kind = QUANTITIES[name].kind
        value, surprising = read(text, kind, fitting(getattr(self, name), kind))
        value = self.checked(name, value)
        self.resets = {name: value} | self.resets
        self.param.update(**{name: value})
        return f"{text.strip()} in SI is {written(value, kind)}" if surprising else ""

    def reset(self, name):
        """Set a number to what it was loaded as."""
        self.param.update(**{name: self.resets.get(name, getattr(self, name))})

    def choose(self, name, option):
        """Take another option of a choice, with the numbers that mean the same where there are such."""
        if option not in _ALL_CHOICES[name]:
            raise ValueError(f"{option!r:.40} is not one of {', '.join(_ALL_CHOICES[name])}")
        if option == getattr(self, name):
            return
        converted = {}
        # A shape that has been looked at before keeps its values.
        if name != "shape" or option not in self.sized:
            converted = {key: float(value) for key, value in CONVERT[name](self, option).items()}
        if name == "shape":
            self.sized |= {option}
        self.resets = self.resets | converted
        self.param.update(**{name: option}, **converted)

    def take_tip(self, samples, note):
        """Take the samples of a tip as the indenter, pressed no deeper than they reach."""
        tip = mdr.Sampled(*samples)
        changes = {"samples": (tip.r, tip.z), "tip_note": note, "shape": "sampled"}
        if self.drive == "depth" and self.max_depth > tip.deepest:
            changes["max_depth"] = float(f"{tip.deepest / 2:.3g}")
            self.resets = self.resets | {"max_depth": changes["max_depth"]}
        self.param.update(**changes)

    def hit_again(self, hit):
        """Let the body hit the imprint that it has left itself."""
        if not hit.growth > 0:
            raise ValueError("nothing has yielded further: the next impact is the same as this one")
        left = self.checked("plastic_depth", float(hit.plastic_depth))
        self.resets = self.resets | {"plastic_depth": left}
        self.param.update(plastic_depth=left, **{SURFACE: "imprint"})

    # What it gives.

    def profile(self):
        """The indenter."""
        if self.shape == "sampled":
            if self.samples is None:
                raise ValueError("load a tip first: a CSV file with radii r and heights z")
            return mdr.Sampled(*self.samples)
        values = {q.name: getattr(self, name) for name, q in shape_quantities(self.shape)}
        return SHAPES[self.shape].build(**values)

    def medium(self):
        """The medium."""
        if self.elasticity == "modulus":
            medium = mdr.Medium(self.E_star)
        elif self.elasticity == "rigid_tip":
            medium = mdr.Medium.from_bodies(self.E_1, self.nu_1)
        else:
            medium = mdr.Medium.from_bodies(self.E_1, self.nu_1, self.E_2, self.nu_2)
        hardness = self.hardness * self.hardness_radius
        q_c = {"q_c": self.q_c, "hardness": hardness, "none": inf}[self.plasticity]
        eta = {"none": 0.0, "eta": self.eta, "tau": self.tau * medium.E_star / 4}[self.damping]
        return mdr.Medium(medium.E_star, q_c, eta)

    def scene(self):
        """What is to be modelled: pressed once, or hit once."""
        before = self.plastic_depth if self.surface == "imprint" else 0.0
        drive = {
            "depth": lambda: mdr.DepthPath(self.max_depth),
            "force": lambda: mdr.ForcePath(self.max_force),
            "impact": lambda: mdr.FreeImpact(self.mass, self.speed, before),
        }[self.drive]()
        if self.shape == "sampled" and self.drive == "impact" and len(self.samples[0]) > MOST_IN_IMPACT:
            raise ValueError(
                f"a measured tip of {len(self.samples[0])} samples is too much for an impact on this page: "
                f"at most {MOST_IN_IMPACT}; mdr_core itself takes any number"
            )
        return mdr.Scene(self.profile(), self.medium(), drive)

    def solved(self):
        """The deepest state of the present scene, without its way there."""
        result = self.scene().solve()
        return result.deepest if isinstance(result, mdr.Impact) else result

    def described(self):
        """The scene as JSON; if it cannot be made, what it would be made of."""
        try:
            return self.scene().to_json()
        except Exception as error:
            numbers = {name: getattr(self, name) for name in self.used()}
            return json.dumps({"choices": self.choices, "numbers": numbers, "error": str(error)})


for _name, _options in _ALL_CHOICES.items():
    Explorer.param.add_parameter(_name, param.Selector(objects=list(_options)))
for _name, _quantity in QUANTITIES.items():
    _number = param.Number(
        _quantity.start, bounds=_quantity.bounds, label=_quantity.label, doc=_quantity.help
    )
    Explorer.param.add_parameter(_name, _number)
