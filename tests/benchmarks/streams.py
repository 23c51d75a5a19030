"""A stream of particles on worker processes: time and memory over its length, and over the workers.

python -m tests.benchmarks.streams
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from .tables import time

SCRIPT = Path(__file__).parents[2] / "assets" / "erosion.py"
#: Particles and workers: over the length, and with the same work, in all and each, on one and on two.
STREAMS = (1e5, 2), (1e6, 2), (1e7, 1), (1e7, 2), (2e7, 2), (1e8, 2)
#: What a run says of its time (s) and memory (GB).
MEASURED = re.compile(r"took ([\d.e+]+) s.* memory ([\d.]+) GB")


def rows(streams=STREAMS):
    """What, how long, and with how much memory."""
    for particles, workers in streams:
        taken, memory = _run(particles, workers)
        each = f"{taken / particles * 1e6:.2g} s per million, {memory:.2f} GB in all processes"
        yield f"{particles:.0e} different spheres on {workers} workers, by dask", time(taken), each


def _run(particles, workers):
    """Time (s) and memory (GB) of one run of the example."""
    environment = os.environ | {"MPLBACKEND": "Agg", "PYTHONPATH": str(SCRIPT.parents[1])}
    command = [sys.executable, str(SCRIPT), "--particles", str(particles), "--workers", str(workers)]
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=True
        )
    return map(float, MEASURED.search(run.stdout).groups())


if __name__ == "__main__":
    for row in rows():
        print("{:55} {:>8}   {}".format(*row), flush=True)
