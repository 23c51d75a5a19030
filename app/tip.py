"""The samples of a measured tip from the text of a CSV file."""

import tempfile
from pathlib import Path

import mdr_core as mdr

#: Most samples: more would keep everybody waiting.
MOST_SAMPLES = 300


def read_tip(text):
    """Radii and heights (m) of an uploaded tip; a header names their unit, as in "r (nm), z (nm)".

    Raises
    ------
    ValueError
        If the text is not two columns of numbers, or no tip.
    """
    if text.count("\n") > 20_000:
        raise ValueError("the file has more than 20000 rows")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tip.csv"
        path.write_text(text, encoding="utf-8")
        try:
            tip = mdr.Sampled.from_csv(path)
        except ValueError as error:
            raise ValueError(str(error).replace(str(path), "the file")) from None
    if len(tip.r) > MOST_SAMPLES:
        raise ValueError(
            f"the tip has {len(tip.r)} samples, and at most {MOST_SAMPLES} are shown here: thin them, "
            "or use mdr.Sampled.from_csv, which takes any number"
        )
    return tip.r, tip.z
