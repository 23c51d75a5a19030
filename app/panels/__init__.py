"""What stands around the plots: controls, readouts, what is brought and what is taken away."""
