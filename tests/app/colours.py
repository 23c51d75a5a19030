"""Colours of the style sheet, and the contrast of two colours (WCAG 2.2)."""

import re
from pathlib import Path

import app

CSS = (Path(app.__file__).parent / "static" / "style.css").read_text(encoding="utf-8")


def variables(selector):
    """Colours by name of a block of the style sheet."""
    block = re.search(rf"^{re.escape(selector)} \{{(.*?)^\}}", CSS, re.DOTALL | re.MULTILINE)[1]
    return dict(re.findall(r"--([\w-]+): (#\w+)", block))


LIGHT, DARK = variables(":root"), variables(":root.dark")


def luminance(colour):
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    parts = [int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one, other):
    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)


def hexadecimal(colour):
    """A colour that a browser has computed."""
    return "#" + "".join(f"{int(part):02x}" for part in re.findall(r"\d+", colour)[:3])
