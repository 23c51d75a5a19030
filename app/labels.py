"""Labels on curves and areas: their boxes, and which of them have a place in a plot.

Labels are placed in the smallest plot, that of a phone. Their letters have one size in every plot, so that
boxes which do not cover each other there do so in no larger plot either.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from mdr_core.show.figures import NOTHING, Axis, Row

#: Pixels within the axes of the smallest plot, of a line of 12 px letters, and kept free beside a label.
WIDTH, HEIGHT, LINE, GAP = 290, 130, 14, 2
#: Widths of letters of Helvetica and Arial over their size.
_WIDTHS = {"fijlrt .,;:()'|": 0.28, "cksvxyz": 0.5, "mwMWCGOQ→−=∞%": 0.8}


def width(text: str) -> float:
    """Width (px) of a text of 12 px letters, some percent too large.

    Examples
    --------
    >>> round(width("plastic zone"))
    65
    """
    sizes = (next((size for some, size in _WIDTHS.items() if each in some), 0.56) for each in text)
    return 12 * sum(sizes)


@dataclass(frozen=True)
class Box:
    """Edges of a label in pixels from the lower left corner of the smallest plot."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def inside(self) -> bool:
        """Whether all of it is within the axes."""
        return self.left >= 0 and self.right <= WIDTH and self.bottom >= 0 and self.top <= HEIGHT

    def covers(self, other: "Box") -> bool:
        """Whether it and another one cover each other."""
        across = self.left < other.right + GAP and other.left < self.right + GAP
        return across and self.bottom < other.top and other.bottom < self.top


_ACROSS = {"left": 0.0, "center": 0.5, "right": 1.0}
_UP = {"bottom": 0.0, "middle": 0.5, "top": 1.0}


def box(row: Row, x: float, y: float, text: str, axes: list[Axis]) -> Box:
    """Box of a label at a point (SI), with the size of a letter of its axes' smallest plot."""
    right, up = (
        (value - axis.start) / (axis.end - axis.start) for value, axis in zip((x, y), axes, strict=False)
    )
    wide = width(text)
    left = right * WIDTH - _ACROSS[row.look["text_align"]] * wide
    bottom = up * HEIGHT - _UP[row.look["text_baseline"]] * LINE
    return Box(left, left + wide, bottom, bottom + LINE)


def arranged(rows: list[Row], places: dict[str, Any], axes: list[Axis]) -> dict[str, tuple]:
    """Places of labels that name rows: the first of their points at which there is room, or none.

    Every other label has its place; `places` has points (SI) and a text for each row. A label of rows that
    are not seen is empty; one without room keeps its text, because its rows need no legend.
    """
    labels = [row for row in rows if row.kind == "labels"]
    taken, found = [], {}
    for row in (row for row in labels if not row.names):
        x, y, text = places[row.name]
        if text and np.isfinite(x) and np.isfinite(y):
            taken.append(box(row, x, y, text, axes))
    for row in (row for row in labels if row.names):
        xs, ys, text = places[row.name]
        found[row.name] = (
            *NOTHING,
            text if any(_seen(places.get(name, NOTHING)) for name in row.names) else "",
        )
        points = zip(np.atleast_1d(xs), np.atleast_1d(ys), strict=True) if found[row.name][2] else ()
        for x, y in points:
            place = box(row, x, y, text, axes)
            if place.inside and not any(map(place.covers, taken)):
                taken.append(place)
                found[row.name] = float(x), float(y), text
                break
    return found


def _seen(place: tuple) -> bool:
    return bool(np.isfinite(place[1]).any())
