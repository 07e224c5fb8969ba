"""Figures; the only room that imports matplotlib.

separation  Figures of separations and costs; axes, legends and colours of all figures.
contact     Figures of contacts.
film        Figures of films on faces; animations.
"""
