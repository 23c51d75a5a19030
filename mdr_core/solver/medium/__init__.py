"""What is indented: the medium, its laws of hardness, the structure behind it."""
