"""The figure: time against error in small panels, written as SVG by hand to stay small.

All colours are of middle brightness, so that the picture reads on light and on dark pages.
"""

import math
from xml.sax.saxutils import escape

_PANELS = (
    ("elastic cone, field on a grid", "pressure"),
    ("cone, 10⁸ critical depths deep", "pressure"),
    ("cone, 10⁴ critical depths deep", "restitution and contact time"),
    ("viscous medium, 100 critical depths deep", "restitution and contact time"),
)
_COLUMNS, _WIDTH, _HEIGHT, _PLOT, _LEFT, _TOP = 2, 330, 352, (268, 196), 48, 42
_OWN = "#2f81f7"
_OTHERS = ("#e5534b", "#bf8700", "#d6409f", "#c9510c", "#9a6cd8", "#8a929b", "#7d9b2f")
_INK = "#7a828c"
_LEAST = 1e-17


def figure(results):
    """The SVG, from what `report.collect` gives."""
    panels = []
    for index, (title, question) in enumerate(_PANELS):
        chosen = [r for r in results["records"] if (r["title"], r["question"]) == (title, question)]
        x, y = index % _COLUMNS * _WIDTH, index // _COLUMNS * _HEIGHT
        if chosen:
            panels.append(f'<g transform="translate({x} {y})">' + _panel(title, question, chosen) + "</g>")
    rows = -(-len(_PANELS) // _COLUMNS)
    size = f'viewBox="0 0 {_COLUMNS * _WIDTH} {rows * _HEIGHT}" width="{_COLUMNS * _WIDTH}"'
    style = (
        f"text{{font:12px system-ui,sans-serif;fill:{_INK}}}.t{{font-weight:600;font-size:13px}}"
        ".k{font-size:11px}"
        f".g{{stroke:{_INK};stroke-opacity:.25;fill:none}}.l{{fill:none;stroke-width:1.6;stroke-opacity:.8}}"
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img">'
        "<title>Time against relative error of mdr_core and of other methods; lower left is better</title>"
        f"<style>{style}</style>" + "".join(panels) + "</svg>\n"
    )


def _panel(title, question, records):
    families = {}
    for record in records:
        families.setdefault(record["family"], []).append(record)
    times = [r["seconds"] for r in records]
    low, high = math.floor(math.log10(min(times))), math.ceil(math.log10(max(times)))
    width, height = _PLOT

    def place(record):
        error = math.log10(max(record["error"], _LEAST))
        x = _LEFT + (min(error, 0) - math.log10(_LEAST)) / -math.log10(_LEAST) * width
        y = _TOP + (high - math.log10(record["seconds"])) / (high - low) * height
        return round(x, 1), round(y, 1)

    parts = [
        f'<text class="t" x="{_LEFT}" y="16">{escape(question.capitalize())}</text>',
        f'<text x="{_LEFT}" y="32">{escape(title)}</text>',
        *_axes(low, high),
    ]
    others = iter(_OTHERS)
    for index, (family, members) in enumerate(families.items()):
        colour = _OWN if family == "mdr_core" else next(others)
        points = sorted(map(place, members))
        parts += [*_series(points, colour, family), *_legend(index, family, colour)]
    return "".join(parts)


def _axes(low, high):
    """Grid lines with their labels: errors below, times on the left."""
    width, height = _PLOT
    for decade in range(-16, 1, 4):
        x = round(_LEFT + (decade + 17) / 17 * width, 1)
        yield f'<path class="g" d="M{x} {_TOP}v{height}"/>'
        label = "1" if decade == 0 else f"10{_raised(decade)}"
        yield f'<text x="{x}" y="{_TOP + height + 15}" text-anchor="middle">{label}</text>'
    y = _TOP + height + 29
    yield f'<text x="{_LEFT}" y="{y}">↙ better</text>'
    yield f'<text x="{_LEFT + width}" y="{y}" text-anchor="end">relative error</text>'
    for decade in range(low, high + 1):
        y = round(_TOP + (high - decade) / (high - low) * height, 1)
        yield f'<path class="g" d="M{_LEFT} {y}h{width}"/>'
        yield f'<text x="{_LEFT - 5}" y="{y + 4}" text-anchor="end">{_seconds(decade)}</text>'


def _raised(number):
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def _seconds(decade):
    unit = math.floor(decade / 3)
    name = {0: "s", -1: "ms", -2: "µs", -3: "ns"}.get(unit)
    return f"{10 ** (decade - 3 * unit)} {name}" if name else f"10{_raised(decade)} s"


def _series(points, colour, family):
    line = "M" + "L".join(f"{x} {y}" for x, y in points)
    yield f'<path class="l" d="{line}" stroke="{colour}"/>'
    for x, y in points:
        if family == "mdr_core":
            yield f'<circle cx="{x}" cy="{y}" r="4.5" fill="{colour}"/>'
        else:
            yield f'<rect x="{x - 3:.1f}" y="{y - 3:.1f}" width="6" height="6" fill="{colour}"/>'


def _legend(index, family, colour):
    x = 8 + index % 2 * 162
    y = _TOP + _PLOT[1] + 46 + index // 2 * 14
    mark = "●" if family == "mdr_core" else "■"
    yield f'<text class="k" x="{x}" y="{y}" style="fill:{colour}">{mark} {escape(family)}</text>'
