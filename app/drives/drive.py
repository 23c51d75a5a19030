"""What the page needs to know of a drive: each is a class of these methods, and one instance of it."""

from dataclasses import fields

import numpy as np


class Drive:
    """What drives the indenter, as a person sets it and as `mdr.Scene` has it.

    A subclass has, besides what is here: `make`, which gives the value of a scene from what is set on the
    page; `opened`, choices and numbers for a scene from a file; `follow`, the `Trajectory` of a scene with
    a state at some progress, and where a move has no time for all of it `in_time`, the full one; `deepest`,
    the deepest state of a scene alone; `alike`, numbers with which a state would be the deepest; `snippet`,
    lines of Python that come to the present state, from the arguments of profile and medium and a prefix of
    names.

    `values` are the types of the values of a scene, `form` the choices and parts of the form that follow
    its numbers. `solver` is the function of the core for whole arrays, with the numbers that it takes,
    `results` what it gives.
    """

    values, form, solver, results = (), (), (), ()

    def owns(self, value):
        """Whether this drive shows a value of a scene."""
        return isinstance(value, self.values)

    def saved(self, way):
        """The value for a scene file."""
        return way.scene.drive

    def cells(self, way):
        """Further readouts."""
        return []

    def words(self, explorer):
        """More for the summary in a line."""
        return []

    def duration(self, explorer):
        """How long it takes (s), where that counts."""


def arguments(value, written=repr):
    """The fields of a value of the core as arguments in Python, without what it takes by default."""
    own = {each.name: getattr(value, each.name) for each in fields(value)}
    usual = {each.name: each.default for each in fields(value)}
    return named({n: own[n] for n in own if not np.array_equal(own[n], usual[n])}, written)


def named(numbers, written=repr):
    """Numbers by their names as arguments in Python."""
    numbers = {n: v.item() if isinstance(v, np.generic) else v for n, v in numbers.items()}
    return ", ".join(f"{name}={written(number)}" for name, number in numbers.items())
