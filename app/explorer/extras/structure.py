"""The structure behind the medium in the drive *impact*: a thick block, a plate, or a support."""

from dataclasses import dataclass, fields, replace
from functools import cached_property
from math import exp, inf, log
from types import SimpleNamespace
from typing import Any

import numpy as np
from markupsafe import Markup
from scipy.optimize import brentq

import mdr_core as mdr
from mdr_core.show.structure_limits import BACK
from mdr_core.show.units import digits, format_quantity
from mdr_core.solver.impacts.modal import contact_instants, motion_at
from mdr_core.solver.medium.modes import Modes

from ...common.quantities import QUANTITIES
from ...common.ui import html_subscripts
from ..changes import with_tile
from ..courses import Caution, Course, path_progress
from ..drives import DRIVES, INSTANTS, Impact, follow
from ..extra import Extra
from ..plot import Plot, View
from ..plots import PLOTS
from ..state import State, medium, numbers_of, preset_values, profile
from ..widgets import Part, button

#: Notes on a body that never leaves.
_STAYS = "The body never leaves the plate: waves take all of the energy that yield leaves, e = 0."
_CAPTURED = "The body stays on the plate for more than 100 periods of both together, e = 0."
#: Number of modes of a plate with edges in results; smallest number in previews and sweeps. These take
#: all modes that swing less than twice in the contact time on a rigid body. On a laminate the error of e
#: is then at most 0.0015 for all masses; with at least 12 modes it is 0.024, for 0.9 times the time.
MODES, FEW, _SWINGS = 100, 25, 2.0
_PENDING = f"Computing {MODES} modes; the plots have fewer modes so far."


#: Ratio of a limit to its bound above which readouts are no results, and these readouts by limit.
_FAR = 3.0
_OF_BODY = ("force", "restitution", "contact_time", "structure_work", "support_energy")
_DOUBTFUL = {
    "edges": (*_OF_BODY, "deflection"),
    "second contact": ("restitution", "structure_work"),
    "deflection": (*_OF_BODY, "deflection"),
    "dent": ("force", "depth", "plastic_depth", "plastic_work"),
}


@dataclass(frozen=True, eq=False, kw_only=True)
class StructureCourse(Course):
    """Course of an impact on a plate or a support."""

    @property
    def in_place(self):
        taken = "structure_work" if self.structure.is_plate else "support_energy"
        return {"damaged_area": taken, "plastic_radius": "deflection"}

    @cached_property
    def cautions(self):
        found = [_caution(limit) for limit in self.limits if _far_beyond(limit)]
        # If the advice is another structure, other limits of this structure do not matter.
        other = next((each for each in found if each.option), None)
        return tuple(found) if other is None else (replace(other, limits=(*other.limits, *_DOUBTFUL)),)

    @property
    def asides(self):
        if not _has_edges(self.structure):
            return {}
        count = self.hit.contacts
        return {"restitution": "1 contact" if count == 1 else f"{count} contacts"}

    @property
    def behind(self) -> SimpleNamespace:
        """Results (SI) for the structure, and for the body that moves with it."""
        motion, found = self.motion, {"max_deflection": self.hit.max_deflection}
        found |= {"deflection": motion.deflection, "body_velocity": motion.body_velocity}
        if self.structure.is_plate:
            return SimpleNamespace(structure_work=motion.structure_work, **found)
        return SimpleNamespace(support_energy=motion.support_energy, **found)

    @property
    def largest_terms(self):
        own = {"deflection": self.hit.max_deflection, "body_velocity": self.hit.speed}
        if _has_edges(self.structure):
            # The depth is the displacement of the body minus the deflection.
            own["depth"] = self.hit.max_deflection
        return super().largest_terms | own


def _far_beyond(limit: Any) -> bool:
    """Whether a limit is exceeded so far that readouts are no results."""
    again = limit.what == "second contact" and limit.exceeded
    return limit.what in _DOUBTFUL and (again or limit.value > _FAR * limit.bound)


def _caution(limit: Any) -> Caution:
    """Return the caution for an exceeded limit of a structure: advice and its reason."""
    readouts, times = _DOUBTFUL[limit.what], f"{digits(limit.value / 2, 3)} times the thickness"
    if limit.what == "deflection":
        text = f"Take a thicker plate or a slower body: the deflection, {times}, stretches the plate"
        return Caution((limit.what,), f"{text}.", readouts)
    if limit.what == "dent":
        text = f"Take a thicker plate or a larger indenter: the dent reaches {times} of the plate"
        return Caution((limit.what,), f"{text}.", readouts)
    text = "Take a plate with edges: this structure swings back and hits the body again"
    if limit.what == "edges":
        text = "Take a plate with edges: in this plate no wave returns to lift the body"
        if limit.value < inf:
            text = f"Take a plate with edges: the contact lasts {digits(limit.value, 3)} times as long as"
            text += " waves take to the edge and back"
    return Caution((limit.what,), f"{text}.", readouts, "structure.behind", "edges")


