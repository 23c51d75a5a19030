"""Bytes that reach ever more lines of Scene.from_json or Sampled.from_csv, by atheris.

    pip install atheris
    python -W error -m tests.fuzz.guided scenes -runs=1000000
    python -W error -m tests.fuzz.guided tips -runs=1000000

Not a part of the tests: atheris is there for few versions of Python. It stops at the first finding.
"""

import json
import sys

import atheris

with atheris.instrument_imports(include=["mdr_core"]):
    import mdr_core  # so that its lines are counted before anything else imports it

from . import texts
from .source import Source

CALLS = {"scenes": texts.read, "tips": texts.table}
SEEDS = {"scenes": [scene.to_json().encode() for scene in texts.SCENES], "tips": list(texts.TIPS)}


def call(data):
    """Answered or refused; everything else ends the run."""
    try:
        CALLS[sys.argv[1]](data)
    except (ValueError, TypeError) as error:
        if len(str(error)) <= 15:
            raise RuntimeError("refused without a useful sentence") from error


def mutator(data, most, seed):
    """Half of the time bytes, otherwise a valid one in which something has been changed."""
    source = Source(seed)
    if source.chance(0.5):
        return atheris.Mutate(data, most)
    data = data if source.chance(0.9) else source.pick(SEEDS[sys.argv[1]])
    if sys.argv[1] == "scenes" and source.chance(0.8):
        try:
            return json.dumps(texts.rearranged(source, json.loads(data))).encode()[:most]
        except (ValueError, RecursionError):
            data = source.pick(SEEDS["scenes"])
    return texts.mutated(source, data)[:most]


def main():
    name, *options = sys.argv[1:]
    atheris.Setup([name, *options], call, custom_mutator=mutator)
    print(f"{name}: lines of {mdr_core.__name__} are counted", flush=True)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
