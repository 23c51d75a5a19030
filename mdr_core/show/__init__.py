"""What a result looks like: texts, tables, datasets, limits in words, units, plots."""
