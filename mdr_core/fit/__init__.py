"""From measurements to the medium: curves of indentation, impacts, hardness over radius."""
