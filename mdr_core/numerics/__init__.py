"""Numerics that know nothing of mechanics: quadrature, collocation, roots, stable functions."""
