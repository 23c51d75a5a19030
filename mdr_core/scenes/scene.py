"""Scenes of an indenter, a medium and a drive: solve, save and load them."""

import json
import os
from dataclasses import asdict, dataclass, fields, is_dataclass

import numpy as np

from ..base.check import one_of, shown
from ..base.errors import MDRError
from ..base.results import Model
from ..show.quantities import at_default
from ..solver.applicability import check_pair, refuse_own_law
from ..solver.contact.indentation import Indentation
from ..solver.foundation.chain_impact import ChainImpact
from ..solver.foundation.depth_path import TimedIndentation
from ..solver.impacts.result import Impact
from ..solver.medium.medium import Medium
from ..solver.medium.modes import Modes
from ..solver.medium.structure import Structure
from ..solver.oblique.oblique_impact import ObliqueImpact
from ..solver.profiles import power, rounded, sampled, truncated
from ..solver.profiles.profile import Profile
from .drives import DepthPath, ForcePath, FreeImpact, FreeObliqueImpact

_PROFILES = (
    power.FlatPunch, power.Cone, power.Paraboloid, power.PowerLaw, rounded.Sphere, rounded.Hyperboloid,
    rounded.RoundedCone, rounded.ParabolicPunch, truncated.TruncatedCone, truncated.TruncatedParaboloid,
    truncated.RoundedPunch, sampled.Sampled,
)  # fmt: skip
_DRIVES = (DepthPath, ForcePath, FreeImpact, FreeObliqueImpact)
#: Default values of the optional entries in a file.
_OPTIONAL = {"time": None, "poisson": 0.5, "work_of_adhesion": 0.0, "plastic_depth": 0.0}
_OPTIONAL |= {"hardness": None, "f_c": None, "structure": None, "modes": None}
#: Default values of entries that are optional in one class and have another meaning in other classes.
_OPTIONAL_OF = {Structure: {"mass": None}}
#: Parameters whose infinite values are written as null.
_INFINITE = {Medium: ("q_c",), Structure: ("impedance", "stiffness")}
#: Remedy for a user's law of hardness, whose class a file does not contain.
_NOT_KEPT = "keep the script that makes the law, or pickle the scene where its class can be imported"
_FORMAT, _VERSION = "mdr-scene", 1
_EXPECTED = {
    "profile": "Profile",
    "medium": "Medium",
    "drive": "DepthPath, ForcePath, FreeImpact or FreeObliqueImpact",
}


@dataclass(frozen=True)
class Scene:
    """Whole calculation as one value: an indenter, a medium and a drive.

    Parameters
    ----------
    profile, medium
        The indenter, a `Profile`, and the `Medium`.
    drive : DepthPath, ForcePath, FreeImpact or FreeObliqueImpact
        Path of the indenter, or impact.

    Raises
    ------
    TypeError
        If an argument has another type.
    ValueError
        If parameters of profile or medium are arrays: a scene is a single problem.

    Examples
    --------
    >>> from mdr_core import Cone, Medium
    >>> from mdr_core.scene import DepthPath, Scene
    >>> scene = Scene(Cone(slope=1.0), Medium(E_star=1.0), DepthPath(2.0))
    >>> print(round(scene.solve().force, 9))  # 2E* d²/(π s)
    2.546479089
    """

    profile: Profile
    medium: Medium
    drive: DepthPath | ForcePath | FreeImpact | FreeObliqueImpact

    def __post_init__(self):
        for name, kind in (("profile", Profile), ("medium", Medium), ("drive", _DRIVES)):
            if not isinstance(getattr(self, name), kind):
                raise TypeError(
                    f"scene {name} must be a {_EXPECTED[name]}, got {shown(getattr(self, name))}"
                )
        check_pair(self.profile, self.medium, "a scene")

    @property
    def models(self) -> tuple[Model, ...]:
        """Models for the scene, the cheapest exact model first."""
        return self.drive.models(self.medium)

    def solve(
        self, model: str | None = None
    ) -> Indentation | TimedIndentation | Impact | ChainImpact | ObliqueImpact:
        """Solve the scene.

        `result.model` is the model, and `result.model.reason` the reason for its choice.

        Parameters
        ----------
        model : {"closed form", "scalar ODE", "chain", "chain with friction"}, optional
            One of `models`, for a comparison; by default the cheapest exact model.

        Examples
        --------
        >>> from mdr_core import Cone, Medium
        >>> from mdr_core.scene import FreeImpact, Scene
        >>> scene = Scene(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), FreeImpact(1e-9, 0.1))
        >>> print(scene.models, round(scene.solve().restitution, 6))
        ('closed form', 'scalar ODE', 'chain') 0.200701
        """
        model = self.models[0] if model is None else one_of("model of this scene", model, self.models)
        return self.drive.solve(self.profile, self.medium, model)

    def to_json(self) -> str:
        """Return the scene as JSON text with exact numbers.

        Infinite values and a missing Poisson ratio are null. A user's law of hardness raises MDRError,
        because the file would not contain its class.
        """
        refuse_own_law(self.medium, "a scene as JSON", _NOT_KEPT)
        return json.dumps(
            {
                "format": _FORMAT,
                "version": _VERSION,
                "profile": _tagged(self.profile),
                "medium": _with_null(self.medium),
                "drive": _tagged(self.drive),
            },
            indent=1,
            allow_nan=False,
        )

    def to_python(self) -> str:
        """Return Python code that makes and solves the scene, without arguments at their defaults.

        A user's law of hardness raises MDRError, because the code would not contain its class.

        Examples
        --------
        >>> from mdr_core import Cone, Medium
        >>> from mdr_core.scene import DepthPath, Scene
        >>> print(Scene(Cone(slope=1.0), Medium(E_star=1.0), DepthPath(2.0)).to_python())
        import mdr_core as mdr
        <BLANKLINE>
        scene = mdr.Scene(
            mdr.Cone(slope=1.0),
            mdr.Medium(E_star=1.0),
            mdr.scene.DepthPath(depth=2.0),
        )
        result = scene.solve()
        <BLANKLINE>
        """
        refuse_own_law(self.medium, "a scene as Python", _NOT_KEPT)
        parts = "".join(f"    {_constructed(getattr(self, each.name))},\n" for each in fields(self))
        return f"import mdr_core as mdr\n\nscene = mdr.Scene(\n{parts})\nresult = scene.solve()\n"

    @classmethod
    def from_json(cls, text: str | bytes) -> "Scene":
        """Read a scene from the text of `to_json`.

        Raises
        ------
        ValueError
            If the text is not JSON, not a scene, or has a value outside its range.

        Examples
        --------
        >>> from mdr_core import Cone, Medium
        >>> from mdr_core.scene import DepthPath, Scene
        >>> scene = Scene(Cone(slope=1.0), Medium(E_star=1.0), DepthPath(2.0))
        >>> Scene.from_json(scene.to_json()) == scene
        True
        """
        if isinstance(text, os.PathLike) or (isinstance(text, str) and text.strip().endswith(".json")):
            name, remedy = shown(str(text)), "Scene.from_json(pathlib.Path(name).read_text())"
            raise MDRError(
                f"scene: {name} is the name of a file, not JSON text: read it first, as in {remedy}"
            )
        try:
            data = json.loads(text, parse_constant=_no_constant, object_pairs_hook=_no_duplicates)
        except RecursionError:
            raise MDRError("scene: JSON is nested too deeply") from None
        except UnicodeDecodeError as error:
            raise MDRError(f"scene: not UTF-8 text ({error.reason})") from None
        except ValueError as error:
            raise MDRError(f"scene: not JSON text ({error})") from None
        _keys("scene", data, {"format", "version", "profile", "medium", "drive"})
        if data["format"] != _FORMAT or data["version"] != _VERSION:
            raise MDRError(
                f"scene: format {shown(data['format'])} version {shown(data['version'])} is not supported; "
                f"it must be {_FORMAT!r} version {_VERSION}"
            )
        drive = data["drive"]
        if isinstance(drive, dict) and (structure := drive.get("structure")) is not None:
            if isinstance(structure, dict) and structure.get("modes") is not None:
                structure = structure | {"modes": _build("modes", structure["modes"], Modes)}
            drive = drive | {"structure": _build("structure", structure, Structure)}
        return cls(
            _untagged("profile", data["profile"], _PROFILES),
            _build("medium", data["medium"], Medium),
            _untagged("drive", drive, _DRIVES),
        )


