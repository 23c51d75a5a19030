"""Effective modulus of a half-space pressed along its axis of elastic symmetry."""

import numpy as np

from ...base import check

#: Rounding of 1 − ν_p − 2ν²E_p/E_z, which is 0 for an incompressible medium.
_ROUNDING = 1e-14


def effective_modulus(E_in_plane, E_axial, nu_in_plane, nu_axial, G_axial):
    """Return the effective modulus E* (Pa) from the five constants of a transversely isotropic half-space.

    Its surface is the plane of isotropy. With ν = ν_zp and the stiffnesses C of the medium (Elliott 1948;
    Hanson 1992; Delafargue and Ulm 2004)

        E* = 2 √( (C₁₁C₃₃ − C₁₃²)/C₁₁ / (1/C₄₄ + 2/(√(C₁₁C₃₃) + C₁₃)) )

    where, with n = E_p/E_z and Δ = 1 − ν_p − 2nν²,

        C₁₁ = E_p (1 − nν²)/((1 + ν_p) Δ)      C₃₃ = E_z (1 − ν_p)/Δ      C₁₃ = E_p ν/Δ      C₄₄ = G_z

    The first quotient is then E_z/(1 − nν²), and the last quotient is finite for Δ → 0. The arguments are
    the same as in `Medium.from_transversely_isotropic`.
    """
    given = {"E_in_plane": E_in_plane, "E_axial": E_axial, "G_axial": G_axial}
    E_p, E_z, G_z = (check.positive(f"modulus {name}", value, unit="Pa") for name, value in given.items())
    nu_p = check.finite_array("Poisson ratio nu_in_plane", nu_in_plane)
    nu = check.finite_array("Poisson ratio nu_axial", nu_axial)
    check.common_shape("medium", **given, nu_in_plane=nu_p, nu_axial=nu)
    n = E_p / E_z
    delta = _stable(n, nu_p, nu)
    with_plane = E_z / (1 - n * nu**2)
    mean = np.sqrt(E_p * E_z * (1 - n * nu**2) * (1 - nu_p) / (1 + nu_p))
    return 2 * np.sqrt(with_plane / (1 / G_z + 2 * delta / (mean + nu * E_p)))


def _stable(n, nu_p, nu):
    """Return Δ = 1 − ν_p − 2nν² if the elastic energy of every strain is positive; 0 if incompressible."""
    bound = "must lie in −1 < ν < 1"
    check.raise_if("Poisson ratio nu_in_plane", nu_p, np.abs(nu_p) >= 1, bound, advice="check it")
    delta = 1 - nu_p - 2 * n * nu**2
    unstable = delta < -_ROUNDING
    if np.any(unstable):
        nu, largest = np.broadcast_arrays(nu, np.sqrt((1 - nu_p) / (2 * n)))
        bound = (
            "leaves no stable medium: 1 − ν_p − 2ν_zp² E_p/E_z must be positive, so that |nu_axial| must "
            f"be below {largest[unstable].min():.4g}"
        )
        advice = "nu_axial is ν_zp = ν_pz E_z/E_p, the strain in the plane for a stress along the axis"
        check.raise_if("Poisson ratio nu_axial", nu, unstable, bound, advice=advice)
    return np.maximum(delta, 0.0)
