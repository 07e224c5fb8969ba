"""Scenes and results in files.

contact_results  Contact results as arrays and a header of plain values, and back.
results          Result files: npz with a JSON header, and CSV. Never half a file.
scenes           Scene files: TOML, read whole or refused with every reason.
structure        Tables of plain values to nouns and back: quantities by their units, kinds by their
unstructure      Nouns to tables of plain values, and the names that their kinds have there.
"""
