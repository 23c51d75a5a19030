"""The samples of a measured tip from the text of a CSV file."""

import tempfile
from pathlib import Path

import mdr_core as mdr

#: Most samples: more would keep everybody waiting.
MOST_SAMPLES = 300
_MOST_HEADER = 100


def read_tip(text):
    """Radii and heights (m) of an uploaded tip; a header names their unit, as in "r (nm), z (nm)".

    Raises
    ------
    ValueError
        If the text is not two columns of numbers, or no tip.
    """
    rows = text.count("\n")
    if rows > MOST_SAMPLES + _MOST_HEADER:
        raise ValueError(
            f"the file has {rows} rows, and at most {MOST_SAMPLES} samples are shown here: thin them, "
            "or use mdr.Sampled.from_csv, which takes any number"
        )
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tip.csv"
        path.write_text(text, encoding="utf-8")
        try:
            tip = mdr.Sampled.from_csv(path)
        except ValueError as error:
            raise ValueError(str(error).replace(str(path), "the file")) from None
    return tip.r, tip.z
