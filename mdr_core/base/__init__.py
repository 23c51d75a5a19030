"""What all stands on: checks of arguments, errors, remarks, base classes of results."""
