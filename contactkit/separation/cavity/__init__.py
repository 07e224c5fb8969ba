"""Cavity of a film between flats that is pulled apart, with the history of its rupture.

law        Film that cavitates, of any face: inception, stages of a step, memory; the round one.
disc_film  Film between discs, and the two tensions of its liquid.
state      Cavity at an instant: full, receding, returning; what is remembered.
stages     Void and forces at the stages of a step of Radau's method.
events     Inception of a cavity, where its edge turns, where the film is full again.
path       Steps of a cavity whose film moves as imposed.
"""
