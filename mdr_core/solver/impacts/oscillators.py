"""Linear oscillators under a force that is a polynomial over a step, propagated exactly.

q″ + 2 ζ ω q′ + ω² q = F/M has the roots λ, λ̄ with λ = −ζω + iω√(1 − ζ²). With z = q′ − λ̄ q

    z′ = λ z + F/M        q = Im z/Im λ        q′ = Re z + q Re λ

so that a step only needs ∫ exp(λ (t − τ)) F dτ. For polynomials it is exact, both for modes with a thousand
oscillations within a step and for modes that hardly move. Free masses (ω = 0) are polynomials themselves.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

#: Degree of the force over a step. The nodes are Lobatto nodes: the first node is the end of the last step.
DEGREE = 8
#: Bounds of |λh| and numbers of Gauss nodes; beyond the bounds, the integral by parts has no cancellation.
_GAUSS = ((4.0, 14), (40.0, 44))
#: Number of durations with stored matrices.
_KEPT = 64


def _lobatto(count):
    """Return the Lobatto nodes in [0, 1]."""
    inner = legendre.Legendre.basis(count - 1).deriv().roots()
    return (np.concatenate([[-1.0], np.sort(inner.real), [1.0]]) + 1) / 2


NODES = _lobatto(DEGREE + 1)
_VANDER = legendre.legvander(2 * NODES - 1, DEGREE)
#: Matrix from values at the nodes to Legendre coefficients.
TO_LEGENDRE = np.linalg.inv(_VANDER)
#: Matrix from these coefficients to the coefficients of the derivative by the share of the step.
_DERIVE = np.array([np.pad(2 * legendre.legder(row), (0, 1))[: DEGREE + 1] for row in np.eye(DEGREE + 1)]).T


def at(shares):
    """Return the matrix from values at the nodes to the polynomial at shares of the step."""
    return legendre.legvander(2 * np.asarray(shares) - 1, DEGREE) @ TO_LEGENDRE


def slope_at(shares):
    """Return the matrix from values at the nodes to the derivative by the share."""
    return legendre.legvander(2 * np.asarray(shares) - 1, DEGREE) @ _DERIVE @ TO_LEGENDRE


def polynomial(values, sign=0):
    """Return the polynomial of the share through values at the nodes; with a `sign`, ± its derivative."""
    coefficients = (sign * _DERIVE if sign else np.eye(DEGREE + 1)) @ TO_LEGENDRE @ values
    return lambda share: float(legendre.legval(2 * share - 1, coefficients))


def integral_at(shares, times=1):
    """Return the matrix from values at the nodes to the integral from the start, repeated `times`."""
    columns = [legendre.Legendre(column, [0, 1]).integ(times, lbnd=0)(shares) for column in TO_LEGENDRE.T]
    return np.transpose(columns)


@lru_cache
def _derivatives():
    """Return the matrices from values at the nodes to derivatives of all orders there."""
    powers = [np.eye(DEGREE + 1)]
    for _ in range(DEGREE):
        powers.append(_DERIVE @ powers[-1])
    return [_VANDER @ power @ TO_LEGENDRE for power in powers]


@lru_cache
def _gauss(count):
    """Return Gauss nodes u of [0, 1], and per node c weighted Lagrange polynomials at c u: (c, u, j)."""
    node, weight = legendre.leggauss(count)
    node, weight = (node + 1) / 2, weight / 2
    return node, np.array([at(c * node) * (c * weight)[:, None] for c in NODES])


def _convolved(rate, i):
    """Return ∫₀^c exp(rate (c − τ)) ℓ_j(τ) dτ, (K, j), for complex rates (K,) at node number i, c."""
    c, low = NODES[i], -1.0
    result, z = np.zeros((rate.size, DEGREE + 1), complex), np.abs(rate) * c
    for high, count in _GAUSS:
        rows = (z > low) & (z <= high)
        if rows.any():
            node, values = _gauss(count)
            result[rows] = np.exp(np.multiply.outer(rate[rows] * c, 1 - node)) @ values[i]
        low = high
    rows = z > low
    # ∫ exp(z(c − τ)) ℓ dτ = Σ (exp(zc) ℓ⁽ⁿ⁾(0) − ℓ⁽ⁿ⁾(c))/zⁿ⁺¹
    turned, power = np.exp(rate[rows] * c)[:, None], rate[rows, None]
    for derivative in _derivatives():
        result[rows] += (turned * derivative[0] - derivative[i]) / power
        power = power * rate[rows, None]
    return result


#: ∫₀^c (c − τ) ℓ_j dτ and the derivative at the nodes c, and ∫₀¹ ℓ_j dτ.
DISPLACEMENTS, SLOPE, WHOLE = integral_at(NODES, 2), slope_at(NODES), integral_at(np.ones(1))[0]


class Oscillators:
    """Free masses and modes under one force; the first mass is the body, which the force brakes.

    `residual` is the compliance (m/N) of the parts that respond without delay.
    """

    def __init__(self, omega, mass, damping, residual):
        free = omega == 0
        self.free_mass, self.mass, self.omega = mass[free], mass[~free], omega[~free]
        zeta, self.residual = damping[~free], residual
        self.root = self.omega * (-zeta + 1j * np.sqrt(1 - zeta**2))
        self._steps = {}

    def displacements(self, z):
        """Return the displacements q (m) of the modes."""
        return z.imag / self.root.imag

    def rates(self, z):
        """Return the rates q′ (m/s) of the modes."""
        return z.real + self.displacements(z) * self.root.real

    def energies(self, z):
        """Return the energy (J) of the modes."""
        return (
            np.sum(self.mass * (self.rates(z) ** 2 + (self.omega * self.displacements(z)) ** 2), axis=-1)
            / 2
        )

    def step(self, h):
        """Return the three matrices of a step of duration h (s).

        The first is the compliance (node, j) of modes, free masses and residual between forces and
        displacements at the nodes. The second is exp(λ c h) at the nodes, (node, K). The third is the
        forces' part of z, (node, K, j).
        """
        if h not in self._steps:
            if len(self._steps) >= _KEPT:
                self._steps.clear()
            weights = np.array([_convolved(self.root * h, i) for i in range(DEGREE + 1)])
            weights *= h / self.mass[:, None]
            compliance = np.einsum("ikj,k->ij", weights.imag, 1 / self.root.imag)
            compliance += h * h * np.sum(1 / self.free_mass) * DISPLACEMENTS + self.residual * np.eye(
                DEGREE + 1
            )
            turned = np.exp(np.multiply.outer(NODES * h, self.root))
            self._steps[h] = compliance, turned, weights
        return self._steps[h]

    def after(self, z, t, force):
        """Return z after a time t (s), from the forces (N) at the nodes of this time."""
        weights = _convolved(self.root * t, DEGREE)
        return np.exp(self.root * t) * z + t / self.mass * (weights @ force)
