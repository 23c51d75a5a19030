"""Errors for tables with ambiguous columns, with a suggestion, and for tables without a curve."""

from typing import Any

from ...base.errors import MDRError
from ...base.remark import Remedy
from .units import is_deflection, is_voltage

#: Largest numbers of columns of numbers and of words in a message.
_SHOWN, _WORDS = 14, 3
#: Units of the constants of a cantilever by argument name.
CONSTANTS = {"spring_constant": "N/m", "sensitivity": "m/V"}
#: Names of the constants in a sentence.
WORDS_OF_CONSTANTS = {
    "spring_constant": "the spring constant of the cantilever",
    "sensitivity": "its sensitivity",
}


class NoCurve(MDRError):
    """Error for a table without a curve, for example of results or settings."""


class UnknownColumns(MDRError):
    """Error for a table with ambiguous columns, with a suggestion to confirm.

    ``read_curves(path, **error.suggestion)`` reads the file with the suggestion, if it is right and
    complete. A piezo or a deflection also needs ``spring_constant=``; the message says so.

    Attributes
    ----------
    why : str
        The question as text. The message also has the columns and a line to paste.
    suggestion : dict
        Arguments of `read_curves`, "columns" and perhaps "by", as far as they are known; otherwise empty.
        "?" stands for an unknown unit.
    complete : bool
        Whether the suggestion has both columns with known units.
    table : Table
        The headers and numbers of the table; `table.name` is the name of a sheet.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import mdr_core as mdr
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("Tiefe (nm);Kraft (mN)\\n0;0\\n10;1\\n20;4\\n", encoding="utf-8")
    ...     try:
    ...         curves = mdr.read_curves(path)
    ...     except mdr.UnknownColumns as error:
    ...         print(error.suggestion)
    ...         curves = mdr.read_curves(path, **error.suggestion)
    {'columns': {'depth': (0, 'nm'), 'force': (1, 'mN')}}
    >>> print(round(curves[0].force.max(), 9))
    0.004
    """

    def __init__(
        self, why: str, table: Any, file: str = "", suggestion: dict[str, Any] | None = None,
        *, hint: str = "", results: bool = False, text: str = "",
        remedy: tuple[Remedy, ...] = (Remedy("give", "columns"),),
    ):  # fmt: skip
        self.why, self.table, self.file, self._hint = why, table, file, hint
        self._text, self.remedy = text or why, remedy
        self.suggestion: dict[str, Any] = suggestion or {}
        #: Whether each row is likely a test, not a sample of a curve.
        self.results = results
        columns = self.suggestion.get("columns") or {}
        parts = columns if isinstance(columns, list) else [columns]
        pairs = [column for part in parts for column in part.values() if column is not None]
        self.complete = bool(pairs) and all(unit != "?" for _, unit in pairs)
        sentence = f"{why}{hint}"
        sentence += "" if sentence.endswith((".", "?")) else "."
        place = ", ".join(filter(None, (file, table.name)))
        known = not columns and not any(each.what == "columns" for each in remedy)
        paste = "" if known else f"\n{_paste(self.suggestion)}"
        super().__init__(f"{place}: {sentence}\n{_shown(table)}{paste}")

    @property
    def text(self):
        return self._text

    def __reduce__(self):
        return _again, self._with(self.suggestion)

    def elsewhere(self, suggestion: dict[str, Any]) -> "UnknownColumns":
        """Return the error with another suggestion."""
        return _again(*self._with(suggestion))

    def of_files(self, count: int) -> "UnknownColumns":
        """Return the error for a number of files with these headers."""
        again, (*given, options) = self.__reduce__()
        end = "" if f"{self.why}{self._hint}".endswith((".", "?")) else "."
        return again(*given, options | {"hint": f"{self._hint}{end} {count} files have this header"})

    def _with(self, suggestion):
        given = {"hint": self._hint, "results": self.results, "text": self._text, "remedy": self.remedy}
        return self.why, self.table, self.file, suggestion, given


def _again(why, table, file, suggestion, given):
    return UnknownColumns(why, table, file, suggestion, **given)


def _shown(table):
    """Return the headers with their first numbers, one line each."""
    lines = []
    if not any(table.heads.values()):
        lines = [f"      {line.strip()[:90]}" for line in table.header[-5:]]
    for k, head in list(table.heads.items())[:_SHOWN]:
        numbers = ", ".join(f"{x:.5g}" for x in table.values[k][:3])
        lines.append(f"  {k:>3}  {head[:40]!r:<42} {numbers}, …")
    more = len(table.heads) - _SHOWN
    if more > 0:
        lines.append(f"  … and {more} more columns")
    for key, cells in list(table.words.items())[:_WORDS]:
        number, _, head = key.partition(" ")
        lines.append(f"  {int(number) - 1:>3}  {head[:40]!r:<42} {', '.join(cells[:2])[:60]}, …")
    return "\n".join(lines)


def _paste(suggestion):
    """Return a line with the suggestion, to paste behind the name of the file."""
    columns = suggestion.get("columns")
    if not columns:
        return 'Give the columns and their units: columns={"depth": (0, "nm"), "force": (1, "mN")}'
    text = as_python(columns)
    by = f", by={suggestion['by']!r}" if suggestion.get("by") is not None else ""
    parts = columns if isinstance(columns, list) else [columns]
    constants = [name for name in CONSTANTS if any(constants_needed(part)[name] for part in parts)]
    text += by + "".join(f", {name}=…" for name in constants)
    text += ", with " * bool(constants) + " and ".join(f"{name} in {CONSTANTS[name]}" for name in constants)
    is_open = ', and replace "?" by the unit' if '"?"' in text else ""
    return f"If this is right, give: columns={text}{is_open}"


def constants_needed(columns):
    """Return for each constant of a cantilever whether the columns need it.

    A piezo or a deflection needs the spring constant, and a deflection in V the sensitivity.
    """
    _, unit = columns.get("force") or (None, "N")
    return {
        "spring_constant": is_deflection(unit) or columns.get("piezo") is not None,
        "sensitivity": is_voltage(unit),
    }


def as_python(columns):
    """Return the value of `columns=` as Python code."""
    if isinstance(columns, list):
        return f"[{', '.join(map(as_python, columns))}]"
    pairs = []
    for each, column in columns.items():
        which, unit = column if column is not None else (None, "")
        name = f'"{which}"' if isinstance(which, str) else which
        pairs.append(f'"{each}": None' if column is None else f'"{each}": ({name}, "{unit}")')
    return "{" + ", ".join(pairs) + "}"


def lacks_constants(table, name, layout, lacking, deflection, asked):
    """Return the error for missing constants of a cantilever."""
    head = table.heads[layout["force" if deflection else "piezo"][0]]
    what = (
        f"{head!r} is a deflection in {layout['force'][1]}"
        if deflection
        else f"{head!r} is the position of a piezo, which includes the deflection F/k"
    )
    hint = "" if deflection else ', or columns={"depth": …} if it is the depth of the tip'
    words = "" if deflection else ", or choose it as the depth of the tip if it is"
    give = " and ".join(f"{each}= ({CONSTANTS[each]})" for each in lacking)
    said = " and ".join(f"{WORDS_OF_CONSTANTS[each]} ({CONSTANTS[each]})" for each in lacking)
    return UnknownColumns(
        what,
        table,
        name.removesuffix(f", {table.name}") if table.name else name,
        asked,
        hint=f": give {give}{hint}",
        text=f"{what}: give {said}{words}",
        remedy=tuple(Remedy("give", each) for each in lacking),
    )
