"""Modes of structures with edges: frequencies and modal masses at a contact.

A structure under the force F of a contact moves there by w = Σ q_k + r F, with

    q_k″ + 2 ζ_k ω_k q_k′ + ω_k² q_k = F/M_k

The modal mass is M_k = M/φ², with the displacement φ of the mode at the contact. r is the compliance of the
omitted modes.
"""

from dataclasses import dataclass

import numpy as np

from ...base import check

#: Displacement of a mode at the contact, over its largest displacement, below which the contact is a node.
_NODE = 1e-9
#: Largest modal mass (kg). A mode with this mass does not move at the contact.
_HEAVIEST = 1e30
#: Terms of the series of the compliance of a plate. The error decreases as the third power of their number.
_TERMS = 4000
#: Relative distance of two roots below which an integral gives their divided difference.
_NEAR = 0.1


@dataclass(frozen=True)
class Modes:
    """Modes of a structure at the point of contact; made by `Structure.modal`.

    Attributes
    ----------
    frequency : tuple of float
        Natural frequencies (Hz); 0 is a rigid motion.
    mass : tuple of float
        Modal masses (kg) at the contact.
    damping : tuple of float
        Damping ratios, 0 ≤ ζ < 1.
    """

    frequency: tuple[float, ...]
    mass: tuple[float, ...]
    damping: tuple[float, ...]

    def __post_init__(self):
        frequency = check.positive("frequency", np.atleast_1d(self.frequency), unit="Hz", zero=True)
        mass = np.atleast_1d(self.mass)
        mass = check.positive("modal mass", mass, unit="kg", infinite=True, within=(1e-60, 1e300))
        bound, advice = "belongs to a mode with a node at the contact", "leave the mode out"
        check.raise_if("modal mass", mass, mass > _HEAVIEST, bound, unit="kg", advice=advice)
        damping = check.positive("damping ratio", np.atleast_1d(self.damping), zero=True)
        check.raise_if("damping ratio", damping, damping >= 1, "must be below 1")
        shape = check.common_shape("modes", frequency=frequency, mass=mass, damping=damping)
        if len(shape) != 1 or not shape[0]:
            raise check.MDRError(
                f"modes have shape {shape}, not one dimension and at least one mode: give a number per mode"
            )
        values = {"frequency": frequency, "mass": mass, "damping": damping}
        each = {name: tuple(np.broadcast_to(value, shape).tolist()) for name, value in values.items()}
        check.store(self, **each)

    def __repr__(self) -> str:
        return f"<{len(self.frequency)} modes, {min(self.frequency):.4g} to {max(self.frequency):.4g} Hz>"

    @property
    def compliance(self) -> float:
        """Static compliance (m/N) of these modes; infinite with a rigid motion."""
        omega = 2 * np.pi * np.array(self.frequency)
        with np.errstate(divide="ignore"):
            return float(np.sum(1 / (np.array(self.mass) * omega**2)))


def modes_of_plate(sides, stiffness, mass_per_area, at, count):
    """Return frequencies (Hz) and modal masses (kg) of the lowest modes of a simply supported rectangle.

    `stiffness` is D₁₁, D₁₂ + 2 D₆₆ and D₂₂ (N·m), `at` the contact as shares of the sides (m). The modes
    are Navier's, sin(π i x/a) sin(π j y/b). Modes with a node at the contact are left out.
    """
    (a, b), (D11, H, D22) = sides, stiffness
    # For given i the lowest ω² is D₁₁ (1 − H²/D₁₁D₂₂) (π i/a)⁴ if H < 0, else at least D₁₁ (π i/a)⁴.
    least = 1 - min(H, 0.0) ** 2 / (D11 * D22)
    numbers = np.array([4, 4])
    while True:
        i, j = (np.ravel(n) for n in np.meshgrid(*(np.arange(1, n + 1) for n in numbers), indexing="ij"))
        x, y = np.pi * i / a, np.pi * j / b
        square = (D11 * x**4 + 2 * H * x**2 * y**2 + D22 * y**4) / mass_per_area
        shape = np.sin(np.pi * at[0] * i) * np.sin(np.pi * at[1] * j)
        order = np.argsort(square, kind="stable")
        order = order[np.abs(shape[order]) > _NODE][:count]
        # The lowest mode beyond the grid, along each side.
        beyond = least * np.array([D11, D22]) * (np.pi * (numbers + 1) / sides) ** 4 / mass_per_area
        highest = square[order[-1]] if order.size == count else np.inf
        if np.all(beyond > highest):
            mass = mass_per_area * a * b / 4 / shape[order] ** 2
            return np.sqrt(square[order]) / (2 * np.pi), mass
        numbers = np.where(beyond > highest, numbers, 2 * numbers)


