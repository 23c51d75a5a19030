"""Files that tests of the reading write."""

import pytest


@pytest.fixture
def write(tmp_path):
    def write(content, name="run.txt", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode(encoding))
        return path

    return write
