"""Random calls of every public function: a right answer, or an error with a useful sentence.

    python -W error -m tests.fuzz_long [COUNT] [SEED] [ENTRY ...]

runs COUNT calls (100 000 by default) of every entry point, or of those named, and prints how many
were answered, how many refused, and every call that gave NaN, a warning, an internal error or took
longer than `PATIENCE`. The viscous ones cost about 0.1 s a call.
"""

import json
import signal
import sys
import tempfile
import warnings
from dataclasses import fields

import numpy as np

import mdr_core as mdr

#: Seconds that one call may take.
PATIENCE = 20
ODD = (
    0, 0.0, -0.0, -1.0, 1, True, None, "1", "", b"1", 1j, [], [[]], {}, object(), np.nan, np.inf, -np.inf,
    1e300, 1e-300, 1e140, 1e-140, 5e-324, 1.7e308, 10**400, np.float32(1e-3), np.int8(1), np.uint64(3),
    np.bool_(True), np.array(1e-6), np.array([]), np.array([1e-6]), np.array([[1e-6, np.nan]]), "nan",
    np.zeros((2, 0)), (1e-6, 2e-6), [1e-6, [2e-6]], np.array([1e-6], dtype=object), np.datetime64("2020"),
)  # fmt: skip
#: Sentences that come from inside, and help nobody.
INTERNAL = (
    "operands could not", "broadcast input", "zero-size", "setting an array element", "out of bounds",
    "truth value", "unexpected keyword", "object has no", "not subscriptable", "unsupported operand",
    "cannot reshape", "singular matrix", "did not converge", "was not found", "ufunc", "cannot convert",
    "loop of ufunc", "must be a sequence", "could not convert", "index ", "overflow",
)  # fmt: skip
SCALARS = ("FlatPunch", "Cone", "Paraboloid", "PowerLaw", "Sphere", "Hyperboloid", "RoundedCone",
           "ParabolicPunch", "TruncatedCone", "TruncatedParaboloid", "RoundedPunch")  # fmt: skip
COUNTS = {name: len(fields(getattr(mdr, name))) for name in SCALARS}


class Source:
    """Random arguments: mostly plausible ones, at the rate `odd` some that are not."""

    def __init__(self, seed, odd=0.05):
        self.rng, self.odd = np.random.default_rng(seed), odd

    def pick(self, values):
        return values[self.rng.integers(len(values))]

    def number(self, low=-9.0, high=1.0):
        """A number between powers of ten, of any type that users hand in."""
        if self.rng.random() < self.odd:
            return self.pick(ODD)
        value = 10.0 ** self.rng.uniform(low, high)
        kind = self.rng.random()
        if kind < 0.05:
            return np.float32(value)
        return np.array(value) if kind < 0.1 else value

    def numbers(self, low=-9.0, high=1.0, most=6):
        """A number or an array."""
        if self.rng.random() < 0.5 or self.rng.random() < self.odd:
            return self.number(low, high)
        values = 10.0 ** self.rng.uniform(low, high, self.rng.integers(0, most))
        values = values.astype(np.float32) if self.rng.random() < 0.1 else values
        values.setflags(write=False)
        return values.tolist() if self.rng.random() < 0.3 else values

    def shape(self):
        """An indenter of lengths that fit each other, or of odd arguments."""
        draw = self.rng.random()
        if draw < 0.1:
            r = np.append(0, np.cumsum(10.0 ** self.rng.uniform(-9, -5, self.rng.integers(1, 8))))
            slopes = np.cumsum(10.0 ** self.rng.uniform(-3, 0, len(r) - 1))
            return mdr.Sampled(r, np.append(0, np.cumsum(slopes * np.diff(r))))
        if draw < 0.15:
            R = 10.0 ** self.rng.uniform(-8, -2)
            return mdr.Smooth(self.pick((lambda r: r / R, lambda r: 0.3 * r / np.hypot(r, R))))
        name = self.pick(SCALARS)
        if name == "PowerLaw":
            n = 10.0 ** self.rng.uniform(-1, 1.7)
            return mdr.PowerLaw(10.0 ** self.rng.uniform(-2, 2) * 1e-6 ** (1 - n), n)
        return getattr(mdr, name)(*(self.number(-8, -1) for _ in range(COUNTS.get(name, 1))))

    def medium(self, viscous=False):
        q_c = np.inf if self.rng.random() < 0.2 else self.number(-4, 4)
        return mdr.Medium(self.number(4, 12), q_c, self.number(-6, 6) if viscous else 0.0)


def finite(*values, infinite=False):
    """Refuses NaN, and infinity where it has no place."""
    for value in values:
        value = np.asarray(value)
        assert value.dtype.kind in "fiu", value
        assert not np.isnan(value).any(), value
        assert infinite or np.isfinite(value).all(), value


