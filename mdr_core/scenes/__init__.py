"""A whole calculation as a value: scenes and their drives."""
