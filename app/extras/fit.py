"""*Fit a measurement*: the link to the page for measurements."""

from typing import Any

from markupsafe import Markup

from ..extra import Extra
from ..parts import Part, text
from ..plot import View


def header(page: Any, view: View) -> Part:
    return text("fit", Markup('<a href="?fit">Fit a measurement</a>'), "way")


EXTRA = Extra("fit", order=5, header=header)
