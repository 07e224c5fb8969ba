"""Running the comparison of closures of liquid bridges from the command line.

run   Report of liquid bridges: errors of their closures against the exact bridge, in bands of gaps.
cost  Work-precision of the closures of a liquid bridge: exact, arc, as published.
"""
