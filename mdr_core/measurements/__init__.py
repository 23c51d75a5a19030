"""Measured curves: files that are read, and fits of the medium to them."""
