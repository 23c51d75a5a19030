"""Random ensembles of shapes, classes of hardness, structures and solvers, against a loop of single calls.

An ensemble is known by its seed. `deviations` calls its solver once with arrays, and once for each entry.
"""

import re
from dataclasses import dataclass, replace

import numpy as np

import mdr_core as mdr

from .laws import Decaying, Layered, NixGao, Written
from .random_cases import SUMS, TIPS, E

#: Shapes of ensembles, and of arguments that broadcast to each of them.
SIZES = {(3,): ((3,),), (2, 3): ((2, 3), (2, 1), (1, 3), (3,), (1,))}
#: What an entry has none or one of, with the number that means none.
APART = {
    "medium.eta": 0.0, "medium.work_of_adhesion": 0.0, "structure.impedance": np.inf,
    "structure.stiffness": np.inf,
}  # fmt: skip
#: Names of their dimensions in a sweep.
DIMENSIONS = ("row", "column")
#: Depths of a path over the largest one before the last: loading, unloading, reloading.
PATH = np.array([0.0, 0.4, 1.0, 0.98, 0.7, 1.1])
#: Largest error of a stiffness, which has g′: of a `Smooth` tip that is the derivative of an interpolation.
STIFFNESS = 1e-10
#: Largest errors of a state, of a dry impact, and of an impact in time, on a plate or a viscous medium, and
#: of any contact time. Two calls may deviate by twice as much.
STATE, DRY, IN_TIME = 1e-12, 1e-10, 1e-9
#: Tolerances of the chain and of friction, which state their errors.
CHAIN, FRICTION = 1e-3, 1e-5


@dataclass(frozen=True)
class Ensemble:
    """A call of a solver with numbers and arrays, by names such as "mass" and "medium.E_star"."""

    seed: int
    solver: str
    profile: mdr.Profile
    law: type | None
    values: dict
    shape: tuple
    #: A structure by its modes, of which there is one for all entries.
    modal: mdr.Structure | None = None

    def __str__(self):
        kind = self.law.__name__ if self.law else "constants"
        kind += " on modes" if self.modal else ""
        values = ", ".join(f"{name} {np.shape(value) or ''}" for name, value in self.values.items())
        return f"seed {self.seed}: {self.solver}, {type(self.profile).__name__}, {kind}, {values}"

    def at(self, index):
        """The call with the numbers at an index."""
        values = {k: float(np.broadcast_to(v, self.shape)[index]) for k, v in self.values.items()}
        return replace(self, values=values, shape=())

    def given(self, owner):
        """Parameters of the profile, the medium, the law or the structure."""
        return {k.partition(".")[2]: v for k, v in self.values.items() if k.startswith(f"{owner}.")}

    @property
    def structure(self):
        return self.modal or mdr.Structure(**self.given("structure"))

    @property
    def others(self):
        """Arguments of the solver that are no parameters."""
        return {name: value for name, value in self.values.items() if "." not in name}

    def pair(self):
        """The profile and the medium."""
        own, medium = self.given("profile"), self.given("medium")
        if self.law:
            medium["hardness"] = self.law(**self.given("law"))
        return type(self.profile)(**own) if own else self.profile, mdr.Medium(**medium)


def random_ensemble(seed):
    """The ensemble of a seed; solvers and shapes take turns."""
    rng = np.random.default_rng(seed)
    solver, tip = list(SOLVERS)[seed % len(SOLVERS)], list(TIPS.values())[seed % len(TIPS)]
    profile = tip(rng)
    largest = min(3e-7, 0.5 * float(profile.known_depth)) * 10 ** rng.uniform(-1.5, 0)
    state = mdr.indent(profile, mdr.Medium(E), largest)
    values = {"medium.E_star": E}
    if not isinstance(profile, mdr.Sampled | mdr.Smooth):
        values |= {f"profile.{name}": x for name, x in profile.__getstate__().items() if np.ndim(x) == 0}
    law, hardness = _hardness(rng, largest, float(state.contact_radius))
    values |= hardness
    modal = None
    if solver in ("indent", "sweep.indentations"):
        values["depth"] = largest
    else:
        values |= _impact(rng, solver, largest, float(state.force), float(state.stored_energy))
        if solver in MODAL and rng.random() < 0.25:
            modal = _modes(rng, values, float(state.force) / largest)
    # Under facets the rim jumps, which is computed for one medium at a time.
    facets = isinstance(profile, mdr.Sampled)
    if law is None and not (facets or modal) and solver in ADHESIVE and rng.random() < 0.3:
        values["medium.work_of_adhesion"] = 10 ** rng.uniform(-4, -2) * E * largest
    shape = list(SIZES)[rng.integers(len(SIZES))]
    return Ensemble(seed, solver, profile, law, _with_arrays(rng, solver, values, shape), shape, modal)


