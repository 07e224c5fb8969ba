"""The cavity of a film between flats in C: its memory, edge, force, events and paths."""
