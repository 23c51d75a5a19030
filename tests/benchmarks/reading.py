"""Time to read a table of 300,000 samples, and the slowest of the lines of 10 kB that the tests have.

Run `python -m tests.benchmarks.reading`, also in an older tree with the file of this one.
"""

import tempfile
import time
from contextlib import suppress
from pathlib import Path

import numpy as np

import mdr_core as mdr

from ..measurements.files.test_bounds import LINES


def seconds(path):
    """Shortest time of the process (s) of three readings."""
    times = []
    for _ in range(3):
        start = time.process_time()
        with suppress(ValueError):
            mdr.read_curves(path)[0]
        times.append(time.process_time() - start)
    return min(times)


def main():
    depth = np.append(np.linspace(0, 1000, 200_000), np.linspace(1000, 600, 100_000))
    columns = depth, 1e-3 * depth**1.5, 0.01 * np.arange(depth.size)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.csv"
        np.savetxt(
            path, np.column_stack(columns), "%.6g", ",", header="Depth (nm),Load (mN),Time (s)", comments=""
        )
        print(f"300,000 samples: {seconds(path):.2f} s")
        slowest = {}
        for name, line in LINES.items():
            path.write_text(f"{line}\n{line}\n1,2\n3,4\n", encoding="utf-8")
            slowest[name] = seconds(path)
        name = max(slowest, key=slowest.get)
        print(f"slowest line of 10 kB: {slowest[name]:.3f} s ({name})")


if __name__ == "__main__":
    main()
