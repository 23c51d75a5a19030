"""What a person may do to a state: each change is a function that gives another state, or refuses it."""

import re
from collections.abc import Callable
from math import inf
from typing import Any

import mdr_core as mdr

from .drives import oblique, path
from .solve import DRIVES, deepest, option, options, scene_of
from .state import State, checked, medium, number, opened, quantity, settled
from .state.quantities import QUANTITIES, Scale, shape_quantities
from .state.units import fitting, read, written

_BETWEEN = re.compile(r"\s*(?:;|\t|,\s|\bat\b)\s*")


def choose(state: State, name: str, wanted: str) -> State:
    """Take another option of a choice, with the numbers that mean the same where there are such."""
    known = options(state, name)
    if wanted not in known:
        raise ValueError(f"{wanted!r:.40} is not one of {', '.join(known)}")
    if wanted == option(state, name):
        return state
    if name == "preset":
        return opened(wanted, **{each: state[each] for each in ("hold", "tiles", "keep", "dark", "axes")})
    if name == "swept":
        return state.but(swept=wanted, sweep_low=None, sweep_high=None)
    if name == "shape" and wanted == "sampled" and not state.samples:
        raise ValueError("load a tip first: a CSV file with radii r and heights z")
    convert = CONVERT.get(name, lambda state, wanted: {})
    numbers = {k: float(v) if k in QUANTITIES else v for k, v in convert(state, wanted).items()}
    return settled(state.but(**{name: wanted}, **numbers))


def slide(state: State, name: str, scale: Scale, position: float) -> State:
    """Set a number to a step of its slider."""
    return put(state, name, scale.value(position))


def put(state: State, name: str, value: float) -> State:
    """Set a number; E* of two bodies by the modulus of the medium, q_c of a hardness by that."""
    value = checked(state, name, value)
    if name == "E_star" and state.elasticity != "modulus":
        return settled(state.but(**_elasticity(state, state.elasticity, value)))
    if name == "q_c" and state.plasticity == "hardness":
        return settled(state.but(hardness=checked(state, "hardness", value / state.hardness_radius)))
    return settled(state.but(**{name: value}))


def typed(state: State, name: str, text: str, like: float = 0.0) -> tuple[State, str]:
    """Set a number to what was typed; and how it was read, where that may surprise."""
    kind = quantity(state, name).kind
    value, surprising = read(text, kind, fitting(number(state, name), kind, like))
    said = f"{text.strip()}{'' if kind == 'slope' else ' in SI'} is {written(value, kind)}"
    return put(state, name, value), said if surprising else ""


def take_tip(state: State, samples: tuple[Any, Any], note: str) -> State:
    """Take the samples of a tip as the indenter, pressed no deeper than they reach."""
    tip, more = mdr.Sampled(*samples), {}
    if state.drive == "depth" and state.max_depth > tip.known_depth:
        more["max_depth"] = float(f"{tip.known_depth / 2:.3g}")
    return state.but(samples=(tip.r, tip.z), tip_note=note, shape="sampled", **more)


def hit_again(state: State, hit: mdr.Impact) -> State:
    """Let the body hit the imprint that it has left itself."""
    if not hit.plastic_depth_increase > 0:
        raise ValueError("nothing has yielded further: the next impact is the same as this one")
    left = checked(state, "plastic_depth", float(hit.plastic_depth))
    return state.but(plastic_depth=left, surface="imprint")


def press_to(state: State, depth: float) -> State:
    """Press to another depth (m), as the indenter is dragged there."""
    depth = QUANTITIES["max_depth"].bounded(depth)
    state_there = mdr.indent(scene_of(state).profile, medium(state), depth)
    numbers = DRIVES[state.drive].alike(state, state_there)
    return state.but(progress=1.0, **{name: checked(state, name, value) for name, value in numbers.items()})


def reset(state: State) -> State:
    """The preset as it is, at its deepest state; what is seen beside it stays."""
    return opened(state.preset, **{name: state[name] for name in ("hold", "tiles", "keep", "dark", "axes")})


# Numbers that mean the same under another option, so that looking at it changes no result.


def _shape(state: State, shape: str) -> dict[str, Any]:
    """Numbers of a shape that has not been looked at: those of the present one, or sizes of its contact."""
    if all(state[name] is not None for name, _ in shape_quantities(shape)):
        return {}
    here = {q.name: state[name] for name, q in shape_quantities(state.shape)}
    radius = float(deepest(state).contact_radius)
    return {
        name: here.get(q.name)
        or q.bounded(float(f"{q.default * radius:.2g}") if q.kind == "length" else q.default)
        for name, q in shape_quantities(shape)
    }


