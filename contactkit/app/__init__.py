"""What the command line runs: opens a scene, runs it, measures its cost, writes files and figures.

scenes      Opening a scene by file or by name, and what the command line does with each kind.
report      Numbers with units, text and files that a command leaves.
run         Running a scene: report, files and figures.
cost        Work and precision of a scene: error against time.
system      A valve and its film as one system structure (SSP 1.0).
crosscheck  Reference files beside native FMUs, in the format of the FMI cross-check.
"""
