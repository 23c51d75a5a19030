"""All numbers of the present state, in a table."""

from typing import Any

from ..extra import Extra
from ..plot import View
from ..readouts import readings, table
from ..ui import html, show


class Numbers:
    """The table of all readouts."""

    def __init__(self, page: Any):
        self.view = html("", "all-numbers")

    def show(self, view: View) -> None:
        course = view.course
        show(self.view, object=table(course, readings(course), course.now))


EXTRA = Extra("numbers", order=101, tab="All numbers", place="line", side=Numbers)
