"""Implicit integration of a mass on a stiff film.

radau         One step: Radau IIA with three stages, its iteration and its error estimate.
dense_output  The highest force of a step and the work along its path.
"""
