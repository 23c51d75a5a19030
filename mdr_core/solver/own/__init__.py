"""What a user writes is admitted here: shapes, laws of hardness, and the cap of a law."""
