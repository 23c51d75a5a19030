"""What two extras or more share. The page needs nothing of it."""
