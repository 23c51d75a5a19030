"""Measured curves: reading of files, and fits of the medium."""
