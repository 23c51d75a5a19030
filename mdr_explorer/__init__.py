"""The command `mdr-explorer`, which serves the explorer wherever the package is installed."""

import sys
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
    """Serve the explorer, by default at http://localhost:5006/app.

    Parameters
    ----------
    arguments : sequence of str, optional
        Options of `panel serve`, such as ``--show`` (opens the browser) or ``--port 5007``; by default
        those of the command line. They hold instead of those in `OPTIONS`.

    Raises
    ------
    SystemExit
        If Panel is not installed.
    """
    try:
        from panel.command import main as panel
    except ImportError:
        sys.exit('mdr-explorer needs Panel, which is not installed: pip install "mdr-core[app]"')
    given = sys.argv[1:] if arguments is None else arguments
    # Panel takes its arguments from here alone.
    sys.argv = ["panel", "serve", str(APP), *OPTIONS, *given]
    panel()
