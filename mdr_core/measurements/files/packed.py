"""Size limits for packed files, whose contents may be a thousand times larger."""

import re
import zipfile

from ...base.errors import MDRError

#: Largest sizes (bytes) of a file and of its unpacked contents, and largest ratio for larger contents.
_BYTES, _UNPACKED, _RATIO = 2_000_000_000, 500_000_000, 20


def refuse_large(path, sheets=None):
    """Raise MDRError for a packed file that is too large, before unpacking it.

    `sheets` is the largest number of sheets in a workbook. Files other than workbooks may be larger, unless
    they are packed to less than a twentieth.
    """
    size = path.stat().st_size
    if size > _BYTES:
        raise MDRError(f"{path.name} has {size / 1e9:.3g} GB: at most {_BYTES / 1e9:g} GB are read")
    if not zipfile.is_zipfile(path):
        return
    try:
        with zipfile.ZipFile(path) as file:
            inside = file.infolist()
    except NotImplementedError as error:
        raise MDRError(
            f"{path.name} is packed in an unsupported way, {error}: unpack it and read its files"
        ) from None
    except (zipfile.BadZipFile, OSError, ValueError):
        # The reader of the file raises its own error.
        return
    unpacked = sum(each.file_size for each in inside)
    if unpacked > _UNPACKED and (sheets is not None or unpacked > _RATIO * size):
        raise MDRError(
            f"{path.name} unpacks to {unpacked / 1e9:.3g} GB, and at most {_UNPACKED / 1e9:g} GB are read: "
            "save the curve as a CSV table"
        )
    count = sum(each.filename.startswith("xl/worksheets/") for each in inside)
    if sheets is not None and count > sheets:
        raise MDRError(f"{path.name} has {count} sheets: at most {sheets} are read")


def is_binary(data):
    """Whether the bytes are not text: they contain zeros outside UTF-16, or other control characters."""
    head = data[:4096]
    marked = head.startswith((b"\xff\xfe", b"\xfe\xff"))
    utf16 = marked or (b"\0" in head[:2] and head[:200].count(b"\0") > 0.4 * len(head[:200]))
    if utf16:
        return bool(re.search(rb"\0\0\0", head))
    controls = sum(byte < 9 or 13 < byte < 32 for byte in head)
    return b"\0" in data or controls > 0.02 * len(head)
