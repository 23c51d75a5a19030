"""Modules above the solver, each imported when it is first asked for (PEP 562), as the public names are.

What solves asks for them as `lazy.report.text(self)`. This is the one way upward. Type checkers and editors
read `lazy.pyi`.
"""

from importlib import import_module

#: Where they are, and why they are asked for: a new one is a line here, with its reason.
MODULES = {
    "shape": "solver.own.shape",  # a user's shape is admitted, up to the contact radii that are reached
    "law": "solver.own.law",  # a user's law of hardness is admitted, and asked in the units of a cap
    "cap": "solver.own.cap",  # the rule of yield of a law of which nothing is known beforehand
    "report": "show.report",  # a result as text, table or dataset
    "limits": "show.limits",  # the limits of a result as data and in words
    "plots": "show.plots",  # a result is drawn
    "hints": "show.hints",  # an error says what is meant by a name that is not here
    "progress": "show.progress",  # a long calculation says how far it is
    "tips": "measurements.files.tips",  # a tip is read from a file
}


def __getattr__(name):
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = import_module(f"mdr_core.{MODULES[name]}")
    # The next time it is found without this function.
    globals()[name] = module
    return module
