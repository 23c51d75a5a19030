"""Random calls of every public function: a right answer, or an error with a useful sentence.

    python -W error -m tests.fuzz_long [COUNT] [SEED] [ENTRY ...]

runs COUNT calls (100 000 by default) of every entry point, or of those named, and prints how many
were answered, how many refused, and every call that gave NaN, a warning, an internal error or took
longer than `PATIENCE`. The viscous ones cost about 0.1 s a call; those called many_… carry 100 or
200 states each.
"""

import json
import signal
import sys
import warnings

from .fuzz import contact, geometry, odd, texts, viscous
from .fuzz.source import Source

#: Seconds of computing that one call may take, however busy the machine is.
PATIENCE = 5
#: Sentences that come from inside, and help nobody.
INTERNAL = (
    "operands could not", "broadcast input", "zero-size", "setting an array element", "out of bounds",
    "truth value", "unexpected keyword", "object has no", "not subscriptable", "unsupported operand",
    "cannot reshape", "singular matrix", "did not converge", "was not found", "ufunc", "cannot convert",
    "loop of ufunc", "must be a sequence", "could not convert", "index ", "overflow", "codec", "unhashable",
    "dimensions must be", "not iterable", "not supported between", "has no len",
)  # fmt: skip
ENTRIES = {
    function.__name__: function
    for function in (
        *(geometry.shapes, geometry.odd_shapes, geometry.inverses, geometry.media, geometry.transforms),
        *(geometry.scalings, texts.scenes, texts.tips, contact.indentations, contact.force_paths),
        *(contact.dry_impacts, contact.many_depths, contact.many_forces, contact.many_impacts),
        *(viscous.viscous_impacts, viscous.many_viscous_impacts, viscous.timed, viscous.foundations),
        *(viscous.chains, odd.one_odd),
    )
}


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
    signal.signal(signal.SIGPROF, _too_long)
    for entry in entries or ENTRIES:
        tally = {"answered": 0, "refused": 0}
        for seed in range(int(start), int(start) + int(count)):
            signal.setitimer(signal.ITIMER_PROF, PATIENCE)
            outcome = attempt(entry, seed)
            signal.setitimer(signal.ITIMER_PROF, 0)
            if outcome in tally:
                tally[outcome] += 1
            else:
                print(f"{entry}, seed {seed}: {outcome:.300}", flush=True)
        print(json.dumps({entry: tally}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