def _hardness(rng, largest, a):
    """Type of a law or None, and constants by which the caps are 0.01 to 2 times the largest depth (m)."""
    line_load = 2 * E * largest / np.pi * 10 ** rng.uniform(-2, 0.3)
    hardness, length = line_load / a, a * rng.uniform(0.5, 2)
    if rng.random() < 0.3:
        laws = {
            NixGao: {"H0": hardness, "a_star": length},
            Decaying: {"H": hardness, "k": rng.uniform(0.2, 2), "L": length},
            Layered: {"H": hardness, "k": rng.uniform(0.1, 0.6), "L": length, "w": rng.uniform(0.2, 1)},
            Written: {"H": hardness / 2, "q": line_load / 3, "f": line_load * length / 5},
        }
        law = list(laws)[rng.integers(len(laws))]
        return law, {f"law.{name}": value for name, value in laws[law].items()}
    constants = {"a": ("hardness", hardness), "b": ("q_c", line_load), "c": ("f_c", line_load * a)}
    pairs = (constants[letter] for letter in SUMS[rng.integers(len(SUMS))])
    return None, {f"medium.{name}": value for name, value in pairs}


def _impact(rng, solver, largest, force, energy):
    """Arguments of an impact that comes to a depth (m) where nothing yields: a force (N), an energy (J)."""
    mass, stiffness = 10 ** rng.uniform(-13, -9), force / largest
    speed = np.sqrt(2 * energy / mass)
    values = {"mass": mass, "speed": speed}
    if solver == "sweep.oblique_impacts":
        return values | {"tangential_speed": speed * rng.uniform(0, 3), "friction": rng.uniform(0.05, 1)}
    if solver != "chain_impact" and rng.random() < 0.4:
        values["plastic_depth"] = largest * rng.uniform(0, 0.5)
    if rng.random() < 0.3:
        values["medium.eta"] = 10 ** rng.uniform(-3, 1) * E / 4 * largest / speed
    if rng.random() < 0.5:
        values["structure.impedance"] = 10 ** rng.uniform(-0.7, 2) * np.sqrt(mass * stiffness)
    if rng.random() < 0.5:
        values["structure.stiffness"] = 10 ** rng.uniform(-1.5, 2) * stiffness
    return values


def _modes(rng, values, stiffness):
    """A structure by one to three modes, about as stiff as the contact (N/m), instead of another one."""
    # Viscous media are refused, which is tried, too.
    viscous = ("medium.eta",) if rng.random() < 0.9 else ()
    for name in ("structure.impedance", "structure.stiffness", *viscous):
        values.pop(name, None)
    mass = values["mass"] * 10 ** rng.uniform(-1, 1, rng.integers(1, 4))
    frequency = np.sqrt(stiffness / values["mass"]) * 10 ** rng.uniform(-0.7, 0.7, mass.size) / 2 / np.pi
    return mdr.Structure.modal(frequency, mass, damping=rng.choice([0.0, 0.05]))


