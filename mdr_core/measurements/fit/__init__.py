"""Fits of media to measurements: force–depth curves, and hardness at several radii."""
