"""All extras: every module of this folder has an `EXTRA`, and its data in a JSON file of the same name."""

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from ...common.quantities import CHOICES, QUANTITIES, include, read_data
from ..drives import DRIVES
from ..extra import EXTRAS, Extra
from ..plot import OVERLAYS
from ..plots import PLOTS
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
    for extra in sorted(map(_extra, names), key=lambda extra: extra.order):
        _register(extra, data.get(extra.name, {}))
    for name in sorted(PLOTS, key=lambda name: PLOTS[name].order):
        PLOTS[name] = PLOTS.pop(name)


def _read(path: Path) -> dict[str, Any]:
    try:
        return read_data(path)
    except ValueError as error:
        raise ValueError(f"{path.name} is not JSON: {error}") from None


def _extra(name: str) -> Extra:
    """Return the extra of a module."""
    try:
        return import_module(f".{name}", __name__).EXTRA
    except AttributeError as error:
        raise ValueError(f"{name}.py: {error}; it must end with EXTRA = Extra({name!r}, …)") from error


def _register(extra: Extra, data: dict[str, Any]) -> None:
    """Register an extra, after the data of its JSON file."""
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
