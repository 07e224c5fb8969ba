"""Liquids and their properties as functions of temperature.

liquid            Liquid: surface tension, viscosity, density, constant or by a law; rheology.
temperature_laws  Temperature laws: base class, linear laws.
viscosity         Viscosity laws of Walther (ASTM D341) and Vogel.
temperature_table Properties at equally spaced temperatures, for kernels in C and JavaScript.
water             Surface tension and density of water.
rheology          Viscosity over pressure and shear, density over pressure.
"""
