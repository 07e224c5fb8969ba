"""Figures; the only room that imports matplotlib.

style       Style of all figures: colours, axes, legends, panel letters, saving.
axis_units  Units of axes: those in which a quantity of some size reads best, and labels.
accessors   Figures of results as methods: ``result.plot``.
maps        Maps over the window of a contact.
contact     Figures of contacts: pressure, areas, sections, layers.
stress      Stress below a contact: sections to scale, with the maximum marked.
view3d      Surface, pressure and stress in three dimensions, through pyvista.
explore     A map with sections that follow the mouse, and a slider over depth.
slip        Partial slip and stick-slip.
plastic_history Loading histories: force over approach, residual depth.
viscoelastic Viscoelastic contacts: load, approach and area over time; load over approach.
adhesion    Load and area over the approach of contacts under adhesion.
load_displacement Load-displacement curves: first loading and unloading.
roughness   Rough surfaces: area over load beside theories, spectra, patches.
separation  Separations and slidings: gap and forces, cycles, reference scales.
deforming   Separations of deforming bodies: loop, gaps, sections, energies.
film        Films on faces: pressure, liquid fraction; animations.
curves      Any curves of a result along one axis.
study       Studies: numbers over a parameter, bands over seeds.
fit         Fits: data and model, residuals, information, correlations.
tornado     Tornado figures: which assumption moves a quantity.
gradient    Slopes over heights and parameters; Sobol' indices.
cost        Error over seconds.
gallery     Figures of the gallery: bands over seeds, colour bars, files for print.
"""
