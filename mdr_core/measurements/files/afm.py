"""Curves of AFM files by `afmformats`, and errors for other binary files."""

import logging
import re
from contextlib import contextmanager
from functools import partial

import numpy as np

from ...base import check
from ...base.remark import MeasurementError, Remark, Remedy
from ...show.report import imported
from ..measured_curve import MODALITIES, MeasuredCurves
from .cantilever import Cantilever
from .curve import curve_of
from .hdf5 import refuse_outside
from .packed import is_binary, refuse_large
from .table import Table

# Without a handler the package would print its errors next to the error messages.
logging.getLogger("afmformats").addHandler(logging.NullHandler())

#: Beginnings of the suffixes of AFM files that are not text.
SUFFIXES = ".jpk", ".h5", ".hdf5", ".ibw", ".zip"
#: Text that occurs only in files of AFM instruments.
_OF_AFM = re.compile(r"# afmformats |Force-Distance Curve|Device:\tChiaro")
_GIVE = Remedy("give", "spring_constant"), Remedy("give", "sensitivity")
#: Remedies for errors of `afmformats`.
_CURES = {
    "MissingMetaDataError": ("", _GIVE),
    "NotImplementedError": (
        " Its forces are in N: leave out both. Subtract a deflection as a frame compliance of 1/k",
        (),
    ),
    "UnicodeDecodeError": ("; if it is packed, unpack it and read its files", ()),
}
#: Exports that replace unsupported files, by suffix.
_EXPORTS = {
    r"\.(spm|pfc|\d{3})": "NanoScope Analysis of Bruker: export the curve as ASCII text, with Ramp and "
    "Deflection in nm and pN or nN",
    r"\.(nid|nhf)": "Nanosurf's program: export depth or tip position and force as a text or CSV table",
    r"\.tdms": "the program of the instrument, or Excel with the importer of NI: save depth, force and "
    "time as a CSV table",
    r"\.(h5|hdf5)": "the program that wrote it: save depth, force and time of a curve as a CSV table, with "
    "units in its header",
    r"\.(mdt)": "NT-MDT's program: export the curve as ASCII text",
    r"\.(hap|fis)": "the program WIN-HCU of Fischer: export depth, force and time of a test as text",
    r"\.(hys|tst|mss|nmd|msm)": "the instrument's program: export depth, force and time of a test as text "
    "or Excel",
    r"\.(ods|parquet|mat|npy|npz|pkl|opj|opju)": "the program that wrote it: save it as a CSV table with "
    "names and units in its header",
}
_EXPORT = (
    "the program of the instrument: export depth, force and time as a text or CSV table with units in its "
    "header"
)


def refuse_binary(path, data):
    """Raise MDRError for a binary file, with the export to make."""
    suffix = path.suffix.lower()
    known = next((text for pattern, text in _EXPORTS.items() if re.fullmatch(pattern, suffix)), None)
    if known is None and not is_binary(data):
        return
    # Some programs export text with the suffix of their binary files.
    if known is not None and not is_binary(data) and data.strip():
        return
    raise check.MDRError(f"{path.name} is a binary file in an unsupported format. Use {known or _EXPORT}")


def export_of(suffix):
    """Return a sentence on the export that replaces a file with a suffix, or an empty text."""
    known = next((text for pattern, text in _EXPORTS.items() if re.fullmatch(pattern, suffix)), "")
    return f". Use {known}" if known else ""


def is_afm_text(text):
    """Whether `afmformats` reads a text."""
    return bool(_OF_AFM.search(text[:2000]))


@contextmanager
def _refused(errors, path):
    """Convert errors of `afmformats` to MeasurementErrors with remedies."""
    try:
        yield
    # `except Exception` alone would not catch most errors of this package.
    except (Exception, errors.AFMFileFormatError, errors.MissingMetaDataError) as error:
        export = export_of(path.suffix.lower())
        cure, remedy = _CURES.get(type(error).__name__, (export, ()))
        text = f"{path.name} cannot be read by afmformats: {_in_words(error, errors)}{cure}"
        raise MeasurementError(Remark(text, "invalid", *remedy, together=True)) from None


