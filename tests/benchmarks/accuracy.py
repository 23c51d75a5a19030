"""Worst error against references of many digits, quantity by regime, over all shapes and media.

    python -m tests.benchmarks.accuracy

writes the table to assets/accuracy.md and prints it.
"""

from pathlib import Path

import numpy as np

from ..hard_cases import BOUNDS, EXTREMES, MEDIA, QUANTITIES, REGIMES, errors
from ..shapes import name

TABLE = Path(__file__).parents[2] / "assets" / "accuracy.md"


def main():
    worst = {}
    for regime in REGIMES:
        for shape in EXTREMES:
            for medium in MEDIA:
                for quantity, error in errors(shape, medium, regime).items():
                    key = regime, quantity
                    worst[key] = max(worst.get(key, (0.0, "")), (error, name(shape)))
    lines = [
        "# Accuracy",
        "",
        "Worst relative error against 40-digit references, over "
        f"{len(EXTREMES)} indenters ({', '.join(sorted({type(s).__name__ for s in EXTREMES}))}; exponents "
        "from 0.1 to 50) and three media (E* = 1 MPa, 1 GPa, 1 TPa), with the indenter it occurs for.",
        "Pressure at r = 10⁻⁹ a and a/2, at r = c(1 ± 10⁻⁶) and at r = 0.999999 a, per unit of its "
        "condition number in r.",
        "",
        "| regime | " + " | ".join(QUANTITIES) + " |",
        "|---" * (len(QUANTITIES) + 1) + "|",
        *(
            f"| {regime} | "
            + " | ".join(f"{worst[regime, q][0]:.0e} {worst[regime, q][1]}" for q in QUANTITIES)
            + " |"
            for regime in REGIMES
        ),
        "| **bound** | " + " | ".join(f"{BOUNDS[q]:.0e}" for q in QUANTITIES) + " |",
        "",
        f"Made by `python -m tests.benchmarks.accuracy` with numpy {np.__version__}.",
        "",
    ]
    TABLE.write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
