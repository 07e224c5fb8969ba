"""Data of liquids and materials, with their sources."""
