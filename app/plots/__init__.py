"""Every plot of the page, by its name: all that stand in the modules of their subjects, in their order."""

from . import below, contact, force, motion, sweep
from .plot import Plot

_MODULES = (contact, motion, force, below, sweep)
_ALL = [each for module in _MODULES for each in vars(module).values() if isinstance(each, Plot)]
PLOTS: dict[str, Plot] = {plot.name: plot for plot in _ALL}
#: Those that are always seen, and those that are asked for by tabs.
NAMED = tuple(name for name, plot in PLOTS.items() if not plot.tab)
TILES = tuple(name for name, plot in PLOTS.items() if plot.tab)
