"""Rheology of liquids: viscosity over pressure and shear, density over pressure.

pressure  Viscosity over pressure: Barus, Roelands.
shear     Viscosity over the rate of shear: power law, Carreau-Yasuda, Eyring.
density   Density over pressure: Dowson and Higginson.
"""
