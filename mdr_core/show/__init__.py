"""Presentation of results: texts, tables, datasets, limits in words, units, plots."""
