"""Files that tests of the reading write, and the question that one raises."""

import pytest

import mdr_core as mdr


@pytest.fixture
def write(tmp_path):
    def write(content, name="run.txt", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode(encoding))
        return path

    return write


@pytest.fixture
def asked(write):
    """The question about a text."""

    def asked(content, **given):
        with pytest.raises(mdr.UnknownColumns) as error:
            mdr.read_curves(write(content), **given)
        return error.value

    return asked
