"""The samples of a measured tip from the text of a CSV file."""

import tempfile
from pathlib import Path

import mdr_core as mdr

_MOST = 20_000


def read_tip(text):
    """Radii and heights (m) of an uploaded tip; a header names their unit, as in "r (nm), z (nm)".

    Raises
    ------
    ValueError
        If the text is not two columns of numbers, or no tip.
    """
    if text.count("\n") > _MOST:
        raise ValueError(f"the file has more than {_MOST} rows")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tip.csv"
        path.write_text(text, encoding="utf-8")
        try:
            tip = mdr.Sampled.from_csv(path)
        except ValueError as error:
            raise ValueError(str(error).replace(str(path), "the file")) from None
    return tip.r, tip.z
