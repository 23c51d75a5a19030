"""A whole page as a link and as a scene file, and back; what comes from outside is bounded or refused."""

from dataclasses import asdict, replace
from math import inf, isfinite
from urllib.parse import parse_qs, urlencode

import mdr_core as mdr

from .drives import drive_of
from .drives.path import checked
from .explorer import FROM_FILE
from .plots import DASHES, PLOTS
from .presets import PRESETS
from .quantities import ENDS, QUANTITIES, SHAPES, shape_quantities
from .tip import MOST_SAMPLES

#: Longest link, and most characters of a file.
LONGEST_LINK, LARGEST_FILE = 8000, 2_000_000


def query(explorer, view=True):
    """The page as the query of a link, with every number that is used; empty if it is too long for one.

    With `view` also what is held, which plots are shown, and whether it is dark.
    """
    choices = {n: option for n, option in explorer.choices.items() if view or n not in explorer.VIEW}
    pairs = {"preset": explorer.preset} | choices
    more = ["noise", *(name for plot in explorer.plots for name in PLOTS[plot].controls)]
    numbers = {name: getattr(explorer, name) for name in (*explorer.used(), *explorer.numbers(more))}
    pairs |= {name: repr(number) for name, number in numbers.items() if number is not None}
    pairs["at"] = f"{explorer.progress:.6g}"
    if explorer.shape == "sampled":
        pairs["samples"] = " ".join(f"{x!r},{y!r}" for x, y in zip(*explorer.samples, strict=True))
    if explorer.drive == "path":
        pairs["path"] = " ".join(",".join(map(repr, row)) for row in explorer.path)
    if view:
        pairs |= {"plots": " ".join(explorer.plots), "dark": str(int(explorer.dark))}
        pairs |= {"hold": " ".join(explorer.hold)} if explorer.hold else {}
    text = urlencode(pairs)
    return text if len(text) <= LONGEST_LINK else ""


def arguments(text):
    """The arguments of a query: lists of bytes by name, as a request has them."""
    return {name: [value.encode() for value in values] for name, values in parse_qs(text, True).items()}


def restore(explorer, arguments):
    """Begin anew with the state that `query` wrote, see `apply`."""
    apply(explorer, arguments)
    explorer.settle()


def apply(explorer, arguments):
    """Set an explorer to the state that `query` wrote, from the arguments of a request.

    Raises ValueError if anything in them is unknown, said twice, or out of bounds.
    """
    length = sum(len(text) for texts in arguments.values() for text in texts)
    if len(arguments) > 60 or length > LONGEST_LINK:
        raise ValueError("this link is too long")
    if any(len(values) != 1 for values in arguments.values()):
        raise ValueError("this link says the same thing twice")
    pairs = {name: values[0].decode("utf-8", "replace") for name, values in arguments.items()}
    preset = pairs.pop("preset", None)
    if preset in PRESETS:
        explorer.load(preset)
    elif preset != FROM_FILE:
        raise ValueError("this link names no preset that is known")
    changes = {"preset": preset, "hold": pairs.pop("hold", "").split()}
    if len(changes["hold"]) > len(DASHES):
        raise ValueError(f"more than {len(DASHES)} scenes are held in this link")
    plots = pairs.pop("plots", "").split()
    changes |= {"dark": pairs.pop("dark", "0") == "1", "plots": [name for name in PLOTS if name in plots]}
    if "samples" in pairs:
        tip = _samples(pairs.pop("samples"))
        changes["samples"] = (tip.r, tip.z)
    path = _rows("path", pairs.pop("path", ""))
    for name in explorer.choices.keys() & pairs.keys():
        changes[name] = option = pairs.pop(name)
        known = explorer.param[name].objects
        if option not in known or (option == "sampled" and "samples" not in changes):
            raise ValueError(f"{name} = {option:.40} in this link is not known")
    if path:
        changes["path"] = checked(path, changes.get("prescribed", explorer.prescribed))
    changes["progress"] = _number("at", pairs.pop("at", "1"))
    low, high = explorer.param.progress.bounds
    if not low <= changes["progress"] <= high:
        raise ValueError(f"the position {changes['progress']:g} is out of bounds: {low} to {high}")
    for name, value in pairs.items():
        if name not in QUANTITIES | ENDS:
            raise ValueError(f"this link sets {name:.40}, which is not known")
        changes[name] = explorer.checked(name, _number(name, value))
    explorer.param.update(**changes)
    explorer.resets = {name: getattr(explorer, name) for name in QUANTITIES}
    explorer.sized = frozenset({explorer.shape})


