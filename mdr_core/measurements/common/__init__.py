"""What unloadings and fits share: columns, least squares, standard errors, doubts about numbers."""