class OnStructure(Impact):
    """The drive *impact*, also on a structure."""

    def given(self, state):
        structure = structure_of(state)
        return super().given(state) | ({} if structure is None else {"structure": structure})

    def given_quickly(self, state):
        given = self.given(state)
        if _has_edges(given.get("structure")):
            rigid = mdr.impact(profile(state), medium(state), **super().given(state))
            given["structure"] = few_modes(given["structure"], rigid)
        return given

    def limiting_cases(self, state):
        """Return the limiting cases of a plate with edges: without edges, and without mass."""
        numbers = numbers_of(state, "structure.behind")
        if state["structure.behind"] != "edges" or any(np.ndim(state[name]) for name in numbers):
            return {}
        support = mdr.Structure(stiffness=structure_of(state).stiffness)
        endless = structure_of(state.replace(**{"structure.behind": "plate"}))
        cases = {"plate without edges": endless, "support without mass": support}
        return {
            name: super(OnStructure, self).given(state) | {"structure": each}
            for name, each in cases.items()
        }

    def follow(self, scene, progress):
        if _has_edges(scene.drive.structure):
            rigid = replace(scene, drive=replace(scene.drive, structure=None)).solve()
            drive = replace(scene.drive, structure=few_modes(scene.drive.structure, rigid))
            return replace(self.exact(replace(scene, drive=drive)), scene=scene, pending=_PENDING)
        course = super().follow(scene, progress)
        if course.structure is None:
            return course
        own = {field.name: getattr(course, field.name) for field in fields(course)}
        notes = (_STAYS,) * bool(course.hit.captured)
        return StructureCourse(**own | {"notes": notes})

    def exact(self, scene):
        """Return the states of an impact by modes, in all contacts."""
        hit = scene.solve()
        motion = motion_at(hit, contact_instants(hit, INSTANTS))
        return StructureCourse(
            scene=scene, progress=path_progress(motion.time, motion.depth), states=motion.states,
            motion=motion, hit=hit, turns=hit.contacts > 1, notes=(_CAPTURED,) * bool(hit.captured),
        )  # fmt: skip

    def converted(self, state, choice, wanted):
        """Return unset numbers of a structure, such that it affects the present impact."""
        if choice != "structure.behind" or wanted == "block" or _losses(state):
            return {}
        hit = follow(state).hit
        # Under the present force a spring stores the energy, and waves of a half-sine take half of it.
        stiffness = float(hit.max_force**2 / (hit.mass * hit.speed**2))
        if wanted == "support":
            found = {"stiffness": float(f"{stiffness:.2g}")}
        else:
            found = _material(state)
            of_one_metre = float(mdr.Structure.plate(1.0, **found).impedance)
            thickness = (2 * stiffness * float(hit.contact_time) / of_one_metre) ** 0.5
            found["thickness"] = float(f"{thickness:.2g}")
        if wanted == "edges":
            # Waves return from the edges when the contact ends.
            spread = mdr.Structure.plate(**found).wave_spread
            side = (BACK * spread * float(hit.contact_time)) ** 0.5
            found |= dict.fromkeys(("width", "length"), float(f"{side:.2g}"))
        found = {f"structure.{name}": value for name, value in found.items()}
        known = preset_values(state.preset).keys() | state.extras.keys()
        return {name: QUANTITIES[name].bounded(each) for name, each in found.items() if name not in known}

    def equivalent(self, state, turning_point):
        """Return numbers for equal depth; on a structure the speed is larger than from the work alone."""
        numbers = super().equivalent(state, turning_point)
        given = self.given_quickly(state) | numbers
        if "structure" not in given or hasattr(DRIVES[state.drive].make(state), "speed"):
            return numbers
        depth, shape, made = float(turning_point.depth), profile(state), medium(state)

        def beyond(log_speed):
            hit = mdr.impact(shape, made, **given | {"speed": exp(log_speed)})
            return float(hit.max_depth) / depth - 1

        low = log(numbers["speed"])
        high = next(low + step for step in range(1, 40) if beyond(low + step) > 0)
        return numbers | {"speed": exp(brentq(beyond, low, high, xtol=1e-9))}


def _material(state: State) -> dict[str, float]:
    """Return modulus, Poisson ratio and density of a plate, from the medium if it has a Young's modulus."""
    if state.elasticity == "bodies":
        nu = QUANTITIES["structure.nu"].bounded(state.nu_1)
        return {"E": state.E_1, "nu": nu, "density": state.density}
    return {name: state[f"structure.{name}"] for name in ("E", "nu", "density")}


