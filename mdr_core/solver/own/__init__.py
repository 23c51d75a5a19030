"""Users' classes: checks of shapes and laws of hardness, and the cap of a law."""
