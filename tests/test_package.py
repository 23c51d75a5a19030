"""The wheel and the source distribution, as they are built and installed."""

import os
import re
import socket
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path
from urllib.request import urlopen

import pytest

import mdr_explorer

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def call(*command, **options):
    run = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, **options)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Paths of wheel and sdist; the wheel is built from the sdist."""
    for package in ("build", "hatchling"):
        pytest.importorskip(package)
    folder = tmp_path_factory.mktemp("dist")
    call("-m", "build", "--no-isolation", "--outdir", folder, ROOT)
    (wheel,), (sdist,) = folder.glob("*.whl"), folder.glob("*.tar.gz")
    return wheel, sdist


@pytest.fixture(scope="module")
def unpacked(built, tmp_path_factory):
    """A folder with what is in the wheel, as `pip` unpacks it beside other packages."""
    folder = tmp_path_factory.mktemp("unpacked")
    with zipfile.ZipFile(built[0]) as wheel:
        wheel.extractall(folder)
    return folder


def files(folder):
    """Files below a folder, but for what Python leaves there."""
    paths = (path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)
    return {path.relative_to(folder).as_posix() for path in paths}


def test_the_wheel_has_the_library_and_the_explorer_and_nothing_else(unpacked):
    assert {path.name for path in unpacked.iterdir() if path.suffix != ".dist-info"} == {
        "mdr_core",
        "mdr_explorer",
    }
    assert files(unpacked / "mdr_core") == files(ROOT / "mdr_core")
    assert files(unpacked / "mdr_explorer" / "app") == files(ROOT / "app")
    own = {name for name in files(unpacked / "mdr_explorer") if not name.startswith(("app/", "assets/"))}
    assert own == files(ROOT / "mdr_explorer")


def test_the_wheel_has_each_asset_that_the_explorer_reads(unpacked):
    """Files of assets/ that are named in its code or drawn in its theory."""
    code = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "app").rglob("*.py"))
    named = {path.name for path in (ROOT / "assets").iterdir() if f'"{path.name}"' in code}
    theory = (ROOT / "assets" / "theory.md").read_text(encoding="utf-8")
    named |= set(re.findall(r"!\[.*?\]\((\w+\.svg)\)", theory))
    assert {"quantities.json", "presets.json", "theory.md"} <= named
    assert files(unpacked / "mdr_explorer" / "assets") == named


@pytest.mark.slow
def test_the_command_serves_the_explorer_from_the_wheel(unpacked, tmp_path):
    """Its three pages, the assets with them, apart from the tree."""
    pytest.importorskip("panel")
    code = (
        "from importlib.metadata import distribution; "
        "(command,) = distribution('mdr-core').entry_points.select(group='console_scripts'); "
        "assert command.name == 'mdr-explorer'; command.load()(['--port', '0'])"
    )
    environment = os.environ | {"PYTHONPATH": str(unpacked), "PYTHONUNBUFFERED": "1"}
    output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    server = subprocess.Popen([sys.executable, "-P", "-c", code], cwd=tmp_path, env=environment, **output)
    try:
        lines = []
        # Ends where the server ends.
        for line in server.stdout:
            lines.append(line)
            if found := re.search(r"running at: (http\S+/app)", line):
                break
        else:
            raise AssertionError("".join(lines))
        for query, expected in {"": "Bokeh", "?fit": "Bokeh", "?theory": "renderMathInElement"}.items():
            assert expected in urlopen(found[1] + query, timeout=120).read().decode()
        sheet = urlopen(found[1] + "/static/style.css", timeout=20).read()
        assert sheet == (ROOT / "app" / "static" / "style.css").read_bytes()
    finally:
        server.terminate()
        rest, _ = server.communicate(timeout=20)
    assert "Traceback" not in "".join([*lines, rest]), rest


def test_the_command_names_its_options_and_another_port(capsys):
    with pytest.raises(SystemExit):
        mdr_explorer.main(["--help"])
    said = capsys.readouterr().out
    for name in ("http://localhost:5006/app", "--port", "--show", "--static", "--version", "panel serve"):
        assert name in said
    pytest.importorskip("panel")
    with socket.socket() as other:
        other.bind(("", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(SystemExit, match=f"port {port} is in use.*--port {port + 1}"):
            mdr_explorer.main(["--port", str(port)])
    with pytest.raises(SystemExit, match="--static does not serve, and does not take --prefix lab"):
        mdr_explorer.main(["--static", "folder", "--prefix", "lab"])
    with pytest.raises(SystemExit, match="--scene does not serve, and does not take there"):
        mdr_explorer.main(["--scene", "?drive=impact", "scene.html", "there"])


def test_the_command_says_how_to_install_what_it_needs(monkeypatch):
    monkeypatch.setitem(sys.modules, "panel.command", None)
    with pytest.raises(SystemExit, match=r'pip install "mdr-core\[app\]"$'):
        mdr_explorer.main([])


def test_extras_that_a_user_chooses_from_and_the_names_they_had():
    extras = PROJECT["optional-dependencies"]
    assert {"app", "afm", "sweep", "all"} <= set(extras)
    # Each of them is in "all".
    (everything, *others) = extras["all"]
    parts = re.search(r"mdr-core\[(.*)\]", everything)[1].split(",")
    needed = {need for name in parts for need in extras[name]} | set(others)
    assert needed == {need for name in set(extras) - {"all"} for need in extras[name]}


def test_the_sdist_has_what_the_page_and_the_tests_need(built):
    with tarfile.open(built[1]) as sdist:
        names = {name.partition("/")[2] for name in sdist.getnames()}
    needed = {"app/main.py", "assets/quantities.json", "assets/docs/conf.py", "tests/test_package.py"}
    assert needed | {"README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md"} <= names
    assert not any(name.startswith(("assets/docs/gallery/", "site/")) for name in names)


def test_the_sdist_has_nothing_of_environments_beside_the_tree(tmp_path):
    """The README makes `.venv-test` and `.venv-docs` in the tree; they have packages of the same names."""
    pytest.importorskip("hatchling")
    for name in ("pyproject.toml", ".gitignore", "README.md", "LICENSE"):
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    others = [
        f"{place}/lib/{name}/a.py" for place in (".venv-test", "env") for name in ("mdr_core", "tests")
    ]
    for name in ("mdr_core/a.py", "tests/a.py", *others):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    code = (
        "from hatchling.builders.sdist import SdistBuilder; "
        "print(*(file.relative_path for file in SdistBuilder('.').recurse_included_files()))"
    )
    files = call("-c", code, cwd=tmp_path).split()
    assert {name for name in files if name.endswith("a.py")} == {"mdr_core/a.py", "tests/a.py"}


def test_the_wheel_is_installed_and_imported_apart_from_the_tree(built, tmp_path):
    target = tmp_path / "installed"
    call("-m", "pip", "install", "-q", "--no-deps", "--no-index", "--target", target, built[0])
    code = "from mdr_core import *; print(abel.__file__, impact(Cone(1), Medium(1), 1, 1).restitution)"
    environment = os.environ | {"PYTHONPATH": str(target)}
    file, restitution = call("-P", "-c", code, cwd=tmp_path, env=environment).split()
    assert Path(file).is_relative_to(target)
    # Without yield and viscosity no energy is lost.
    assert float(restitution) == 1.0


def test_versions_agree():
    import mdr_core

    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (.*)$", citation, re.MULTILINE)[1] == PROJECT["version"]
    assert mdr_core.__version__ == PROJECT["version"]


def test_the_command_writes_the_scene_of_a_link(tmp_path):
    """The file has the numbers of the link; a link that the page would not open as given is rejected."""
    pytest.importorskip("panel")
    file = tmp_path / "scene.html"
    for link in (
        "preset=berkovich-pdms&max_depth=5e-7",
        "https://host/app?preset=berkovich-pdms&max_depth=5e-7",
    ):
        mdr_explorer.main(["--scene", link, str(file)])
        text = file.read_text(encoding="utf-8")
        assert "PDMS" in text
        assert "500.0 nm" in text
        file.unlink()
    for link, named in {"preste=x": "preste", "max_depth=1e9": "10.00 m", "preset=nix": "nix"}.items():
        with pytest.raises(SystemExit, match=named):
            mdr_explorer.main(["--scene", link, str(file)])
    with pytest.raises(SystemExit, match="nowhere"):
        mdr_explorer.main(["--scene", "", str(tmp_path / "nowhere" / "scene.html")])
    assert not file.exists()
