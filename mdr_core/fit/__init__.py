"""Fits of media to measurements: force–depth curves, impacts, hardness at several radii."""
