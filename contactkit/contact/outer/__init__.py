"""Outer iteration of a contact: unknowns that effects add to the pressure, and scalar balances.

unknown          Unknowns that effects add to a contact, and the contact while they are held.
held_contact     The contact while its unknowns are held: one call of the solver.
iteration        Fixed point of all unknowns; limits and messages.
tension          Tension of an attraction across the gap.
branches         States of a contact with an attraction: which of several is found.
displacement     Normal displacement by the tractions of sliding friction.
local_hardness   Hardness of each pixel, which depends on the displacement there.
hardness_balance One hardness for all pixels, that of the largest displacement.
step             One contact with its unknowns and its hardness.
load             Contact under the load of a scene, and a force that adds to it.
film_balance     Balances of load, film and bodies.
"""
