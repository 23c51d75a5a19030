"""The solver: profiles, media, the contact with yield, the foundation of springs, impacts."""
