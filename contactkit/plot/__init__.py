"""Figures; the only importer of matplotlib.

contact     Figures of contacts, on axes that `plot` makes; they draw, and compute nothing.
separation  Figures. The only module that imports matplotlib; it draws, and computes nothing.
"""
