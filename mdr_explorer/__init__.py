"""The command `mdr-explorer`, which serves the explorer or writes it as a folder."""

import errno
import socket
import sys
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from mdr_core import __version__

_HERE = Path(__file__).parent
#: The served folder: inside this package in the wheel, next to it in the tree.
APP = next(path for path in (_HERE / "app", _HERE.parent / "app") if (path / "main.py").is_file())

#: Default options of a server that is open to all; an option of the user replaces the one here. A message
#: has at most 8 MB. A page has ten minutes to connect, and a session without its page ends after the same
#: time. A page sees only the host and the theme of a request: other cookies and headers may have secrets
#: of a sign-on.
OPTIONS = (
    "--include-headers", "Host", "--include-cookies", "dark", "--websocket-max-message-size", "8000000",
    "--session-token-expiration", "600", "--check-unused-sessions", "15000",
    "--unused-session-lifetime", "600000", "--keep-alive", "15000",
)  # fmt: skip


#: The help of the command, before and after its options.
_ABOUT = "Serve the explorer at http://localhost:5006/app, or write it as a folder for a host of files."
_MORE = "All other options are those of `panel serve`; `panel serve --help` lists them."


def main(arguments: Sequence[str] | None = None) -> None:
    """Serve the explorer, by default at http://localhost:5006/app, or write it as a folder.

    Parameters
    ----------
    arguments : sequence of str, optional
        Options of `panel serve`, such as ``--show`` (opens the browser) or ``--port 5007``; by default
        the options of the command line. They replace those in `OPTIONS`. ``--static FOLDER`` writes the
        explorer for a host of files instead; ``--pyodide`` is the folder of a whole Pyodide, or the
        address from which browsers load it. ``--scene LINK FILE`` writes the scene of a link as one HTML
        file that plays without a server.

    Raises
    ------
    SystemExit
        If Panel is not installed, the port is in use, or the folder cannot be written.
    """
    given, others = _parser().parse_known_args(arguments)
    try:
        from panel.command import main as panel
    except ImportError:
        sys.exit('mdr-explorer needs Panel, which is not installed: pip install "mdr-core[app]"')
    if others and (given.static is not None or given.scene is not None):
        option = "--scene" if given.static is None else "--static"
        sys.exit(f"mdr-explorer: {option} does not serve, and does not take {' '.join(others)}")
    if given.static is not None:
        _write(given)
        return
    if given.pyodide:
        sys.exit("mdr-explorer: --pyodide goes with --static FOLDER")
    if given.scene is not None:
        _write_scene(*given.scene)
        return
    if not any(each.startswith(("--address", "--unix-socket")) for each in others):
        _check_free(given.port)
    shown = ["--show"] if given.show else []
    _allow_sockets()
    # Panel reads its arguments only from here.
    sys.argv = ["panel", "serve", str(APP), *OPTIONS, "--port", str(given.port), *shown, *others]
    panel()


def _allow_sockets() -> None:
    """Raise the limit of open files and sockets, often 1024, to the system's; each user needs one."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


def _parser() -> ArgumentParser:
    """Return the parser of the options that the command handles without Panel."""
    parser = ArgumentParser(
        "mdr-explorer", description=_ABOUT, epilog=_MORE, formatter_class=RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )  # fmt: skip
    parser.add_argument("--port", type=int, default=5006, help="port of the server, by default 5006")
    parser.add_argument("--show", action="store_true", help="open the explorer in the browser")
    parser.add_argument("--static", metavar="FOLDER", type=Path, help="write it there, do not serve it")
    parser.add_argument(
        "--scene", metavar=("LINK", "FILE"), nargs=2, help="write the scene of a link as one HTML file"
    )
    told = "with --static: the folder of a whole Pyodide, or the address from which browsers load it"
    parser.add_argument("--pyodide", metavar="URL-or-folder", default="", help=told)
    parser.add_argument("--version", action="version", version=f"mdr-core {__version__}")
    return parser


def _check_free(port: int) -> None:
    """Exit with a remedy if another program uses the port."""
    with socket.socket() as tried:
        tried.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            tried.bind(("", port))
        except OSError as error:
            if error.errno != errno.EADDRINUSE:
                raise
            sys.exit(f"mdr-explorer: port {port} is in use: choose another, such as --port {port + 1}")


def _write_scene(link: str, file: str) -> None:
    """Write the scene of a link as one HTML file."""
    from . import pages

    try:
        pages.write_scene(link, Path(file))
    except (ValueError, OSError) as error:
        sys.exit(f"mdr-explorer: {error}")


def _write(given: Namespace) -> None:
    """Write the explorer as a folder."""
    from . import static

    folder = given.static
    try:
        static.write(folder, given.pyodide)
    except (ValueError, OSError) as error:
        sys.exit(f"mdr-explorer: {error}")
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    print(f"{folder}: the explorer, {size / 1e6:.0f} MB. Try it: python -m http.server -d {folder}")
    if not (folder / "pyodide").exists():
        print(f"Browsers load Pyodide from {given.pyodide or static.PUBLISHED}")
