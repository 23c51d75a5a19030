"""The served pages: `panel serve app` from the project root."""

from urllib.parse import urlencode

import panel as pn

from . import security
from .common.ui import SHEETS
from .explorer.page import Address, Page
from .measurement.page import Measurement

_ADDRESS = Address.from_request(pn.state.curdoc.session_context.request)
_GIVEN = pn.state.session_args
_QUERY = urlencode(_GIVEN, doseq=True)
pn.state.curdoc.template = security.template()
if "fit" in _GIVEN:
    pn.extension("filedropper", notifications=True, css_files=[*SHEETS, "app/static/fit.css"])
    pn.panel(Measurement(_QUERY)).servable("Measurement", _ADDRESS)
else:
    pn.extension(notifications=True, css_files=SHEETS)
    # The theme from the browser's cookie; a link may set another theme.
    _DARK = pn.state.cookies.get("dark") == "1"
    pn.panel(Page(_QUERY, _DARK)).servable("Indentation explorer", _ADDRESS)
