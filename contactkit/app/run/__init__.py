"""Running a scene from the command line: its numbers, files and figures.

separation   Running a separation scene from the command line: its numbers, files and figures.
contact      Running a contact scene from the command line: its numbers, files and figures.
sliding      Running a sliding scene from the command line: its report, files and figure.
study        Running the study of a scene file: tables, files with all columns, and a figure.
bridges      Errors of the arc and the published forces against the exact bridge, up to its rupture.
injector     Running the fuel injector from the command line.
micromirror  Running the digital micromirror from the command line.
"""
