"""The command `mdr-explorer`, which serves the explorer wherever the package is installed, or writes it."""

import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path

_HERE = Path(__file__).parent
#: The folder that is served: in the wheel it is in this package, in the tree beside it.
APP = next(path for path in (_HERE / "app", _HERE.parent / "app") if (path / "main.py").is_file())

#: What a server that is open to all needs; an option that is given holds instead of the one here. A message
#: has at most 8 MB. A page has ten minutes to connect, and a session without its page ends after the same
#: time. A page is told the host of its request alone: cookies and headers may have secrets of a sign-on.
OPTIONS = (
    "--include-headers", "Host", "--include-cookies", "none", "--websocket-max-message-size", "8000000",
    "--session-token-expiration", "600", "--check-unused-sessions", "15000",
    "--unused-session-lifetime", "600000", "--keep-alive", "15000",
)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> None:
    """Serve the explorer, by default at http://localhost:5006/app, or write it as a folder.

    Parameters
    ----------
    arguments : sequence of str, optional
        Options of `panel serve`, such as ``--show`` (opens the browser) or ``--port 5007``; by default
        those of the command line. They hold instead of those in `OPTIONS`. Or ``--static FOLDER``, which
        writes the explorer for a host of files; ``--pyodide`` is the folder of a whole Pyodide, or the
        address from which browsers load it.

    Raises
    ------
    SystemExit
        If Panel is not installed, or the folder cannot be written.
    """
    try:
        from panel.command import main as panel
    except ImportError:
        sys.exit('mdr-explorer needs Panel, which is not installed: pip install "mdr-core[app]"')
    given = sys.argv[1:] if arguments is None else arguments
    if any(each.split("=")[0] == "--static" for each in given):
        _write(given)
        return
    # Panel takes its arguments from here alone.
    sys.argv = ["panel", "serve", str(APP), *OPTIONS, *given]
    panel()


def _write(given: Sequence[str]) -> None:
    """Write the explorer as a folder."""
    from . import static

    parser = ArgumentParser("mdr-explorer", description="Write the explorer for a host of files.")
    parser.add_argument("--static", metavar="FOLDER", type=Path, required=True, help="where it is written")
    told = f"folder of a whole Pyodide {static.PYODIDE}, or its address; by default {static.PUBLISHED}"
    parser.add_argument("--pyodide", metavar="URL-or-folder", default="", help=told)
    options = parser.parse_args(given)
    try:
        static.write(options.static, options.pyodide)
    except (ValueError, OSError) as error:
        sys.exit(f"mdr-explorer: {error}")
    size = sum(path.stat().st_size for path in options.static.rglob("*") if path.is_file())
    folder = options.static
    print(f"{folder}: the explorer, {size / 1e6:.0f} MB. Try it: python -m http.server -d {folder}")
    if not (folder / "pyodide").exists():
        print(f"Browsers load Pyodide from {options.pyodide or static.PUBLISHED}")
