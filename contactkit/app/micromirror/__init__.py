"""The digital micromirror on the command line.

figures  The micromirror's figures: its side view, the flips, the lift-off, release and force law.
report   What a run of the micromirror comes to: adhesion, release, the flips, in words and numbers.
run      The digital micromirror: whether it lets go of its landing sites, and by which pulse.
sketch   Side view of a micromirror: the whole to scale, and one tip with its meniscus.
"""
