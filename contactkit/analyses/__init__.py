"""Analyses that take many solutions: curves over load, approach or humidity; stick-slip; division.

humidity_curve     Meniscus force against relative humidity.
adhesion_curve     Contact radius and approach of an adhesive sphere against load.
pull_off           Pull-off curve of a contact under adhesion: approach, separation, jumps.
division           Division of a meniscus into many: forces and optimal number.
division_laws      Force laws of N equal menisci between flats, for the division.
area_over_load     Real area of contact over the load, beside the theories of rough contact.
heights            Heights of a surface on a grid, without a contact.
load_curve         A contact under a series of loads or approaches, and its cost.
load_for           Load at which a contact reaches a given area, or yields first.
subsurface         Stress below a contact that is solved already, for any friction.
deforming          Films between deforming bodies: over speed, rest, humidity, frequency.
stick_slip         Stick-slip of a block that is pulled through a spring.
load_displacement  Load-displacement curve of a rough contact: loading, unloading, impact.
"""
