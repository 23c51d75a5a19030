"""What people use today, set up as their documentation does: tamaas, ContactMechanics.

They find the elastic contact of any rough surface by boundary elements and FFT, here in their
non-periodic mode. Neither is needed: those that do not import are left out and reported.
"""

import warnings
from functools import cache
from importlib import import_module, metadata

import numpy as np

from mdr_core import indent

from . import exact
from .harness import Method

_NAMES = "tamaas", "ContactMechanics"
#: Contact radius over half the width of the box.
_FILL = 0.8


@cache
def versions():
    """Version of each peer, or why it is not there."""
    found = {}
    for name in _NAMES:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                import_module(name)
        except (ImportError, OSError) as reason:
            found[name] = f"not imported: {reason}"
        else:
            found[name] = metadata.version(name)
    return found


def is_there(name):
    return not versions()[name].startswith("not")


class Square:
    """Cell centres of an n × n grid around a contact of radius a, and what is exact there.

    The codes have absolute tolerances, so that they get the problem in units of a, the depth and
    E*: `box`, `height`, and `push`, the force in these units.
    """

    def __init__(self, profile, medium, depth, n):
        self.profile, self.medium, self.depth, self.n = profile, medium, depth, n
        self.box = 2 / _FILL
        x = ((np.arange(n) + 0.5) / n - 0.5) * self.box
        self.radius = float(profile.contact_radius(depth))
        self.r = self.radius * np.hypot(x[:, None], x)
        self.height = profile.height(self.r) / depth
        self.unit = medium.E_star * self.radius * depth
        self.push = float(indent(profile, medium, depth).force) / self.unit
        self._radii, self._inverse = np.unique(self.r, return_inverse=True)

    @property
    def exact(self):
        return _field(self.profile, self.medium, self.depth, self.n)

    def error(self, pressure):
        return self.exact.error(np.ravel(pressure))


@cache
def _field(profile, medium, depth, n):
    square = Square(profile, medium, depth, n)
    field = exact.pressure(profile, medium, depth, square._radii)
    field.high, field.low = (part[square._inverse.ravel()] for part in (field.high, field.low))
    return field


def boundary_elements(square):
    """The pressure by both codes on one grid."""
    methods = []
    if is_there("tamaas"):
        methods += [
            Method("tamaas", f"{square.n}², tolerance {tol:g}", lambda tol=tol: _tamaas(square, tol))
            for tol in (1e-3, 1e-6)
        ]
    if is_there("ContactMechanics"):
        setting = f"{square.n}², its tolerances"
        methods.append(Method("ContactMechanics", setting, lambda: _contact_mechanics(square)))
    return methods


def _tamaas(square, tolerance):
    import tamaas

    tamaas.set_log_level(tamaas.LogLevel.error)
    n, box, height = square.n, square.box, square.height
    model = tamaas.Model(tamaas.model_type.basic_2d, [box, box], [n, n])
    model.E, model.nu = 1.0, 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "free")
    solver = tamaas.PolonskyKeerRey(model, -height, tolerance)
    solver.setIntegralOperator("free")

    def call():
        model.traction[:] = 0
        solver.solve(square.push / box**2)
        return model.traction * (square.unit / square.radius**2)

    return call


def _contact_mechanics(square):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from ContactMechanics import FreeFFTElasticHalfSpace, make_system
        from SurfaceTopography import Topography
    n, box = square.n, square.box
    surface = Topography(-square.height, (box, box))
    half_space = FreeFFTElasticHalfSpace((n, n), 1.0, (box, box))
    system = make_system(substrate=half_space, surface=surface)
    # Its default, which it takes by a route that it warns about.
    penetration = square.height.std() / (10 * n)

    def call():
        forces = np.asarray(system.minimize_proxy(offset=1.0, pentol=penetration).jac)[:n, :n]
        return forces * (square.unit * (n / box / square.radius) ** 2)

    return call