def _constructed(value):
    """Return a value as a call of its class."""
    if not is_dataclass(value):
        return repr(np.asarray(value).tolist())
    if isinstance(value, Structure) and value.modes is not None:
        own = asdict(value.modes) | {"stiffness": value.stiffness, "thickness": value.thickness}
        given = [f"{k}={_constructed(v)}" for k, v in own.items() if v is not None and v != np.inf]
        return f"mdr.Structure.modal({', '.join(given)})"
    own = [(each, getattr(value, each.name)) for each in fields(value) if each.init]
    given = [f"{each.name}={_constructed(part)}" for each, part in own if not at_default(each, part)]
    module = "mdr.scene" if isinstance(value, _DRIVES) else "mdr"
    return f"{module}.{type(value).__name__}({', '.join(given)})"


def _tagged(value):
    if type(value) not in _PROFILES + _DRIVES:
        raise MDRError(f"a {type(value).__name__} cannot be written as JSON")
    parts = {field.name: getattr(value, field.name) for field in fields(value)}
    nested = {name: _with_null(part) for name, part in parts.items() if isinstance(part, Structure)}
    return {"type": type(value).__name__} | asdict(value) | nested


def _with_null(value):
    """Return the parameters of a medium or a structure, with None for infinite values."""
    return {k: None if isinstance(v, float) and np.isinf(v) else v for k, v in asdict(value).items()}


def _untagged(what, data, kinds):
    kinds = {kind.__name__: kind for kind in kinds}
    if not isinstance(data, dict) or not isinstance(data.get("type"), str) or data["type"] not in kinds:
        raise MDRError(f"scene: {what} needs a type, one of {', '.join(kinds)}")
    return _build(what, {k: v for k, v in data.items() if k != "type"}, kinds[data["type"]])


def _build(what, data, kind):
    names = {field.name for field in fields(kind)}
    if isinstance(data, dict):
        optional = _OPTIONAL | _OPTIONAL_OF.get(kind, {})
        data = {name: optional[name] for name in names & optional.keys()} | data
        data |= {name: np.inf for name in _INFINITE.get(kind, ()) if name in data and data[name] is None}
    _keys(f"scene {what}", data, names)
    try:
        return kind(**data)
    except (TypeError, ValueError, OverflowError) as error:
        raise MDRError(f"scene {what}: {error}") from None


def _keys(what, data, expected):
    if not isinstance(data, dict) or set(data) != expected:
        names = ", ".join(sorted(map(str, data)))[:200] if isinstance(data, dict) else type(data).__name__
        raise MDRError(
            f"{what} must have exactly {', '.join(sorted(expected))}; got {names or 'none of them'}"
        )


def _no_constant(name):
    raise MDRError(f"{name} is not a finite number")


def _no_duplicates(pairs):
    data = dict(pairs)
    if len(data) < len(pairs):
        raise MDRError("a key is repeated")
    return data
