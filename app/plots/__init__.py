"""Every plot of the page, by its name, in the order of the tabs."""

from .below import SECTION, SURFACE
from .contact import PRESSURE, RADII, RELIEF, SPRINGS
from .force import FORCE, LOGLOG, RESIDUAL
from .motion import ENERGY, FORCES, MAW, MOTION
from .plot import Plot
from .sweep import SWEEP

_ALL = (
    SPRINGS, PRESSURE, FORCE,
    RADII, MOTION, ENERGY, FORCES, MAW, RESIDUAL, SURFACE, SECTION, RELIEF, LOGLOG, SWEEP,
)  # fmt: skip
PLOTS: dict[str, Plot] = {plot.name: plot for plot in _ALL}
#: Those that are always seen, and those that are asked for by tabs.
NAMED = tuple(name for name, plot in PLOTS.items() if not plot.tab)
TILES = tuple(name for name, plot in PLOTS.items() if plot.tab)
