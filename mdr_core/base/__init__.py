"""Foundations of all modules: argument checks, errors, remarks, base classes of results."""
