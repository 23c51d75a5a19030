"""The served page: `panel serve app` from the project root."""

import panel as pn

from .page import Page

pn.extension(notifications=True, reconnect=True, css_files=["app/static/style.css"])
Page(pn.state.session_args).view.servable(title="Indentation explorer")
