"""Oblique impacts with friction."""
