"""The explorer: a served page over `mdr_core`."""

from . import extras as extras
