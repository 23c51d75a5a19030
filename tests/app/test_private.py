"""The page is served without each private end of Panel and Bokeh, with a line in the log."""

import re
import shutil
import subprocess
import sys
import tomllib

import pytest

from app import private

from .conftest import ROOT, Explorer, Server

#: Names that are taken away before the app is loaded: what the log says, and how it is done.
ENDS = {
    "bokeh.server.urls.per_app_patterns": "from bokeh.server import urls; del urls.per_app_patterns",
    "panel.io.server.WSHandler": "from panel.io import server; del server.WSHandler",
    "panel.io.document.dispatch_tornado": "from panel.io import document; del document.dispatch_tornado",
    "panel.io.resources.BASE_TEMPLATE": "from panel.io import resources; del resources.BASE_TEMPLATE",
}


@pytest.mark.parametrize("end", ENDS)
def test_the_app_loads_without_a_private_end_and_logs_one_line(end):
    """In a process of its own, because the names are taken away for good."""
    code = f"""import panel, bokeh.server.server, panel.io.server
{ENDS[end]}
from app import private, server_lifecycle
print(private.template().count("block"))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.count(f"{end} is not there in this version") == 1
    # The template has its head in any case.
    assert int(done.stdout) == (2 if "TEMPLATE" in end else 4)


def test_all_private_ends_are_there_in_the_versions_that_are_installed(caplog):
    assert "bokeh-gl" in private.template()
    assert caplog.text == ""


def test_the_page_is_in_use_without_any_of_them(browser, tmp_path):
    """Served with all names gone, and in a browser whose views show nothing but their element."""
    shutil.copytree(ROOT / "app", tmp_path / "app", ignore=shutil.ignore_patterns("__pycache__"))
    for other in ("assets", "mdr_core"):
        (tmp_path / other).symlink_to(ROOT / other)
    path = tmp_path / "app" / "private.py"
    text = path.read_text(encoding="utf-8")
    for end in ENDS:
        name = end.rsplit(".", 1)[1]
        assert f'"{name}"' in text
        text = text.replace(f'"{name}"', f'"moved_{name}"')
    path.write_text(text, encoding="utf-8")
    server = Server(root=tmp_path)
    try:
        with browser.new_context(viewport={"width": 1280, "height": 720}) as context:
            explorer = Explorer(context.new_page(), server.url)
            explorer.page.evaluate("""() => {
                const find = Bokeh.index.find_one.bind(Bokeh.index)
                Bokeh.index.find_one = (model) => find(model) && { el: find(model).el }
            }""")
            explorer.change(explorer.type, "d_max", "5 nm")
            assert explorer.readout("depth") == "5.000 nm"
            explorer.page.get_by_label("State along the path").press("Home")
            explorer.wait("explorer.row('force', 'now')[0][0] === 0")
            assert explorer.problems == []
    finally:
        server.stop()
    assert server.log.count("is not there in this version") >= 3
    assert "Traceback" not in server.log


def test_panel_has_an_upper_bound_at_the_next_minor_version():
    """Private ends may move with it."""
    data = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    needed = [each for each in data["project"]["optional-dependencies"]["app"] if each.startswith("panel")]
    low, high = re.fullmatch(r"panel>=1\.(\d+),<1\.(\d+)", *needed).groups()
    assert int(high) == int(low) + 1
