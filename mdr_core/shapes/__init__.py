"""Indenter shapes: geometry only."""
