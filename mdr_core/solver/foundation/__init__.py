"""The chain: the 1D foundation of Popov (2015), Fig. 1, solved element by element."""
