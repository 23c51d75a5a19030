"""Indentation and impact by the method of dimensionality reduction (MDR).

The contact of an axisymmetric rigid indenter with an elastic half-space is mapped exactly onto a row of
independent springs. The yield criterion is non-local: the hardness depends on the contact radius. See
V. L. Popov, Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

import ast
from importlib import import_module
from importlib.util import find_spec
from operator import attrgetter
from pathlib import Path
from warnings import warn

from .base.check import no_attribute

__version__ = "0.9.0"

#: Modules of the public names, also read by type checkers and editors. A module is imported at the first
#: access to one of its names.
_STUB = ast.parse(Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
_MODULE_OF = {
    alias.name: node.module
    for node in _STUB.body
    if isinstance(node, ast.ImportFrom)
    for alias in node.names
}
#: Former names, which still work in this version, and their present names.
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
    # Python then finds the name without this function.
    globals()[name] = value
    return value
