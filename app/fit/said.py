"""Remarks and refusals on the page: their texts, each with buttons for what one can do about it."""

from typing import Any

import panel as pn
from markupsafe import Markup

from mdr_core.numerics.remark import Remark, Remedy

from ..ui import WIDE, html, show
from . import words
from .refusals import Message
from .remedies import do, label

_TEXT, _REFUSED = Markup("<p>{}</p>"), Markup('<p class="refused" role="alert">{}</p>')


class Said:
    """Remarks below each other; `alert` for what a person waits for, as a refusal."""

    def __init__(self, page: Any, *classes: str, alert: bool = False):
        self._page, self._alert = page, alert
        self._shown: tuple[Any, ...] = ()
        self.view = pn.Column(css_classes=["said", *classes], visible=False, **WIDE)

    def show(self, *remarks: Remark | Message) -> None:
        """Show remarks in the place of those before; empty ones are none."""
        shown = tuple(
            (words.sentence(each.text, self._page.setting.file), self._offers(each))
            for each in remarks
            if each
        )
        if shown == self._shown:
            return
        self._shown = shown
        self.view.objects = [part for each in shown for part in self._parts(*each)]
        show(self.view, visible=bool(shown))

    @property
    def text(self) -> Markup:
        """All that is said (HTML)."""
        return Markup("").join(_TEXT.format(text) for text, _ in self._shown)

    @property
    def offers(self) -> dict[str, pn.widgets.Button]:
        """The buttons by their labels."""
        return {each.label: each for each in self.view.select(pn.widgets.Button)}

    def _offers(self, remark: Remark | Message) -> tuple[tuple[str, Remedy], ...]:
        labels = ((label(each, self._page), each) for each in remark.remedy)
        return tuple(each for each in labels if each[0])

    def _parts(self, text: Markup, offers: tuple[tuple[str, Remedy], ...]) -> list[Any]:
        kind, form = ("refusal", _REFUSED) if self._alert else ("remark", _TEXT)
        made = html(form.format(text), "note", kind)
        if not offers:
            return [made]
        buttons = []
        for name, remedy in offers:
            button = pn.widgets.Button(label=name, css_classes=["button"], margin=0)
            button.on_click(lambda event, remedy=remedy: do(remedy, self._page))
            buttons.append(button)
        return [made, pn.Row(*buttons, css_classes=["tools", "remedies"], **WIDE)]
