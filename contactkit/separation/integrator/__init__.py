"""Implicit integration of a mass on a stiff film.

dense_output  What can be read off a step once it is taken: its highest force and the work along its
radau         One implicit step of a mass held by a film whose resistance may be enormous or nothing
radau_short   The step of `stiff_step` where it is short: solved with the slopes at its start alone.
radau_smooth  The step of `stiff_step` through a liquid between flats, where next to nothing changes
"""
