"""Running the fuel injector from the command line.

cosimulation  Co-simulation of the fuel injector by two FMUs, each run beside its monolithic
              solution.
cycles        Firing cycles of the fuel injector: release delays, impulses and forces of each.
deformation   Whether end cap and spool deform: the number, and the release with and without.
end_stop      Impacts of the spool on rough faces of its end stop: numbers of a run for the report.
run           Report of the fuel injector's co-simulations: table, signals in files, figures.
figures       Figures of the fuel injector: gaps in um, times in ms, forces in N.
delay_figures  Release delays of the fuel injector over what its oil does: figures by the monolithic
              model.
cost          Work and precision of the fuel injector: solvers, couplings, steps and closures.
coupling      Coupling schemes of a mass and a film, on three films: non-stiff, stiff, and very
              stiff.
"""
