"""Separations of bodies that deform while a film is between them.

effects   Elastic bodies, and the contact of their asperities.
numbers   Dimensionless numbers that decide which effects matter.
checks    What such a scene may not have.
plan      Plan: the film on rings or on a map, its numbers and notes.
phases    What drives the bodies, and until when.
outcome   Numbers of a motion, and its result.
run       The motion on rings or on a map.
maps      Bodies with heights: films on a grid.
limits    Rigid bodies with a film, and bodies at rest.
validity  Ranges of validity along a run.
maxwell   Rigid film in series with a spring, its first correction.
result    Result: curves, sections, numbers.
"""
