"""The served page: `panel serve app` from the project root."""

import panel as pn

from .session import Session

pn.extension(notifications=False)
Session(pn.state.session_args).page.servable(title="Indentation explorer")
