"""Two served pages over `mdr_core`: the explorer, and one for measurements."""
