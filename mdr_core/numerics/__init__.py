"""Numerical methods, independent of mechanics: quadrature, collocation, roots, stable functions."""
