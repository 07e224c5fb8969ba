"""The C kernel of native FMUs.

cavities  The cavity of a film between flats in C: its memory, edge, force, events and paths.
deforming  Films between bodies that deform in C: what a film is, its implicit steps, the models.
fmi       The functions of FMI 2 and 3 in C, and the host they are called by.
rheology  Films in C whose viscosity follows pressure and shear: what that changes their force by.
tips      The tips of ``tip-contact`` in C: their motion, flight and impacts.
"""
