"""Films on a grid between deforming bodies: any face, rough and measured surfaces.

wet_map         Film, contact and motion of a face as residuals and slopes, in SI units.
preconditioner  Factors of film and local compliance, as an approximate inverse.
step            One implicit Euler stage: semismooth Newton, GMRES.
follow          Motion in time: steps of order 1 or 2, rupture, balances.
motion          Phases of a motion: curves, sections, maps.
limits          Rigid bodies with a film, and deforming bodies without one.
"""
