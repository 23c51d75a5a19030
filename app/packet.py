"""What the page draws of a trajectory: one buffer of numbers, in the units of its axes."""

import numpy as np

from .units import fitting, round_up

#: Depth of the springs' base below the surface, in units of the depth axis.
REST = 1.5
SPRINGS = 48
_EDGE = (1 - np.cos(np.linspace(0, np.pi, 48))) / 2


class Buffer:
    """Arrays end to end, and where each of them lies."""

    def __init__(self):
        self._parts, self.places, self._length = [], {}, 0

    def add(self, name, values, unit=1.0):
        """Append values (SI) in a unit given by its size."""
        values = np.asarray(values, float).ravel() / unit
        self.places[name] = [self._length, values.size]
        self._length += values.size
        self._parts.append(values)

    def joined(self):
        """All arrays as one, in single precision: finer than any screen."""
        with np.errstate(over="ignore", under="ignore"):
            return np.concatenate(self._parts).astype(np.float32)


def _axis(label, kind, largest, below=0.0):
    """An axis that ends at the next round number above `largest` (SI), in a unit that fits."""
    unit = fitting(largest, kind)
    end = round_up(largest / unit.factor)
    if end >= 1000:
        unit = fitting(end * unit.factor, kind)
        end = round_up(largest / unit.factor)
    return {
        "unit": unit.name,
        "factor": unit.factor,
        "start": -below * end,
        "end": end,
        "label": unit.label(label),
    }