def _losses(state: State) -> str:
    """Return the property of the medium that excludes a structure, in words, or an empty text."""
    return "adhesion" if state.adhesion != "none" else "viscosity" if state.damping != "none" else ""


def structure_of(state: State) -> mdr.Structure | None:
    """Return the structure of a state, None for a thick block. Raises ValueError."""
    behind = state["structure.behind"]
    if behind == "block":
        return None
    if losses := _losses(state):
        label = state.chosen("structure.behind").label
        raise ValueError(
            f"a {label} is not computed together with {losses}: choose “thick block” as the structure, "
            f"or no {losses} (More about the medium)"
        )
    own = {name.removeprefix("structure."): state[name] for name in numbers_of(state, "structure.behind")}
    if behind == "support":
        return mdr.Structure(**own)
    by_thickness = state["structure.plate"] == "moduli"
    if state["structure.plate"] == "bending":
        # An isotropic plate by its bending stiffness; the Poisson ratio, here 0, does not matter.
        D = own.pop("D")
        own |= {"D11": D, "D12": 0.0, "D22": D, "D66": D / 2}
    if behind == "edges":
        make = mdr.Structure.supported_isotropic_plate if by_thickness else mdr.Structure.supported_plate
        return make(**own, modes=MODES)
    # 0 means an unknown edge.
    edge = own.pop("edge") or None
    return (mdr.Structure.plate if by_thickness else mdr.Structure.laminate)(**own, edge=edge)


def _has_edges(structure: mdr.Structure | None) -> bool:
    return structure is not None and structure.modes is not None


def few_modes(structure: mdr.Structure, rigid: mdr.Impact) -> mdr.Structure:
    """Return a plate with the lowest modes, enough for an impact; its stiffness includes the others."""
    modes = structure.modes
    count = max(int(np.searchsorted(modes.frequency, _SWINGS / float(rigid.contact_time))), FEW)
    lowest = (each[:count] for each in (modes.frequency, modes.mass, modes.damping))
    return replace(structure, modes=Modes(*lowest))


def notes(view: View) -> dict[str, str]:
    """Return notes on the derived numbers of a plate, and on the necessary distance of its edges."""
    course = view.course
    if not isinstance(course, StructureCourse):
        return {}
    plate = course.structure
    if _has_edges(plate):
        mass = 4 * plate.modes.mass[0]
        parts = [
            f"mass of the plate M = {format_quantity(mass, 'mass')}, m/M = {course.hit.mass / mass:.3g}",
            f"K = {format_quantity(float(plate.stiffness), 'yield constant')}",
            f"f_1 = {plate.modes.frequency[0]:.4g} Hz",
        ]
        return {"form": html_subscripts(", ".join(parts))}
    if not plate.is_plate:
        return {}
    # Z is 8√(D ρh).
    stiffness, mass = plate.impedance * plate.wave_spread / 8, plate.impedance / plate.wave_spread / 8
    parts = [
        f"D = {format_quantity(float(stiffness), 'bending stiffness')}",
        f"ρh = {format_quantity(float(mass), 'mass per area')}",
        f"Z = 8√(D ρh) = {format_quantity(float(plate.impedance), 'drag')}",
    ]
    lines = [html_subscripts(", ".join(parts))]
    if (far := _far(course)) < inf:
        lines.append(
            html_subscripts(f"Edges farther than {format_quantity(far, 'length', 2)} have no effect")
        )
    return {"form": Markup("<br>").join(lines)}


def _far(course: StructureCourse) -> float:
    """Return the distance (m) beyond which edges have no effect; infinite if the body never leaves."""
    told = replace(course.hit, structure=replace(course.structure, edge=1.0))
    (limit,) = (each for each in told.limits if each.what == "edges")
    # The travel time of waves grows with the square of the distance.
    return float(np.sqrt(limit.value / limit.bound))


def e_over(page: Any, plot: Plot, view: View) -> list[Part]:
    """Return the button above the force that plots the restitution over the mass or the thickness."""
    thickness, drawn = "structure.thickness", plot.name == "force" and "sweep" in PLOTS
    if drawn and _has_edges(view.course.structure):
        label, swept = "e over m", "mass"
    elif drawn and thickness in numbers_of(view.state, "drive"):
        label, swept = "e over h", thickness
    else:
        return []
    chosen = {"sweep.swept": swept, "sweep.against": "restitution"}
    return [button(label, lambda: page.apply(lambda state: with_tile(state, "sweep").replace(**chosen)))]


EXTRA = Extra("structure", drives={"impact": OnStructure()}, notes=notes, on_plots=e_over)
