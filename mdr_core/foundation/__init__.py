"""The chain: the 1D foundation of Popov (2015), Fig. 1, element by element; witness of all the rest."""
