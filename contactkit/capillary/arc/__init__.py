"""Liquid bridges in the circular (toroidal) approximation.

bridge           Bridge of given volume between two bodies: `arc_bridge`.
flat             Bridge between two flats, explicit.
sphere           Bridge between two curved bodies.
profile          Meridian curve of a solved bridge: `arc_profile`.
shape            Geometry of a circular meridian between two flats at unit gap.
contact_circles  Contact circles between curved bodies, by Newton iteration.
"""
