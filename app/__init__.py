"""Served pages over `mdr_core`: the explorer, one for measurements, and the theory."""
