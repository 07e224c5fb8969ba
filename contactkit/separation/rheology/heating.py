"""Temperature rise of a squeezed film: adiabatic, or with heat that leaves through the walls."""
