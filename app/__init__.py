"""The explorer: a served page over `mdr_core`."""

# Imported when the server starts, so that the first visitor does not wait for it.
from . import session as session
