"""Solution of curves: the best minimum from several starts, or an elastic medium, with its errors."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...solver.contact.integrals import tabulated
from ...solver.medium.medium import Medium
from ...solver.profiles.profile import check_known
from ..common.errors import autocorrelation, block_factors, block_length, covariances, roughness
from ..common.least_squares import Minimum
from .adhesion import AdhesiveCurves
from .curves import NO_WEIGHT, Curves
from .depth_noise import with_depth_noise
from .measurement import rates
from .parameters import CLASSES, MEDIUM, PARAMETERS, REACH
from .start import first_guesses

#: Constant of the hardness, in any unit, that represents infinity.
_NO_YIELD = 1e130
#: Largest gain in χ² over an elastic medium for which the elastic medium fits equally well.
_AS_WELL = 2.0


@dataclass(frozen=True)
class Solution:
    """Solution of the curves `rows` of a measurement, and whether media are elastic (R,).

    `rival` is the second-best minimum in scaled parameters (R, P), and `rival_squares` its sum of squares
    (R,), which is infinite without a second minimum.
    """

    rows: np.ndarray
    curves: Curves
    minimum: Minimum
    rival: np.ndarray
    rival_squares: np.ndarray
    elastic: np.ndarray
    noise_known: bool

    @cached_property
    def values_and_states(self):
        """Parameters by name (R, 1), with exact values for elastic media, and the states at all samples."""
        values, state = self.curves.model_states(self.minimum.x)
        elastic = {"hardness": 0.0, "q_c": np.inf, "f_c": 0.0}
        for name, value in elastic.items():
            values[name] = np.where(self.elastic[:, None], value, values[name])
        return values, state

    def medium(self):
        """Return the media (R,). Raise MDRError if a parameter is out of its range."""
        values, _ = self.values_and_states
        return Medium(**{name: values[name][:, 0] for name in MEDIUM})

    @cached_property
    def noise(self):
        """Standard deviation (N) of the residuals at all samples (R, N)."""
        return self.curves.noise(self.values_and_states[1].slope)

    @cached_property
    def deviation(self):
        """Residuals (N) at all samples (R, N), 0 at samples without weight in the fit."""
        return self.minimum.residual * self.noise

    @cached_property
    def reduced_chi_square(self):
        """Sum of squares over the degrees of freedom (R,)."""
        return self.minimum.sum_of_squares / self.minimum.degrees_of_freedom

    @cached_property
    def orders(self):
        """Indices in order of time, or of depth for elastic media whose residuals then correlate more."""
        residual = self.minimum.residual
        orders = np.broadcast_to(np.arange(residual.shape[1]), residual.shape).copy()
        if self.curves.held_elastic:
            by_depth = np.argsort(self.curves.depth, axis=1)
            sorted_residual = np.take_along_axis(residual, by_depth, axis=1)
            closer = autocorrelation(sorted_residual) > autocorrelation(residual)
            orders[closer] = by_depth[closer]
        return orders

    @cached_property
    def block_length(self):
        """Number of samples over which residuals are correlated (R,), 1 for noise."""
        residuals = zip(self.minimum.residual, self.orders, strict=True)
        return np.array([block_length(residual[order]) for residual, order in residuals])

    @cached_property
    def covariance(self):
        """Covariance of the scaled free parameters (R, P, P), from blocks if residuals are correlated."""
        residual, jacobian, free = self.minimum.residual, self.minimum.jacobian, len(self.curves.free)
        variance = 1.0 if self.noise_known else self.reduced_chi_square
        covariance = covariances(jacobian, variance)[:, :free, :free]
        for i in np.flatnonzero(self.block_length > 1) if free else ():
            order, length = self.orders[i], self.block_length[i]
            factors = block_factors(residual[i, order], jacobian[i, order], length)[:free]
            covariance[i] *= factors[:, None] * factors
        return covariance

    def errors(self, i):
        """Return the standard errors of the scaled free parameters of one curve by name."""
        return dict(zip(self.curves.free, np.sqrt(np.diag(self.covariance[i])).tolist(), strict=True))


def problems(profile, measured, held, depth_noise):
    """Yield numbers of measured curves, and their `Curves` with equally many parameters."""
    profile = tabulated(profile, table_depth(profile, measured.depth, held))
    used = [name for name in PARAMETERS if name not in held or held[name].any()]
    adhesive, in_time = "work_of_adhesion" in used, any(PARAMETERS[name].in_time for name in used)
    for rows, depth, force, time, force_noise in measured.groups():
        rate, corner = rates(depth, time) if in_time else (np.zeros_like(depth), False)
        fixed = {name: value[rows] for name, value in held.items()}
        curves = Curves(profile, depth, force, force_noise, rate, time, depth_noise, fixed)
        sigma = _sigma(curves) * np.where(corner, NO_WEIGHT, np.ones_like(depth))
        curves = replace(curves, sigma=sigma)
        if depth_noise:
            yield from ((rows[subset], noisy) for subset, noisy in with_depth_noise(curves))
        else:
            yield rows, curves.as_kind(AdhesiveCurves) if adhesive else curves


def table_depth(profile, depth, held):
    """Return the largest depth (m) in the table of the profile, from the farthest first contact."""
    top = np.nanmax(depth, axis=1)
    limit = (1 + REACH) * float((top - np.nanmin(depth, axis=1)).max())
    if "contact_point" in held:
        largest = top - held["contact_point"]
        limit = max(limit, 1.01 * float(largest.max()))
        check_known(profile, largest)
    return min(limit, profile.known_depth)


def _sigma(curves):
    """Return the standard deviation of the force (N): given, estimated, or its range if it is unknown."""
    if curves.sigma is not None or not curves.depth_noise:
        return curves.load if curves.sigma is None else curves.sigma
    force = curves.force
    # Without memory and rates the order of samples does not matter; ordered by depth, the force is smooth.
    if curves.held_elastic and not curves.rate.any():
        force = np.take_along_axis(force, np.argsort(curves.depth, axis=1), axis=1)
    return np.maximum(roughness(force), 1e-6 * curves.load)


def solved(rows, curves, noise_known):
    """Return the `Solution` of the curves with the numbers `rows`."""
    minimum, *rival = _best_minimum(curves)
    if curves.adhesive:
        curves = replace(curves, contact=curves.contact_of_data(minimum.x))
        minimum = curves.minimum(minimum.x)
    if set(curves.free) & set(CLASSES.values()):
        minimum, elastic = _compared_with_elastic(curves, minimum, noise_known)
    else:
        elastic = np.isinf(curves.held["q_c"])
    minimum = replace(minimum, residual=np.where(curves.left_out, 0.0, minimum.residual))
    return Solution(rows, curves, minimum, *rival, elastic, noise_known)


def _best_minimum(curves):
    """Return the best minimum, and the second-best minimum with another E* or first contact."""
    (_, start), *others = first_guesses(curves)
    best = curves.search(start)
    rival, rival_squares = best.x.copy(), np.full(len(start), np.inf)
    columns = [i for i, name in enumerate(curves.free) if name in ("E_star", "contact_point")]
    for rows, start in others:
        trial = curves.rows(rows).search(start)
        x, sum_of_squares = best.x[rows], best.sum_of_squares[rows]
        differs = np.any(np.abs(trial.x - x)[:, columns] > 0.05, axis=1)
        better, worse = (
            trial.sum_of_squares < sum_of_squares,
            np.maximum(sum_of_squares, trial.sum_of_squares),
        )
        second = differs & (worse < rival_squares[rows])
        rival[rows[second]] = np.where(better[:, None], x, trial.x)[second]
        rival_squares[rows[second]] = worse[second]
        best = best.replaced(rows, trial, better)
    return best, rival, rival_squares


def _compared_with_elastic(curves, minimum, noise_known):
    """Return the minimum, or the elastic minimum if it fits equally well, and whether it is elastic.

    The force of an elastic medium does not depend on its hardness. Hence a second search starts with a
    smaller hardness.
    """
    elastic = np.zeros(len(minimum.x), bool)
    values, state = curves.states(minimum.x)
    share = state.cap[:, -1] / state.depth.max(axis=1)
    rows = np.flatnonzero(share > 0.5)
    if not rows.size:
        return minimum, elastic
    subset = curves.rows(rows)
    values = subset.values(minimum.x[rows])
    constants = [name for name in subset.constants if name in subset.free]
    less = np.minimum(0.85 / share[rows], 1.0)[:, None]
    softer = values | {name: less * values[name] for name in constants}
    without_yield = values | {constants[0]: np.full_like(less, _NO_YIELD)}
    yielding = subset.minimum(subset.scaled(softer))
    unyielding = subset.minimum(subset.scaled(without_yield))
    first, second, third = minimum.sum_of_squares[rows], yielding.sum_of_squares, unyielding.sum_of_squares
    least = np.minimum(first, second)
    noise = 1.0 if noise_known else np.minimum(least, third) / minimum.degrees_of_freedom
    gain = (third - least) / np.maximum(noise, 1e-300)
    nearer = (gain <= _AS_WELL) | (third <= 1e-24 * minimum.residual.shape[1])
    elastic[rows] = nearer
    minimum = minimum.replaced(rows, yielding, (second < first) & ~nearer)
    return minimum.replaced(rows, unyielding, nearer), elastic
