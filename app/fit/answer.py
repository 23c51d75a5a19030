"""What stands largest on the page, one text for its state, and what is said above and below that."""

from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from mdr_core.numerics.remark import Remark

from . import words
from .refusals import Message

_HEAD, _ONE = Markup('<p class="big none">{}</p><p class="of">{}</p>'), Markup('<p class="big none">{}</p>')
_OF_POISSON = Markup('<p class="of">Give ν on the left for Young’s modulus E of the sample.</p>')
_WAITING = Markup('<p class="waiting" role="status">{} …</p>')


@dataclass(frozen=True)
class Answer:
    """The number, or what is to be done (HTML), empty for a welcome; and remarks above and below it."""

    large: Markup
    above: tuple[Remark | Message, ...] = ()
    below: tuple[Remark | Message, ...] = ()


def answer_of(page: Any) -> Answer:
    """What the page answers in its state."""
    if page.busy:
        return Answer(_WAITING.format(page.busy))
    if page.fit is not None:
        return _of_fit(page)
    if page.lacks:
        large = _HEAD.format("Give the spring constant k", "Then the fit runs at once.")
        return Answer(large, below=(page.lacks,))
    if page.curve is not None and page.setting.missing:
        return Answer(_HEAD.format(f"Give {page.setting.missing}", "Then the fit runs at once."))
    if page.refused and page.wants:
        return Answer(
            _HEAD.format("The curve is not read yet", "Give the missing information on the left.")
        )
    if page.refused:
        todo = "The reason is on the left. Drop another file, or correct this one."
        return Answer(_HEAD.format("This file cannot be read", todo))
    return Answer(_ONE.format("No fit")) if page.not_fitted else Answer(Markup(""))


def _of_fit(page: Any) -> Answer:
    told, quoted = page.told, page.told.quoted
    large = words.headline(told, page.E, words.assumed(page.setting))
    if quoted.value is None:
        why = Message(quoted.reason, quoted.remedy)
        return Answer(large, told.above, (why, *told.below))
    poisson = _OF_POISSON if page.setting.poisson is None else ""
    return Answer(large + poisson, told.above, told.below)
