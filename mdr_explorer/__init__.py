"""The command `mdr-explorer`, which serves the explorer wherever the package is installed."""

import sys
from collections.abc import Sequence
from pathlib import Path

_HERE = Path(__file__).parent
#: The folder that is served: in the wheel it is in this package, in the tree beside it.
APP = next(path for path in (_HERE / "app", _HERE.parent / "app") if (path / "main.py").is_file())


def main(arguments: Sequence[str] | None = None) -> None:
    """Serve the explorer, by default at http://localhost:5006/app.

    Parameters
    ----------
    arguments : sequence of str, optional
        Options of `panel serve`, such as ``--show`` (opens the browser) or ``--port 5007``; by default
        those of the command line.

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
    sys.argv = ["panel", "serve", str(APP), *given]
    panel()
