"""The vertices of a path as text, a line each: a depth or a force, and a time where times count."""

import re

import panel as pn

from .drives.path import KIND, checked
from .parts import WIDE, field, html, marked
from .units import fitting, read

_BETWEEN = re.compile(r"\s*(?:;|\t|,\s|\bat\b)\s*")
_HELP = (
    "One vertex a line: a depth or force with its unit, then a time after a comma and a blank, a semicolon "
    "or a tab, at each vertex or at none. Straight in between. Without times the path is followed "
    "infinitely slowly, from first contact on."
)


def _columns(path, prescribed):
    """The kinds of the columns, and the units in which they are shown."""
    kinds = KIND[prescribed], "time"
    largest = [max(map(abs, column)) for column in zip(*path, strict=True)]
    return [(kind, fitting(size, kind)) for kind, size in zip(kinds, [*largest, 0.0], strict=False)]


def write(path, prescribed):
    """Vertices as text that `read_path` understands, in one unit for each column, with five digits."""
    columns = _columns(path, prescribed)
    return "\n".join(
        ", ".join(f"{v / unit.factor:.5g} {unit.name}" for v, (_, unit) in zip(row, columns, strict=False))
        for row in path
    )


def read_path(text, prescribed, shown):
    """Vertices (SI) from text in which the path `shown` has been altered.

    Bare numbers are in the units shown; a line that stands as it was has all digits that it had. Raises
    ValueError, with the line, if it is none.
    """
    path, columns = [], _columns(shown, prescribed)
    kept = dict(zip(write(shown, prescribed).splitlines(), shown, strict=True))
    for number, line in enumerate(text.splitlines(), 1):
        cells = [cell for cell in _BETWEEN.split(line.strip()) if cell]
        try:
            if len(cells) > 2:
                raise ValueError(f"“{line:.40}” is more than a {prescribed} and a time")
            pairs = zip(cells, columns, strict=False)
            row = kept.get(line.strip()) or tuple(read(cell, *column)[0] for cell, column in pairs)
        except ValueError as error:
            raise ValueError(f"Line {number}: {error}") from None
        path += [row] if row else []
    return checked(path, prescribed)


class Vertices(pn.Column):
    """The table of vertices; what is refused stays in it, with what is wrong below."""

    def __init__(self, explorer, attempt):
        self._explorer, self._attempt = explorer, attempt
        look = {"name": "Vertices: one a line, with times or without", "description": _HELP}
        look |= {"rows": 6, "auto_grow": True, "max_rows": 14}
        self.text, self.said = field(pn.widgets.TextAreaInput, "vertices", **look), html()
        super().__init__(self.text, self.said, **WIDE)
        self.text.param.watch(self._typed, "value")
        explorer.param.watch(lambda *events: self.show(), ["path", "prescribed"])

    def _typed(self, event):
        explorer = self._explorer
        if explorer.path and event.new == write(explorer.path, explorer.prescribed):
            return

        def take():
            path = read_path(event.new, explorer.prescribed, explorer.path)
            explorer.param.update(path=path, pattern="own")

        try:
            self._attempt(take)
            self.show()
        except ValueError as error:
            self.said.object = f'<span class="beyond">{marked(str(error))}</span>'

    def show(self):
        """The vertices as they stand."""
        if self._explorer.path:
            self.said.object = ""
            self.text.value = write(self._explorer.path, self._explorer.prescribed)
