"""Liquid bridges with a circular (toroidal) meridian.

bridge           Capillary bridge between two bodies, its meridian taken for an arc of a circle: the
contact_circles  The two contact circles of an arc between curved bodies: equations, Newton iteratio
flat             A liquid bridge between two flats, its meridian taken for an arc of a circle.
shape            Pure numbers of an arc of a circle between two flats: all that follows from two ang
sphere           A liquid bridge between two curved bodies, its meridian taken for an arc of a circl
"""
