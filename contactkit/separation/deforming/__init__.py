"""Separations of bodies that deform while a film is between them.

effects   Elastic bodies, and the contact of their asperities.
numbers   Dimensionless numbers that decide which effects matter.
checks    What such a scene may not have.
plan      Plan: the film of smooth bodies, its numbers and notes.
run       The motion, and its result.
validity  Ranges of validity along a run.
maxwell   Rigid film in series with a spring, its first correction.
result    Result: curves, sections, numbers.
"""
