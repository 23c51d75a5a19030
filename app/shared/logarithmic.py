"""Pictures with logarithmic axes."""

from typing import Any

import bokeh.models as bk
import numpy as np

from mdr_core.show.figures import Axis

from ..draw import Picture
from ..ui import JS


class Logarithmic(Picture):
    """A plot whose axes may be logarithmic."""

    def set_axes(self, axes: list[Axis]) -> None:
        super().set_axes(axes)
        f = self.figure
        for name, side, axis in zip(("x_scale", "y_scale"), (f.below[0], f.left[0]), axes, strict=False):
            if isinstance(getattr(f, name), bk.LogScale) != axis.log:
                setattr(f, name, bk.LogScale() if axis.log else bk.LinearScale())
            elif not axis.log:
                continue
            linear = bk.BasicTicker(), bk.BasicTickFormatter()
            ticker, formatter = ticks(*axis.ends) if axis.log else linear
            side.update(ticker=ticker, formatter=formatter)
            for grid in (each for each in f.center if getattr(each, "axis", None) is side):
                grid.ticker = ticker


def ticks(low: float, high: float) -> tuple[Any, Any]:
    """Ticker and formatter of a logarithmic axis; over two decades or less Bokeh's has too many."""
    formatter = bk.CustomJSTickFormatter(code=JS["powers"])
    if high > 101 * low:
        return bk.LogTicker(num_minor_ticks=0), formatter
    powers = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    fixed = bk.FixedTicker(ticks=[float(f"{n}e{power:.0f}") for power in powers for n in (1, 2, 5)])
    return fixed if high > 5 * low else bk.BasicTicker(), formatter
