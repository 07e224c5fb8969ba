"""Results as objects of other packages.

contents  Quantities over named axes, with units and labels.
datasets  Datasets of xarray.
frames    Data frames of pandas.
html      Tables and lists as HTML.
lines     A description in lines, as text and pages show it, and rows of a table as text.
pages     Pages of HTML that hold all they show.
report    Report of a run of the command line, and the FMU that holds a scene.
"""
