"""What the page needs to know of a drive; every drive is one such value."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mdr_core as mdr

from ..trajectory import Trajectory


@dataclass(frozen=True)
class Drive:
    """What drives the indenter, as a person sets it and as `mdr.Scene` has it.

    `make` gives the value of a scene from what is set on the page. `owns` tells whether this drive shows a
    value of a scene, and `opened` gives choices and numbers to a scene from a file. `follow` gives all
    states of a scene with one at some progress, `deepest` its deepest one alone. `alike` gives numbers with
    which a state would be the deepest. `snippet` gives lines of Python that come to the present state, from
    a trajectory, the arguments of profile and medium, and a prefix of names; `saved` the value for a scene
    file. `form` are the choices and parts of the form that follow its numbers, `cells` further readouts,
    `words` more for the summary in a line, `duration` how long it takes (s) where that counts. `in_time`
    gives the states of a trajectory that is `pending`, for which a move has no time. `solver` is the
    function of the core for whole arrays, with the numbers that it takes, `results` what it gives.
    """

    make: Callable[[Any], Any]
    owns: Callable[[Any], bool]
    opened: Callable[[mdr.Scene], tuple[dict, dict]]
    follow: Callable[[mdr.Scene, float], Trajectory]
    deepest: Callable[[mdr.Scene], mdr.Indentation]
    alike: Callable[[Any, mdr.Indentation], dict]
    snippet: Callable[[Trajectory, str, str], list[str]]
    saved: Callable[[Trajectory], Any] = lambda way: way.scene.drive
    form: tuple[str, ...] = ()
    cells: Callable[[Trajectory], list] = lambda way: []
    words: Callable[[Any], list[str]] = lambda explorer: []
    duration: Callable[[Any], float | None] = lambda explorer: None
    in_time: Callable[[mdr.Scene], Trajectory] | None = None
    solver: tuple[str, ...] = ()
    results: tuple[str, ...] = ()
