"""What every solver of impacts gives: the state of largest depth, and what becomes of the energy."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..indentation import Indentation
from ..integrals import tabulated
from ..results.base import CLOSED_FORM, Entries
from ..yielding import yield_rule


@dataclass(frozen=True)
class Solution(Entries, ABC):
    """Solved impacts, elementwise, without what a subclass adds.

    Mass m (kg), speed v₀ (m/s), the state of largest depth, and the increase (m) of the plastic depth.
    """

    mass: np.ndarray
    speed: np.ndarray
    turning_point: Indentation
    plastic_depth_increase: np.ndarray

    #: How it was solved.
    model = CLOSED_FORM

    @property
    @abstractmethod
    def restitution(self):
        """Coefficient of restitution e."""

    @property
    @abstractmethod
    def contact_time(self):
        """Time (s) from first contact to its loss, infinite where there is no loss."""

    @property
    def max_force(self):
        """Largest force (N)."""
        return self.turning_point.force

    @property
    def plastic_work(self):
        """Energy (J) dissipated by yielding."""
        increase = self.plastic_depth_increase
        imprint_depth = self.turning_point.plastic_depth - increase
        return 2 * self.medium.E_star * self.rule.plastic_integral(imprint_depth, increase)

    @property
    def viscous_work(self):
        """Energy (J) dissipated by viscosity."""
        return np.zeros(np.shape(self.mass))

    @property
    def adhesive_work(self):
        """Energy (J) that adhesion takes."""
        return np.zeros(np.shape(self.mass))

    @property
    def captured(self):
        """Whether adhesion holds the body."""
        return np.zeros(np.shape(self.mass), bool)

    @property
    def medium(self):
        """The medium."""
        return self.turning_point.medium

    @property
    def interval(self):
        """Live interval at the turning point."""
        return self.turning_point.live_interval

    @cached_property
    def rule(self):
        """The rule of yield."""
        profile = tabulated_for(self.turning_point.profile, np.size(self.plastic_depth_increase))
        return yield_rule(profile, self.medium)


def tabulated_for(profile, count):
    """The profile to solve `count` impacts with: a table if they are many and the known depth is finite."""
    many = count > 16 and np.all(profile.known_depth < np.inf)
    return tabulated(profile, profile.known_depth) if many else profile
