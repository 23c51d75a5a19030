"""Bounds on packed files, whose contents may be a thousand times larger."""

import re
import zipfile

from ...base.errors import MDRError

#: Most bytes of a file, and of what is packed in one; and by how much what is larger may be packed.
_BYTES, _UNPACKED, _RATIO = 2_000_000_000, 500_000_000, 20


def refuse_large(path, sheets=None):
    """Refuse a packed file that is too large, before it is unpacked; `sheets` is the most of a workbook.

    Other files than workbooks may be larger, if they are not packed to a twentieth.
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
            f"{path.name} is packed in a way that cannot be read, {error}: unpack it and read its files"
        ) from None
    except (zipfile.BadZipFile, OSError, ValueError):
        # Its reader says what is wrong.
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
    """Whether the bytes are no text: zeros, which only UTF-16 has, or other control characters."""
    head = data[:4096]
    marked = head.startswith((b"\xff\xfe", b"\xfe\xff"))
    utf16 = marked or (b"\0" in head[:2] and head[:200].count(b"\0") > 0.4 * len(head[:200]))
    if utf16:
        return bool(re.search(rb"\0\0\0", head))
    controls = sum(byte < 9 or 13 < byte < 32 for byte in head)
    return b"\0" in data or controls > 0.02 * len(head)
