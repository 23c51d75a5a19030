"""Random texts: scenes as JSON and tips as CSV, valid ones with something changed."""

import json
import tempfile

import numpy as np

import mdr_core as mdr

from .source import finite

PIECES = (b"", b"0", b"7", b"3", b".", b"-", b"e", b"9" * 400, b"\0", b"\xff", b",", b"[", b'"', b"null",
          b"NaN", b"1e999", b"{}", b"1e300", b"(", b"()", b"\n", b"#", b"\r", b"\xef\xbb\xbf")  # fmt: skip
VALUES = (
    0, 1, -1, 2, 0.3, 1e-6, 1e9, 1e300, 1e-300, 10**30, 5e-324, True, False, None, "", "1", "Cone",
    "Sampled", "DepthPath", "ForcePath", "FreeImpact", "PowerLaw", [], {}, [0, 1e-6], [0, 1e-6, 3e-6],
    [[1.0]], [1e-6] * 300, ["a"], [None], [1e-6, [1e-6]], {"type": "Cone", "slope": 0.3}, {"type": []},
)  # fmt: skip
SCENES = [
    mdr.Scene(mdr.Cone(0.3), mdr.Medium(1e9, 1.0), mdr.DepthPath([1e-6, 2e-6])),
    mdr.Scene(mdr.Sampled([0, 1, 2], [0, 1, 3]), mdr.Medium(1e9), mdr.ForcePath(1e-6)),
    mdr.Scene(mdr.RoundedCone(1e-6, 0.3), mdr.Medium(1e9, 1.0), mdr.FreeImpact(1e-6, 0.1)),
    mdr.Scene(mdr.PowerLaw(1.0, 3.0), mdr.Medium(1e9, 1.0, 2.0), mdr.DepthPath([0, 1e-6], [0, 1.0])),
]
TIPS = (
    b"r (nm), z (nm)\n# a comment\n0, 0\n100, 10\n200, 30\n400, 90\n",
    "\ufeffr [µm];z [µm]\r\n0;0\r\n.1;1e1\r\n".encode(),
    b"0\t1\n1e-6\t2\n",
)


def mutated(source, text):
    """A text with a few bytes of it changed, dropped or doubled."""
    data = bytearray(text)
    for _ in range(source.rng.integers(1, 3)):
        at, length = source.rng.integers(0, max(len(data), 1)), source.rng.integers(0, 3)
        new = source.pick((*PIECES, bytes(source.rng.integers(0, 256, 3).tolist())))
        data[at : at + length] = new
    return bytes(data)


def rearranged(source, data):
    """JSON with a value somewhere in it replaced, or a key dropped, renamed or added."""
    if not isinstance(data, dict | list) or not data or source.chance(0.1):
        return source.pick(VALUES)
    places = list(data) if isinstance(data, dict) else range(len(data))
    place, kind = source.pick(places), source.rng.random()
    if isinstance(data, list):
        return [*data[:place], rearranged(source, data[place]), *data[place + (kind < 0.5) :]]
    data = dict(data)
    if kind < 0.9:
        return data | {place: rearranged(source, data[place])}
    value = data.pop(place)
    return data if kind < 0.95 else data | {source.pick(("", "x", "type", "time", "r")): value}


def scenes(source):
    """What is read is written and read again as the same; some are solved, too."""
    text = source.pick(SCENES).to_json()
    if source.chance(0.7):
        data = json.loads(text)
        for _ in range(source.rng.integers(1, 4)):
            data = rearranged(source, data)
        text = json.dumps(data)
    data = mutated(source, text.encode()) if source.chance(0.4) else text
    if isinstance(data, bytes) and source.chance(0.5):
        data = data.decode("utf-8", "replace")
    read(data, source.chance(0.02))


def read(data, solve=False):
    """A scene from what may be none."""
    scene = mdr.Scene.from_json(data)
    assert mdr.Scene.from_json(scene.to_json()) == scene
    if solve and scene.models[0] == "closed form" and np.size(getattr(scene.drive, "depth", 0)) < 50:
        result = scene.solve()
        finite(result.stored_energy, result.plastic_work, result.contact_radius)


def tips(source):
    tip = source.pick(TIPS)
    if source.chance(0.3):
        rows = tip.splitlines(keepends=True)
        tip = b"".join(source.pick(rows) for _ in range(source.rng.integers(0, 6)))
    data = source.rng.bytes(source.rng.integers(0, 200)) if source.chance(0.1) else mutated(source, tip)
    table(data, source.pick((None, "nm", "m", "furlong")))


def table(data, unit=None):
    """A tip from the bytes of what may be none."""
    with tempfile.NamedTemporaryFile(suffix=".csv") as file:
        file.write(data)
        file.flush()
        tip = mdr.Sampled.from_csv(file.name, unit)
    finite(tip.r, tip.z, tip.deepest)
    assert mdr.Sampled(tip.r, tip.z) == tip
