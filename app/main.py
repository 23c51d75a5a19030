"""The served pages: `panel serve app` from the project root."""

from urllib.parse import urlencode

import panel as pn

from . import security
from .common.ui import SHEETS
from .explorer import theory
from .explorer.page import Address, Page
from .measurement import page as measurement

#: Pages beside the explorer by their names in the query, of which the first one wins. Each has its maker,
#: its title, its style sheets, and its extensions of Panel.
_PAGES = {
    "fit": (measurement.Measurement, "Measurement", ["app/static/fit.css"], ["filedropper"]),
    "theory": (theory.served, "Theory", [], ["katex"]),
}
_ADDRESS = Address.from_request(pn.state.curdoc.session_context.request)
_GIVEN = pn.state.session_args
_QUERY = urlencode(_GIVEN, doseq=True)
pn.state.curdoc.template = security.template()
_name = next((name for name in _PAGES if name in _GIVEN), "")
_made, _title, _sheets, _extensions = _PAGES.get(_name, (None, "Indentation explorer", [], []))
pn.extension(*_extensions, notifications=True, css_files=[*SHEETS, *_sheets])
#: The theme that a browser has told by a cookie; a link may ask for another one.
_DARK = pn.state.cookies.get("dark") == "1"
pn.panel(_made(_QUERY) if _made else Page(_QUERY, _DARK)).servable(_title, _ADDRESS)
