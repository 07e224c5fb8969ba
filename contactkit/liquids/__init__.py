"""A liquid and its properties over temperature.

liquid            Liquids: surface tension, viscosity and density, as constants or as laws of temper
temperature_laws  Laws of temperature: how viscosity, surface tension and density of a liquid follow
viscosity         Viscosity as a function of temperature: the laws of Walther and of Vogel.
water             Water: its surface tension and its density as functions of temperature.
"""
