"""Running the fuel injector from the command line.

cosimulation  Co-simulation by two FMUs, each run beside its monolithic solution.
cycles        Firing cycles: release delays, impulses and forces of each.
end_stop      Impacts of the spool on rough faces of its end stop.
report        Table, signals in files, figures.
figures       Gaps, forces and release delays.
"""
