"""The fuel injector: its file, coil, valve and monolithic model.

scene       The file of a fuel injector: film and spool, the valve, the temperatures of a study.
coil        An electromagnet with two poles and a moving armature: flux, current, force, energy.
valve       A spool valve: coil, return spring, end stop and voltage profile.
monolithic  Monolithic model of spool, film and coil; its curves, events and firing cycles.
"""
