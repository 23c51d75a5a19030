"""All extras: every module of this folder has one, as `EXTRA`, and its data in a JSON file of its name."""

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from mdr_core.show.units import UNITS

from ..drives import DRIVES
from ..extra import EXTRAS, Extra
from ..plot import OVERLAYS, rows_of
from ..plots import PLOTS
from ..quantities import CHOICES, QUANTITIES, Option, include, read_data
from ..readouts import MOST
from ..state import LISTS, OF_EXTRAS, VIEW, Entries, include_presets

_HERE = Path(__file__).parent


def _load() -> None:
    names = [module.name for module in iter_modules(__path__)]
    paths = {name: _HERE / f"{name}.json" for name in names}
    data = {name: _read(path) for name, path in paths.items() if path.exists()}
    for name, each in data.items():
        try:
            include(each)
        except (KeyError, TypeError) as error:
            raise ValueError(
                f"{name}.json does not describe a number, choice or readout: {error}"
            ) from error
    extras = {name: _extra(name) for name in names}
    for name, extra in extras.items():
        _check(name, extra, data.get(name, {}))
    _check_plots(extras)
    for name, extra in sorted(extras.items(), key=lambda each: each[1].order):
        _register(extra, data.get(name, {}))
    for name in sorted(PLOTS, key=lambda name: PLOTS[name].order):
        PLOTS[name] = PLOTS.pop(name)


def _read(path: Path) -> dict[str, Any]:
    try:
        return read_data(path)
    except ValueError as error:
        raise ValueError(f"{path.name} is not JSON: {error}") from None


def _extra(name: str) -> Extra:
    """The extra of a module."""
    try:
        return import_module(f".{name}", __name__).EXTRA
    except AttributeError as error:
        raise ValueError(f"{name}.py: {error}; it ends with EXTRA = Extra({name!r}, …)") from error


def _check_plots(extras: dict[str, Extra]) -> None:
    """Refuse two plots of one name, of which the page would have the last one."""
    owners = dict.fromkeys(PLOTS, "the page")
    for name, extra in extras.items():
        for plot in extra.plots:
            if plot.name in owners:
                raise ValueError(
                    f"extra {name}: {owners[plot.name]} has a plot {plot.name!r}, too; give another name"
                )
            owners[plot.name] = name


def _check(name: str, extra: Extra, data: dict[str, Any]) -> None:
    """Refuse what would fail on the page without a word."""

    def require(true: bool, message: str) -> None:
        if not true:
            raise ValueError(f"extra {name}: {message}")

    require(extra.name == name, f"it is called {extra.name!r}; give it the name of its file")
    for number in data.get("numbers", ()):
        called, kind = number["name"], number.get("kind")
        require(called.startswith(f"{name}."), f"number {called!r} must be called {name + '.' + called!r}")
        require(QUANTITIES[called].kind in UNITS, f"no unit of kind {kind!r} is known, of {called!r}")
    for choice, told in data.get("choices", {}).items():
        known = "." in choice or "label" not in told
        require(known, f"choice {choice!r} is not one of the page; call it {name + '.' + choice!r}")
    for drive, told in data.get("choices", {}).get("drive", {}).get("options", {}).items():
        line = told.get("line", ())
        require(
            len(line) <= MOST, f"drive {drive!r} has {len(line)} readouts in its line; give at most {MOST}"
        )
    for plot in extra.plots:
        require(plot.tab != "", f"plot {plot.name!r} has no tab, by which it is opened")
        called = [row.name for row in rows_of(plot)]
        require(len({*called}) == len(called), f"two rows of plot {plot.name!r} have the same name")
        for along in plot.axes:
            kinds = ", ".join(UNITS)
            require(along.kind in UNITS, f"no unit of kind {along.kind!r} is known; known are {kinds}")
        for choice in plot.controls:
            known = choice in CHOICES or choice in QUANTITIES
            require(known, f"no choice or number {choice!r} is known; add it to {name}.json")
            using = [key for key, option in _options(choice).items() if option.uses]
            require(not using, f"options of a choice above a plot use no numbers of the form: {using}")


def _options(name: str) -> dict[str, Option]:
    """Options of a choice, none of a number."""
    return CHOICES[name].options if name in CHOICES else {}


def _register(extra: Extra, data: dict[str, Any]) -> None:
    """Let the page have an extra; the data of its JSON file are included already."""
    OF_EXTRAS.update({each["name"]: QUANTITIES[each["name"]].default for each in data.get("numbers", ())})
    choices = [name for name in data.get("choices", {}) if "." in name]
    OF_EXTRAS.update({name: next(iter(CHOICES[name].options), "") for name in choices})
    lists = {name: entries for name, entries in extra.values.items() if isinstance(entries, Entries)}
    values = extra.values | dict.fromkeys(lists, ())
    LISTS.update(lists)
    OF_EXTRAS.update(values)
    VIEW.update(values)
    OVERLAYS.update({(extra.name, each.on, k): each for k, each in enumerate(extra.overlays)})
    DRIVES.update(extra.drives)
    PLOTS.update({plot.name: plot for plot in extra.plots})
    EXTRAS[extra.name] = extra
    include_presets(data)


_load()
