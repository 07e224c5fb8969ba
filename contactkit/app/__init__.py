"""What the command line runs: opens a scene, runs it, writes its report and figures.

contact         Running a contact scene from the command line: its numbers, files and figures.
end_stop        What rough faces of a stop or a landing did in a run: words and numbers for the repo
fmu_crosscheck  Reference files beside native FMUs, in the format of the FMI cross-check.
fmu_system      The valve and its film as one system structure (SSP 1.0), for masters that read thos
report          What a run leaves behind.
scenes          Opening a scene by file or by name, and running it: plain separations and devices al
sliding         Running a sliding scene from the command line: its report, files and figure.
"""
