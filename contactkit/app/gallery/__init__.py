"""The gallery: every figure and table of the source, computed again and judged.

page     What a page states: its claim and verdict, checks and tables.
scripts  Finding the scripts of pages, and the code that a computation reaches.
run      Running pages on all cores, with their data kept.
report   Files of a page and of the index.
"""
