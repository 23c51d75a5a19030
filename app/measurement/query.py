"""The link of the page: chosen and typed values, in SI, and options of the reader."""

from contextlib import suppress
from dataclasses import dataclass, field
from math import isfinite
from typing import Any
from urllib.parse import parse_qsl, urlencode

from mdr_core.measurements.reading import WORDS

from ..common.upload import in_line
from .choices import FITTED, MEDIA, NUMBERS, TIPS

#: Largest numbers of characters of a link, and of parts of a table in it.
_LENGTH, _PARTS = 4000, 100
#: Quantities of the columns of a table, and largest number of characters of their units.
_ROLES, _UNIT = ("depth", "piezo", "force", "time", "stiffness"), 12


@dataclass(frozen=True)
class Link:
    """Content of a link.

    `numbers` differ from the defaults of the kind of sample; None is a fitted parameter. `samples` are the
    numbers of the first and last sample, () for the default of the kind of sample. `options` are `columns`
    and `by` of `mdr_core.read_curves`.
    """

    file: str = ""
    curve: int = 0
    tip: str = ""
    medium: str = ""
    numbers: dict[str, float | None] = field(default_factory=dict)
    samples: tuple[int, ...] = ()
    options: dict[str, Any] = field(default_factory=dict)

    def query(self) -> str:
        """Return the link as a query."""
        pairs = {"file": self.file, "tip": self.tip, "medium": self.medium, "curve": self.curve or ""}
        pairs |= {"samples": "{}-{}".format(*self.samples) if self.samples else ""}
        pairs |= {name: "free" if value is None else repr(value) for name, value in self.numbers.items()}
        pairs |= _pairs(self.options.get("columns") or {}, self.options.get("by"))
        return urlencode({name: value for name, value in pairs.items() if value != ""}, safe=",;")


def read(query: str) -> Link:
    """Decode a link, without unknown names and invalid values."""
    given = dict(parse_qsl(query[:_LENGTH]))
    numbers: dict[str, float | None] = {}
    for name, known in (NUMBERS | FITTED).items():
        if given.get(name) == "free" and name in FITTED:
            numbers[name] = None
        with suppress(KeyError, ValueError):
            value = float(given[name])
            if isfinite(value) and known.low <= value <= known.high:
                numbers[name] = value
    samples: tuple[int, ...] = ()
    with suppress(KeyError, ValueError):
        first, last = (int(each) for each in given["samples"][:20].split("-"))
        samples = (first, last) if 1 <= first < last else ()
    columns, by = _columns(given), _by(given)
    curve = given.get("curve", "")[:6]
    return Link(
        in_line(given.get("file", "")), int(curve) if _is_number(curve) else 0,
        given.get("tip", "") if given.get("tip") in TIPS else "",
        given.get("medium", "") if given.get("medium") in MEDIA else "", numbers, samples,
        ({"columns": columns} if columns else {}) | ({} if by is None else {"by": by}),
    )  # fmt: skip


def _pairs(columns: Any, by: Any) -> dict[str, str]:
    """Encode `columns` and `by` as pairs of a query; semicolons separate several parts."""
    parts = columns if isinstance(columns, list) else [columns]
    pairs: dict[str, str] = {}
    for role in _ROLES:
        if any(role in part for part in parts):
            cells = [part.get(role, ("", "")) for part in parts]
            texts = ("none" if cell is None else f"{cell[0]},{cell[1]}" for cell in cells)
            pairs[f"{role}_column"] = ";".join(texts)
    if by is not None:
        pairs["by"] = ",".join(map(str, by)) if isinstance(by, list) else str(by)
    return pairs


def _columns(given: dict[str, str]) -> Any:
    """Decode the columns in a link: a dictionary, or a list for several parts."""
    texts = {role: given.get(f"{role}_column", "").split(";")[:_PARTS] for role in _ROLES}
    parts: list[dict[str, Any]] = [{} for _ in range(max(map(len, texts.values())))]
    for role, cells in texts.items():
        for part, cell in zip(parts, cells, strict=False):
            number, _, unit = cell.partition(",")
            if cell == "none" and role == "time":
                part[role] = None
            elif _is_number(number) and len(unit) < _UNIT:
                part[role] = int(number), unit
    return parts if len(parts) > 1 else parts[0]


def _by(given: dict[str, str]) -> Any:
    """Decode `by`: a word, the number of a column, several numbers, or None if it is invalid."""
    text = given.get("by", "")
    numbers = text.split(",")
    if text in WORDS:
        return text
    if not all(map(_is_number, numbers)):
        return None
    return int(text) if len(numbers) == 1 else [int(number) for number in numbers[:_PARTS]]


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= 6
