"""Reports on liquid bridges: exact, circular approximation and as published.

errors  How far the arc and the printed forces are off the exact bridge, on the way to rupture.
run     Liquid bridges by their closures: how far the arc and the printed equations are off.
"""
