"""Motion of a mass held back by a film: state, events, time steps.

state    The state of the motion, and the forces that belong to it.
events   Release, rupture, rest on asperities, re-wetting, solids that pull off.
advance  The motion itself: internal steps chosen by their error, cut at events.
"""
