"""All extras: every module of this folder has one, as `EXTRA`, and its data in a JSON file of its name."""

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from ..extra import Extra, register
from ..quantities import include, read_data

_HERE = Path(__file__).parent


def _load() -> None:
    names = [module.name for module in iter_modules(__path__)]
    paths = {name: _HERE / f"{name}.json" for name in names}
    data = {name: read_data(path) for name, path in paths.items() if path.exists()}
    for each in data.values():
        include(each)
    extras: dict[str, Extra] = {name: import_module(f".{name}", __name__).EXTRA for name in names}
    for name, extra in sorted(extras.items(), key=lambda each: each[1].order):
        register(extra, data.get(name, {}))


_load()
