"""The explorer: a served page over `mdr_core`."""
