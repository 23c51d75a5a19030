"""The served page: `panel serve app` from the project root."""

from urllib.parse import urlencode

import panel as pn

from .extra import EXTRAS
from .page import Address, Page
from .ui import SHEETS

_ADDRESS = Address.from_request(pn.state.curdoc.session_context.request)
_GIVEN = pn.state.session_args
# As wide as the screen: a phone would lay the page out for a desk. No plot is drawn with WebGL, which
# spares the first visit 194 of 3,060 kB of scripts.
pn.state.curdoc.template = """{% block postamble %}
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="modulepreload" href="app/static/parts.js">{% endblock %}{% block js_resources %}
{% for line in bokeh_js.splitlines() if "bokeh-gl" not in line %}{{ line }}
{% endfor %}{% endblock %}"""
pn.extension(notifications=True, css_files=SHEETS)
_PAGES = [extra for extra in EXTRAS.values() if extra.served and extra.name in _GIVEN]
if _PAGES:
    place = _GIVEN[_PAGES[0].name][0].decode("utf-8", "replace")
    _PAGES[0].served(place).servable(_PAGES[0].name.capitalize(), _ADDRESS)
else:
    Page(urlencode(_GIVEN, doseq=True)).view.servable("Indentation explorer", _ADDRESS)
