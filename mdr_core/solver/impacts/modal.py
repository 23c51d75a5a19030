"""Impacts on a structure with modes, as results: all contacts of a body until it has left."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...base import check
from ...base.check import Array
from ...base.motions import Motion, instants
from ...base.results import MODES, check_single
from ..contact.indentation import Indentation
from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..contact.yielding import yield_rule
from ..medium.modes import Modes
from .modal_motion import TOLERANCE, ModalMotion
from .oscillators import DISPLACEMENTS, NODES, SLOPE, WHOLE, at
from .result import Impact


class ModalErrors(NamedTuple):
    """Estimated errors of an impact on modes, each relative to the quantity.

    An error is three times the change by half of the modes (the others then have no inertia), plus the
    change by a 100 times larger tolerance. Of 100 impacts of balls on plates they cover 97. If a body hits
    dozens of times, neither change converges.
    """

    restitution: Array
    max_depth: Array
    max_force: Array


@dataclass(frozen=True, eq=False, repr=False)
class ModalImpact(Impact):
    """Impacts on a structure with modes, from first touch until the body has left.

    A body may hit several times. `contact_time` is the time from first touch to the last loss of contact.
    It is infinite for a captured body, which does not leave within 100 periods of the lowest oscillation.
    On a free structure, `restitution` is negative if the body continues behind it.
    """

    restitution: Array = field()
    contact_time: Array = field()
    max_force: Array = field()
    #: Energy (J) that the structure has taken: the energy of its modes, and the energy lost by damping.
    structure_work: Array = field()
    _motions: Any = field()

    model = MODES

    def __post_init__(self):
        # A single motion has no index.
        check.store(self, _motions=np.asarray(self._motions, object))

    @property
    def captured(self):
        """Whether the body has not left within 100 periods of the lowest oscillation."""
        return np.isinf(self.contact_time)[()]

    @property
    def hits(self):
        """Contacts: a tuple of `Hit` for one impact, an array of tuples for many."""
        return self._each(lambda motion: tuple(motion.hits), object)

    @property
    def contacts(self):
        """Number of contacts; contacts with less than 1 % of the momentum depend on the number of modes."""
        return self._each(lambda motion: len(motion.hits), int)

    @property
    def max_deflection(self):
        """Largest deflection (m) of the structure under the contact, up to the last loss of contact."""
        return self._each(lambda motion: motion.max_deflection, float)

    def _each(self, value, kind):
        """Return an array of values of the motions, or one value."""
        found = np.empty(self.shape, kind)
        for index in np.ndindex(*self.shape):
            found[index] = value(self._motions[index])
        return found[()]

    @cached_property
    def errors(self) -> ModalErrors:
        """Estimated errors, from solutions with half of the modes and with a larger tolerance."""
        modes, K = self.structure.modes, self.structure.stiffness
        order = np.argsort(modes.frequency)[: (len(modes.frequency) + 1) // 2]
        half = Modes(*(np.array(each)[order] for each in (modes.frequency, modes.mass, modes.damping)))
        if np.isinf(K) and 0 < modes.compliance < np.inf:
            K = 1 / modes.compliance
        fewer = replace(self.structure, modes=half, stiffness=K)
        given = self.mass, self.speed, self.plastic_depth - self.plastic_depth_increase
        given = self.profile, self.medium, *np.broadcast_arrays(*given)
        others = modal_impact(*given, fewer), modal_impact(*given, self.structure, 100 * TOLERANCE)
        changes = {
            name: sum(
                factor * np.abs(getattr(other, name) - getattr(self, name))
                for factor, other in zip((3.0, 1.0), others, strict=True)
            )
            for name in ModalErrors._fields
        }
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = {
                name: np.nan_to_num(c / np.abs(getattr(self, name)), nan=0.0) for name, c in changes.items()
            }
        return ModalErrors(**relative)

    def motion(self, n: int = 200) -> Motion:
        """Return the motion of one impact at n instants, from first touch to the last loss of contact.

        It includes contacts and flights. Instants are equally spaced before the turning point, the largest
        depth, and again after it. `structure_work` is the energy dissipated by damping, and
        `support_energy` the energy of the structure.
        """
        check_single(self, "motion")
        motion = self._motions[()]
        return motion_at(self, instants(n, motion.turning_time, motion.hits[-1].end))


def modal_impact(profile, medium, mass, speed, imprint_depth, structure, tolerance=TOLERANCE):
    """Solve impacts on one structure with modes, one by one, over imprints of given plastic depth (m)."""
    motions = np.empty(mass.shape, object)
    for index in np.ndindex(*mass.shape):
        own = (
            profile.entries(index, mass.shape),
            medium.entries(index, mass.shape),
            mass[index],
            speed[index],
        )
        motions[index] = ModalMotion(*own, imprint_depth[index], structure, tolerance)

    def each(value):
        return check.frozen(np.reshape([value(motion) for motion in motions.flat], mass.shape))

    depth = each(lambda motion: np.inf if motion.too_deep else motion.max_depth)
    interval, increase = yield_rule(profile, medium).turning(depth - imprint_depth, imprint_depth)
    return ModalImpact(
        mass[()], speed[()], Indentation(profile, medium, interval.upper, interval, in_time=True), increase,
        restitution=each(lambda motion: motion.restitution),
        contact_time=each(lambda motion: motion.contact_time),
        max_force=each(lambda motion: max((hit.max_force for hit in motion.hits), default=np.nan)),
        structure_work=each(lambda motion: motion.structure_work),
        _motions=motions, structure=structure,
    )  # fmt: skip


def contact_instants(hit, n):
    """Return about n ascending times (s) of one impact: in all contacts, a few in flights, and the turn.

    Half of the times of a contact are before and half after the turning point or its middle.
    """
    turn, half = hit._motions[()].turning_time, max(n // len(hit.hits), 8) // 2  # noqa: SLF001
    found = [np.linspace(one.end, other.start, 6) for one, other in pairwise(hit.hits)]
    for each in hit.hits:
        middle = turn if each.start < turn < each.end else (each.start + each.end) / 2
        found += [np.linspace(each.start, middle, half + 1), np.linspace(middle, each.end, half + 1)]
    return np.unique(np.concatenate(found))


def motion_at(hit, time):
    """Return the `Motion` of one impact at ascending times (s)."""
    motion = hit._motions[()]  # noqa: SLF001
    law, found = motion.law, _sampled(motion, time)
    y, p, yields = found["penetration"], found["imprint"], found["yields"]
    interval, increase = law.rule.loading(np.maximum(y, 0.0), p)
    increase = np.where(yields, increase, 0.0)
    # Without a force nothing is compressed, although y may be above 0 at the end of a contact.
    live = np.where(found["force"] > 0, np.where(yields, interval.length, np.maximum(y, 0.0)), 0.0)
    stiffness = law.modulus * np.where(
        yields, law.rule.loading_stiffness_radius(interval, increase), law.rule.profile.radius_at(p + live)
    )
    # d′ (1 + r F′) is the rate without the residual compliance r.
    softer = 1 + motion.system.residual * np.where(live > 0, stiffness, 0.0)
    plastic = p + increase
    interval = LiveInterval(plastic, plastic + live, live)
    states = Indentation(hit.profile, hit.medium, p + y, interval, in_time=True)
    kinetic = hit.mass * found["body_velocity"] ** 2 / 2
    first = hit.plastic_depth - hit.plastic_depth_increase
    work = law.modulus * law.rule.plastic_integral(np.full_like(plastic, first), plastic - first)
    stored = law.modulus * integrals(law.rule.profile).energy_integral(interval)
    return Motion(
        time=time, depth=p + y, velocity=found["free_velocity"] / softer, force=found["force"],
        contact_radius=states.contact_radius * (live > 0), plastic_radius=states.plastic_radius,
        plastic_depth=plastic, live_depth=live, kinetic_energy=kinetic, stored_energy=stored,
        plastic_work=work, viscous_work=np.zeros(len(time)), deflection=found["position"] - p - y,
        body_velocity=found["body_velocity"], structure_work=found["damping_work"],
        support_energy=found["structure_energy"], states=states, impact=hit,
    )  # fmt: skip


def _sampled(motion, time):
    """Return columns of a `ModalMotion` at ascending times (s): depth, velocity, force … and energies."""
    starts = np.array([part.start for part in motion.parts])
    rows = np.clip(np.searchsorted(starts, time, side="right") - 1, 0, None)
    parts = [motion.parts[row] for row in rows]
    columns = [_at(motion, part, t - part.start) for part, t in zip(parts, time, strict=True)]
    return {name: np.array([each[name] for each in columns]) for name in columns[0]}


def _at(motion, part, t):
    """Return one instant at a time t (s) after the beginning of a part."""
    s, h, imprint, damped = motion.system, part.duration, part.imprint, part.damping_work
    begun = motion.energy_of(part.z, part.v, 0.0 if part.force is None else part.force[0])
    if part.force is None:
        z, v, x, force, work = np.exp(s.root * t) * part.z, part.v, part.x + part.v * t, 0.0, 0.0
        penetration = -np.sum(x) - np.sum(s.displacements(z)) - imprint
    else:
        # Nodes of the part up to this time.
        there = at(t / h * NODES)
        forces, penetrations = there @ part.force, there @ part.penetration
        force, penetration = forces[-1], penetrations[-1]
        z, v = s.after(part.z, t, forces), part.v + t * (WHOLE @ forces) / s.free_mass
        x = part.x[0] + part.v[0] * t * NODES + t * t / motion.mass * (DISPLACEMENTS @ forces)
        work = WHOLE @ (forces * (SLOPE @ (-x - penetrations)))
        x = x[-1:]
    energy = motion.energy_of(z, v, force)
    damped += work + begun - energy if motion.damped else 0.0
    return {
        "force": force, "penetration": penetration, "imprint": imprint, "yields": part.yields,
        "free_velocity": -np.sum(v) - np.sum(s.rates(z)), "position": -x[0], "body_velocity": -v[0],
        "structure_energy": energy, "damping_work": damped,
    }  # fmt: skip
