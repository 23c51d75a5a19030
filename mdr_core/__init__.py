"""Indentation and impact by the method of dimensionality reduction (MDR).

Axisymmetric rigid indenters on an elastic half-space with a non-local yield criterion (a hardness that
depends on the contact radius), mapped exactly onto a row of independent springs: V. L. Popov,
Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

import ast
from importlib import import_module
from importlib.util import find_spec
from operator import attrgetter
from pathlib import Path
from warnings import warn

from .base.check import no_attribute

__version__ = "0.9.0.dev0"

#: Modules of the public names, which type checkers and editors read, too. Each is imported when one of its
#: names is first asked for.
_STUB = ast.parse(Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
_MODULE_OF = {
    alias.name: node.module
    for node in _STUB.body
    if isinstance(node, ast.ImportFrom)
    for alias in node.names
}
#: Former names, which work in this version, and what they are now.
_FORMER = {
    "critical_force": "yield_force",
    "DepthPath": "scene.DepthPath",
    "ForcePath": "scene.ForcePath",
    "FreeImpact": "scene.FreeImpact",
    "FreeObliqueImpact": "scene.FreeObliqueImpact",
}

__all__ = sorted(_MODULE_OF)


def __dir__():
    return __all__


def __getattr__(name):
    if name in _FORMER:
        new = _FORMER[name]
        warn(f"mdr_core.{name} is mdr_core.{new} now", DeprecationWarning, stacklevel=2)
        return attrgetter(new)(import_module(__name__))
    if _MODULE_OF.get(name):
        value = getattr(import_module(f".{_MODULE_OF[name]}", __name__), name)
    elif name.isidentifier() and not name.startswith("__") and find_spec(f"{__name__}.{name}"):
        value = import_module(f".{name}", __name__)
    else:
        raise no_attribute("mdr_core", name, __all__)
    # The next time it is found without this function.
    globals()[name] = value
    return value