def _elasticity(state: State, wanted: str, modulus: float | None = None) -> dict[str, Any]:
    """Numbers with which the effective modulus is as it was, or another one, Popov (2015), Eq. (2)."""
    modulus = modulus or medium(state).E_star
    if wanted == "modulus":
        return {"E_star": modulus}
    other = (1 - state.nu_2**2) / state.E_2 if wanted == "bodies" else 0.0
    compliance = 1 / modulus - other
    if compliance > 0.01 / modulus:
        return {"E_1": (1 - state.nu_1**2) / compliance}
    return {"E_1": 2 * modulus * (1 - state.nu_1**2), "E_2": 2 * modulus * (1 - state.nu_2**2)}


def _plasticity(state: State, wanted: str) -> dict[str, Any]:
    """Numbers with which the yield constant stays as it is; none is remembered from before."""
    q_c = medium(state).q_c
    if q_c == inf:
        return {}
    if wanted == "q_c":
        return {"q_c": q_c}
    radius = float(f"{float(deepest(state).contact_radius):.1g}")
    return {"hardness": q_c / radius, "hardness_radius": radius} if wanted == "hardness" else {}


def _damping(state: State, wanted: str) -> dict[str, Any]:
    """Numbers with which viscosity and relaxation time mean the same."""
    made = medium(state)
    if state.damping == "none":
        # A relaxation time that shows, and does not rule, at the time scale of an impact.
        lasting = DRIVES[state.drive].duration(state, deepest(state))
        tau = float(f"{(lasting or 1e-3) / 10:.1g}")
        return {"tau": tau, "eta": tau * made.E_star / 4}
    return {"eta": made.eta, "tau": made.relaxation_time} if wanted != "none" else {}


def _surface(state: State, wanted: str) -> dict[str, Any]:
    """The imprint that the present impact leaves; a shallow one where it leaves none."""
    if wanted == "virgin" or state.drive != "impact":
        return {}
    there = deepest(state)
    return {"plastic_depth": float(there.live_interval.lower) or float(f"{0.1 * float(there.depth):.2g}")}


def _prescribed(state: State, wanted: str) -> dict[str, Any]:
    return path.prescribed(state, scene_of(state), wanted) if state.drive == "path" and state.path else {}


CONVERT: dict[str, Callable[[State, str], dict[str, Any]]] = {
    "shape": _shape,
    "elasticity": _elasticity,
    "plasticity": _plasticity,
    "damping": _damping,
    "drive": lambda state, wanted: DRIVES[wanted].alike(state, deepest(state)),
    "surface": _surface,
    "aim": oblique.aim,
    "pattern": lambda state, wanted: path.pattern(state, deepest(state), wanted),
    "prescribed": _prescribed,
}


# The vertices of a path as text, a line each: a depth or a force, and a time where times count.


def _columns(vertices: tuple, prescribed: str) -> list[tuple[str, Any]]:
    """The kinds of the columns, and the units in which they are shown."""
    kinds = path.KIND[prescribed], "time"
    largest = [max(map(abs, column)) for column in zip(*vertices, strict=True)]
    return [(kind, fitting(size, kind)) for kind, size in zip(kinds, [*largest, 0.0], strict=False)]


def write_path(vertices: tuple, prescribed: str) -> str:
    """Vertices as text that `read_path` understands, in one unit for each column, with five digits."""
    columns = _columns(vertices, prescribed)
    return "\n".join(
        ", ".join(f"{v / unit.factor:.5g} {unit.name}" for v, (_, unit) in zip(row, columns, strict=False))
        for row in vertices
    )


def read_path(text: str, prescribed: str, shown: tuple) -> tuple:
    """Vertices (SI) from text in which the path `shown` has been altered.

    Bare numbers are in the units shown; a line that stands as it was has all digits that it had. Raises
    ValueError, with the line, if it is none.
    """
    vertices, columns = [], _columns(shown, prescribed)
    kept = dict(zip(write_path(shown, prescribed).splitlines(), shown, strict=True))
    for line_number, line in enumerate(text.splitlines(), 1):
        cells = [cell for cell in _BETWEEN.split(line.strip()) if cell]
        try:
            if len(cells) > 2:
                raise ValueError(f"“{line:.40}” is more than a {prescribed} and a time")
            pairs = zip(cells, columns, strict=False)
            row = kept.get(line.strip()) or tuple(read(cell, *column)[0] for cell, column in pairs)
        except ValueError as error:
            raise ValueError(f"Line {line_number}: {error}") from None
        vertices += [row] if row else []
    return path.checked(vertices, prescribed)


def type_path(state: State, text: str) -> State:
    """Take the vertices that were typed as a path of one's own."""
    if state.path and text == write_path(state.path, state.prescribed):
        return state
    return state.but(path=read_path(text, state.prescribed, state.path), pattern="own")
