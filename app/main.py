"""The served page: `panel serve app` from the project root."""

from urllib.parse import urlencode

import panel as pn

from . import theory
from .page import Address, Page

_ADDRESS = Address.from_request(pn.state.curdoc.session_context.request)
_PLACE = pn.state.session_args.get("theory")
_SHEETS = {"css_files": ["app/static/style.css"]}
# As wide as the screen: a phone would lay the page out for a desk. No plot is drawn with WebGL.
pn.state.curdoc.template = """{% block postamble %}
<meta name="viewport" content="width=device-width, initial-scale=1">{% endblock %}{% block js_resources %}
{% for line in bokeh_js.splitlines() if "bokeh-gl" not in line %}{{ line }}
{% endfor %}{% endblock %}"""
if _PLACE:
    pn.extension("katex", **_SHEETS)
    theory.page(_PLACE[0].decode("utf-8", "replace")).servable("The theory", _ADDRESS)
else:
    pn.extension(notifications=True, **_SHEETS)
    Page(urlencode(pn.state.session_args, doseq=True)).view.servable("Indentation explorer", _ADDRESS)
