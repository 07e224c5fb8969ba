"""The fuel injector: its file, coil, valve and monolithic model.

scene       The file of a fuel injector: film and spool, the valve that pulls, and what they are
            run at.
coil        An electromagnet with two poles and a moving armature: flux, current, force and energy.
valve       A spool valve drawn off its end cap by an electromagnet: coil, spring, stop and drive.
monolithic  Monolithic model of spool, film and coil, by another method than
            `contactkit.separation.motion`.
torn_pieces  Cavity of the film in a monolithic simulation: its equation, its events, its memory.
"""
