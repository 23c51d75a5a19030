"""Fits of media to measurements: force–depth curves, hardness at several radii."""
