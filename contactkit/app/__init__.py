"""Runs of the command line: a scene opened, simulated and measured, with files and figures.

scenes       Opening a scene by file or by name, and what the command line does with it.
check        All mistakes of a scene file, of fields and of physics.
plugin       Own kinds from a Python file.
settings     Values that the command line sets over those of a scene.
listing      Lists of scenes, liquids, materials and effects.
templates    Commented scene files to begin with.
output       Output folders: what contactkit wrote there, and for which scene.
cite         Works to cite for a scene, a result file or an output folder.
report_page  One page of HTML about a result: figures, numbers, validity, plan, sources.
run          Running a scene of any kind: its plan and result in words, files of numbers, figures.
study        Running the study of a scene file: a table, files with all columns, and a figure.
fit          Fitting a scene to a measured curve of a CSV file: report, files, figures.
live_page    Live page of a scene that the command line opened.
scene_fmu    FMU that holds a scene, by its kind, and the start values to bake in.
gallery      Every figure and table of the source, computed again and judged.
fmu_files    FMU files as the command line orders them.
system       Valve and film as a system structure (SSP 1.0), for masters that read those.
crosscheck   Reference files beside native FMUs, in the format of the FMI cross-check.
"""
