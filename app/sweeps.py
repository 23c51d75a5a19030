"""Sweeps: results of the core over a range of one number of a scene, and of other classes of hardness."""

from dataclasses import dataclass, replace
from operator import attrgetter

import numpy as np

import mdr_core as mdr

from .changes import CONSTANTS, shown
from .drives import DRIVES
from .state import State, medium, profile, used_by, yield_constant

#: Functions of the core by drives.
SOLVERS = {"depth": "indent", "force": "indent_to_force", "impact": "impact"}
#: Points along the range, and of impacts in time, which take a millisecond each.
POINTS, IN_TIME = 81, 31
#: Names of the fast limit, which is that of class (b), and of the three classes: options and constants.
FAST = "fast limit (23) (24), class (b)"
CLASSES = {
    "(a) hardness constant": ("constant", "volume_hardness"),
    "(b) hardness ∝ 1/a": ("q_c", "q_c"),
    "(c) hardness ∝ 1/a²": ("line", "f_c"),
}
#: Where the result of a fast limit is in that of an impact.
_LIMITS = {
    "damaged_area": "fast_limit.contact_area",
    "max_depth": "fast_limit.max_depth",
    "restitution": "fast_limit.restitution",
}


@dataclass(frozen=True)
class Sweep:
    """A sweep: the scene, the swept number with its range, and the result."""

    state: State
    swept: str
    present: float
    low: float
    high: float
    against: str
    logarithmic: bool
    #: Function of the core, "" if the drive has none.
    solver: str

    @property
    def in_time(self):
        """Whether it is of impacts with dashpots or on a structure."""
        structure = DRIVES[self.state.drive].given(self.state).get("structure")
        return self.solver == "impact" and (self.state.damping != "none" or structure is not None)

    @property
    def numbers(self):
        space = np.geomspace if self.low > 0 else np.linspace
        return space(self.low, self.high, IN_TIME if self.in_time else POINTS)

    def at(self, numbers):
        """The scene with values of the swept number."""
        if self.swept == "energy":
            return self.state.replace(speed=(2 * numbers / self.state.mass) ** 0.5)
        return self.state.replace(**{self.swept: numbers})

    def solve(self, numbers):
        """Results of the core for values of the swept number."""
        state = self.at(numbers)
        given = DRIVES[state.drive].given(state)
        return getattr(mdr, self.solver)(profile(state), medium(state), **given)

    def column(self, numbers, quantity):
        """A result at values of the swept number; NaN where the core refuses."""
        try:
            result = self.solve(numbers[:, None] if len(numbers) > 1 else float(numbers[0]))
            return np.broadcast_to(attrgetter(quantity)(result), (len(numbers), 1))[:, 0]
        except ValueError:
            if len(numbers) == 1:
                return np.full(1, np.nan)
            return np.hstack([self.column(half, quantity) for half in np.array_split(numbers, 2)])

    @property
    def yields(self):
        """Whether the medium yields at the present value."""
        return self.column(np.array([self.present]), "plastic_work")[0] > 0

    @property
    def dry(self):
        return not self.in_time and self.state.adhesion == "none"

    def fast(self, numbers):
        """The fast limit, of dry impacts on a virgin medium of class (b), and nothing elsewhere."""
        virgin = self.solver == "impact" and self.dry and not self.state.plastic_depth
        if virgin and self.against in _LIMITS and self.state.plasticity in ("q_c", "hardness"):
            return {FAST: self.column(numbers, _LIMITS[self.against])}
        return {}

    def classes(self):
        """Sweeps of the other classes of hardness, through the present value, by their rows."""
        return dict(self.each_class())

    def each_class(self):
        """Rows of the other classes of hardness, and their sweeps through the present value, one by one."""
        own = yield_constant(self.state)
        others = {row: pair for row, pair in CLASSES.items() if pair[1] not in own}
        constant = self.swept in used_by(self.state, "plasticity")
        # Under a given force each constant is a search of its own.
        if constant or not self.dry or not self.yields or self.solver == "indent_to_force":
            return
        for row, pair in others.items():
            if each := self._through(*pair):
                yield row, each

    def _through(self, option, constant):
        """The sweep of another class, with the constant that gives the present result; None without one.

        The constant is looked for about that of the same hardness at the largest contact radius, and has
        five digits, as in a field.
        """
        at = np.array([self.present])
        wanted, a = (float(self.column(at, quantity)[0]) for quantity in (self.against, "contact_radius"))
        same = float(medium(self.at(self.present)).hardness_at(a)) * a ** (CONSTANTS.index(constant))
        other = replace(self, state=self.state.replace(plasticity=option), swept=constant)
        found = crossing(lambda values: other.column(values, self.against) - wanted, same / 40, same * 30)
        if found is None:
            return None
        return replace(other, state=other.state.replace(**{constant: shown(found)}), swept=self.swept)


def crossing(function, low, high):
    """Smallest number between two positive ones at which a function changes its sign; None without one.

    The function takes an array, in which a number costs a small part of one by itself: so it is looked for
    on a grid of equal ratios that is refined once, which leaves 10⁻³ of it, and then by a chord, 10⁻⁶.
    """
    for _ in range(2):
        numbers = np.geomspace(low, high, POINTS)
        values = function(numbers)
        changes = np.flatnonzero(values[:-1] * values[1:] < 0)
        if not changes.size:
            return None
        first = changes[0]
        low, high = numbers[first : first + 2]
    return low + (high - low) * values[first] / (values[first] - values[first + 1])
