"""Data of liquids and materials, with their sources, and the bibliography.

bibliography  Works by their keys, and the works that a text names.
"""
