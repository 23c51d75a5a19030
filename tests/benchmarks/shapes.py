"""The indenters and media of the benchmarks."""

import mdr_core as mdr

from .harness import Method

CONE, PARABOLOID, SPHERE = mdr.Cone(0.1), mdr.Paraboloid(1e-3), mdr.Sphere(1e-3)
QUARTIC = mdr.PowerLaw(1e9, 4.0)
ELASTIC, SOFT = mdr.Medium(1e9), mdr.Medium(1e9, 1e-3)


def by_quadrature(profile):
    """The same shape, told in a way for which there are no closed forms."""
    if profile is CONE:
        return mdr.Sampled([0.0, 1.0], [0.0, CONE.slope])
    if profile is PARABOLOID:
        return mdr.Smooth(lambda r: r / PARABOLOID.radius)
    return mdr.Smooth(
        lambda r: r / ((profile.radius - r) * (profile.radius + r)) ** 0.5, radius=profile.radius
    )


def solver(profile, run, setting=""):
    """The solver in closed form and by quadrature; `run` takes the shape."""
    families = ("mdr_core", profile), ("mdr_core, quadrature", by_quadrature(profile))
    return [Method(family, setting, lambda shape=shape: lambda: run(shape)) for family, shape in families]
