"""States of creep by the scalar laws: live intervals, depth excesses, energies, element states."""

from dataclasses import dataclass, replace

import numpy as np

from ...base.results import CLOSED_FORM, CREEP_LAW, Model
from ..foundation.depth_path import states_along
from ..foundation.force_path import Start
from ..medium.medium import Medium
from ..profiles.profile import Profile
from .creep_retreat import Retreat
from .integrals import integrals
from .live_interval import LiveInterval


@dataclass(frozen=True, eq=False)
class ScalarPath:
    """States by the scalar laws, as arrays with one entry per state; the `History` of a `TimedIndentation`.

    `depth_excess` is e = d − D (m), the depth minus the depth of the contact edge, and `lag` is τḋ (m).
    Energies are in J. The last states of the `Retreat`, if there is one, are the last states of the path.
    """

    profile: Profile
    medium: Medium
    interval: LiveInterval
    depth_excess: np.ndarray
    lag: np.ndarray
    stored_energy: np.ndarray
    plastic_work: np.ndarray
    viscous_work: np.ndarray
    retreat: Retreat | None = None

    @property
    def model(self) -> Model:
        """Name of the model."""
        return CREEP_LAW if self.medium.eta > 0 else CLOSED_FORM

    @property
    def depth(self):
        """Depth d (m)."""
        return self.interval.upper + self.depth_excess

    def elements(self, x, count):
        """Return line load (N/m) and elastic compression (m) at x (m) in the first states, (count, M)."""
        columns = np.array([
            self.interval.upper, self.interval.length, self.depth_excess, self.lag,
        ])[:, :count, None]  # fmt: skip
        edge, length, depth_excess, lag = columns
        height = np.asarray(self.profile.reduced(x))
        springs = np.clip(edge - height, 0.0, length)
        contact = height < edge
        elastic = np.where(contact, springs + depth_excess, self._released(height)[:count])
        # In a retreating contact, dashpots balance the depth excess.
        load = np.where(contact, springs + np.maximum(lag, 0.0), 0.0)
        return self.medium.E_star * load, elastic

    def _released(self, height):
        """Return compressions (m) of released elements of reduced heights (m) in all states."""
        result = np.zeros((len(self.depth_excess), height.size))
        if self.retreat is not None:
            later = self.retreat.released(height)
            # The turning point may be between two times.
            result[len(result) - len(later) + 1 :] = later[1:]
        return result

    def states(self, time, force, error):
        """Return the `TimedIndentation` of this path."""
        edge = np.asarray(self.interval.upper)
        radius = np.where(force > 0, self.profile.radius_at(edge), 0.0)
        return states_along(
            self, np.arange(len(time)), profile=self.profile, medium=self.medium, time=time,
            depth=self.depth, force=force, contact_radius=radius, stored_energy=self.stored_energy,
            plastic_work=self.plastic_work, viscous_work=self.viscous_work,
            plastic_depth=self.interval.lower, error=error,
        )  # fmt: skip

    @property
    def last(self):
        """The last state, from which the chain continues."""
        return Start(
            depth=float(self.depth[-1]),
            largest=float(self.retreat.interval.upper),
            plastic_depth=float(self.interval.lower[-1]),
            edge=float(self.interval.upper[-1]),
            elastic=lambda x: self.elements(x, len(self.depth_excess))[1][-1],
            plastic_work=float(self.plastic_work[-1]),
            viscous_work=float(self.viscous_work[-1]),
        )


def pressed_states(profile, medium, law, pressed):
    """Return the `ScalarPath` of a growing depth, from its law and the `Pressed` depths."""
    rule, modulus = law.rule, 2 * medium.E_star
    f = law.area[: pressed.depth.size]
    interval, _ = rule.loading(pressed.depth)
    area, radius = law.pressed(pressed.depth)
    with np.errstate(divide="ignore", invalid="ignore"):
        lag = np.where(radius > 0, np.maximum(f - area, 0.0) / radius, 0.0)
    stored = integrals(rule.profile).energy_integral(interval)
    plastic = rule.plastic_integral(np.zeros_like(interval.lower), interval.lower)
    viscous = _lost(pressed.depth, f, pressed.moment, stored + plastic)
    return ScalarPath(
        profile,
        medium,
        interval,
        depth_excess=np.zeros_like(lag),
        lag=lag,
        stored_energy=modulus * stored,
        plastic_work=modulus * plastic,
        viscous_work=modulus * viscous,
    )


def retreating_states(before, law, pressed, retreat):
    """Return the `ScalarPath` of the states `before` a turning point and of its `Retreat`."""
    rule, modulus, turning = law.rule, 2 * before.medium.E_star, retreat.interval
    # The first state of the retreat is the turning point, which is not a state of the path.
    depth_excess, remainder, work = retreat.states[:, 1:]
    f = retreat.area[1:]
    interval = LiveInterval.above(turning.lower, retreat.length[1:])
    stored = integrals(rule.profile).energy_integral(interval) + depth_excess * f + remainder / 2
    plastic = float(rule.plastic_integral(np.zeros_like(turning.lower), turning.lower))
    energy_at_turn = float(integrals(rule.profile).energy_integral(turning)) + plastic
    # Work of the dashpots up to the turning point.
    lost = _lost(
        np.append(before.depth, pressed.turning_depth),
        np.append(law.area[: pressed.depth.size], retreat.area[0]),
        np.append(pressed.moment, pressed.turning_moment),
        np.append((before.stored_energy + before.plastic_work) / modulus, energy_at_turn),
    )[-1]
    return replace(
        before,
        interval=_appended(before.interval, interval),
        depth_excess=np.append(before.depth_excess, depth_excess),
        lag=np.append(before.lag, -depth_excess),
        stored_energy=np.append(before.stored_energy, modulus * stored),
        plastic_work=np.append(before.plastic_work, np.full(len(depth_excess), modulus * plastic)),
        viscous_work=np.append(before.viscous_work, modulus * (lost + work)),
        retreat=retreat,
    )


def _lost(depth, area, moment, energy):
    """Return the dashpots' work over 2E* (m³): the work of the force minus stored and plastic `energy`.

    The arguments are depths d (m), f (m²), ∫ d df (m³) and energies over 2E* (m³) at all times. The first
    state is reached infinitely slowly. The work of the force, ∫ f dd, is f d − ∫ d df.
    """
    work = area * depth - area[0] * depth[0] - moment
    return np.maximum.accumulate(np.maximum(work - (energy - energy[0]), 0.0))


def _appended(first, later):
    """Return the `LiveInterval` of the states of one interval, followed by the states of another."""
    return LiveInterval(
        np.append(first.lower, later.lower),
        np.append(first.upper, later.upper),
        np.append(first.length, later.length),
    )
