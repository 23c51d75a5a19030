"""A scene: what is to be modelled, as a value that can be saved, loaded and solved."""

import json
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields, replace
from typing import ClassVar

import numpy as np

from . import _check
from ._check import ArrayLike, Parameter, one_of, shown
from .dynamics.impact import Impact, solve_impact
from .foundation.depth_path import TimedIndentation, check_times, indent_in_time
from .foundation.force_path import creep
from .foundation.impact import ChainImpact, chain_impact
from .indentation import Indentation, indent, indent_to_force
from .medium import Medium, check_pair
from .results import CHAIN, CLOSED_FORM, SCALAR_ODE, Model
from .shapes import power, rounded, sampled, truncated
from .shapes.profile import Profile


def _path(quantity, values, unit):
    values = _check.finite_array(quantity, values, unit=unit)
    if values.ndim > 1 or not values.size:
        raise ValueError(f"{quantity} must be a number or a path, got shape {values.shape}")
    return tuple(values.tolist()) if values.ndim else values.item()


def _times(quantity, values, path):
    if values is None:
        return None
    return tuple(check_times(values, np.asarray(path), quantity).tolist())


class _Path:
    """A path of one quantity, the first field of a subclass, with or without `time`.

    A subclass says its unit, and what follows it infinitely slowly and in time.
    """

    _unit: ClassVar[str]
    _slowly: ClassVar[Callable[..., Indentation]]
    _in_time: ClassVar[Callable[..., TimedIndentation]]
    time: ArrayLike | None

    def __post_init__(self):
        name = self._name
        object.__setattr__(self, name, _path(f"{type(self).__name__} {name}", self._path, self._unit))
        object.__setattr__(self, "time", _times(name, self.time, self._path))

    _name = property(lambda self: fields(self)[0].name)
    _path = property(lambda self: getattr(self, self._name))

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Names of the models that can solve it, the cheapest that is exact first."""
        return (CHAIN,) if self.time and medium.eta > 0 else (CLOSED_FORM, CHAIN)

    def solve(self, profile, medium, model):
        """The `Indentation` along this path, or on the chain the `TimedIndentation`."""
        if model == CLOSED_FORM:
            return type(self)._slowly(profile, medium, self._path)
        path, time = np.atleast_1d(self._path), self.time
        if time is None:
            # Infinitely slow is without viscosity, at whatever times.
            time, medium = np.arange(float(path.size)), replace(medium, eta=0.0)
        result = type(self)._in_time(profile, medium, path, np.asarray(time))
        return result if np.ndim(self._path) else result[0]


@dataclass(frozen=True)
class DepthPath(_Path):
    """Press along prescribed depths.

    Parameters
    ----------
    depth : float or sequence of float
        Indentation depth (m), one or a path.
    time : sequence of float, optional
        Increasing times (s) of a path; without them it is followed infinitely slowly.
    """

    depth: Parameter
    time: ArrayLike | None = None

    _unit, _slowly, _in_time = "m", staticmethod(indent), staticmethod(indent_in_time)


@dataclass(frozen=True)
class ForcePath(_Path):
    """Press with prescribed forces.

    Parameters
    ----------
    force : float or sequence of float
        Normal force (N), one or a path; not negative.
    time : sequence of float, optional
        Increasing times (s) of a path; without them it is followed infinitely slowly.
    """

    force: Parameter
    time: ArrayLike | None = None

    _unit, _slowly, _in_time = "N", staticmethod(indent_to_force), staticmethod(creep)


@dataclass(frozen=True)
class FreeImpact:
    """Let a free body hit the medium.

    Parameters
    ----------
    mass : float
        Mass m (kg), positive.
    speed : float
        Speed v₀ (m/s) at first contact, positive.
    plastic_depth : float
        Plastic depth (m) that earlier impacts on the same spot have left; 0, the default, is a virgin
        surface.
    """

    mass: float
    speed: float
    plastic_depth: float = 0.0

    def __post_init__(self):
        for name, unit in (("mass", "kg"), ("speed", "m/s"), ("plastic_depth", "m")):
            quantity = f"FreeImpact {name}"
            value = _check.number(quantity, getattr(self, name), unit)
            value = _check.positive(quantity, value, unit=unit, zero=name == "plastic_depth")
            object.__setattr__(self, name, float(value))

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Names of the models that can solve it, the cheapest that is exact first.

        The chain hits an imprint by `chain_impact(start=…)`: the depth alone does not set it up.
        """
        models = (SCALAR_ODE, CHAIN) if medium.eta > 0 else (CLOSED_FORM, SCALAR_ODE, CHAIN)
        return models[:-1] if self.plastic_depth > 0 else models

    def solve(self, profile, medium, model):
        """The `Impact` of this body, or on the chain the `ChainImpact`."""
        if model == CHAIN:
            return chain_impact(profile, medium, self.mass, self.speed)
        in_time = model == SCALAR_ODE
        return solve_impact(profile, medium, self.mass, self.speed, self.plastic_depth, in_time=in_time)


_PROFILES = {
    shape.__name__: shape
    for shape in (
        power.FlatPunch,
        power.Cone,
        power.Paraboloid,
        power.PowerLaw,
        rounded.Sphere,
        rounded.Hyperboloid,
        rounded.RoundedCone,
        rounded.ParabolicPunch,
        truncated.TruncatedCone,
        truncated.TruncatedParaboloid,
        truncated.RoundedPunch,
        sampled.Sampled,
    )
}
_DRIVES = {drive.__name__: drive for drive in (DepthPath, ForcePath, FreeImpact)}
_FORMAT, _VERSION = "mdr-scene", 1


