"""Widgets of Panel as extras have them."""

from typing import Any

import panel as pn

from ..ui import WIDE


def button(name: str, **options: Any) -> pn.widgets.Button:
    return pn.widgets.Button(label=name, css_classes=["button"], **{"margin": 0} | options)


def field(kind: type, *classes: str, **options: Any) -> Any:
    return kind(css_classes=["choice", *classes], **WIDE | options)


def tools(*parts: Any, **options: Any) -> pn.Row:
    return pn.Row(*parts, css_classes=["tools"], **WIDE | options)
