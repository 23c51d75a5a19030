"""HDF5 files with data elsewhere: nothing of another file is read."""

import numpy as np
import pytest

import mdr_core as mdr

h5py = pytest.importorskip("h5py")
afmformats = pytest.importorskip("afmformats")
SECRET = b"root:x:0:0:of nobody else"


def made(path, kind, other):
    """A file of one curve whose force is in another file, in a way that HDF5 has."""
    depth = np.linspace(0, 1e-6, len(SECRET))
    data = {"force": depth, "height (measured)": -depth, "segment": np.zeros(depth.size, np.uint8)}
    known = {"enum": 0, "path": "made", "imaging mode": "force-distance", "spring constant": 0.05}
    afmformats.mod_force_distance.AFMForceDistance(data, known).export_data(path, fmt="hdf5")
    with h5py.File(path, "r+") as file:
        group = file["0"]
        del group["force"]
        if kind == "dataset":
            group.create_dataset("force", (len(SECRET),), "u1", external=[(str(other), 0, len(SECRET))])
        elif kind == "link":
            group["force"] = h5py.ExternalLink(str(other), "/force")
        elif kind == "soft link to a link":
            file["outside"] = h5py.ExternalLink(str(other), "/")
            group["force"] = h5py.SoftLink("/outside/force")
        elif kind == "virtual dataset":
            layout = h5py.VirtualLayout((len(SECRET),), "f8")
            layout[:] = h5py.VirtualSource(str(other), "force", (len(SECRET),))
            group.create_virtual_dataset("force", layout)
        elif kind == "deep":
            deep = group.create_group("/".join("abcdefghijkl"))
            deep["external"] = h5py.ExternalLink(str(other), "/force")
    return path


@pytest.mark.parametrize("kind", ["dataset", "link", "soft link to a link", "virtual dataset", "deep"])
def test_data_in_another_file_are_not_read(kind, tmp_path):
    other = tmp_path / "other.h5"
    if kind == "dataset":
        other.write_bytes(SECRET)
    else:
        with h5py.File(other, "w") as file:
            file["force"] = np.linspace(0, 1e-9, len(SECRET))
    with pytest.raises(ValueError, match=r"copy the data into one file|levels") as refused:
        mdr.read_curves(made(tmp_path / "curve.h5", kind, other))
    assert "root" not in str(refused.value)


def test_a_file_with_more_members_than_its_bound_is_refused(tmp_path, monkeypatch):
    """The bound of a million is ten here; each member counts once."""
    monkeypatch.setattr("mdr_core.measurements.files.hdf5._MEMBERS", 10)
    with h5py.File(tmp_path / "many.h5", "w") as file:
        for k in range(11):
            file.create_group(f"{k}")
    with pytest.raises(ValueError, match="more than 10 members"):
        mdr.read_curves(tmp_path / "many.h5")


@pytest.mark.parametrize("data", [b"", b"\x89HDF\r\n\x1a\n", b"\x89HDF\r\n\x1a\n" + bytes(500)])
def test_a_damaged_file_is_a_clear_error(data, tmp_path):
    (tmp_path / "damaged.h5").write_bytes(data)
    with pytest.raises(ValueError, match=r"damaged\.h5"):
        mdr.read_curves(tmp_path / "damaged.h5")