@dataclass(frozen=True)
class Scene:
    """An indenter, a medium, and what is done with them.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium.
    drive : DepthPath, ForcePath or FreeImpact
        What drives the indenter.

    Examples
    --------
    >>> from mdr_core import Cone, Medium
    >>> scene = Scene(Cone(slope=1.0), Medium(E_star=1.0), DepthPath(2.0))
    >>> Scene.from_json(scene.to_json()) == scene
    True
    >>> print(round(scene.solve().force, 9))  # 2E* d²/(π s)
    2.546479089
    """

    profile: Profile
    medium: Medium
    drive: DepthPath | ForcePath | FreeImpact

    def __post_init__(self):
        for name, kind in (("profile", Profile), ("medium", Medium), ("drive", tuple(_DRIVES.values()))):
            if not isinstance(getattr(self, name), kind):
                raise TypeError(f"scene {name} is of the wrong type: {shown(getattr(self, name))}")
        check_pair(self.profile, self.medium, "a scene")

    @property
    def models(self) -> tuple[Model, ...]:
        """Models that can solve the scene, the cheapest that is exact for it first."""
        return self.drive.models(self.medium)

    def solve(self, model: str | None = None) -> Indentation | TimedIndentation | Impact | ChainImpact:
        """Results of the scene; `result.model` says how they were found, `result.model.reason` why.

        Parameters
        ----------
        model : {"closed form", "scalar ODE", "chain"}, optional
            Another model than the cheapest that is exact, to compare: one of `models`.

        Returns
        -------
        Indentation, TimedIndentation, Impact or ChainImpact

        Examples
        --------
        >>> from mdr_core import Cone, Medium
        >>> scene = Scene(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), FreeImpact(1e-9, 0.1))
        >>> exact, chain = scene.solve(), scene.solve(model="chain")
        >>> print(exact.model, chain.model, abs(chain.restitution - exact.restitution) < 1e-6)
        closed form chain True
        """
        if model is None:
            return self.drive.solve(self.profile, self.medium, self.models[0])
        one_of("model of this scene", model, self.models)
        return self.drive.solve(self.profile, self.medium, model)

    def to_json(self) -> str:
        """The scene as JSON text, every number exact; an infinite yield constant as null."""
        return json.dumps(
            {
                "format": _FORMAT,
                "version": _VERSION,
                "profile": _tagged(self.profile, _PROFILES),
                "medium": {k: None if np.isinf(v) else v for k, v in asdict(self.medium).items()},
                "drive": _tagged(self.drive, _DRIVES),
            },
            indent=1,
            allow_nan=False,
        )

    @classmethod
    def from_json(cls, text: str | bytes) -> "Scene":
        """The scene that `to_json` wrote.

        Raises
        ------
        ValueError
            If the text is not JSON, not a scene, or has a value out of its range.
        """
        if isinstance(text, os.PathLike) or (isinstance(text, str) and text.strip().endswith(".json")):
            raise ValueError(
                f"scene: {shown(str(text))} is the name of a file, not JSON text; read it first, as in "
                "Scene.from_json(pathlib.Path(name).read_text())"
            )
        try:
            return cls._read(text)
        except RecursionError:
            raise ValueError("scene: JSON is nested too deeply") from None

    @classmethod
    def _read(cls, text):
        try:
            data = json.loads(text, parse_constant=_no_constant, object_pairs_hook=_no_duplicates)
        except UnicodeDecodeError as error:
            raise ValueError(f"scene: not UTF-8 text ({error.reason})") from None
        except ValueError as error:
            raise ValueError(f"scene: {error}") from None
        _keys("scene", data, {"format", "version", "profile", "medium", "drive"})
        if data["format"] != _FORMAT or data["version"] != _VERSION:
            raise ValueError(
                f"scene: format {shown(data['format'])} version {shown(data['version'])} cannot be read; "
                f"expected {_FORMAT!r} version {_VERSION}"
            )
        medium = data["medium"]
        if isinstance(medium, dict) and "q_c" in medium and medium["q_c"] is None:
            medium = medium | {"q_c": np.inf}
        return cls(
            _untagged("profile", data["profile"], _PROFILES),
            _build("medium", medium, Medium),
            _untagged("drive", data["drive"], _DRIVES),
        )


def _tagged(value, kinds):
    name = type(value).__name__
    if kinds.get(name) is not type(value):
        raise ValueError(f"a {name} cannot be written as JSON")
    return {"type": name} | asdict(value)


def _untagged(what, data, kinds):
    if not isinstance(data, dict) or not isinstance(data.get("type"), str) or data["type"] not in kinds:
        raise ValueError(f"scene: {what} needs a type out of {', '.join(kinds)}")
    return _build(what, {k: v for k, v in data.items() if k != "type"}, kinds[data["type"]])


def _build(what, data, kind):
    if isinstance(data, dict) and kind in (DepthPath, ForcePath):
        data = {"time": None} | data
    if isinstance(data, dict) and kind is Medium:
        data = {"poisson": 0.5} | data
    if isinstance(data, dict) and kind is FreeImpact:
        data = {"plastic_depth": 0.0} | data
    _keys(f"scene {what}", data, {field.name for field in fields(kind)})
    try:
        return kind(**data)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"scene {what}: {error}") from None


def _keys(what, data, expected):
    if not isinstance(data, dict) or set(data) != expected:
        found = ", ".join(sorted(map(str, data)))[:200] if isinstance(data, dict) else type(data).__name__
        raise ValueError(f"{what} must have exactly {', '.join(sorted(expected))}; found {found}")


def _no_constant(name):
    raise ValueError(f"{name} is not a number that can be used")


def _no_duplicates(pairs):
    data = dict(pairs)
    if len(data) < len(pairs):
        raise ValueError("the same key stands twice")
    return data
