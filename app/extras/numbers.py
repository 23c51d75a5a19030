"""All numbers of the present state, in a table."""

from typing import Any

from ..courses import Course
from ..extra import Extra
from ..plot import View
from ..readouts import head, readings, text
from ..ui import html, show


class Numbers:
    """The table of all readouts."""

    def __init__(self, page: Any):
        self.view = html("", "all-numbers")

    def show(self, view: View) -> None:
        show(self.view, object=table(view.course))


def table(course: Course) -> str:
    """All numbers of the present state, as HTML."""
    rows = (
        f'<tr data-name="{each.name}"><th>{head(each)}</th><td>{text(each, value, course.now)}</td></tr>'
        for each, value in readings(course).items()
    )
    return f"<table>{''.join(rows)}</table>"


EXTRA = Extra("numbers", order=99, tab="All numbers", place="over", side=Numbers)
