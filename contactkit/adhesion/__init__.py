"""Adhesion of solids: van der Waals attraction, JKR, DMT and Maugis-Dugdale.

dmt             DMT: adhesion around a contact of Hertz' shape, for stiff, small, weakly sticky bodi
jkr             JKR: adhesion inside the contact only, for soft, large, sticky bodies.
maugis_dugdale  Maugis-Dugdale: adhesion in a ring of constant stress, from DMT to JKR and all betwe
parameters      What measures an adhesive contact of a sphere: Maugis' units, and how sharp its adhe
van_der_waals   Van der Waals attraction of two bodies by Hamaker's sum over pairs, not retarded.
"""
