"""Numerical methods, independent of mechanics: quadrature, roots, stable functions."""
