"""Motion of a mass held back by a film: state, events, time steps.

advance       The time step: a mass, pulled, held back by a film and a spring.
events        What happens at a gap on the way: release, rupture, rest, re-wetting, solids that let
smooth        The internal step of `motion` through a liquid without limits, where next to nothing c
state         The state of the motion, and the forces that belong to it: plain numbers, ready to be
step_problem  What one internal step of the motion solves: the forces on the mass, and how they are
"""
