"""Impacts of free bodies: depth, contact time and restitution, normal and oblique."""
