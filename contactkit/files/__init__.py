"""Scenes and results in files.

scenes           Scene files in TOML: read completely, or refused with all errors.
toml_lines       Lines of a TOML file on which its keys stand, for messages.
structure        Tables of plain values to scene objects.
meniscus_amount  Amount of liquid that a file gives by a contact radius, or by a coverage, at a gap.
schema           JSON Schema of scene files, by which editors complete and check them.
parameter_texts  Texts of the parameters in docstrings, for tables and editors.
unstructure      Scene objects to tables of plain values, and the names of their kinds in files.
csv_rows         Rows of CSV files, without formulas.
results          Result files: npz with a JSON header, and CSV.
deforming_results
                 Results of deforming bodies as arrays and a header, and back.
curves           Saved curves: columns with their units, numbers and sources, and back.
surfaces         Surfaces and maps of results as topographies, alone and in containers.
contact_results  Contact results as arrays and a header of plain values, and back.
"""