def _with_arrays(rng, solver, values, shape):
    """The values, of which some are arrays; in each row one of what does not go together, or none."""
    result = {}
    for name, value in values.items():
        # A sweep has one law for all.
        many = rng.random() < 0.4 and not (name.startswith("law.") and solver.startswith("sweep"))
        size = SIZES[shape][rng.integers(len(SIZES[shape]))] if many else ()
        spread = 0.02 if name == "profile.exponent" else 0.4
        result[name] = value * rng.uniform(1 - spread, 1 + spread, size)
    name = "speed" if "speed" in values else "depth"
    result[name] = result[name] * rng.uniform(0.8, 1.2, shape)
    apart = [name for name in APART if name in values]
    # Together they are refused, which is tried, too.
    if len(apart) > 1 and rng.random() < 0.9:
        turn = rng.integers(len(apart) + 1, size=shape)
        for number, name in enumerate(apart):
            result[name] = np.where(turn == number, result[name], APART[name])
    if not np.any(result.get("medium.work_of_adhesion", 0.0)):
        result.pop("medium.work_of_adhesion", None)
    elif {"medium.hardness", "medium.f_c"} & result.keys() and rng.random() < 0.9:
        sticks = np.broadcast_to(result["medium.work_of_adhesion"] > 0, shape)
        for name in {"medium.hardness", "medium.f_c"} & result.keys():
            result[name] = np.where(sticks, 0.0, result[name])
        result["medium.q_c"] = np.where(
            sticks, result.get("medium.q_c", np.inf), result.get("medium.q_c", 0.0)
        )
    return result


def compared(ensemble):
    """Largest deviations of the quantities of entries from single calls, over their bounds.

    Where a single call raises an error, the call with arrays must raise one that names such an entry.
    """
    many, one = SOLVERS[ensemble.solver]
    single, refused = {}, np.zeros(ensemble.shape, bool)
    for index in np.ndindex(ensemble.shape):
        try:
            single[index] = one(ensemble.at(index))(())
        except ValueError:
            refused[index] = True
        if one is _chain:
            # It takes a second for each impact.
            break
    if one is _chain and refused.any():
        # It takes no more than 20,000 steps.
        return {}
    try:
        result = many(ensemble)
    except ValueError as error:
        # Entries with adhesion are solved apart from others, by a sweep on its own.
        mixed = "solve these separately" in str(error) and not ensemble.solver.startswith("sweep")
        if one is _chain or mixed or _names_one(error, refused):
            return {}
        raise AssertionError(f"{ensemble}: {error}") from error
    assert not refused.any(), f"{ensemble}: {np.argwhere(refused).tolist()} raise an error alone"
    misses = {}
    for index, expected in single.items():
        for name, miss in _misses(result(index), expected, _bound(ensemble)).items():
            misses[name] = max(misses.get(name, 0.0), miss)
    return misses


def _names_one(error, refused):
    """Whether an error names an entry that is refused alone; a number of all needs no index."""
    bad = np.broadcast_to(getattr(error, "bad", refused), refused.shape)
    named = re.search(r"\[\d+(, \d+)*\] = ", str(error)) is not None
    return bool(np.any(bad & refused)) and (named or refused.all())


def _bound(ensemble):
    """Largest deviation of a quantity over its size."""
    if "speed" not in ensemble.values:
        return 2 * STATE
    if ensemble.solver == "sweep.oblique_impacts":
        return 2 * IN_TIME
    dry = not (ensemble.modal or ensemble.values.keys() & {"medium.eta", "structure.impedance"})
    return 2 * (DRY if dry and ensemble.solver != "motion" else IN_TIME)


def _misses(result, expected, bound):
    """Deviations of the quantities of one entry over the bound, or over the errors that are stated."""
    errors, misses = expected.pop("errors", None), {}
    for name in result.keys() & expected.keys():
        value, other = np.asarray(result[name]), np.asarray(expected[name])
        with np.errstate(invalid="ignore"):
            miss = np.max(np.where(value == other, 0.0, np.abs(value - other)))
        # Infinite times of bodies that never leave are the same.
        if miss == 0:
            allowed = 1.0
        elif errors is None:
            own = {"contact_time": 2 * IN_TIME, "stiffness": 2 * STIFFNESS}
            allowed = own.get(name, bound) * _size(name, expected)
        else:
            allowed = getattr(errors, name) * np.abs(other) if other else CHAIN
        misses[name] = float(miss / allowed)
    return misses


