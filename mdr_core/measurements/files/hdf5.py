"""Check that an HDF5 file contains all its data."""

from ...base.errors import MDRError
from ...show.report import imported

#: Largest number of members of a file, and of levels of its groups.
_MEMBERS, _LEVELS = 1_000_000, 10


def refuse_outside(path):
    """Raise MDRError if a file refers to data in other files, before reading any data.

    A dataset may be in any file that its reader may open, such as a file with passwords. A link may lead to
    another file, and a virtual dataset consists of other datasets.
    """
    h5py = imported("h5py", f"reading {path.name}", '"mdr-core[afm]"')
    count = 0

    def fault(name, link):
        """Return the fault of a member, which ends the walk; an exception raised here would be lost."""
        nonlocal count
        count += 1
        if count > _MEMBERS or name.count("/") >= _LEVELS:
            return f"more than {_MEMBERS} members or {_LEVELS} levels: save the curve as a CSV table"
        outside = isinstance(link, h5py.ExternalLink)
        if isinstance(link, h5py.HardLink) and isinstance(found := file[name], h5py.Dataset):
            outside = found.external or found.is_virtual
        text = f"{name[:80]!r} in another file, which is not read: copy the data into one file"
        return text if outside else None

    try:
        with h5py.File(path, "r") as file:
            found = file.visititems_links(fault)
    except (OSError, RuntimeError, KeyError, SystemError) as error:
        raise MDRError(f"{path.name} is a damaged HDF5 file: {error}") from None
    if found:
        raise MDRError(f"{path.name} has {found}")