def _in_words(error, errors):
    """Return the message of an error of `afmformats`, or the meaning of another error."""
    if isinstance(error, KeyError):
        return f"it has no {error}"
    own = errors.AFMFileFormatError, errors.MissingMetaDataError, NotImplementedError, UnicodeDecodeError
    if not isinstance(error, own):
        return f"it does not follow its format ({type(error).__name__})"
    return re.sub(r"<_io\.\w+ name='?(?:[^'>]*[/\\\\])?([^'/>]*)'?[^>]*>", r"\1", str(error))


def from_afm(path, given):
    """Return the `MeasuredCurves` of a file by `afmformats`, with the given constants of the cantilever."""
    refuse_large(path)
    given = {name.replace("_", " "): value for name, value in given.items() if value is not None}
    afmformats = imported("afmformats", f"reading {path.name}", '"mdr-core[afm]"')
    if path.suffix.lower() in (".h5", ".hdf5"):
        refuse_outside(path)
    with _refused(afmformats.errors, path):
        loaded, stiffness = _loaded(afmformats, path, given)
        curves = sorted(loaded, key=lambda data: data.enum)
        position = [[data.metadata.get(f"position {axis}", np.nan) for axis in "xy"] for data in curves]
    position = None if np.isnan(position).any() else check.frozen(position)
    makers = [partial(_afm_curve, afmformats.errors, data, stiffness) for data in curves]
    return MeasuredCurves(path.name, position, makers)


def _loaded(afmformats, path, given):
    """Return the curves of a file, and the stiffness (N/m) to use here, None if `afmformats` uses it.

    `afmformats` accepts no constants for formats with forces in N. Their height includes the deflection. A
    given stiffness serves to subtract it, unless the file contains a stiffness.
    """
    try:
        return afmformats.load_data(path, meta_override=given), None
    except NotImplementedError:
        if list(given) != ["spring constant"]:
            raise
        loaded = afmformats.load_data(path)
        if any("spring constant" in data.metadata or "tip position" in data for data in loaded):
            raise
        return loaded, given["spring constant"]


def _deflection(head):
    """Return a remark on a height that still includes the deflection."""
    text = f"{head!r} includes the deflection of the cantilever, whose stiffness is not known"
    return Remark(text, "deflection", Remedy("give", "spring_constant"))


def _afm_curve(errors, data, stiffness):
    """Return the `MeasuredCurve` of a curve in `afmformats`, approach and retract in order of time."""
    with _refused(errors, data.path):
        heights = [head for head in ("tip position", "height (measured)", "height (piezo)") if head in data]
        heads = [heights[0], "force", *(["time"] if "time" in data else [])]
        values = {k: np.asarray(data[head], dtype=float) for k, head in enumerate(heads)}
        number = np.asarray(data["segment"], dtype=int)
        # If all numbers are 0, the file does not contain the segments.
        segment = np.array(MODALITIES[data.modality])[number] if number.any() else None
        stiffness = data.metadata.get("spring constant", stiffness)
    table = Table(dict(enumerate(heads)), values, np.arange(1, number.size + 1), {}, {})
    columns = {"depth": (0, "−m"), "force": (1, "N")} | ({"time": (2, "s")} if 2 in values else {})
    # A height includes the deflection; without a stiffness it cannot be subtracted.
    place = "piezo" if stiffness is not None and heads[0] != "tip position" else "depth"
    columns = {place if each == "depth" else each: column for each, column in columns.items()}
    remarks = [_deflection(heads[0])] * (stiffness is None and heads[0] != "tip position")
    options = {"turn": False, "segment": segment, "remarks": remarks}
    return curve_of(
        table, data.path.name, columns, Cantilever(stiffness), "as afmformats reads them", **options
    )
