"""Films of liquids whose viscosity depends on pressure and shear, and which slip.

changes        Parts of the rheology, and what each changes the force by.
choice         Choice of the parts that a film computes, by what each changes.
film           Force and pressure of such a film, between discs and under a sphere.
face           The same on a face of any shape, by Reynolds' equation on a grid.
correction     Correction of an estimate by solutions on a grid, over gap and rate of shear.
limits         The same where its pressure is truncated.
table          Table of a force over the logarithms of gap and speed.
prepared_film  The film as tables, for a motion.
heating        Temperature rise of the film, its number.
validity       Ranges of the laws, what is left out.
"""
