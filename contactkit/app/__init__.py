"""Runs of the command line: a scene opened, simulated and measured, with files and figures.

scenes       Opening a scene by file or by name, and what the command line does with each kind.
settings     Values that the command line sets over those of a scene.
listing      Lists of scenes, liquids, materials and effects.
templates    Commented scene files to begin with.
report       Report of a run.
output       Output folders: what contactkit wrote there, and for which scene.
report_page  One page of HTML about a result: figures, numbers, validity, plan, sources.
run          Running a scene from the command line: its numbers, files and figures.
gallery      Every figure and table of the source, computed again and judged.
cost         Work and precision of every kind of scene: error against time.
fmu_files    FMU files as the command line orders them.
system       Valve and film as a system structure (SSP 1.0), for masters that read those.
crosscheck   Reference files beside native FMUs, in the format of the FMI cross-check.
"""
