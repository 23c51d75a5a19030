"""The motion of one impact over time, with its energy ledger, for plots and playback."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Motion:
    """One impact from first contact to its loss, as arrays of one length: at equal steps of time, or at
    those of the chain.

    On a virgin medium elements of the foundation under the contact radius are in contact. On
    unloading of a viscous one its edge is where g = d_p + ℓ, ahead of the depth d itself; elements
    outside have let go and relax. The energies sum to the same, at every instant.

    Attributes
    ----------
    time : ndarray
        Time (s) since first contact; of a chain that is not virgin, since the start.
    depth, velocity, force : ndarray
        Indentation depth d (m), its rate (m/s), force (N).
    contact_radius, plastic_radius : ndarray
        Radii a and c (m).
    plastic_depth, live_depth : ndarray
        Plastic depth d_p and length ℓ of the live interval [d_p, d_p + ℓ] (m): what the load has
        compressed the spring at the axis by.
    kinetic_energy, stored_energy, plastic_work, viscous_work : ndarray
        The ledger (J). Stored is the energy of all springs, of those too that have let go.
    """

    time: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    contact_radius: np.ndarray
    plastic_radius: np.ndarray
    plastic_depth: np.ndarray
    live_depth: np.ndarray
    kinetic_energy: np.ndarray
    stored_energy: np.ndarray
    plastic_work: np.ndarray
    viscous_work: np.ndarray
