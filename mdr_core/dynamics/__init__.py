"""A free body on the medium: how deep it comes, how long it stays, what it gives back."""