def shapes(source):
    shape = source.shape()
    finite(shape.height(source.numbers()), shape.reduced(source.numbers()), infinite=True)
    finite(shape.contact_radius(source.numbers()))


def odd_shapes(source):
    name = source.pick((*SCALARS, "Sampled", "Smooth"))
    count = COUNTS.get(name, 2 if name == "Sampled" else 1)
    shape = getattr(mdr, name)(*(source.pick(ODD) for _ in range(count)))
    finite(shape.contact_radius(1e-9), shape.reduced(1e-9), infinite=True)


def media(source):
    odd = Source(source.rng, 0.3)
    if odd.rng.random() < 0.5:
        medium = mdr.Medium(odd.numbers(3, 12), odd.numbers(-6, 6), odd.numbers(-6, 6))
    else:
        medium = mdr.Medium.from_bodies(odd.numbers(3, 12), odd.number(-1, 0), odd.number(3, 12))
    finite(medium.critical_depth, medium.relaxation_time, medium.yield_line_load, infinite=True)


QUANTITIES = ("force", "contact_radius", "plastic_radius", "plastic_depth", "stored_energy", "plastic_work",
              "stiffness")  # fmt: skip


def states(source, result, r):
    finite(result.depth, *(getattr(result, name) for name in QUANTITIES))
    if np.ndim(result.depth):
        if not len(result):
            return
        result = result[-1]
    finite(result.pressure(r), infinite=True)
    finite(result.line_load(r), result.surface(r), result.imprint(r))


def indentations(source):
    shape, medium = source.shape(), source.medium()
    states(source, mdr.indent(shape, medium, source.numbers(-12, -4)), source.numbers(-12, -3))


def force_paths(source):
    shape, medium = source.shape(), source.medium()
    states(source, mdr.indent_to_force(shape, medium, source.numbers(-12, 3)), source.numbers(-12, -3))


def timed(source):
    shape, medium = source.shape(), source.medium(viscous=True)
    time = np.cumsum(10.0 ** source.rng.uniform(-6, 1, 4))
    path = 10.0 ** source.rng.uniform(-10, -5, 4)
    if source.rng.random() < 0.5:
        result = mdr.indent(shape, medium, path, time=time, tolerance=1e-2)
    else:
        result = mdr.indent_to_force(shape, medium, path, time=time, tolerance=1e-2)
    finite(result.force, result.contact_radius, result.stored_energy, result.plastic_depth)


RESULTS = ("max_depth", "max_force", "contact_radius", "plastic_radius", "plastic_depth", "damaged_area",
           "restitution", "rebound_speed", "contact_time", "stored_energy", "plastic_work",
           "viscous_work")  # fmt: skip


def hits(source, viscous, number):
    shape, medium = source.shape(), source.medium(viscous)
    before = source.number(-10, -6) if source.rng.random() < 0.2 else 0.0
    hit = mdr.impact(shape, medium, number(-12, 0), number(-4, 2), plastic_depth=before)
    finite(*(getattr(hit, name) for name in RESULTS))
    energy = hit.mass * hit.speed**2 / 2
    lost = (hit.plastic_work + hit.viscous_work) / energy
    np.testing.assert_allclose(hit.restitution**2 + lost, 1.0, rtol=1e-7, err_msg="energy ledger")
    return hit


def dry_impacts(source):
    hit = hits(source, False, source.numbers)
    if np.all(np.isfinite(hit.medium.critical_depth)) and source.rng.random() < 0.3:
        finite(*vars(hit.fast_limit).values())


def viscous_impacts(source):
    hit = hits(source, True, source.number)
    if source.rng.random() < 0.2:
        motion = hit.motion(source.pick((2, 17, np.int64(5))))
        finite(*vars(motion).values())


def scalings(source):
    odd = Source(source.rng, 0.2)
    result = mdr.hardness_class(odd.numbers(), odd.numbers(), odd.number(-1, 1))
    finite(result.slope, result.slope_error)


def foundations(source):
    shape, medium = source.shape(), source.medium(source.rng.random() < 0.5)
    n = source.pick((2, 40, 100, 41, -2, 1e9, 0, 2.5, "4", np.int32(60), np.float64(20)))
    row = mdr.Foundation(shape, medium, n, source.number(-8, -3), nodes=source.numbers(-9, -5))
    for _ in range(4):
        dt = np.inf if source.rng.random() < 0.3 else source.number(-8, 2)
        depth = source.number(-11, -6)
        row = row.advance(-depth if isinstance(depth, float) and source.rng.random() < 0.2 else depth, dt)
    finite(row.force, row.stored_energy, row.plastic_work, row.viscous_work, row.line_load, row.elastic)


