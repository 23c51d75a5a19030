"""Normal impacts of a free body."""
