"""Contactkit against programs and measurements of others."""
