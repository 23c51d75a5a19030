"""Pages of a static explorer, with their scripts and style sheets."""

import json
import re
import shutil
import sys
from pathlib import Path
from string import Template

from . import APP, licenses

_HERE = Path(__file__).parent
#: Compiled packages, loaded from Pyodide with their dependencies in its lock.
COMPILED = ("numpy", "scipy")
#: Imports in their order: share of the progress bar, module, message, and seconds of this import.
IMPORTS = (
    (0.46, "numpy", "Starting NumPy", 0.5), (0.5, "scipy.special", "Starting SciPy", 0.7),
    (0.54, "scipy.optimize", "Starting SciPy", 1), (0.58, "scipy.integrate", "Starting SciPy", 0.5),
    (0.62, "mdr_core.solver.contact", "Starting the solver", 0.5),
    (0.68, "bokeh.models", "Starting Bokeh", 1.2), (0.72, "bokeh.plotting", "Starting Bokeh", 0.7),
    (0.9, "panel", "Starting Panel", 3), (0.96, "app.explorer.browser", "Starting the explorer", 1),
)  # fmt: skip
#: Scripts of the served page in their order, below the folder of Bokeh or Panel; a test compares them.
_OF_BOKEH = ("js/bokeh.min.js", "js/bokeh-widgets.min.js", "js/bokeh-tables.min.js")
_SHIMS = "bundled/reactiveesm/es-module-shims@^1.10.0/dist/es-module-shims.min.js"
_NOTICES = "bundled/notificationarea/notyf@3"
#: Files that Panel's components load when they are drawn, 200 kB of its 107 MB.
_ASKED = ("css", "bundled/theme", "bundled/font-awesome/css")


def write(folder: Path, pyodide: str, integrity: dict[str, str]) -> list[licenses.Licensed]:
    """Write the pages with their files, and return the licences of their scripts.

    `pyodide` is the address of Pyodide, `integrity` has digests of its scripts by their addresses.
    """
    _find_app()
    import bokeh
    import panel

    from app.common import ui
    from app.explorer import theory
    from app.explorer.extras.scene_file import scene_file
    from app.explorer.link import APPENDED
    from app.explorer.page import Page
    from app.explorer.state import PRESETS

    dist = theory.DIST
    own = f"static/panel/{panel.__version__}/dist"
    scripts = [own + "/" + _SHIMS, *(f"static/{name}" for name in _OF_BOKEH)]
    scripts += [f"{own}/{_NOTICES}/notyf.min.js", f"{own}/panel.min.js"]
    sheets = [f"{own}/{_NOTICES}/notyf.min.css", f"{own}/css/notifications.css"]
    for name in (*_ASKED, _SHIMS, _NOTICES + "/notyf.min.js", _NOTICES + "/notyf.min.css", "panel.min.js"):
        _copy(dist / name, folder / own / name)
    # Panel loads it from this address when it shows the first notice.
    _copy(dist / _NOTICES / "notyf.min.css", folder / "static/npm/notyf@3/notyf.min.css")
    for name in ("katex.min.js", "contrib/auto-render.min.js"):
        _copy(dist / theory.KATEX / name, folder / "static/npm/katex" / name)
    for name in _OF_BOKEH:
        _copy(Path(bokeh.__file__).parent / "server/static" / name, folder / "static" / name)
    _copy(APP / "static", folder / "app/static")

    words = {"theme": ui.JS["head"], "private": ui.JS["private"] + ui.JS["page"]}
    words["style"] = ui.LAYOUT[0] + ui.CSS
    words["sheets"] = "\n".join(f'<link rel="stylesheet" href="{name}">' for name in sheets)
    settings = {"pyodide": pyodide, "compiled": COMPILED, "imports": IMPORTS, "scripts": scripts}
    settings |= {"presets": [*PRESETS], "appended": APPENDED.pattern}
    words |= {"settings": json.dumps(settings), "integrity": json.dumps({"integrity": integrity})}
    words["start"] = (_HERE / "static.js").read_text(encoding="utf-8")
    for name in ("static", "theory", "measurement"):
        page = Template((_HERE / f"{name}.html").read_text(encoding="utf-8")).substitute(words)
        _write(folder / f"{'index' if name == 'static' else name}.html", page)
    _write(folder / "app/theory.html", theory.page("../static/npm/katex"))
    # A visitor loads one of them: apart from Bokeh, which the page needs anyway, 0.2 to 0.7 MB.
    (folder / "drawings").mkdir()
    for name in PRESETS:
        drawing = scene_file(Page(f"preset={name}").view, "../static/js/bokeh.min.js")
        _write(folder / "drawings" / f"{name}.html", drawing)
    found = {"es-module-shims": _SHIMS, "notyf": _NOTICES, "katex": theory.KATEX}
    versions = {name: re.search(r"@\^?([\d.]+)", path) for name, path in found.items()}
    parts = [licenses.of_script(name, match[1] if match else "") for name, match in versions.items()]
    font = (dist / "bundled/font-awesome/LICENSE.txt").read_text(encoding="utf-8")
    return [*parts, licenses.Licensed("Font Awesome Free", "5.15.4", "CC-BY-4.0, OFL-1.1, MIT", font)]


def write_scene(link: str, file: Path) -> None:
    """Write the scene of a link, or of the query of a link, as one HTML file that plays without a server.

    Raise ValueError if the link has a wrong value or an unknown name.
    """
    _find_app()
    from app.explorer import link as links
    from app.explorer.extras.scene_file import scene_file
    from app.explorer.page import Page

    query = link.rpartition("?")[2]
    if unknown := links.unknown(query):
        raise ValueError(f"the link has unknown names: {', '.join(unknown)}")
    page = Page()
    page.draw(links.read(query))
    _write(file, scene_file(page.view))


def _find_app() -> None:
    """Let Python import the folder of the explorer as `app`, as a server does."""
    if str(APP.parent) not in sys.path:
        sys.path.insert(0, str(APP.parent))


def _copy(path: Path, to: Path) -> None:
    to.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        shutil.copytree(path, to)
    else:
        shutil.copy(path, to)


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
