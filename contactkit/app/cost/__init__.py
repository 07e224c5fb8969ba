"""Work and precision of every kind of scene: error against time.

report       Table, numbers, advice, picture and CSV file.
separation   A separation under an imposed force: error of the release time.
contact      A contact, over tolerance and grid, by solver and by effect.
effects      What each effect of a contact adds to its cost.
bridges      The closures of a liquid bridge: exact, circular approximation, as published.
injector     The fuel injector: solvers, couplings, steps and closures.
coupling     Coupling schemes of a mass and a film, on three films.
micromirror  The lift-off of a micromirror.
"""
