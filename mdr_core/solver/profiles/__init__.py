"""Profiles: geometry of indenters."""
