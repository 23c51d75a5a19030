"""Modules above the solver, each imported at its first use (PEP 562), like the public names.

The solver calls them as `lazy.report.text(self)`. It has no other way upward. Type checkers and editors
read `lazy.pyi`.
"""

from importlib import import_module

#: The modules, and the reason why the solver needs each. A new module is a new line here, with its reason.
MODULES = {
    "shape": "solver.own.shape",  # checks a user's shape up to the contact radii of a calculation
    "law": "solver.own.law",  # checks a user's law of hardness, and evaluates it in the units of a cap
    "cap": "solver.own.cap",  # the rule of yield of a user's law, which may be any function
    "report": "show.report",  # a result as text, table or dataset
    "limits": "show.limits",  # the limits of a result as data and in words
    "plots": "show.plots",  # draws a result
    "hints": "show.hints",  # suggestions in an error for an unknown name
    "progress": "show.progress",  # shows the progress of a long calculation
    "tips": "measurements.files.tips",  # reads a tip from a file
}


def __getattr__(name):
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = import_module(f"mdr_core.{MODULES[name]}")
    # Python then finds the name without this function.
    globals()[name] = module
    return module
