"""Files of measured tips, and the limits of files that the manual names."""

import re

import numpy as np
import pytest

from app.common.quantities import ASSETS
from app.common.upload import TIP_BYTES, Uploaded
from app.explorer.page import Page

from .states import part, table


def test_a_file_that_is_larger_than_the_browser_should_send_is_refused():
    with pytest.raises(ValueError, match=r"run\.csv has more than 5 MB"):
        Uploaded("run.csv", 5_000_001, b"1, 2\n" * 10**6 + b"3").read()


def test_a_refused_tip_is_named_with_its_misfit():
    page, r = Page(), np.linspace(0, 400, 200)
    wavy = table({"r (nm)": r, "z (nm)": r**2 / 2000 + 50 * np.sin(r / 30)})
    shapes = part(page, "shape")
    option, label = shapes.look["options"][-1]
    assert label == "Measured tip: a file"
    shapes.act(option)
    for text, why in (
        (wavy, r"the nearest convex profile misses the samples by (\d\d) nm \(rms, most at r = \d+ nm\), "),
        ("depth\n", "no samples; expected rows of numbers"),
        ("r (nm), z (nm)\n0, 0\n1, x\n", "expected two numbers r, z, found"),
        ("r, z\n0, 0\n1, 1\n", "the header must name the units of r and z"),
    ):
        file = {"name": "my  tip.csv", "size": len(text), "data": text.encode()}
        part(page, "CSV file of a measured tip: r, z").act(file)
        said = part(page, "CSV file of a measured tip: r, z").look["refused"]
        found = re.match(rf"my tip\.csv(?:, line \d)?: {why}", said)
        assert found, said
        if text is wavy:
            # An rms of at most 50/√2 nm.
            assert 10 < float(found[1]) < 36
    assert page.state.shape == "cone"


def test_the_manual_names_the_limits_of_files_and_messages():
    text = (ASSETS / "docs" / "explorer.md").read_text(encoding="utf-8")
    files, messages = re.search(
        r"Files of tips are limited to (\d+) MB.*?messages to (\d+) MB", text, re.DOTALL
    ).groups()
    assert int(files) * 10**6 == TIP_BYTES
    assert int(messages) * 10**6 == int(re.search(r"--websocket-max-message-size (\d+)", text)[1])
