"""Running the digital micromirror from the command line.

cosimulation   Co-simulation of the micromirror with an FMU of its spring tips on each side.
deformation    Whether tips and sites deform: by the meniscus at rest, and at lift-off.
landing_sites  Impacts of spring tips on rough landing sites: numbers of a run for the report.
run            Report of a run of the micromirror: adhesion, release, flips; signals and figures.
figures        The micromirror's figures: its side view, the flips, the lift-off, release and force
               law.
sketch         Side view of a micromirror: the whole to scale, and one tip with its meniscus.
cost           Work-precision of the lift-off of a micromirror.
"""
