"""Work and precision of every kind of scene: error against time.

report       Report of a work-precision study: table, numbers, advice, picture and CSV file.
separation   Work and precision of a separation under an imposed force: error of the release time.
contact      Work-precision of a contact over tolerance and grid, by solver and by effect.
effects      Cost of each effect of a contact.
bridges      Work-precision of the closures of a liquid bridge: exact, arc, as published.
injector     Work and precision of the fuel injector: solvers, couplings, steps and closures.
coupling     Coupling schemes of a mass and a film, on three films: non-stiff, stiff, and very
             stiff.
micromirror  Work-precision of the lift-off of a micromirror.
"""
