"""Measured curves that come with the package; their licences are in the files next to them."""

from pathlib import Path

from ...base.errors import MDRError

_FOLDER = Path(__file__).parent


def example(name: str) -> Path:
    """Return the path of a measured curve that comes with the package.

    Parameters
    ----------
    name : str
        "silica.csv": fused silica under a Berkovich tip, with times (micromechanics).
        "gel.csv": a gel under a colloid of radius 10 µm in an AFM, approach and retraction (afmformats).

    Returns
    -------
    Path
        A table with units in its header, for `read_curve` or any other reader.

    Raises
    ------
    MDRError
        If there is no curve of this name.

    Examples
    --------
    >>> import mdr_core as mdr
    >>> curve = mdr.read_curve(mdr.example("silica.csv"))
    >>> round(1e3 * float(curve.force.max()), 1)  # mN
    407.8
    """
    names = sorted(path.name for path in _FOLDER.glob("*.csv"))
    if name not in names:
        raise MDRError(f"the name of an example is {name!r}, but must be one of {', '.join(names)}")
    return _FOLDER / name
