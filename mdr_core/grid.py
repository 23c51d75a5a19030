"""Where the elements of a chain stand: a grid that knows the shape.

Edges between elements stand on the axis, on the flat face, kinks and wall of the shape, and on the
radii that are asked for; elements sit in the middle between edges. With every kink of the line load
on an edge, the sum over elements is of second order.
"""

import numpy as np


def cell_edges(profile, count, half_width, nodes=()):
    """Edges between the elements on one side of the axis.

    Parameters
    ----------
    profile : Profile
        The indenter.
    count : int
        Number of elements on this side, at least one for each stretch between nodes.
    half_width : float
        Where the row ends (m).
    nodes : sequence of float, optional
        Further radii (m) that must be edges, as those of the contact and of the plastic zone.

    Returns
    -------
    ndarray, shape (count + 1,)
        Ascending from 0 to `half_width`.

    Raises
    ------
    ValueError
        If there are fewer elements than stretches.
    """
    posts = _posts(profile, half_width, nodes)
    share = np.diff(posts) / half_width
    if len(share) > count:
        raise ValueError(
            f"n = {2 * count} elements cannot stand on the {len(share)} stretches between the axis, the "
            f"kinks of the shape and the nodes on each side; give at least n = {2 * len(share)}"
        )
    # Half of them by length, half for each stretch alike: one just behind a flat face is short.
    share = (share + 1 / len(share)) / 2
    # One each to begin with; the rest rounded so that they add up.
    extra = np.diff(np.floor((count - len(share)) * np.append(0, np.cumsum(share)) + 0.5).astype(int))
    extra[-1] += count - len(share) - extra.sum()
    stretches = zip(posts, posts[1:], 1 + extra, _grading(profile, posts), strict=False)
    return np.append(
        np.concatenate([low + (high - low) * (np.arange(n) / n) ** p for low, high, n, p in stretches]),
        half_width,
    )


def _posts(profile, half_width, nodes):
    """The radii (m) on which edges must stand, from 0 to the half-width, none closer than rounding."""
    kinks = np.array([0.0, *profile.kinks])
    with np.errstate(all="ignore"):
        # At depth 0 the contact radius is that of the flat face.
        own = profile.contact_radius(kinks)
    radii = np.concatenate([own, [profile.wall], np.asarray(nodes, dtype=float)])
    radii = np.unique(radii[(radii > 0) & (radii < half_width * (1 - 1e-12))])
    apart = np.diff(radii, prepend=0.0) > 1e-12 * half_width
    return np.concatenate([[0.0], radii[apart], [half_width]])


def _grading(profile, posts):
    """The power p with which the edges of each stretch are set as ξ^p, 1 for equal ones.

    Where g rises from the lower end with a vertical tangent, as (x − low)^n with n < 1, the cells
    narrow toward it with p = 3/(1 + n): then h³ g″ is the same for all of them.
    """
    low, long = posts[:-1], np.diff(posts)
    with np.errstate(all="ignore"):
        foot, near, far = profile.reduced(low + long * np.array([[0.0], [2.0**-20], [2.0**-19]]))
        exponent = np.log2((far - foot) / (near - foot))
    return np.where((exponent > 0) & (exponent < 0.99), 3 / (1 + exponent), 1.0)