def _size(name, entry):
    """Size of a quantity of a path, an impact or a motion, by which a deviation is judged."""
    if name == "restitution":
        return 1.0
    if name == "plastic_depth":
        return np.max(entry.get("max_depth", entry.get("depth")))
    # c is as well known as d_p, of which it is a small power.
    if name == "plastic_radius" and "contact_radius" in entry:
        return np.max(entry["contact_radius"])
    if name == "damaged_area":
        return np.pi * entry["contact_radius"] ** 2
    if name.endswith(("work", "energy")):
        if "kinetic_energy" in entry:
            return entry["kinetic_energy"][0]
        if "mass" in entry:
            return entry["mass"] * entry["speed"] ** 2 / 2
    return np.max(np.abs(entry[name]))


def _entries(result):
    """Quantities of an entry of a result by its index."""
    values = result.to_dict()
    return lambda index: {name: np.asarray(value)[index] for name, value in values.items()}


def _indent(case):
    """A path for each entry, along a last axis, which other arrays have with length 1."""
    values = {name: value[..., None] if np.ndim(value) else value for name, value in case.values.items()}
    long = replace(case, values=values)
    return _entries(mdr.indent(*long.pair(), long.others["depth"] * PATH))


def _first_loading(case):
    return _entries(mdr.indent(*case.pair(), case.others["depth"]))


def _hit(case):
    return mdr.impact(*case.pair(), **case.others, structure=case.structure)


def _impacts(case):
    return _entries(_hit(case))


def _motions(case):
    hit = _hit(case)
    return lambda index: hit[index].motion(9).to_dict()


def _chain(case):
    structure = mdr.Structure(**case.given("structure"))
    hit = mdr.chain_impact(*case.pair(), **case.others, structure=structure, tolerance=CHAIN)
    return lambda index: {name: getattr(hit, name) for name in hit.errors._fields} | {"errors": hit.errors}


def _oblique(case):
    return _entries(mdr.oblique_impact(*case.pair(), **case.others, tolerance=FRICTION))


def _sweep(kind, **other):
    def solve(case):
        import xarray as xr

        given = {}
        for name, value in case.values.items():
            axes = DIMENSIONS[-np.ndim(value) :] if np.ndim(value) else ()
            dims = [dim for dim, size in zip(axes, np.shape(value), strict=True) if size > 1]
            if not name.startswith("law."):
                given[name.partition(".")[2] or name] = xr.DataArray(np.squeeze(value), dims=dims)
        if case.law:
            given["hardness"] = case.law(**case.given("law"))
        if case.modal:
            given["structure"] = case.modal
        shape = type(case.profile) if case.given("profile") else case.profile
        table = getattr(mdr.sweep, kind)(shape, **given, quantities=QUANTITIES[kind], **other)
        grid = xr.DataArray(np.zeros(case.shape), dims=DIMENSIONS[-len(case.shape) :])
        table = {name: (grid + value).transpose(*grid.dims).values for name, value in table.items()}
        return lambda index: {name: value[index] for name, value in table.items()}

    return solve


QUANTITIES = {
    "impacts": (
        "restitution", "contact_time", "max_depth", "max_force", "plastic_work", "structure_work",
        "max_deflection",
    ),
    "indentations": ("force", "stored_energy", "plastic_work", "plastic_radius", "stiffness"),
    "oblique_impacts": ("restitution", "tangential_velocity", "friction_work", "max_tangential_force"),
}  # fmt: skip
#: The solver of an ensemble, and that of an entry: each returns quantities by an index.
MODAL = ("impact", "motion", "sweep.impacts")
SOLVERS = {
    "impact": (_impacts, _impacts),
    "indent": (_indent, _indent),
    "motion": (_motions, _motions),
    "chain_impact": (_impacts, _chain),
    "sweep.impacts": (_sweep("impacts"), _impacts),
    "sweep.indentations": (_sweep("indentations"), _first_loading),
    "sweep.oblique_impacts": (_sweep("oblique_impacts", tolerance=FRICTION), _oblique),
}
ADHESIVE = ("impact", "indent", "sweep.impacts", "sweep.indentations")
