"""The served page: `panel serve app` from the project root."""

import panel as pn

from .controls import STYLE
from .session import Session

pn.extension(raw_css=[STYLE], reconnect=True, notifications=True)
Session().layout().servable(title="Indentation explorer")
