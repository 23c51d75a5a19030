"""Common parts of unloadings and fits: columns, least squares, standard errors, doubts about numbers."""
