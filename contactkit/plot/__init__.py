"""Figures; the only room that imports matplotlib.

separation  Figures of separations and costs; axes, legends and colours of all figures.
axis_units  Units of axes: those in which a quantity of some size reads best.
contact     Figures of contacts.
study       Figures of studies: numbers over a parameter, bands over seeds.
plastic_history Figures of loading histories: force over approach, residual depth.
stress      Figures of stress below a contact: sections to scale, with the maximum marked.
roughness   Figures of rough surfaces: area over load beside theories, spectra, patches.
adhesion    Load and area over the approach of contacts under adhesion.
slip        Figures of partial slip and of stick-slip.
gallery     Figures of the gallery: one style for print, series, bands over seeds.
film        Figures of films on faces; animations.
"""