def modes_of_beam(length, bending_stiffness, mass_per_length, at, count):
    """Return frequencies (Hz) and modal masses (kg) of the lowest modes of a simply supported beam."""
    k = np.arange(1, 2 * count + 2)
    while np.count_nonzero(np.abs(np.sin(np.pi * at * k)) > _NODE) < count:
        k = np.arange(1, 2 * k.size)
    shape = np.sin(np.pi * at * k)
    seen = np.flatnonzero(np.abs(shape) > _NODE)[:count]
    omega = (k[seen] * np.pi / length) ** 2 * np.sqrt(bending_stiffness / mass_per_length)
    return omega / (2 * np.pi), mass_per_length * length / 2 / shape[seen] ** 2


def compliance_of_plate(sides, stiffness, at):
    """Return the static compliance (m/N) of a simply supported rectangle at a point, by Lévy's series.

    Navier's double series is summed over one direction in closed form. Let β = π j/b, and −s the roots of
    D₂₂ β⁴ + 2 H α² β² + D₁₁ α⁴ in β². For each α = π i/a the sum is the divided difference of

        g(s) = (2/b) Σ sin²(β y)/(β² + s) = sinh(√s y) sinh(√s (b − y))/(√s sinh(√s b))
    """
    sides, at = np.asarray(sides), np.asarray(at)
    if sides[0] * (stiffness[0] / stiffness[2]) ** -0.25 > sides[1]:
        # In the other direction √s b is at least 3, and nothing cancels.
        sides, at, stiffness = sides[::-1], at[::-1], stiffness[::-1]
    (a, b), (D11, H, D22) = sides, stiffness
    i = np.arange(1, _TERMS + 1)
    unit = np.sqrt(complex(H * H - D11 * D22))
    low, high = H - unit, H + unit
    # For the accuracy of a root near 0: the smaller root is the product of the roots over the larger root.
    if abs(high) > abs(low):
        low = D11 * D22 / high
    else:
        high = D11 * D22 / low
    square = (np.pi * i / a) ** 2 / D22
    part = -_divided(low * square, high * square, b, at[1]) / D22
    terms = 2 / a * np.sin(np.pi * at[0] * i) ** 2 * part.real
    # Far terms go as 1/i³ times the square of the sine, with the mean 1/2.
    rest = terms.size**3 * part.real[-1] / a / (2 * (terms.size + 0.5) ** 2)
    return float(np.sum(terms[::-1]) + rest)


def _divided(first, second, b, at):
    """Return (g(s₂) − g(s₁))/(s₂ − s₁) of `compliance_of_plate` at complex numbers."""
    if abs(second[0] - first[0]) > _NEAR * abs(first[0]):
        return (_green(second, b, at)[0] - _green(first, b, at)[0]) / (second - first)
    node, weight = np.polynomial.legendre.leggauss(12)
    places = first + np.multiply.outer((node + 1) / 2, second - first)
    return weight / 2 @ _green(places, b, at)[1]


def _green(s, b, at):
    """Return g(s) of `compliance_of_plate`, and its derivative."""
    p = np.sqrt(s)
    lengths = 2 * b * np.array([at, 1 - at, 1.0])
    decays = [np.exp(-p * length) for length in lengths]
    lacks = [-np.expm1(-p * length) for length in lengths]
    value = lacks[0] * lacks[1] / (2 * p * lacks[2])
    slopes = [length * decay / lack for length, decay, lack in zip(lengths, decays, lacks, strict=True)]
    return value, value * (slopes[0] + slopes[1] - slopes[2] - 1 / p) / (2 * p)
