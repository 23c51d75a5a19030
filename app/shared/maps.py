"""Pictures with an image in colours behind the rows."""

from typing import Any

import bokeh.models as bk
import numpy as np

from mdr_core.show.figures import ROLES

from ..draw import Picture
from ..plot import View


class Map(Picture):
    """A plot with an image, and a bar with its colours."""

    margins = (0.0, 0.0)

    def __init__(self, plot: Any):
        super().__init__(plot)
        empty = {name: [] for name in ("image", "x", "y", "dw", "dh")}
        self.source = bk.ColumnDataSource(empty, name=f"{plot.name} image")
        self.source.syncable = False
        mapper = bk.LinearColorMapper(palette="Cividis256", low=0, high=1)
        glyph = self.figure.image("image", "x", "y", "dw", "dh", source=self.source, color_mapper=mapper)
        glyph.name, glyph.level, self.bar = "image", "image", glyph.construct_color_bar(padding=2, width=12)
        self.bar.update(background_fill_color=None, bar_line_color=None)
        self.figure.add_layout(self.bar, "right")
        # Behind lines of full strength the map is not seen.
        self.figure.grid.grid_line_alpha = 0.25

    def columns(self, view: View, i: int) -> dict[Any, dict[str, list]]:
        found = super().columns(view, i)
        if found:
            axes, (across, up, values) = self.axes_of(view), view.places(self.plot, i)["image"]
            (left, right), (low, high) = across / axes[0].factor, up / axes[1].factor
            corner = {"x": [left], "y": [low], "dw": [right - left], "dh": [high - low]}
            found[self.source] = corner | {"image": [np.float32(values / axes[2].factor)]}
        return found

    def show(self, columns: dict, view: View) -> None:
        super().show(columns, view)
        # The bar takes no colours from the sheet.
        colour = ROLES["ink"][view.state.dark]
        self.bar.update(title_text_color=colour, major_label_text_color=colour)

    def set_axes(self, axes: list[Any]) -> None:
        super().set_axes(axes[:2])
        low, high = axes[2].ends
        self.bar.color_mapper.update(low=low, high=high)
        self.bar.title = f"{axes[2].title.split(',')[0]} ({axes[2].unit})"