class Drawing:
    """What is drawn of one trajectory, and with it what is held of another one."""

    def __init__(self, trajectory):
        self.trajectory = trajectory
        states = trajectory.states
        self.largest = {
            "length": 1.25 * float(np.max(states.contact_radius)),
            "depth": float(np.max(states.depth)),
            "force": 1.05 * float(np.max(trajectory.force)),
        }
        onset = trajectory.onset
        # An onset that lies little deeper than the path is kept in the picture.
        if onset is not None and self.largest["depth"] < onset.depth <= 2.5 * self.largest["depth"]:
            self.largest["onset"] = 1.02 * float(onset.depth)
            self.largest["force"] = max(self.largest["force"], 1.05 * float(onset.force))
        half = self.largest["length"]
        self.largest["pressure"] = 1.05 * _ceiling(trajectory, half)
        if trajectory.motion is not None:
            m = trajectory.motion
            self.largest["time"] = float(m.time[-1])
            self.largest["energy"] = float(m.kinetic_energy[0])

    def axes(self, held=None):
        """Axes that hold this drawing, and the held one if there is one."""

        def size(name):
            sizes = [each.largest.get(name, 0.0) for each in (self, held) if each is not None]
            return max(sizes)

        axes = {
            "x": _axis("x, coordinate of the springs", "length", size("length"), 1.0),
            "z": _axis("z, height", "length", size("depth"), REST),
            "d": _axis("d, indentation depth", "length", 1.02 * max(size("depth"), size("onset"))),
            "F": _axis("F, normal force", "force", size("force")),
            "a": _axis("a, c, radius", "length", size("length") / 1.1),
            "p": _axis("−σ_zz, contact pressure", "pressure", size("pressure")),
        }
        if "time" in self.largest:
            axes["t"] = _axis("t, time", "time", size("time"))
            axes["E"] = _axis("energy", "energy", size("energy"))
        axes["x"]["other"] = axes["x"]["label"].replace("x, coordinate of the springs", "r, radius")
        return axes

    def moving(self, buffer, axes):
        """Add the states along the way."""
        unit = {name: axis["factor"] for name, axis in axes.items()}
        trajectory, states = self.trajectory, self.trajectory.states
        for name, values in (("d", states.depth), ("dp", states.live.lower), ("live", states.live.length)):
            buffer.add(name, values, unit["d"])
        buffer.add("F", trajectory.force, unit["F"])
        buffer.add("a", states.contact_radius, unit["a"])
        buffer.add("c", states.plastic_radius, unit["a"])
        energy = unit.get("E") or _axis("", "energy", float(np.max(_work(states))))["factor"]
        buffer.add("U", trajectory.stored_energy, energy)
        buffer.add("W", trajectory.plastic_work, energy)
        if trajectory.motion is not None:
            motion = trajectory.motion
            buffer.add("t", motion.time, unit["t"])
            buffer.add("v", motion.velocity, float(motion.velocity[0]))
            buffer.add("K", motion.kinetic_energy, energy)
            buffer.add("V", motion.viscous_work, energy)
        return energy

    def still(self, buffer, axes):
        """Add the profile along the springs, and where each spring stands."""
        profile, unit = self.trajectory.scene.profile, axes["x"]["factor"]
        half = axes["x"]["end"] * unit
        spots = half * (np.arange(SPRINGS // 2) + 0.5) / (SPRINGS / 2)
        fine = _outline(profile, 1.1 * half)
        buffer.add("spot", spots, unit)
        buffer.add("spot g", _reduced(profile, spots), axes["z"]["factor"])
        buffer.add("fine", fine, unit)
        buffer.add("fine g", _reduced(profile, fine), axes["z"]["factor"])

    def fields(self, buffer, axes, indices):
        """Add the pressure over the radius and the unloading curve of some states, end to end."""
        half = axes["x"]["end"] * axes["x"]["factor"]
        radii = [_radii(self.trajectory, index, half) for index in indices]
        pressure = [self.trajectory.pressure(i, r) for i, r in zip(indices, radii, strict=True)]
        buffer.add("count", [len(r) for r in radii])
        buffer.add("r", np.concatenate(radii), axes["x"]["factor"])
        buffer.add("p", np.concatenate(pressure), axes["p"]["factor"])
        depth, force = self.trajectory.released(np.asarray(indices))
        buffer.add("out d", depth, axes["d"]["factor"])
        buffer.add("out F", force, axes["F"]["factor"])

    def held(self, buffer, axes):
        """Add the curves to compare with."""
        states, trajectory = self.trajectory.states, self.trajectory
        half = axes["x"]["end"] * axes["x"]["factor"]
        r = _radii(trajectory, trajectory.now, half)
        columns = (
            ("d", states.depth, "d"),
            ("F", trajectory.force, "F"),
            ("a", states.contact_radius, "a"),
            ("c", np.where(states.plastic_radius > 0, states.plastic_radius, np.nan), "a"),
            ("r", r, "x"),
            ("p", trajectory.pressure(trajectory.now, r), "p"),
        )
        for name, values, axis in columns:
            buffer.add(f"held {name}", values, axes[axis]["factor"])
        if trajectory.motion is not None and "t" in axes:
            buffer.add("held t", trajectory.motion.time, axes["t"]["factor"])


def _work(states):
    return states.stored_energy + states.plastic_work


def _reduced(profile, x):
    """Reduced profile, not a number where the shape is not known."""
    known = x <= profile.known_radius
    return np.where(known, profile.reduced(np.where(known, x, 0.0)), np.nan)


def _kinks(profile):
    """Radii (m) of the flat face and of the kinks."""
    return [profile.face_radius, *profile.contact_radius(np.array(profile.kinks)).tolist()]


def _outline(profile, half):
    """Coordinates x from 0 to `half`, with the profile's kinks and its wall among them."""
    kinks = _kinks(profile)
    wall = [profile.wall, profile.wall * (1 + 1e-9)] if profile.wall < half else []
    x = np.unique(np.concatenate([np.linspace(0, half, 81), kinks[:200], wall]))
    return x[x <= half]


def _radii(trajectory, index, half):
    """Radii from 0 to `half`, dense where the pressure has an edge: at 0, c, a and at kinks."""
    states = trajectory.states
    a, c = float(states.contact_radius[index]), float(states.plastic_radius[index])
    kinks = [kink for kink in _kinks(trajectory.scene.profile) if 0 < kink < a]
    edges = np.array(sorted(edge for edge in {0.0, half, a, c, *kinks[:3]} if edge <= half))
    return np.unique((edges[:-1, None] + np.diff(edges)[:, None] * _EDGE).ravel())


def _ceiling(trajectory, half):
    """The largest pressure to draw: where it is infinite, some times the mean."""
    pressure = trajectory.pressure(trajectory.peak, _radii(trajectory, trajectory.peak, half))
    finite = np.isfinite(pressure)
    largest = float(np.max(pressure[finite], initial=0.0))
    deepest = trajectory.deepest
    mean = float(deepest.force / (np.pi * deepest.contact_radius**2)) if deepest.contact_radius > 0 else 0.0
    return largest if finite.all() else min(largest, 4 * mean)
