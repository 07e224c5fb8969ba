"""Sliding of one wetted surface past another.

effects  Viscous drag, and force of pinned contact lines.
plan     Plan of a sliding: the checked scene and its prepared forces.
run      Forces at an imposed speed, or impulse within an imposed time.
scales   Reference scales: wetted radius, speed, Couette drag.
result   Result of a sliding: forces over the travel, numbers, ranges of validity.
"""
