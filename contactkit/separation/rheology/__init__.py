"""Films of liquids whose viscosity depends on pressure and shear, and which slip.

choice    What a film computes of the rheology of its liquid, by what each part changes.
film      Force and pressure of such a film, as its force law.
limits    The same film where its liquid cavitates.
validity  Ranges of the laws, what is left out, the temperature rise of the film.
"""
