"""What a person tells the reader of a file, columns and what parts curves: in the form, and in a link."""

from typing import Any

from mdr_core.reading import WORDS

#: Quantities of a column that a link names.
_ROLES = "depth", "piezo", "force", "time", "stiffness"
#: Most parts of a table, and characters of a unit, in a link.
_PARTS, _UNIT = 100, 12


def told_pairs(columns: Any, by: Any) -> dict[str, str]:
    """Pairs of a query; columns of several parts are separated by semicolons."""
    parts = columns if isinstance(columns, list) else [columns]
    pairs: dict[str, str] = {}
    for role in _ROLES:
        if any(role in part for part in parts):
            cells = [part.get(role, ("", "")) for part in parts]
            pairs[f"{role}_column"] = ";".join(
                "none" if cell is None else f"{cell[0]},{cell[1]}" for cell in cells
            )
    if by is not None:
        pairs["by"] = ",".join(map(str, by)) if isinstance(by, list) else str(by)
    return pairs


def told_columns(given: dict[str, str]) -> Any:
    """Columns that a link gives to the reader: one choice, or a list of several parts."""
    texts = {role: given.get(f"{role}_column", "").split(";")[:_PARTS] for role in _ROLES}
    count = max(map(len, texts.values()))
    parts: list[dict[str, Any]] = [{} for _ in range(count)]
    for role, cells in texts.items():
        for part, cell in zip(parts, cells, strict=False):
            number, _, unit = cell.partition(",")
            if cell == "none" and role == "time":
                part[role] = None
            elif _is_number(number) and len(unit) < _UNIT:
                part[role] = int(number), unit
    return parts if count > 1 else parts[0]


def told_by(given: dict[str, str]) -> Any:
    """What a link says that parts the curves: one of the words, a number of a column, or several."""
    text = given.get("by", "")
    if text in WORDS:
        return text
    numbers = text.split(",")
    if not all(map(_is_number, numbers)):
        return None
    return int(text) if len(numbers) == 1 else [int(number) for number in numbers[:_PARTS]]


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) < 4


def heads_of(table: Any, words: Any = ()) -> dict[str, int]:
    """Names of the columns of a table, with their first numbers where they have none, and their numbers."""
    firsts = {k: ", ".join(f"{x:.3g}" for x in values[:3]) for k, values in table.values.items()}
    found = {f"{k + 1}: {head or firsts[k] + ' …'}": k for k, head in table.heads.items()}
    for key in words:
        number, _, head = key.partition(" ")
        found[f"{number}: {head or 'words'}"] = int(number) - 1
    return found


def of_parts(layouts: list[dict[str, Any]], given: dict[str, Any]) -> list[dict[str, Any]]:
    """Columns of several parts, the first as it is chosen, the others with its units."""
    named = {"piezo" if "piezo" in given else "depth": "depth"}
    parts = [given]
    for layout in layouts[1:]:
        place = layout.get("piezo") or layout["depth"]
        columns = {"depth": place, "force": layout["force"], "time": layout.get("time")}
        parts.append(
            {
                role: (columns[named.get(role, role)][0], given[role][1])
                for role in given
                if given[role] and columns.get(named.get(role, role))
            }
        )
    return parts
