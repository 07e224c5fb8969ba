"""Running the digital micromirror from the command line.

cosimulation   Co-simulation with an FMU of the spring tips on each side.
landing_sites  Impacts of spring tips on rough landing sites.
report         Adhesion, release and flips; signals in files, figures.
figures        Side view, flips, lift-off, release and force law.
sketch         Side view of the mirror to scale, and of one tip with its meniscus.
"""
