"""Subsurface stress under a pressure map.

isolated  Fields of a load that acts once, from transforms that repeat it: the repetitions are taken
maxima    Where a stress measure is largest, found in one pass over planes of which one is in memory
measures  What a stress means for a material: equivalent and principal stresses, and where they peak
periodic  Fourier modes of a map and the stresses each of them causes on one plane of a layered soli
planes    Stresses on planes in a layered solid under a map of pressure and of tangential tractions.
"""
