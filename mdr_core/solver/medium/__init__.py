"""The indented medium, its laws of hardness, and the structure behind it."""
