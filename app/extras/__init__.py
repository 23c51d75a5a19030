"""All extras: every module of this folder has one, as `EXTRA`, and its data in a JSON file of its name."""

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from ..changes import CONVERT, OFFERED
from ..drives import DRIVES
from ..extra import EXTRAS, Extra
from ..plots import PLOTS
from ..quantities import CHOICES, OF_DRIVE, QUANTITIES, include, read_data
from ..state import OF_EXTRAS, VIEW

_HERE = Path(__file__).parent


def _load() -> None:
    names = [module.name for module in iter_modules(__path__)]
    paths = {name: _HERE / f"{name}.json" for name in names}
    data = {name: read_data(path) for name, path in paths.items() if path.exists()}
    for each in data.values():
        include(each)
    extras: dict[str, Extra] = {name: import_module(f".{name}", __name__).EXTRA for name in names}
    for name, extra in sorted(extras.items(), key=lambda each: each[1].order):
        _register(extra, data.get(name, {}))
    _sort(PLOTS, key=lambda name: PLOTS[name].order)
    _sort(CHOICES["drive"], key=lambda name: OF_DRIVE[name]["order"])


def _register(extra: Extra, data: dict[str, Any]) -> None:
    """Let the page have an extra; the data of its JSON file are included already."""
    OF_EXTRAS.update({each["name"]: QUANTITIES[each["name"]].default for each in data.get("numbers", ())})
    OF_EXTRAS.update({name: next(iter(CHOICES[name]), "") for name in data.get("choices", {})})
    OF_EXTRAS.update(extra.values)
    VIEW.extend(extra.of_view)
    CONVERT.update(extra.converts)
    OFFERED.update(extra.offers)
    DRIVES.update(extra.drives)
    PLOTS.update({plot.name: plot for plot in extra.plots})
    EXTRAS[extra.name] = extra


def _sort(known: dict[str, Any], key: Any) -> None:
    """Sort the entries of a dictionary."""
    for name in sorted(known, key=key):
        known[name] = known.pop(name)


_load()
