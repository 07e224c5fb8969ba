"""Work-precision: error against time for every kind of scene.

bridges           What each closure of a liquid bridge costs, and what it gets wrong: exact, arc, as
contact           What accuracy costs in a contact: over tolerance and grid, by solver, and by effec
coupling          What each way of coupling the film of the injector to its spool costs, and where i
coupling_figure   The picture of all ways of coupling: error against steps and seconds, and where ea
coupling_schemes  Every way of coupling a mass to a film, on three films: harmless, stiff, and very
effects           What each effect of a contact adds to its cost.
micromirror       What accuracy costs in time, for the lift-off of a micromirror.
separation        What accuracy costs in time, for the scenes of the command line.
"""
