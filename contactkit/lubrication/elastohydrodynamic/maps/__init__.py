"""Films on a grid between deforming bodies: any face, rough and measured surfaces.

flow            Flow out of the cells, and its slopes by pressures and gaps.
wet_map         Film, contact and motion of a face as residuals and slopes, in SI units.
multigrid       Approximate inverse of a film with springs.
preconditioner  That of a step: film, local compliance of the bodies, motion.
step            One implicit Euler stage: semismooth Newton, GMRES.
follow          Motion in time: steps of order 1 or 2, rupture, balances.
motion          Phases of a motion: curves, sections, maps.
limits          Rigid bodies with a film, and deforming bodies without one.
"""
