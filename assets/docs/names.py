"""Index of the public names in the reference, and the base classes that it shows.

The index combines the reference pages and the first lines of the docstrings. It
replaces the comment `% index of names` in `reference/index.md`. Words for quantities
are added to the glossary.
"""

import re
from importlib import import_module
from pathlib import Path

from docutils import nodes

import mdr_core
from mdr_core.base.motions import ImpactResult
from mdr_core.base.results import Record, Result
from mdr_core.measurements.fit.report import Fit
from mdr_core.measurements.unloading.oliver_pharr_result import OliverPharr
from mdr_core.show.synonyms import SYNONYMS

_PAGES = Path(__file__).parent / "reference"
_PLACE = "% index of names"
#: In the glossary, the place of the words for quantities.
_QUANTITIES = "   .. words for quantities"
#: Base classes in the reference. Pages do not show others.
_BASES = mdr_core.Profile, Result, ImpactResult, Fit, OliverPharr, ValueError, str


def public(documented):
    """Return the name of a directive if it is public, and functions of a module."""
    name = documented.removeprefix("mdr_core.")
    if name not in mdr_core.__all__:
        return []
    if documented == name:
        return [name]
    module = import_module(documented)
    functions = getattr(module, "__all__", None) or re.findall(
        r"^def ([a-z]\w*)", _text(module), re.M
    )
    return [name, *(f"{name}.{each}" for each in functions)]


def _text(module):
    return Path(module.__file__).read_text(encoding="utf-8")


def index():
    """Return Markdown: a heading and a table for each page with public names."""
    order = re.search(
        r"```{toctree}(.*?)```", (_PAGES / "index.md").read_text("utf-8"), re.DOTALL
    )[1]
    parts = []
    for page in re.findall(r"^[a-z]+$", order, re.M):
        text = (_PAGES / f"{page}.md").read_text(encoding="utf-8")
        documented = re.findall(r"^\.\. auto\w+:: (\S+)", text, re.M)
        names = [name for each in documented for name in public(each)]
        if names:
            lines = "\n".join(f"   {name}" for name in names)
            title = text.partition("\n")[0].removeprefix("# ")
            head = (
                ".. currentmodule:: mdr_core\n\n.. autosummary::\n   :nosignatures:\n\n"
            )
            table = head + lines
            parts.append(f"## [{title}]({page}.md)\n\n```{{eval-rst}}\n{table}\n```\n")
    return "\n".join(parts)


def words_for_quantities():
    """Return entries of the glossary for the words of `SYNONYMS`."""
    entries = []
    for row in SYNONYMS:
        names = " and ".join(map(_linked, row.meanings[0]))
        words = "\n".join(f"   {word}" for word in row.words)
        entries.append(f"{words}\n      {names}. {row.note}".rstrip())
    return "\n\n".join(entries)


def _linked(quantity):
    """Return a quantity's name with a link to the first result that has it."""
    owners = mdr_core.Indentation, mdr_core.Impact, mdr_core.Motion
    owner = next((each.__name__ for each in owners if hasattr(each, quantity)), None)
    return f"`{owner}.{quantity}`" if owner else f"``{quantity}``"


def _write_index(app, docname, source):
    if docname == "reference/index":
        source[0] = source[0].replace(_PLACE, index())
        # It also changes with docstrings and with the other pages.
        app.env.note_reread()
    if docname == "words":
        source[0] = source[0].replace(_QUANTITIES, words_for_quantities())
        app.env.note_reread()


def _bases(app, name, owner, options, bases):
    bases[:] = [next((each for each in owner.__mro__[1:] if each in _BASES), object)]


def _signature(app, what, name, thing, options, signature, returns):
    """Remove the arguments of results, which only solvers make."""
    made_here = isinstance(thing, type) and issubclass(thing, Record)
    return ("", None) if made_here else None


def _tidy(app, doctree):
    """Remove the line "Bases: object"."""
    for line in list(doctree.findall(nodes.paragraph)):
        if line.astext() == "Bases: object":
            line.parent.remove(line)


def setup(app):
    app.connect("source-read", _write_index)
    app.connect("autodoc-process-bases", _bases)
    # Before numpydoc, at the usual priority of 500.
    app.connect("autodoc-process-signature", _signature, priority=400)
    app.connect("doctree-read", _tidy)
    return {"parallel_read_safe": True}
