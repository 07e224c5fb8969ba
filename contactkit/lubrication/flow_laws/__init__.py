"""Flow laws: shear, pressure and slip of the liquid in a thin film, and what a squeezed film does.

base           FlowLaw: flux between parallel walls from the pressure gradient, and its inverse.
gap_flow       Flow between two walls from two half films; roots.
newtonian      Newtonian liquid.
power_law      Power law, with the Newtonian plateau if it has one.
eyring         Eyring's thermally activated flow.
carreau        Carreau and Yasuda: a bend from plateau to power law.
pressure_laws  Viscosity over pressure: Barus, Roelands.
density        Density over pressure: Dowson and Higginson.
walls          Walls of an axisymmetric film: flats, paraboloid, any profile; rim at a volume.
squeeze        Pressure and force of a squeezed axisymmetric film of any law.
closed_forms   Squeezed films in closed form: Scott, Barus, Vinogradova.
on_grid        Squeezed film of any law on any face, in 2-D.
unit_flow      Force of such a film, estimated from the flux of a Newtonian one.
heating        Temperature rise of a film by its own shear.
"""
