"""A whole page as a link and as a scene file, and back; what comes from outside is bounded or refused."""

import json
from math import inf, isfinite
from urllib.parse import urlencode

import mdr_core as mdr

from .presets import PRESETS
from .quantities import CHOICES, QUANTITIES, SURFACE, shape_quantities, used
from .shapes import SHAPES
from .state import LAST_PROGRESS, Explorer
from .tip import MOST_SAMPLES

#: Longest link, and most characters of a file.
LONGEST_LINK, LARGEST_FILE = 8000, 2_000_000
_SAMPLES = 120


def query(state):
    """The page as the query of a link, with every number that is used; empty if it is too long for one."""
    pairs = {"preset": state.preset} | state.choices
    pairs |= {name: f"{state.numbers[name]!r}" for name in used(state.choices)}
    pairs["at"] = f"{state.progress:.6g}"
    if state.shape == "sampled":
        r, z = state.samples
        if len(r) > _SAMPLES:
            return ""
        pairs["samples"] = " ".join(f"{x!r},{y!r}" for x, y in zip(r, z, strict=True))
    text = urlencode(pairs)
    return text if len(text) <= LONGEST_LINK else ""


def restore(arguments):
    """The state that `query` wrote, from the arguments of a request: lists of bytes by name.

    Raises
    ------
    ValueError
        If anything in them is unknown, said twice, or out of bounds.
    """
    if (
        len(arguments) > 60
        or sum(len(text) for values in arguments.values() for text in values) > LONGEST_LINK
    ):
        raise ValueError("this link is too long")
    if any(len(values) > 1 for values in arguments.values()):
        raise ValueError("this link says the same thing twice")
    pairs = {name: values[0].decode("utf-8", "replace") for name, values in arguments.items()}
    if pairs.get("preset") not in PRESETS:
        raise ValueError("this link names no preset that is known")
    state = Explorer(pairs.pop("preset"))
    if "samples" in pairs:
        state.samples = _samples(pairs.pop("samples"))
    for name in CHOICES.keys() & pairs.keys():
        option = pairs.pop(name)
        if option not in CHOICES[name] or (option == "sampled" and state.samples is None):
            raise ValueError(f"{name} = {option:.40} in this link is not known")
        state.choices[name] = option
    state.move(_number("at", pairs.pop("at", "1")))
    for name, value in pairs.items():
        if name not in QUANTITIES:
            raise ValueError(f"this link sets {name:.40}, which is not known")
        state.set(name, _number(name, value))
    state.resets = dict(state.numbers)
    return state


def _number(name, text):
    try:
        value = float(text) if len(text) <= 40 else inf
    except ValueError:
        value = inf
    if not isfinite(value):
        raise ValueError(f"{name:.40} = {text:.40} in this link is not a number")
    return value


def _samples(text):
    points = [point.split(",") for point in text.split(" ")]
    if len(points) > _SAMPLES or any(len(point) != 2 for point in points):
        raise ValueError("the samples in this link are not pairs")
    r, z = zip(*((_number("samples", a), _number("samples", b)) for a, b in points), strict=True)
    tip = mdr.Sampled(r, z)
    return tip.r, tip.z


def scene_file(trajectory):
    """The scene as JSON: pressed to its largest value and, if need be, on to the present one."""
    scene, now, peak = trajectory.scene, trajectory.now, trajectory.peak
    if now != peak and not isinstance(scene.drive, mdr.FreeImpact):
        prescribes_depth = isinstance(scene.drive, mdr.DepthPath)
        along = trajectory.states.depth if prescribes_depth else trajectory.force
        path = along[[now]] if now < peak else along[[peak, now]]
        scene = mdr.Scene(scene.profile, scene.medium, type(scene.drive)(path))
    return scene.to_json()


def from_scene(text, before):
    """The state of a scene file, with what the file does not say taken from `before`.

    Raises
    ------
    ValueError
        If it is no scene, or one that the page cannot show.
    """
    if len(text) > LARGEST_FILE:
        raise ValueError("the file is larger than 2 MB")
    _refuse_long(text)
    scene = mdr.Scene.from_json(text)
    if getattr(scene.drive, "time", None) and scene.medium.eta > 0:
        raise ValueError("a viscous path in time is not shown here: solve it with mdr.Scene.from_json(...)")
    state = Explorer(before.preset)
    _set_profile(state, scene.profile)
    medium = scene.medium
    state.choices |= {
        "elasticity": "modulus",
        "plasticity": "q_c" if medium.q_c < inf else "none",
        "damping": "eta" if medium.eta > 0 else "none",
    }
    state.set("E_star", medium.E_star)
    if medium.q_c < inf:
        state.set("q_c", medium.q_c)
    if medium.eta > 0:
        state.set("eta", medium.eta)
    _set_drive(state, scene)
    state.resets = dict(state.numbers)
    return state


def _refuse_long(text):
    """Refuse a scene with long lists before anything is made of them."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        # What is wrong with it, the scene says.
        return
    parts = data.values() if isinstance(data, dict) else ()
    lists = [value for part in parts if isinstance(part, dict) for value in part.values()]
    longest = max((len(value) for value in lists if isinstance(value, list)), default=0)
    if longest > MOST_SAMPLES:
        raise ValueError(
            f"the scene has a list of {longest} numbers, and at most {MOST_SAMPLES} are taken here"
        )


def _set_profile(state, profile):
    if isinstance(profile, mdr.Sampled):
        state.samples, state.choices["shape"] = (profile.r, profile.z), "sampled"
        return
    if isinstance(profile, mdr.PowerLaw):
        width = 1e-6
        height = profile.height(width)
        values = {"exponent": profile.exponent, "height": float(height), "width": width}
        shape = "power_law"
    else:
        shape = next(key for key, each in SHAPES.items() if each.build is type(profile))
        values = {q.name: getattr(profile, q.name) for _, q in shape_quantities(shape)}
    state.choices["shape"] = shape
    for name, value in values.items():
        state.set(f"{shape}_{name}", value)


def _set_drive(state, scene):
    drive = scene.drive
    if isinstance(drive, mdr.FreeImpact):
        state.choices["drive"] = "impact"
        state.set("mass", drive.mass)
        state.set("speed", drive.speed)
        if drive.plastic_depth > 0:
            state.choices[SURFACE] = "imprint"
            state.set("plastic_depth", drive.plastic_depth)
        return
    kind, path = "depth", getattr(drive, "depth", None)
    if isinstance(drive, mdr.ForcePath):
        kind, path = "force", drive.force
    path = path if isinstance(path, tuple) else (path,)
    state.choices["drive"] = kind
    state.set(f"max_{kind}", max(path))
    if path[-1] == max(path):
        return
    result = scene.solve()
    # All that the way there leaves behind is the largest depth: the last state is one of unloading.
    recovered = min(scene.medium.critical_depth, float(max(result.depth)))
    below = float(max(result.depth) - result.depth[-1])
    rest = float(result.depth[-1])
    lifted = 2.2 - 0.2 * rest / max(float(max(result.depth)) - recovered, 1e-300)
    progress = 1 + below / recovered if below <= recovered else lifted
    state.move(min(max(progress, 1.0), LAST_PROGRESS))
