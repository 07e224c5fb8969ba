"""The fuel injector on the command line.

figures  The injector's figures, drawn for a valve engineer: gaps in um, times in ms, forces in N.
report   What the injector's co-simulations come to: a table, signals in files, figures.
run      The fuel injector: a spool valve held by an oil film, co-simulated over its firing cycles.
"""
