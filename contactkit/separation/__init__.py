"""Separation of wetted surfaces: plan, simulate, result.

columns         The curves of a separation: the one table from which files, plots and results take n
constant_force  Time that a constant pull takes to open the film of a plan, for a massless body.
errata          What is wrong with the printed equations a scene takes, at its start, with the right
film            The forces of a scene made ready to be called: of the film, and of the solids beside
parts           What single effects did in a separation, as a result gives it by `of`.
plan            A scene made ready to run: what will be simulated can be read before it is.
prescribed      Separations of which the motion is given: forces at a speed, the impulse within a ti
results         What a separation gives: curves, numbers, and how well they can be trusted.
simulate        Run a plan: the curve of a speed, the impulse of a time, or the motion under a pull.
validity        Whether each model stayed inside its range: numbers printed with every result.
vibration       An opening at an imposed speed while the gap vibrates: forces over the cycles, and t
"""
