"""What a person has set: parameters in SI, within bounds; gives a `mdr.Scene`. No plotting."""

import param

import mdr_core as mdr

from .presets import OPENING, PRESETS
from .shapes import SHAPES, Quantity
from .units import written

MEDIUM = (
    Quantity("E_star", "E*", "effective modulus (2)", "pressure", (1.0, 1e14), 1e9, 10.0),
    Quantity("q_c", "q_c", "yield constant (11)", "yield constant", (1e-9, 1e12), 1.0, 30.0),
)
DRIVE = (
    Quantity("max_depth", "d_max", "largest depth", "length", (1e-13, 10.0), 1e-6, 30.0),
    Quantity("unloading", "u", "unloading", "fraction", (0.0, 1.2), 0.0, 0.0),
)


class Explorer(param.Parameterized):
    """The state of one session.

    Besides the parameters below there is one for every quantity of every shape, named as in
    `"cone_slope"`, so that a shape keeps its values while another one is looked at.

    `unloading` goes from 0 at the largest depth to 1 where the load is gone, and on to 1.2 where
    the tip is back at the height of the undeformed surface.
    """

    shape = param.Selector(objects=list(SHAPES))

    def __init__(self, preset=OPENING):
        super().__init__()
        self.resets = {}
        self.load(preset)

    def load(self, preset):
        """Set everything to a preset, given by its label."""
        preset = PRESETS[preset]
        self.resets = dict(preset.values)
        self.param.update(shape=preset.shape, **preset.values)

    def choose(self, shape):
        """Take another shape, of the size of the present contact."""
        radius = float(self.profile().contact_radius(self.max_depth))
        values = {}
        for name, quantity in self.shape_quantities(shape):
            is_length = quantity.kind == "length"
            value = float(f"{quantity.default * radius:.2g}") if is_length else quantity.default
            values[name] = min(max(value, quantity.bounds[0]), quantity.bounds[1])
        self.resets.update(values)
        self.param.update(shape=shape, **values)

    def set(self, name, value):
        """Set one quantity to a value in SI, or refuse it.

        Raises
        ------
        ValueError
            If the value is out of bounds.
        """
        quantity = QUANTITIES[name]
        low, high = quantity.bounds
        if not low <= value <= high:
            shown, low, high = (written(v, quantity.kind) for v in (value, low, high))
            raise ValueError(f"{quantity.symbol} = {shown} is out of bounds: {low} to {high}")
        setattr(self, name, value)

    def values(self):
        """All parameters, by name: to go back to."""
        return {name: value for name, value in self.param.values().items() if name != "name"}

    @staticmethod
    def shape_quantities(shape):
        """Parameter names and quantities of a shape."""
        return [(f"{shape}_{quantity.name}", quantity) for quantity in SHAPES[shape].quantities]

    def profile(self):
        """The indenter."""
        values = {q.name: getattr(self, name) for name, q in self.shape_quantities(self.shape)}
        return SHAPES[self.shape].build(**values)

    def medium(self):
        """The medium."""
        return mdr.Medium(self.E_star, self.q_c)

    def depth(self, medium):
        """Present depth (m)."""
        deepest, recovery = self.max_depth, min(medium.critical_depth, self.max_depth)
        if self.unloading <= 1:
            return deepest - recovery * self.unloading
        return (deepest - recovery) * (1.2 - self.unloading) / 0.2

    def scene(self):
        """What is to be modelled: pressed to the largest depth, then drawn back to the present one."""
        medium = self.medium()
        path = (self.max_depth, self.depth(medium)) if self.unloading > 0 else (self.max_depth,)
        return mdr.Scene(self.profile(), medium, mdr.DepthPath(path))


#: Every quantity by the name of its parameter.
QUANTITIES = {quantity.name: quantity for quantity in MEDIUM + DRIVE} | {
    name: quantity for shape in SHAPES for name, quantity in Explorer.shape_quantities(shape)
}
for _name, _quantity in QUANTITIES.items():
    _low, _high = _quantity.bounds
    _default = min(max(_quantity.default, _low), _high)
    Explorer.param.add_parameter(
        _name, param.Number(_default, bounds=_quantity.bounds, label=_quantity.label)
    )