def chains(source):
    shape, medium = source.shape(), source.medium(source.rng.random() < 0.7)
    tolerance = 0.1 if source.rng.random() < 0.9 else source.number(-2, 0)
    hit = mdr.chain_impact(shape, medium, source.number(-12, 0), source.number(-4, 2), tolerance=tolerance)
    finite(hit.max_depth, hit.max_force, hit.restitution, hit.contact_time, hit.plastic_work)


PIECES = (b"", b"0", b"7", b"3", b".", b"-", b"e", b"9" * 400, b"\0", b"\xff", b",", b"[", b'"', b"null",
          b"NaN", b"1e999", b"{}")  # fmt: skip


def mutated(source, text):
    """A text with a few bytes of it changed, dropped or doubled."""
    data = bytearray(text)
    for _ in range(source.rng.integers(1, 3)):
        at, length = source.rng.integers(0, max(len(data), 1)), source.rng.integers(0, 3)
        new = source.pick((*PIECES, bytes(source.rng.integers(0, 256, 3).tolist())))
        data[at : at + length] = new
    return bytes(data)


SCENES = [
    mdr.Scene(mdr.Cone(0.3), mdr.Medium(1e9, 1.0), mdr.DepthPath([1e-6, 2e-6])),
    mdr.Scene(mdr.Sampled([0, 1, 2], [0, 1, 3]), mdr.Medium(1e9), mdr.ForcePath(1e-6)),
    mdr.Scene(mdr.RoundedCone(1e-6, 0.3), mdr.Medium(1e9, 1.0), mdr.FreeImpact(1e-6, 0.1)),
]


def scenes(source):
    text = mutated(source, source.pick(SCENES).to_json().encode())
    text = text if source.rng.random() < 0.3 else text.decode("utf-8", "replace")
    scene = mdr.Scene.from_json(text)
    assert mdr.Scene.from_json(scene.to_json()) == scene


TIP = b"r (nm), z (nm)\n# a comment\n0, 0\n100, 10\n200, 30\n400, 90\n"


def tips(source):
    data = (
        source.rng.bytes(source.rng.integers(0, 200)) if source.rng.random() < 0.2 else mutated(source, TIP)
    )
    with tempfile.NamedTemporaryFile(suffix=".csv") as file:
        file.write(data)
        file.flush()
        tip = mdr.Sampled.from_csv(file.name, source.pick((None, "nm", "m", "furlong")))
    finite(tip.r, tip.z, tip.deepest)


def transforms(source):
    odd = Source(source.rng, 0.1)
    x = np.cumsum(10.0 ** odd.rng.uniform(-9, 0, odd.rng.integers(0, 6)))
    x = (
        x
        if odd.rng.random() < 0.9
        else odd.pick(([], [1.0], [2.0, 1.0], [0.0, np.nan], 1.0, None, x[None]))
    )
    values = odd.numbers() if odd.rng.random() < 0.1 else odd.rng.normal(size=np.size(x))
    function = odd.pick((mdr.abel.stress_from_line_load, mdr.abel.line_load_from_stress))
    finite(function(x, values, odd.numbers()), infinite=True)
    finite(mdr.abel.reduce_slope(np.sqrt if odd.rng.random() < 0.1 else np.tanh, odd.numbers()))


ENTRIES = {
    function.__name__: function
    for function in (shapes, odd_shapes, media, indentations, force_paths, dry_impacts, viscous_impacts,
                     scalings, foundations, scenes, tips, transforms, timed, chains)
}  # fmt: skip


def attempt(entry, seed):
    """One call: "answered" or "refused", or what went wrong."""
    source = Source(seed)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            ENTRIES[entry](source)
    except (ValueError, TypeError) as error:
        sentence = str(error)
        useful = len(sentence) > 15 and not any(part in sentence for part in INTERNAL)
        return "refused" if useful else f"{type(error).__name__}: {sentence}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return "answered"


def _too_long(*_):
    raise TimeoutError(f"longer than {PATIENCE} s")


def main(count=100_000, start=0, *entries):
    signal.signal(signal.SIGALRM, _too_long)
    for entry in entries or ENTRIES:
        tally = {"answered": 0, "refused": 0}
        for seed in range(int(start), int(start) + int(count)):
            signal.alarm(PATIENCE)
            outcome = attempt(entry, seed)
            signal.alarm(0)
            if outcome in tally:
                tally[outcome] += 1
            else:
                print(f"{entry}, seed {seed}: {outcome:.300}", flush=True)
        print(json.dumps({entry: tally}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
