"""One wetted surface sliding past another.

effects  The physics of a sliding: the drag of the film, and contact lines that stick.
plan     A sliding scene made ready to run: what will be simulated can be read before it is.
result   What a sliding gives: forces over the travel, numbers, and how well they can be trusted.
run      Sliding of which the motion is given: forces at a speed, the impulse within a time.
"""
