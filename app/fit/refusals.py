"""Why something is refused, without names of Python, and what one can do about it."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from mdr_core.numerics.remark import Remark, Remedy

from ..quantities import in_words

#: Most characters of a message, which may quote a file.
_MOST = 2000


@dataclass(frozen=True)
class Message:
    """What the page says that is no remark on a curve; an empty one is nothing."""

    text: str
    remedy: tuple[Remedy, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.text)

    def changed(self, change: Callable[[str], str]) -> "Message":
        """The same with its text changed."""
        return replace(self, text=change(self.text))


#: Nothing is said.
NOTHING = Message("")


def refusal(error: Exception) -> tuple[str, tuple[Remedy, ...]]:
    """The values of a `Message` on an error of the core, or of a package that reads files."""
    text = in_words(error) if isinstance(error, ValueError) else str(error)
    return without_folders(text[:_MOST]), getattr(error, "remedy", ())


def deflection(remarks: tuple[Remark, ...]) -> Remark | None:
    """The remark that depths have the deflection of a cantilever of unknown stiffness in them, or None."""
    return next((each for each in remarks if each.kind == "deflection"), None)


def changed(remark: Remark, change: Callable[[str], str]) -> Remark:
    """A remark with its sentence and its text changed."""
    return Remark(change(remark), remark.kind, change(remark.text), remark.remedy)


def without_folders(text: str) -> str:
    """A message without the folders of the server, in which the paths of files begin."""
    return re.sub(r"(?<![\w.)])(?:[A-Za-z]:)?[/\\](?:[^/\\\s'\":]+[/\\]+)+", "", text)
