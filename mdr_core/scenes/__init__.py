"""Scenes and their drives: a whole calculation as one value."""
