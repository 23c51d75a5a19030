"""All plots of the page by name, in their order."""

from . import below, contact, force, motion, sweep
from .plot import Plot, View

_MODULES = (contact, motion, force, below, sweep)
_ALL = [each for module in _MODULES for each in vars(module).values() if isinstance(each, Plot)]
PLOTS: dict[str, Plot] = {plot.name: plot for plot in _ALL}
#: Plots that are always shown, and optional ones.
NAMED = tuple(name for name, plot in PLOTS.items() if not plot.tab)
TILES = tuple(name for name, plot in PLOTS.items() if plot.tab)


def visible(view: View) -> list[Plot]:
    """Plots that a view shows, in their order."""
    seen = (*NAMED, *view.state.tiles)
    return [plot for name, plot in PLOTS.items() if name in seen and plot.applies(view)]
