"""Evaluation of unloadings: E* and H by Oliver and Pharr, first contact, creep, quantities of ISO 14577."""
