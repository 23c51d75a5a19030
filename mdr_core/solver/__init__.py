"""The solver: profiles, media, the contact with its yield, the foundation of springs, impacts."""
