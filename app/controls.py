"""What a person sets: one control for each quantity, and the choices."""

from math import log
from pathlib import Path

import panel as pn
import param

from .presets import ASSETS
from .units import entry, fitting, read

_HERE = Path(__file__).parent
STYLE = (ASSETS / "style.css").read_text(encoding="utf-8")


class Scale:
    """The steps of a slider and the values they stand for."""

    STEPS = 400

    def __init__(self, quantity, reset, value):
        low, high = quantity.bounds
        self.logarithmic = quantity.span > 0
        if self.logarithmic:
            # A value typed beyond the slider's reach becomes its new middle.
            middle = reset if reset / quantity.span <= value <= reset * quantity.span else value
            low, high = max(low, middle / quantity.span), min(high, middle * quantity.span)
        self.low, self.high = low, high

    def position(self, value):
        """The step nearest to a value."""
        if self.logarithmic:
            share = log(value / self.low) / log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return round(self.STEPS * min(max(share, 0.0), 1.0))

    def value(self, position):
        """The value of a step, with three digits."""
        share = position / self.STEPS
        if self.logarithmic:
            value = self.low * (self.high / self.low) ** share
        else:
            value = self.low + (self.high - self.low) * share
        return min(max(float(f"{value:.3g}"), self.low), self.high)


class Text(pn.custom.JSComponent):
    """HTML of our own that changes with every move: replaced in place, without a new layout."""

    html = param.String()

    _esm = """
    export function render({ model, el }) {
      const show = () => { el.innerHTML = model.html }
      model.on("html", show)
      show()
    }
    """
    _stylesheets = (STYLE,)

    def __init__(self):
        super().__init__(sizing_mode="stretch_width", margin=0)


class QuantityControl(pn.custom.JSComponent):
    """A field and a slider for one quantity of the state; reports through `changed` and `refused`.

    Only text and a step travel to the page: units and scale stay here.
    """

    symbol = param.String()
    label = param.String()
    text = param.String()
    position = param.Integer(0)
    answers = param.Integer(0)
    steps = param.Integer(Scale.STEPS, constant=True)

    _esm = (_HERE / "quantity.js").read_text(encoding="utf-8")
    _stylesheets = (STYLE,)
    # The page sends one move at a time: nothing is won by waiting for more.
    _debounce = 1

    def __init__(self, state, name, quantity, attempt):
        self._state, self._name, self._quantity, self._attempt = state, name, quantity, attempt
        super().__init__(
            symbol=quantity.symbol,
            label=quantity.label,
            css_classes=["quantity"],
            sizing_mode="stretch_width",
        )
        self._following = False
        self.follow()
        self.param.watch(self._moved, "position")

    def follow(self):
        """Show the value that the state has."""
        value, reset = getattr(self._state, self._name), self._state.resets.get(self._name)
        self._scale = Scale(self._quantity, value if reset is None else reset, value)
        self._following = True
        try:
            self.param.update(text=entry(value, self._quantity.kind), position=self._position(value))
        finally:
            self._following = False

    def _position(self, value):
        # Rounding to three digits must not move the slider away from the step it was put on.
        stays = self._scale.value(self.position) == value
        return self.position if stays else self._scale.position(value)

    def _moved(self, event):
        if not self._following:
            self._attempt(self._move, event.new)

    def _move(self, position):
        self.answers += 1
        self._set(self._scale.value(position))

    def _handle_msg(self, message):
        if message.get("reset") and self._name in self._state.resets:
            self._attempt(self._set, self._state.resets[self._name])
        elif isinstance(message.get("typed"), str):
            self._attempt(self._type, message["typed"])

    def _type(self, text):
        shown = fitting(getattr(self._state, self._name), self._quantity.kind)
        self._set(read(text, self._quantity.kind, shown))

    def _set(self, value):
        self._state.set(self._name, value)
