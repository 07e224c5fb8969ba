"""Running a scene from the command line: its numbers, files and figures.

separation   A separation scene.
contact      A contact scene, and the studies of its file.
sliding      A sliding scene.
bridges      Errors of the closures of liquid bridges on the way to rupture.
injector     The fuel injector, co-simulated over its firing cycles.
micromirror  The digital micromirror, co-simulated over its flips.
"""
