"""Lubrication: squeeze films, Couette films, cavitation and shear limits.

squeeze_film      Squeeze film: viscous force and impulse of an opening gap.
film_limits       Viscous force with a cavitation pressure or a limiting shear strength.
disc_cavity       Cavity in the middle of a disc of film: edge, force, inflow.
rupture_history   Rupture history: at which gap the film ruptured at each radius.
constant_force    Time to open a film under a constant force.
couette_flat      Couette film between sliding flats; contact-angle hysteresis.
couette_sphere    Couette film under a sliding sphere.
couette_reynolds  Sphere sliding in a round film: drag from Reynolds' equation.
dimensionless     Dimensionless numbers for the range of validity.
elastohydrodynamic
                  Films of bodies that deform, on rings and on a grid: cavities, contact.
flow_laws         Flow laws: shear, pressure, slip; what they make of a squeezed film.
reynolds          Reynolds' equation in 2-D: any face, any gap, cavities with memory.
"""