def _number(name, text):
    try:
        value = float(text) if len(text) <= 40 else inf
    except ValueError:
        value = inf
    if not isfinite(value):
        raise ValueError(f"{name:.40} = {text:.40} in this link is not a number")
    return value


def _samples(text):
    points = _rows("samples", text)
    if any(len(point) != 2 for point in points):
        raise ValueError("the samples in this link are not pairs")
    return mdr.Sampled(*zip(*points, strict=True))


def _rows(name, text):
    """Rows of one or two numbers."""
    rows = [row.split(",") for row in text.split()]
    if len(rows) > MOST_SAMPLES or any(len(row) > 2 for row in rows):
        raise ValueError(f"the {name} in this link are not pairs")
    return [tuple(_number(name, each) for each in row) for row in rows]


def scene_file(trajectory):
    """The scene as JSON, up to the present state."""
    scene = trajectory.scene
    return replace(scene, drive=drive_of(scene).saved(trajectory)).to_json()


def load_scene(explorer, text):
    """Set an explorer to the scene of a file; what the file does not say stays.

    Raises ValueError if it is no scene, or one that the page cannot show.
    """
    if len(text) > LARGEST_FILE:
        raise ValueError("the file is larger than 2 MB")
    scene = mdr.Scene.from_json(text)
    lists = [*asdict(scene.profile).values(), *asdict(scene.drive).values()]
    longest = max((len(each) for each in lists if isinstance(each, tuple)), default=0)
    if longest > MOST_SAMPLES:
        most = f"at most {MOST_SAMPLES} are taken here"
        raise ValueError(f"the scene has a list of {longest} numbers, and {most}")
    choices, numbers = {"preset": FROM_FILE, "inertia": "unknown", "progress": 1.0}, {}
    for more, values in (_medium(scene.medium), _profile(scene.profile), drive_of(scene).opened(scene)):
        choices |= more
        numbers |= values
    numbers = {name: explorer.checked(name, value) for name, value in numbers.items()}
    loaded = {name: choices[name] for name in (*explorer.choices, "path") if name in choices}
    explorer.begin(numbers, loaded | numbers, **choices)


def _medium(medium):
    """Choices and numbers of a medium; one that is not incompressible is under a rigid tip."""
    choices, numbers = {"elasticity": "modulus"}, {"E_star": medium.E_star}
    if medium.poisson != 0.5:
        modulus = (1 - medium.poisson) * (1 + medium.poisson) * medium.E_star
        choices, numbers = {"elasticity": "rigid_tip"}, {"E_1": modulus, "nu_1": medium.poisson}
    yields, viscous = medium.q_c < inf, medium.eta > 0
    choices |= {"plasticity": "q_c" if yields else "none", "damping": "eta" if viscous else "none"}
    numbers |= ({"q_c": medium.q_c} if yields else {}) | ({"eta": medium.eta} if viscous else {})
    return choices, numbers


def _profile(profile):
    """Choices and numbers of an indenter."""
    if isinstance(profile, mdr.Sampled):
        return {"samples": (profile.r, profile.z), "tip_note": "", "shape": "sampled"}, {}
    if isinstance(profile, mdr.PowerLaw):
        width = 1e-6
        values = {"exponent": profile.exponent, "height": float(profile.height(width)), "width": width}
        shape = "power_law"
    else:
        shape = next(key for key, each in SHAPES.items() if each.build is type(profile))
        values = {q.name: getattr(profile, q.name) for _, q in shape_quantities(shape)}
    return {"shape": shape}, {f"{shape}_{name}": value for name, value in values.items()}
