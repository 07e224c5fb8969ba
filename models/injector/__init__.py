"""The fuel injector: coil, valve and the monolithic model.

coil               An electromagnet with two poles and a moving armature: flux, current, force and e
monolithic         Spool, film and coil solved as one system, by another method than `contactkit.mot
monolithic_result  What a monolithic simulation gives: curves, events and a summary of each firing c
valve              A spool valve drawn off its end cap by an electromagnet: coil, spring, stop and d
"""
