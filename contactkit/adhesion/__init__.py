"""Adhesion of solids: laws of attraction, limits of rough surfaces, JKR, DMT, Maugis-Dugdale.

attraction      Laws of attraction over the gap, on maps: Dugdale, exponential, Lennard-Jones.
rough_limits    Rough surfaces: cost of full contact, start of stickiness.
van_der_waals   Non-retarded van der Waals attraction; Hamaker constant and work of adhesion.
parameters      Maugis' units, Tabor and transition parameters.
jkr             JKR: attraction inside the contact only.
dmt             DMT: attraction outside a contact of Hertzian shape.
maugis_dugdale  Maugis-Dugdale: the transition between both.
wet_contact     Elastic contact in a meniscus of given pressure, by Maugis-Dugdale.
contact_models  The three as classes: pull-off, and states over gap and load.
"""
