"""The served page: `panel serve app` from the project root."""

import panel as pn

from . import theory
from .page import Page

_PLACE = pn.state.session_args.get("theory")
_SHEETS = {"css_files": ["app/static/style.css"]}
if _PLACE:
    pn.extension("katex", **_SHEETS)
    theory.page(_PLACE[0].decode("utf-8", "replace")).servable(title="The theory")
else:
    pn.extension(notifications=True, reconnect=True, **_SHEETS)
    Page(pn.state.session_args).view.servable(title="Indentation explorer")
