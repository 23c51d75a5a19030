"""The seam of extras: tables that no session changes, no extra by name, hooks that several of them use."""

import re
from pathlib import Path

from app.common import quantities
from app.explorer import drives, extra, plot, plots, state
from app.explorer.page import Page

APP = Path(extra.__file__).parent
PAGE = [path for path in APP.glob("*.py") if path.stem not in ("main", "server_lifecycle")]


REGISTRIES = {
    "plots": plots.PLOTS,
    "overlays": plot.OVERLAYS,
    "drives": drives.DRIVES,
    "choices": quantities.CHOICES,
    "numbers": quantities.QUANTITIES,
    "values": state.OF_EXTRAS,
    "view": state.VIEW,
    "lists": state.LISTS,
    "extras": extra.EXTRAS,
}


def test_a_session_leaves_the_tables_of_extras_as_they_are():
    """They are those of all sessions."""
    before = {name: dict(each) for name, each in REGISTRIES.items()}
    page = Page()
    for name in state.PRESETS:
        page.apply(lambda now, name=name: state.preset_state(name))
    assert {name: dict(each) for name, each in REGISTRIES.items()} == before


def test_the_page_knows_no_extra_by_name_and_reads_nothing_that_one_of_them_computes():
    values = [name for name in state.OF_EXTRAS if "." in name]
    assert "held.scenes" in values
    for path in PAGE:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"computed(\[|\.get\()[\"']", text), path.name
        assert not [name for name in values if name in text], path.name


#: Names of what an extra may bring; `name` and `order` are its own.
HOOKS = [name for name in extra.Extra.__dataclass_fields__ if name not in ("name", "order")]


def brings(each, hook):
    default = extra.Extra("none")
    return getattr(each, hook) not in (getattr(default, hook), {}, ())


def test_a_hook_has_more_than_one_user():
    users = {hook: [n for n, each in extra.EXTRAS.items() if brings(each, hook)] for hook in HOOKS}
    # Compared scenes alone are a list in links, and have a part that is offered only if there are some.
    single = {"offered", "values"}
    alone = {hook: names for hook, names in users.items() if len(names) < 2 and hook not in single}
    assert alone == {}
    assert len(HOOKS) <= 14


def test_what_a_link_has_of_an_extra_is_of_the_state():
    page = Page("held.scenes=max_depth%3D5e-09&tiles=sweep&sweep.swept=mass")
    assert page.state["held.scenes"] == ("max_depth=5e-09",)
    assert [each.name for each in page.view.computed["held"]] == ["d_max = 5 nm"]
