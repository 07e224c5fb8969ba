"""Separation at an imposed speed with a vibration of the gap.

run     Forces over the cycles, and their mean.
path    Gap over time, and panels along a cycle.
cycles  Impulses of each cycle, and their sum over a run of which some cycles are computed.
curves  Curves over the cycles, computed when asked for.
cavity  Film that cavitates, over the cycles.
"""
