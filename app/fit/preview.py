"""A small drawing of force over depth, as a suggestion has them."""

from typing import Any

import numpy as np
from markupsafe import Markup

from mdr_core.show.units import written

_WIDTH, _HEIGHT, _EDGE = 320, 150, 10
_DRAWING = Markup(
    '<figure class="preview"><svg viewBox="0 0 {width} {height}" role="img" aria-label="{text}">'
    '<polyline points="{points}" fill="none" stroke="currentColor" stroke-width="1.5"/></svg>'
    "</figure><p>{text}.</p>"
)


def drawing(preview: tuple[np.ndarray, np.ndarray] | None) -> Markup:
    """Force over depth of a curve as SVG, with the ranges of both in words; empty without a curve."""
    if preview is None:
        return Markup("")
    depth, force = preview
    x, y = _scaled(depth, _WIDTH), _HEIGHT - _scaled(force, _HEIGHT)
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
    ends: list[Any] = []
    for values, kind in ((depth, "length"), (force, "force")):
        ends += [written(float(end), kind, 3) for end in (values.min(), values.max())]
    text = "As suggested, depth from {} to {} (to the right), force from {} to {}".format(*ends)
    return _DRAWING.format(width=_WIDTH, height=_HEIGHT, points=points, text=text)


def _scaled(values: np.ndarray, size: int) -> np.ndarray:
    return _EDGE + (values - values.min()) / (np.ptp(values) or 1.0) * (size - 2 * _EDGE)
