"""The page works without each private name of Panel and Bokeh, and logs what is missing."""

import re
import shutil
import subprocess
import sys
import tomllib

import pytest

from app import security

from ..conftest import ROOT, Explorer, Server

#: Names that are taken away before the app is loaded: what the log says, and how it is done.
ENDS = {
    "panel.io.server.ComponentResourceHandler": (
        "from panel.io import server; del server.ComponentResourceHandler"
    ),
    "bokeh.core.serialization.Deserializer": (
        "from bokeh.core import serialization; del serialization.Deserializer"
    ),
    "bokeh.server.urls.per_app_patterns": "from bokeh.server import urls; del urls.per_app_patterns",
    "panel.io.server.WSHandler": "from panel.io import server; del server.WSHandler",
    "panel.io.server.DocHandler": "from panel.io import server; del server.DocHandler",
    "panel.io.document.dispatch_tornado": "from panel.io import document; del document.dispatch_tornado",
    "panel.io.resources.BASE_TEMPLATE": "from panel.io import resources; del resources.BASE_TEMPLATE",
}


def python(code):
    """A process of its own, because names are taken away and replaced for good."""
    return subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )


@pytest.mark.few(2)
@pytest.mark.parametrize("end", ENDS)
def test_the_app_loads_without_a_private_end_and_logs_one_line(end):
    code = f"""import panel, bokeh.server.server, panel.io.server
{ENDS[end]}
from app import security, server_lifecycle
print(security.template().count("{{% block"))
"""
    done = python(code)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count(f"{end} is not there") == 1
    # The template has its head in any case.
    assert int(done.stdout) == (1 if "TEMPLATE" in end else 2)


def test_an_array_of_texts_is_not_made_and_packed_bytes_of_a_message_are_not_unpacked():
    """172 bytes that would be a gigabyte, 4 kB that would be 4 MB.

    An array of numbers is taken, and the same bytes beside a message.
    """
    code = """import base64, gzip
from bokeh.core.serialization import Buffer, DeserializationError, Deserializer
from app import server_lifecycle
array = {"type": "ndarray", "array": [1, 2], "order": "little", "shape": [2]}
packed = base64.b64encode(gzip.compress(bytes(4 << 20))).decode()
for bad in (array | {"dtype": "S1000000000"}, {"type": "bytes", "data": packed}):
    try:
        print(len(Deserializer().decode(bad)))
    except DeserializationError:
        print("refused")
print(Deserializer().decode(array | {"dtype": "float64"}).tolist())
beside = Buffer("1", memoryview(b"own"))
print(bytes(Deserializer().decode({"type": "bytes", "data": {"id": "1"}}, [beside])))
"""
    done = python(code)
    assert done.stdout.splitlines() == ["refused", "refused", "[1.0, 2.0]", "b'own'"], done.stderr


def test_all_private_ends_are_there_in_the_versions_that_are_installed(caplog):
    assert "bokeh-gl" in security.template()
    assert caplog.text == ""


#: Names that common/js/private.js takes from Bokeh, and whether what is done below asks for each.
IN_THE_BROWSER = {
    "find_one": True, "el": True, "frame": True, "x_scale": True, "y_scale": True, "bbox": True,
    "all_models": False, "repaint": True, "export": True, ".bk-events": True,
    "invalidate_layout": False, ".noUi-handle": False,
}  # fmt: skip


@pytest.fixture(scope="module")
def without(browser, tmp_path_factory):
    """The page served without all names of the server; a page says which one of the browser is gone."""
    root = tmp_path_factory.mktemp("without")
    shutil.copytree(ROOT / "app", root / "app", ignore=shutil.ignore_patterns("__pycache__"))
    for other in ("assets", "mdr_core"):
        (root / other).symlink_to(ROOT / other)
    names = {root / "app/security.py": [], root / "app/common/js/private.js": IN_THE_BROWSER}
    for path, ends in names.items():
        text = path.read_text(encoding="utf-8")
        for end in ends or [each.rsplit(".", 1)[1] for each in ENDS]:
            assert f'"{end}"' in text
            moved = f'(window.without === "{end}" ? "{end}_moved" : "{end}")' if ends else f'"moved_{end}"'
            text = text.replace(f'"{end}"', moved)
        path.write_text(text, encoding="utf-8")
    server = Server(root=root)
    yield server
    server.stop()


def test_the_page_is_in_use_without_any_of_them(without, context):
    explorer = Explorer(context.new_page(), without.url, window=(1280, 720))
    explorer.change(explorer.type, "d_max", "5 nm")
    assert explorer.readout("depth") == "5.000 nm"
    assert explorer.problems == []
    explorer.page.close()
    assert without.log.count("is not there") >= 3
    assert "Traceback" not in without.log


@pytest.mark.few(1)
@pytest.mark.parametrize("end", IN_THE_BROWSER)
def test_the_page_is_in_use_without_an_end_in_the_browser(end, without, context):
    """Everything is drawn, played and saved, and one line of the console says what is not there."""
    page = context.new_page()
    page.add_init_script(f"window.without = {end!r}")
    explorer = Explorer(page, without.url, window=(1280, 720))
    explorer.change(explorer.type, "d_max", "5 nm")
    assert explorer.readout("depth") == "5.000 nm"
    # The pointer over the springs, and the player.
    page.locator(".card.springs canvas").first.hover(force=True)
    page.get_by_label("State along the path").press("End")
    explorer.wait("explorer.played()")
    page.get_by_label("State along the path").press("Home")
    explorer.wait("explorer.row('force', 'now')[0][0] === 0")
    with page.expect_download():
        explorer.press("Save plots")
    page.close()
    lines = [each for each in explorer.problems if f"{end}_moved is not there" in each]
    assert explorer.problems == lines
    assert len(lines) == 1 if IN_THE_BROWSER[end] else len(lines) <= 1
    assert "Traceback" not in without.log


def test_panel_has_an_upper_bound_at_the_next_minor_version():
    """Private ends may move with it."""
    data = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    needed = [each for each in data["project"]["optional-dependencies"]["app"] if each.startswith("panel")]
    low, high = re.fullmatch(r"panel>=1\.(\d+)[.\d]*,<1\.(\d+)", *needed).groups()
    assert int(high) == int(low) + 1
